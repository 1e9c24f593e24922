// Shadows on what does not face the lamp.
#include <doctest/doctest.h>

#include <cmath>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

/// A wall with bars before it, under a lamp that faces down, `aside` of the wall.
Scene make_wall(float aside) {
    std::vector<Mesh> meshes{make_quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 0)};
    for (int i = 0; i < 8; ++i)
        meshes.push_back(
            make_quad({-2, -0.8f + 0.23f * float(i), 0.1f}, {4, 0.1f, 0}, {0, 0, 0.04f}, 0));
    Scene scene = make_scene(meshes, {lambert(0.7f)});
    scene.film = {48, 36};
    scene.camera = {
        .position = {0, 0, 6}, .target = {0, 0, 0}, .vertical_fov_rad = 2 * std::atan(0.8f / 6)};
    scene.rect_lights = {{.center = {0, 3, aside},
                          .edge_u = {0.6f, 0, 0},
                          .edge_v = {0, 0, 0.6f},
                          .radiance = Vec3(20),
                          .profile = LightProfile::uniform}};
    return scene;
}

/// Of filters everywhere, as a share of the mean of the image.
double error_on_wall(float aside, float mu) {
    const Scene scene = make_wall(aside);
    const Image truth = render(scene, quick(2048, 0, Sampler::lattice, 9)).image;
    RenderOptions options = filtered(mu);
    options.filter = FilterMode::plain;
    return rmse(render(scene, options).image, truth) / channel_mean(truth, "G");
}

// Down the wall shadows move along the rays of the lamp, though no place is farther from them in a
// plane parallel to it.
TEST_CASE("shadows_on_walls_are_as_sharp_as_they_are") {
    for (const float aside : {0.31f, 0.5f, 1.0f, 3.0f}) {
        CAPTURE(aside);
        CHECK(error_on_wall(aside, 4) < 0.02);
    }
}

}  // namespace
}  // namespace wedge::test
