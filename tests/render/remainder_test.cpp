// Pixels that show more surfaces than are told apart.
#include <doctest/doctest.h>

#include <cmath>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

/// Balls as small as pixels on the ground: sides of many directions in each pixel. Every other one
/// is black.
Scene make_pebbles(float ground) {
    std::vector<Mesh> meshes = {make_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 0)};
    for (int i = 0; i < 24; ++i)
        for (int j = 0; j < 24; ++j)
            meshes.push_back(make_sphere({-1.2f + 0.1f * float(i), 0.04f, -1.2f + 0.1f * float(j)},
                                         0.04f, 6, false, (i + j) % 2 ? 1u : 2u));
    Scene scene = make_scene(meshes, {lambert(ground), lambert(0.6f), lambert(0)});
    scene.film = {24, 24};
    scene.camera = {.position = {0, 9, 6}, .target = {0, 0, 0}, .vertical_fov_rad = 0.15f};
    scene.rect_lights = {
        {.center = {1, 4, 0}, .edge_u = {1, 0, 0}, .edge_v = {0, 0, 1}, .radiance = {30, 20, 10}}};
    return scene;
}

/// Of green over the image, over seeds, as a share of the truth. Guarded filters would leave it to
/// plain sampling where the remainder is wrong.
double brightness(const Scene& scene, int bounces, float mu = 1, int seeds = 6) {
    double sum = 0;
    for (int seed = 0; seed < seeds; ++seed) {
        RenderOptions options = filtered(mu, uint32_t(seed));
        options.bounces = bounces;
        options.filter = FilterMode::plain;
        sum += channel_mean(render(scene, options).image, "G");
    }
    const Image truth = render(scene, quick(4096, bounces, Sampler::lattice, 9)).image;
    return sum / seeds / channel_mean(truth, "G");
}

TEST_CASE("what_pixels_show_beyond_three_surfaces_is_not_lost") {
    for (int bounces : {0, 1})
        for (float ground : {0.0f, 0.5f}) {
            CAPTURE(bounces);
            CAPTURE(ground);
            CHECK(brightness(make_pebbles(ground), bounces) ==
                  doctest::Approx(1).epsilon(0.002).scale(1e-9));
        }
}

TEST_CASE("what_meets_nothing_is_no_remainder") {
    Scene scene = make_pebbles(0);
    scene.instances.erase(scene.instances.begin());  // the ground: there is nothing between pebbles
    scene.film = {8, 8};
    CHECK(brightness(scene, 0, 1, 16) == doctest::Approx(1).epsilon(0.004).scale(1e-9));
}

TEST_CASE("remainders_that_few_paths_have_met_are_not_dark") {
    CHECK(brightness(make_pebbles(0), 0, 0.25f) == doctest::Approx(1).epsilon(0.004).scale(1e-9));
}

TEST_CASE("light_that_is_not_filtered_stays_in_pixels_of_many_surfaces") {
    // Only what the sky sends is filtered; points shine straight on the same pebbles.
    Scene scene = make_pebbles(0.5f);
    scene.rect_lights.clear();
    scene.background = Vec3(0.3f);
    scene.point_lights = {{.position = {1, 4, 0}, .intensity = Vec3(30)}};
    // Of what is filtered a per cent is missing: the ground is as dark as it is hidden.
    CHECK(brightness(scene, 0) == doctest::Approx(1).epsilon(0.008).scale(1e-9));
}

}  // namespace
}  // namespace wedge::test
