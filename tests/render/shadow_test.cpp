// Axis-aligned filtering of soft shadows: the bandwidth as a function, and images.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

#include "kernel_harness.hpp"
#include "test_scenes.hpp"

namespace wedge::test {
namespace {

TEST_CASE("shadow_bandwidth_is_that_of_the_thesis") {
    SamplingKernels kernels;
    std::vector<float4> in;
    for (float s_min : {0.01f, 0.3f, 2.0f, 50.0f})
        for (float ratio : {1.0f, 1.7f, 20.0f})
            for (float sigma : {1e-4f, 0.3f, 1e4f})
                for (float pixel : {1e-6f, 0.02f, 3.0f})
                    in.push_back({s_min, s_min * ratio, sigma, pixel});
    for (float mu : {0.5f, 2.0f, 8.0f}) {
        const double alpha = 1, k = 3;
        const auto found = kernels.shadow_bandwidth(in, {mu, float(alpha), float(k), 0});
        for (std::size_t i = 0; i < in.size(); ++i) {
            const double s_min = in[i].x, s_max = in[i].y, sigma = in[i].z, d = in[i].w;
            // Eqs. 3.13 and 3.21, with A_p = d^2 and A_l = (2 sigma)^2.
            const double width = std::max(sigma * s_min, d * (1 + s_min) / alpha) / (k * mu);
            const double area_p = d * d, area_l = 4 * sigma * sigma;
            const double n =
                4 * std::pow(1 + mu * s_max / s_min, 2) *
                std::pow(mu * 2 / s_min * std::sqrt(area_p / area_l) + alpha / (1 + s_min), 2);
            CHECK(found[i].x == doctest::Approx(width).epsilon(1e-5));
            CHECK(found[i].y == doctest::Approx(n).epsilon(1e-4));
        }
    }
}

TEST_CASE("shadow_bandwidth_has_the_limits_of_the_theory") {
    SamplingKernels kernels;
    // mu without bound: no filter. A point light: shadows as sharp as pixels, filtered no wider.
    CHECK(kernels.shadow_bandwidth({{1, 1, 0.5f, 0.01f}}, {1e6f, 1, 3, 0})[0].x < 1e-6f);
    CHECK(kernels.shadow_bandwidth({{1, 1, 1e-9f, 0.01f}}, {1, 1, 3, 0})[0].x ==
          doctest::Approx(0.02 / 3));
    // One occluder depth and small pixels: 4 (1 + mu)^2 / (1 + s)^2 samples.
    CHECK(kernels.shadow_bandwidth({{1, 1, 1, 1e-9f}}, {2, 1, 3, 0})[0].y == doctest::Approx(9));
}

/// A square that floats between a large lamp and the ground: wide penumbrae.
Scene make_penumbra(LightProfile profile) {
    Scene scene = make_scene({make_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 0),
                              make_quad({-0.5f, 1, -0.5f}, {0, 0, 1}, {1, 0, 0}, 0)},
                             {lambert(0.7f)});
    scene.film = {64, 48};
    scene.camera = {.position = {0, 2.5f, 5}, .target = {0, 0, 0}, .vertical_fov_rad = 0.7f};
    scene.rect_lights = {{.center = {0.3f, 3, 0},
                          .edge_u = {1, 0, 0},
                          .edge_v = {0, 0, 1},
                          .radiance = Vec3(8),
                          .profile = profile,
                          .sigma = 0.3f}};
    return scene;
}

RenderOptions filtered(float mu, uint32_t seed = 0) {
    RenderOptions options;
    options.bounces = 0;
    options.method = Method::aaf;
    options.mu = mu;
    options.seed = seed;
    return options;
}

double rmse(const Image& a, const Image& b) {
    double sum = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) sum += std::pow(a.at(x, y, 1) - b.at(x, y, 1), 2);
    return std::sqrt(sum / (double(a.width) * a.height));
}

TEST_CASE("light_without_occluders_is_not_touched") {
    for (LightProfile profile : {LightProfile::uniform, LightProfile::gaussian}) {
        Scene scene = make_penumbra(profile);
        scene.instances.pop_back();
        const Image truth = render(scene, quick(512, 0, Sampler::sobol, 9)).image;
        const Image image = render(scene, filtered(1)).image;
        CHECK(channel_mean(image, "G") == doctest::Approx(channel_mean(truth, "G")).epsilon(1e-3));
        // Visibility is exactly one; what is left is the noise of the unshadowed light.
        CHECK(rmse(image, truth) < 0.02 * channel_mean(truth, "G"));
    }
}

TEST_CASE("filtered_shadows_converge_with_mu") {
    for (LightProfile profile : {LightProfile::uniform, LightProfile::gaussian}) {
        const Scene scene = make_penumbra(profile);
        const Image truth = render(scene, quick(2048, 0, Sampler::sobol, 9)).image;
        double previous = 1e9;
        for (float mu : {0.25f, 1.0f, 4.0f}) {
            const double error = rmse(render(scene, filtered(mu)).image, truth);
            CAPTURE(mu);
            CHECK(error < 0.8 * previous);
            previous = error;
        }
        CHECK(previous < 0.02 * channel_mean(truth, "G"));
    }
}

TEST_CASE("filtered_shadows_need_fewer_samples") {
    const Scene scene = make_penumbra(LightProfile::gaussian);
    const Image truth = render(scene, quick(4096, 0, Sampler::sobol, 9)).image;
    const Frame frame = render(scene, filtered(1));
    const double samples = channel_mean(frame.image, "spp");
    const int same = int(std::ceil(samples));
    const double plain = rmse(render(scene, quick(same, 0)).image, truth);
    CHECK(rmse(frame.image, truth) < 0.8 * plain);
}

TEST_CASE("other_lights_gloss_and_bounces_stay_right_beside_filtered_shadows") {
    Scene scene = make_room(20);
    scene.film = {40, 32};
    scene.point_lights = {{.position = {0.5f, 0.8f, 0.3f}, .intensity = {0.3f, 0.5f, 0.8f}}};
    scene.materials[1].emission = {0.5f, 0.1f, 0.1f};
    const Image truth = render(scene, quick(1024, 1, Sampler::sobol, 9)).image;
    RenderOptions options = filtered(4);
    options.bounces = 1;
    const Image image = render(scene, options).image;
    for (const char* channel : {"direct.R", "direct.B", "indirect.G", "emission.G"})
        CHECK(channel_mean(image, channel) ==
              doctest::Approx(channel_mean(truth, channel)).epsilon(0.01));
}

TEST_CASE("a_large_lamp_over_gloss_is_counted_once") {
    // So near that rays which happen to meet the lamp matter as much as those sent to it.
    Material shiny = lambert(0.4f);
    shiny.specular = Vec3(0.4f);
    shiny.exponent = 20;
    shiny.model = SpecularModel::phong;
    Scene scene = make_scene({make_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 0)}, {shiny});
    scene.film = {32, 24};
    scene.camera = {.position = {0, 0.3f, 1.5f}, .target = {0, 0, 0}, .vertical_fov_rad = 0.5f};
    scene.rect_lights = {{.center = {0, 0.7f, 0}, .edge_u = {2, 0, 0}, .edge_v = {0, 0, 2}}};
    const Image truth = render(scene, quick(1024, 0, Sampler::sobol, 9)).image;
    const Image image = render(scene, filtered(4)).image;
    CHECK(channel_mean(image, "direct.G") ==
          doctest::Approx(channel_mean(truth, "direct.G")).epsilon(0.01));
}

TEST_CASE("filtered_images_do_not_depend_on_work_groups_or_tiles") {
    const Scene scene = make_penumbra(LightProfile::uniform);
    const Image reference = render(scene, filtered(1)).image;
    for (uint32_t tile : {100u, 100000u}) {
        RenderOptions options = filtered(1);
        options.tile_pixels = tile;
        options.local_size = 16;
        const Image image = render(scene, options).image;
        CHECK(std::memcmp(image.pixels.data(), reference.pixels.data(),
                          image.pixels.size() * sizeof(float)) == 0);
    }
}

}  // namespace
}  // namespace wedge::test
