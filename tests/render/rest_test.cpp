// Light beside that which is filtered: its samples, and its error.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "filter_scenes.hpp"
#include "wedge/shared/filter.h"

namespace wedge::test {
namespace {

/// No shadows; but a highlight, which is not filtered.
Scene make_highlight() {
    Material shiny = lambert(0.3f);
    shiny.specular = Vec3(0.4f);
    shiny.exponent = 40;
    shiny.model = SpecularModel::phong;
    Scene scene = make_scene({make_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 0)}, {shiny});
    scene.film = {48, 32};
    scene.camera = {.position = {0, 1, 3}, .target = {0, 0, 0}, .vertical_fov_rad = 0.6f};
    scene.rect_lights = {
        {.center = {0, 1.5f, -2}, .edge_u = {1, 0, 0}, .edge_v = {0, 0, 1}, .radiance = Vec3(9)}};
    return scene;
}

TEST_CASE("light_that_is_not_filtered_gets_its_samples") {
    // Filters ask for none, but the highlight is noise.
    const Image image = render(make_highlight(), filtered(1)).image;
    std::vector<double> samples = channel_values(image, "spp");
    std::sort(samples.begin(), samples.end());
    CHECK(samples.front() == WEDGE_LIGHT_PROBES);
    CHECK(samples.back() >= 4 * WEDGE_LIGHT_PROBES);
    CHECK(samples[samples.size() / 4] == WEDGE_LIGHT_PROBES);  // only there
}

/// Points of light, which are not filtered, over a ground.
Scene make_candles() {
    Scene scene = make_scene({make_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 0)}, {lambert(0.7f)});
    for (int i = 0; i < 16; ++i)
        scene.point_lights.push_back({.position = {0.2f * float(i % 4), 1.5f, 0.2f * float(i / 4)},
                                      .intensity = Vec3(0.1f * float(1 + i % 5))});
    scene.film = {32, 24};
    scene.camera = {.position = {0, 2.5f, 5}, .target = {0, 0, 1}, .vertical_fov_rad = 0.5f};
    return scene;
}

TEST_CASE("light_that_is_not_filtered_is_drawn_from_one_sequence") {
    // As good as path tracing; with one for each half the error is a third larger.
    const Scene scene = make_candles();
    const Image truth = render(scene, quick(1024, 1, Sampler::lattice, 9)).image;
    double squares = 0, plain = 0;
    for (uint32_t seed = 0; seed < 4; ++seed) {
        RenderOptions options = filtered(1, seed);
        options.bounces = 1;
        options.adaptive = false;
        options.samples_per_pixel = 64;
        squares += std::pow(channel_rmse(render(scene, options).image, truth, "direct.G"), 2);
        const Image image = render(scene, quick(64, 1, Sampler::sobol, seed)).image;
        plain += std::pow(channel_rmse(image, truth, "direct.G"), 2);
    }
    CHECK(std::sqrt(squares / plain) < 1.2);
}

TEST_CASE("error_of_light_that_is_not_filtered_is_told") {
    const Scene scene = make_highlight();
    const Image truth = render(scene, quick(1024, 1, Sampler::lattice, 9)).image;
    for (float mu : {0.5f, 4.0f}) {
        double told = 0, squares = 0;
        for (uint32_t seed = 0; seed < 4; ++seed) {
            RenderOptions options = filtered(mu, seed);
            options.bounces = 1;
            const Frame frame = render(scene, options);
            told += std::pow(frame.stats.estimated_error->rmse, 2);
            squares += std::pow(rmse(frame.image, truth), 2);
        }
        CAPTURE(mu);
        CHECK(std::sqrt(told / squares) > 0.6);
        CHECK(std::sqrt(told / squares) < 1.3);
    }
}

}  // namespace
}  // namespace wedge::test
