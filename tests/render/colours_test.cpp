// Light that is filtered where colours change inside pixels.
#include <doctest/doctest.h>

#include <cmath>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

TEST_CASE("black_parts_of_a_surface_do_not_darken_the_rest") {
    // Stripes, black and grey, narrower than pixels, under a white sky. Paths end where they meet
    // black, which says nothing about the light there.
    std::vector<Mesh> meshes;
    for (uint32_t i = 0; i < 200; ++i)
        meshes.push_back(
            make_quad({-2 + 0.02f * float(i), 0, -2}, {0, 0, 4}, {0.02f, 0, 0}, i % 2));
    Scene scene = make_scene(meshes, {lambert(0), lambert(0.8f)});
    scene.film = {16, 16};
    scene.background = Vec3(1);
    scene.camera = {
        .position = {0, 50, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .vertical_fov_rad = 0.04f};
    for (FilterMode mode : {FilterMode::guarded, FilterMode::plain}) {
        RenderOptions options = filtered(1);
        options.filter = mode;
        CHECK(channel_mean(render(scene, options).image, "G") ==
              doctest::Approx(0.4).epsilon(0.01).scale(1e-9));
    }
}

/// Stripes of two colours, narrower than pixels. The sun stands at 45 degrees, and slats that the
/// camera does not see hide it from those of the second colour.
struct Stripes {
    Scene scene;
    double irradiance;  ///< of what is in the sun
};

Stripes half_shaded_stripes(const Vec3& lit, const Vec3& shaded) {
    constexpr float width = 0.02f, height = 4, far = 1000;
    constexpr float shrink = 1 - height / far;  // light that is not quite parallel
    std::vector<Mesh> meshes;
    for (int i = -100; i < 100; ++i) {
        const float x = width * float(i);
        meshes.push_back(make_quad({x, 0, -2}, {0, 0, 4}, {width, 0, 0}, i & 1));
        if (i & 1)
            meshes.push_back(
                make_quad({x * shrink + height, height, -2}, {0, 0, 4}, {width * shrink, 0, 0}, 0));
    }
    Scene scene = make_scene(meshes, {Material{.diffuse = lit}, Material{.diffuse = shaded}});
    scene.film = {16, 16};
    scene.camera = {
        .position = {0, 50, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .vertical_fov_rad = 0.04f};
    const float side = 0.02f, radiance = 2.5e9f;
    scene.rect_lights = {{.center = {far, far, 0},
                          .edge_u = {0, 0, side},
                          .edge_v = {-side, side, 0},
                          .radiance = Vec3(radiance)}};
    const double area = double(side) * side * std::sqrt(2.0);
    return {scene, radiance * area * std::sqrt(0.5) / (2.0 * far * far)};
}

TEST_CASE("light_that_goes_with_colours_inside_pixels_is_kept") {
    const auto [scene, irradiance] = half_shaded_stripes(Vec3(0.8f), Vec3(0.1f));
    for (FilterMode mode : {FilterMode::guarded, FilterMode::plain}) {
        RenderOptions options = filtered(4);
        options.filter = mode;
        CHECK(channel_mean(render(scene, options).image, "G") ==
              doctest::Approx(0.5 * 0.8 / double(kPi) * irradiance).epsilon(0.01).scale(1e-9));
    }
}

TEST_CASE("shadows_have_the_hue_of_what_they_fall_on") {
    // Orange stripes in the sun, blue ones in the shade: blue light that is reflected is a quarter
    // of the orange ones' red.
    const auto [scene, irradiance] = half_shaded_stripes({0.8f, 0.4f, 0.2f}, {0.1f, 0.3f, 0.7f});
    for (FilterMode mode : {FilterMode::guarded, FilterMode::plain})
        for (float mu : {1.0f, 4.0f}) {
            RenderOptions options = filtered(mu);
            options.filter = mode;
            const Image image = render(scene, options).image;
            const double unit = 0.5 / double(kPi) * irradiance;
            CAPTURE(mu);
            CHECK(channel_mean(image, "R") ==
                  doctest::Approx(0.8 * unit).epsilon(0.05 / mu).scale(1e-9));
            CHECK(channel_mean(image, "G") ==
                  doctest::Approx(0.4 * unit).epsilon(0.05 / mu).scale(1e-9));
            CHECK(channel_mean(image, "B") ==
                  doctest::Approx(0.2 * unit).epsilon(0.05 / mu).scale(1e-9));
        }
}

TEST_CASE("shadows_on_a_pixels_other_surfaces_have_hues_too") {
    // A white beam high above the middle of each row of pixels: stripes are the second surface of
    // many.
    Scene scene = half_shaded_stripes({0.8f, 0.4f, 0.2f}, {0.1f, 0.3f, 0.7f}).scene;
    scene.materials.push_back(lambert(0.5f));
    for (int row = -8; row < 8; ++row) {
        scene.meshes.push_back(
            make_quad({-2, 10, 0.1f * (float(row) + 0.3f)}, {0, 0, 0.04f}, {4, 0, 0}, 2));
        scene.instances.push_back({.mesh = uint32_t(scene.meshes.size() - 1)});
    }
    const Image truth = render(scene, quick(1024, 0)).image;
    RenderOptions options = filtered(4);
    options.filter = FilterMode::plain;
    const Image image = render(scene, options).image;
    for (const char* channel : {"R", "G", "B"})
        CHECK(channel_mean(image, channel) ==
              doctest::Approx(channel_mean(truth, channel)).epsilon(0.02).scale(1e-9));
}

}  // namespace
}  // namespace wedge::test
