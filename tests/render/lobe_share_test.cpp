// Surfaces of which a part alone has a lobe, or a diffuse part.
#include <doctest/doctest.h>

#include <cmath>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

constexpr int kSize = 32;

Material glossy(float diffuse, float specular, float exponent) {
    Material m = lambert(diffuse);
    m.specular = Vec3(specular);
    m.exponent = exponent;
    m.model = SpecularModel::blinn_phong;
    return m;
}

/// A plane seen from above, on which two materials alternate, three stripes of each to four pixels,
/// under a sky that is the same everywhere.
Scene stripes(const Material& a, const Material& b) {
    const float side = 2, stripe = side / (6 * kSize / 4);
    std::vector<Mesh> meshes;
    for (int i = 0; i < 6 * kSize / 4; ++i)
        meshes.push_back(make_quad({-1 + stripe * float(i), 0, -1}, {0, 0, side}, {stripe, 0, 0},
                                   uint32_t(i % 2)));
    Scene scene = make_scene(std::move(meshes), {a, b});
    scene.background = Vec3(1);
    scene.film = {kSize, kSize};
    // All that it sees is striped.
    scene.camera = {.position = {0, 2, 0},
                    .target = {0, 0, 0},
                    .up = {0, 0, -1},
                    .vertical_fov_rad = 2 * std::atan(0.5f)};
    return scene;
}

struct Compared {
    double bias, rmse;  // over the mean of what is right
};

/// Light from the sky, filtered everywhere, beside path tracing with many samples.
Compared compare(const Scene& scene) {
    const Image truth = render(scene, quick(4096, 0)).image;
    RenderOptions options = filtered(1);
    options.filter = FilterMode::plain;
    const Image image = render(scene, options).image;
    const double mean = channel_mean(truth, "G");
    return {(channel_mean(image, "G") - mean) / mean, channel_rmse(image, truth, "G") / mean};
}

TEST_CASE("a_lobe_on_a_part_of_each_pixel_reflects_all_that_it_should") {
    // A third of the light is the lobe's: half of it was missing.
    const Compared c = compare(stripes(glossy(0.4f, 0.4f, 20), lambert(0.4f)));
    CHECK(std::abs(c.bias) < 0.005);
    CHECK(c.rmse < 0.03);
}

TEST_CASE("where_a_part_of_each_pixel_has_a_lobe_alone_diffuse_light_is_told_by_the_rest") {
    // What a ray of the lobe tells of it has no variance that is finite.
    const Compared c = compare(stripes(glossy(0.8f, 0.2f, 50), glossy(0, 0.2f, 50)));
    CHECK(std::abs(c.bias) < 0.01);
    CHECK(c.rmse < 0.05);
}

}  // namespace
}  // namespace wedge::test
