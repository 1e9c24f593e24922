// Axis-aligned filtering: widths, sample counts and weights, as functions.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "host/render/stages.hpp"
#include "kernel_harness.hpp"
#include "test_scenes.hpp"
#include "wedge/shared/scene.h"

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
            CHECK(found[i].x == doctest::Approx(width).epsilon(1e-5).scale(1e-9));
            CHECK(found[i].y == doctest::Approx(n).epsilon(1e-4).scale(1e-9));
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

TEST_CASE("indirect_bandwidth_is_that_of_the_thesis") {
    SamplingKernels kernels;
    std::vector<float4> in;
    for (float z_min : {1e-3f, 0.2f, 30.0f})
        for (float ratio : {1.0f, 3.0f, 50.0f})
            for (float band : {2.8f, 5.28f})
                for (float pixel : {1e-5f, 0.01f, 2.0f})
                    in.push_back({z_min, z_min * ratio, band, pixel});
    for (float mu : {0.5f, 0.9f, 4.0f}) {
        const double alpha = 0.3, share = 0.4;
        const auto found = kernels.indirect_bandwidth(in, {mu, float(alpha), float(share), 0});
        for (std::size_t i = 0; i < in.size(); ++i) {
            const double z_min = in[i].x, z_max = in[i].y, band = in[i].z, d = in[i].w;
            // Eqs. 4.15 and 4.18; the width as 1 / (2 Omega_x) (docs/filtering.md).
            const double omega_x = mu * std::min(band / z_min, alpha / d);
            const double n = share * std::pow(mu * band * d / z_min + alpha, 2) * band * band *
                             std::pow(1 + mu * z_max / z_min, 2);
            CHECK(found[i].x == doctest::Approx(0.5 / omega_x).epsilon(1e-5).scale(1e-9));
            CHECK(found[i].y == doctest::Approx(n).epsilon(1e-4).scale(1e-9));
        }
    }
}

TEST_CASE("indirect_bandwidth_has_the_limits_of_the_theory") {
    SamplingKernels kernels;
    // mu without bound: no filter. A reflector at one depth: replicas (1 + mu) apart.
    CHECK(kernels.indirect_bandwidth({{1, 2, 2.8f, 0.01f}}, {1e6f, 0.3f, 0.4f, 0})[0].x < 1e-5f);
    CHECK(kernels.indirect_bandwidth({{1, 1, 2, 1e-9f}}, {1, 0.5f, 1, 0})[0].y ==
          doctest::Approx(0.25 * 4 * 4));
    // The papers' numbers: Blinn-Phong 20 has band 5.28 and a share of 0.11 to 0.12.
    const auto lobe = kernels.lobe_bands({{20, 0, 0, 0}}, WEDGE_MODEL_BLINN_PHONG)[0];
    CHECK(lobe.x == doctest::Approx(3.6 + 0.084 * 20));
    CHECK(lobe.y == doctest::Approx(std::acos(std::pow(std::sqrt(0.5), 0.05)) / (kPi / 2)));
    CHECK(kernels.lobe_bands({{20, 0, 0, 0}}, WEDGE_MODEL_PHONG)[0].x == doctest::Approx(7.27));
}

TEST_CASE("samples_that_are_granted_go_with_a_power_of_what_is_asked_for") {
    SamplingKernels kernels;
    // mu, asked: who asks for 64 sqrt(mu) gets them, who asks for 32 times as many four times.
    const auto granted = kernels.samples_granted(
        {{1, 64, 0, 0}, {4, 128, 0, 0}, {1, 2048, 0, 0}, {1, 2, 0, 0}, {1, 0, 0, 0}});
    CHECK(granted[0] == doctest::Approx(64).epsilon(1e-4).scale(1e-9));
    CHECK(granted[1] == doctest::Approx(128).epsilon(1e-4).scale(1e-9));
    CHECK(granted[2] == doctest::Approx(256).epsilon(1e-4).scale(1e-9));
    CHECK(granted[3] == doctest::Approx(16).epsilon(1e-4).scale(1e-9));
    CHECK(granted[4] == 0);
}

// Shadows move along the rays from the light: what counts is the distance parallel to it, from
// where the ray through the first place is as far away as the other.
TEST_CASE("filter_weights_are_gaussians_of_the_distance_that_the_light_sees") {
    SamplingKernels kernels;
    const float4 up{0, 1, 0, 0};
    const float pixel = 0.01f;
    // The first is the one that is filtered; w: width.
    const std::vector<float4> places = {{0, 0, 0, 0.5f},       {0.3f, 0, 0.4f, 0.5f},
                                        {0.3f, 0, 0.4f, 0.2f}, {0.3f, 0, 0.4f, 2},
                                        {1, 0, 1.2f, 0.5f},    {0.1f, 0, 0, 9}};
    const std::vector<float4> normals(places.size(), up);
    const float4 tilted{float(std::sin(0.4)), float(std::cos(0.4)), 0, 0};
    const float4 middle{0.5f, 2, -0.3f, 0};
    for (const float4& along : {float4{0, 0, 0, 0}, up, tilted}) {
        const std::vector<float> found =
            kernels.filter_weights(places, normals, along, middle, pixel);
        const auto away = [&](const float4& p) {
            return double(along.x * p.x + along.y * p.y + along.z * p.z);
        };
        for (std::size_t i = 0; i < places.size(); ++i) {
            const double step = away(middle) > 0 ? away(places[i]) / away(middle) : 0;
            const double r2 = std::pow(places[i].x - step * middle.x, 2) +
                              std::pow(places[i].y - step * middle.y, 2) +
                              std::pow(places[i].z - step * middle.z, 2);
            const double sigma = std::min(places[0].w, places[i].w);
            const double truth = r2 < 9 * sigma * sigma ? std::exp(-r2 / (2 * sigma * sigma)) : 0;
            CHECK(found[i] == doctest::Approx(truth).epsilon(1e-4).scale(1e-9));
        }
    }
}

TEST_CASE("surfaces_that_differ_have_no_weight_for_each_other") {
    SamplingKernels kernels;
    const float pixel = 0.01f;
    const auto turned = [](double degrees) {
        const double a = degrees * double(kPi) / 180;
        return float4{float(std::sin(a)), float(std::cos(a)), 0, 0};
    };
    // Nineteen degrees are one surface that is bent, 21 are two; so are levels more than half a
    // pixel apart, but for a slope of ten degrees.
    const std::vector<float4> places = {
        {0, 0, 0, 1},           {0.1f, 0, 0, 1},     {0.1f, 0, 0, 1},    {0.001f, 0.0045f, 0, 1},
        {0.001f, 0.007f, 0, 1}, {0.5f, 0.09f, 0, 1}, {0.5f, 0.12f, 0, 1}};
    const std::vector<float4> normals = {turned(0), turned(19), turned(21), turned(0),
                                         turned(0), turned(0),  turned(0)};
    const std::vector<float> w =
        kernels.filter_weights(places, normals, {0, 0, 0, 0}, {0, 0, 0, 0}, pixel);
    CHECK(w[1] > 0.05f);
    CHECK(w[1] < 0.15f);
    CHECK(w[2] == 0.0f);
    CHECK(w[3] > 0.9f);
    CHECK(w[4] == 0.0f);
    CHECK(w[5] > 0.8f);
    CHECK(w[6] == 0.0f);
    // Within a pixel as well; normals are looked at apart.
    const std::vector<float> levels = kernels.levels(places, pixel);
    for (std::size_t i = 3; i < places.size(); ++i) CHECK((levels[i] > 0) == (w[i] > 0));
}

TEST_CASE("stages_hold_each_sample_of_each_pixel_once") {
    using shared::SampleEnds;
    const std::vector<SampleEnds> ends = {{8, 8},     {16, 16},  {8, 64},
                                          {100, 100}, {32, 512}, {8, 16}};
    std::vector<uint32_t> done(ends.size(), 8);
    for (const rendering::Stage& stage : rendering::cut_into_stages(ends, 8)) {
        bool camera_only = false;
        for (uint32_t i : stage.pixels) {
            const uint32_t end = std::max(ends[i].paths, ends[i].camera_rays);
            CHECK(done[i] == stage.first);
            CHECK(end > stage.first);
            done[i] = std::min(end, stage.end);
            // Whole paths come first: what is alike runs together.
            CHECK((!camera_only || ends[i].paths <= stage.first));
            camera_only = ends[i].paths <= stage.first;
        }
    }
    for (std::size_t i = 0; i < ends.size(); ++i)
        CHECK(done[i] == std::max(ends[i].paths, ends[i].camera_rays));
    CHECK(rendering::cut_into_stages(std::vector<SampleEnds>{{8, 8}}, 8).empty());
}

}  // namespace
}  // namespace wedge::test
