// Edges inside pixels, which no filter can help: camera rays look for them, and their error is
// told.
#include <doctest/doctest.h>

#include <cmath>

#include "filter_scenes.hpp"
#include "host/render/filter_settings.hpp"

namespace wedge::test {
namespace {

/// Stripes of two materials, `width` pixels each, on a ground that fills the film, under a lamp
/// that nothing hides.
Scene make_stripes(float width) {
    constexpr int kPixels = 32;
    Scene scene;
    std::vector<Mesh> stripes;
    const float step = 2 * width / kPixels;
    const auto count = int(std::ceil(3 / step));
    for (int i = 0; i < count; ++i)
        stripes.push_back(make_quad({-1.5f + step * float(i), 0, -1.5f}, {0, 0, 3}, {step, 0, 0},
                                    uint32_t(i % 2)));
    scene = make_scene(stripes, {lambert(0.9f), lambert(0.1f)});
    look_down_aslant(scene);
    return scene;
}

// A third of a pixel is as wide as any stripe is seen; their means over pixels are alike.
TEST_CASE("colours_inside_pixels_get_camera_rays") {
    const Scene scene = make_stripes(0.31f);
    const Image truth = render(scene, quick(8192, 0, Sampler::lattice, 9)).image;
    const Frame frame = render(scene, filtered(1));
    CHECK(channel_mean(frame.image, "spp") < 16);
    const double found = channel_rmse(frame.image, truth, "albedo.G");
    const double plain = channel_rmse(render(scene, quick(16, 0)).image, truth, "albedo.G");
    CAPTURE(found / plain);
    CHECK(found < 0.4 * plain);
}

constexpr float kDark = 0.01f, kLessDark = 0.02f;

/// Half of the film shows dark stripes among darker ones. Raised ones are edges of geometry, too.
Scene make_faint_edges(float raised) {
    Scene scene = make_stripes(3.7f);
    scene.materials = {lambert(0.9f), lambert(kDark), lambert(kLessDark)};
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const bool is_dark = i >= scene.meshes.size() / 2, is_odd = i % 2 > 0;
        scene.meshes[i].material_of.assign(2, is_dark ? 1 + is_odd : 0);
        if (is_dark && is_odd)
            for (Vec3& p : scene.meshes[i].positions) p.y += raised;
    }
    return scene;
}

/// Error of what they reflect in pixels that show both, over that of 16 samples.
double error_at_faint_edges(float raised) {
    const Scene scene = make_faint_edges(raised);
    const auto albedo = [](const Image& image) { return channel_values(image, "albedo.G"); };
    const auto truth = albedo(render(scene, quick(8192, 0, Sampler::lattice, 9)).image);
    double found_error = 0, plain_error = 0;
    for (uint32_t seed = 0; seed < 4; ++seed) {
        const auto found = albedo(render(scene, filtered(1, seed)).image);
        const auto plain = albedo(render(scene, quick(16, 0, Sampler::sobol, seed)).image);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            if (truth[i] < 1.01 * double(kDark) || truth[i] > 0.99 * double(kLessDark)) continue;
            found_error += std::pow(found[i] - truth[i], 2);
            plain_error += std::pow(plain[i] - truth[i], 2);
        }
    }
    REQUIRE(plain_error > 0);
    return std::sqrt(found_error / plain_error);
}

// The image would gain as much elsewhere, but they are all the error that there is near by.
TEST_CASE("faint_edges_get_camera_rays") {
    const double colours = error_at_faint_edges(0), steps = error_at_faint_edges(0.3f);
    CAPTURE(colours);
    CAPTURE(steps);
    CHECK(colours < 0.5);
    CHECK(steps < 0.3);
}

// As many as paths at most, which double from mu = 4 to 8.
TEST_CASE("faint_edges_of_geometry_keep_up_with_mu") {
    const auto rays = [](float mu) {
        return double(render(make_faint_edges(0.3f), filtered(mu)).stats.rays);
    };
    CHECK(rays(8) / rays(4) > 2);
}

// Eight samples of a pixel miss a strip that fills a tenth of it more often than not. Pixels next
// to it that show it tell.
TEST_CASE("what_the_probe_missed_is_looked_for_beside_edges") {
    Scene scene = make_stripes(100);
    scene.meshes.push_back(make_quad({-0.003f, 0.01f, -1.5f}, {0, 0, 3}, {0.006f, 0.02f, 0}, 0));
    scene.instances.push_back({.mesh = uint32_t(scene.meshes.size() - 1)});
    const Image truth = render(scene, quick(8192, 0, Sampler::lattice, 9)).image;
    double found = 0, plain = 0;
    for (uint32_t seed = 0; seed < 4; ++seed) {
        const Image image = render(scene, filtered(1, seed)).image;
        found += std::pow(channel_rmse(image, truth, "N.X"), 2);
        const Image sampled = render(scene, quick(16, 0, Sampler::sobol, seed)).image;
        plain += std::pow(channel_rmse(sampled, truth, "N.X"), 2);
    }
    CAPTURE(std::sqrt(found / plain));
    CHECK(found < 0.48 * 0.48 * plain);
}

// Beside the noise of paths that of edges falls faster the more rays look for it, so that a larger
// share of them would be spent in vain: by a power of 4/3 they would be 16 times as many.
TEST_CASE("camera_rays_grow_more_slowly_than_mu") {
    const Scene scene = make_stripes(0.31f);
    const double few = double(render(scene, filtered(1)).stats.rays);
    const double many = double(render(scene, filtered(8)).stats.rays);
    CAPTURE(many / few);
    CHECK(many / few > 4);
    CHECK(many / few < 9);
}

// The price of a path goes with its surfaces, and what is cheaper beside it pays more often: by the
// power 1 / 2.5, where the square of an edge's error falls with n^-1.5.
TEST_CASE("the_longer_paths_are_the_more_camera_rays_pay") {
    const Scene scene = make_stripes(0.31f);
    const auto rays = [&](int bounces) {
        RenderOptions options = filtered(1);
        options.bounces = bounces;
        return double(rendering::make_filter_settings(scene, options, 1).camera_rays_at_edges);
    };
    CHECK(rays(3) / rays(0) == doctest::Approx(std::pow(4, 1 / 2.5)).epsilon(0.01).scale(1e-9));
}

TEST_CASE("the_error_layer_tells_the_error_of_edges") {
    for (float width : {0.31f, 3.7f}) {
        const Scene scene = make_stripes(width);
        const Image truth = render(scene, quick(8192, 0, Sampler::lattice, 9)).image;
        for (float mu : {0.25f, 1.0f}) {
            double told = 0, found = 0;
            for (uint32_t seed = 0; seed < 4; ++seed) {
                const Image image = render(scene, filtered(mu, seed)).image;
                for (double e : channel_values(image, "error")) told += e * e / (32 * 32);
                found += std::pow(rmse(image, truth), 2);
            }
            CAPTURE(width);
            CAPTURE(mu);
            CAPTURE(std::sqrt(told / found));
            // Told as if there were one edge a pixel.
            CHECK(std::sqrt(told / found) > (width < 1 ? 0.3 : 0.7));
            CHECK(std::sqrt(told / found) < 1.4);
        }
    }
}

}  // namespace
}  // namespace wedge::test
