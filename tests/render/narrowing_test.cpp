// Widths of filters, by mu.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "filter_scenes.hpp"
#include "host/render/filter_settings.hpp"

namespace wedge::test {
namespace {

/// Median over pixels of a filter's width at mu = 1 over that at mu = 8.
double narrowing_to_8(const Scene& scene, const char* layer) {
    RenderOptions options = filtered(1);
    options.bounces = 1;
    const std::vector<double> wide = channel_values(render(scene, options).image, layer);
    options.mu = 8;
    const std::vector<double> narrow = channel_values(render(scene, options).image, layer);
    std::vector<double> ratios;
    for (std::size_t i = 0; i < wide.size(); ++i)
        if (wide[i] > 0 && narrow[i] > 0) ratios.push_back(wide[i] / narrow[i]);
    REQUIRE(ratios.size() > 100);
    std::nth_element(ratios.begin(), ratios.begin() + long(ratios.size() / 2), ratios.end());
    return ratios[ratios.size() / 2];
}

TEST_CASE("filters_narrow_by_roots_of_mu") {
    Scene room = make_room(0);
    room.film = {32, 24};
    CHECK(narrowing_to_8(room, "width.direct") ==
          doctest::Approx(std::sqrt(8)).epsilon(0.02).scale(1e-9));
    CHECK(narrowing_to_8(room, "width.indirect") == doctest::Approx(2).epsilon(0.02).scale(1e-9));
    const auto at_8 = rendering::make_filter_settings(room, filtered(8), 8);
    CHECK(at_8.narrowing_shadows == doctest::Approx(1.4 * std::sqrt(8)).scale(1e-9));
    CHECK(at_8.narrowing_diffuse == doctest::Approx(1.6).scale(1e-9));
    const auto at_eighth = rendering::make_filter_settings(room, filtered(0.125f), 0.125f);
    CHECK(at_eighth.narrowing_shadows == doctest::Approx(1.4 / std::pow(8, 0.25)).scale(1e-9));
    CHECK(at_eighth.narrowing_diffuse == doctest::Approx(0.4).scale(1e-9));
    Scene lit_by_mesh = make_scene(
        {make_box(Vec3(-1), Vec3(1), true, 0), make_sphere({0, 0.5f, -0.4f}, 0.2f, 8, false, 1)},
        {lambert(0.5f), lambert(0)});
    lit_by_mesh.materials[1].emission = Vec3(5);
    lit_by_mesh.film = {32, 24};
    lit_by_mesh.camera = {
        .position = {0, 0, 0.9f}, .target = {0.3f, -0.2f, -1}, .vertical_fov_rad = 1.4f};
    CHECK(narrowing_to_8(lit_by_mesh, "width.direct") ==
          doctest::Approx(std::sqrt(8)).epsilon(0.02).scale(1e-9));
}

/// Standard deviation of gloss under a ceiling, which filters take noise from, over its mean.
double noise_of_gloss(float mu) {
    Material shiny = lambert(0);
    shiny.specular = Vec3(0.8f);
    shiny.exponent = 20;
    shiny.model = SpecularModel::phong;
    Scene scene = make_scene({make_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 0),
                              make_quad({-2, 1, -2}, {4, 0, 0}, {0, 0, 4}, 1)},
                             {shiny, lambert(0.8f)});
    scene.background = Vec3(1);
    scene.film = {96, 96};
    scene.camera = {
        .position = {0, 0.9f, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .vertical_fov_rad = 1};
    RenderOptions options = filtered(mu);
    options.filter = FilterMode::plain;
    options.adaptive = false;
    options.samples_per_pixel = 16;
    options.sampler = Sampler::hash;
    options.bounces = 1;
    const auto first = channel_values(render(scene, options).image, "indirect.G");
    options.seed = 1;
    const auto second = channel_values(render(scene, options).image, "indirect.G");
    double square = 0, sum = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        square += 0.5 * std::pow(first[i] - second[i], 2);
        sum += 0.5 * (first[i] + second[i]);
    }
    return std::sqrt(square * double(first.size())) / sum;
}

TEST_CASE("filters_of_lobes_narrow_with_the_root_of_mu") {
    // Samples are as many: noise goes with one over the width.
    const double ratio = noise_of_gloss(32) / noise_of_gloss(4);
    CAPTURE(ratio);
    CHECK(ratio > 2.4);  // 2 with the cube root
    CHECK(ratio < 3.2);
}

}  // namespace
}  // namespace wedge::test
