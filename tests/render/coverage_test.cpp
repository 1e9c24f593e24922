// Noise of where in a pixel paths look.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "kernel_harness.hpp"

namespace wedge::test {
namespace {

/// x: grey colour, y: irradiance, which is one for all rays that meet a surface.
using Rays = std::vector<shared::float4>;

/// Variance of what is reflected, from ray to ray.
double variance_of(const Rays& rays) {
    double sum = 0, squares = 0;
    for (const shared::float4& r : rays) {
        sum += double(r.x) * double(r.y);
        squares += std::pow(double(r.x) * double(r.y), 2);
    }
    const auto n = double(rays.size());
    return squares / n - std::pow(sum / n, 2);
}

void check_noise(const Rays& rays, uint32_t each) {
    SamplingKernels kernels;
    const double variance = variance_of(rays), n = double(rays.size());
    for (const uint32_t paths : {2u, 5u}) {
        const double truth = variance * (1 / double(paths) - 1 / n);
        CHECK(double(kernels.coverage_noise(rays, each, paths)) ==
              doctest::Approx(truth).epsilon(1e-4).scale(1e-9));
    }
    CHECK(kernels.coverage_noise(rays, each, uint32_t(n)) == 0.0f);
}

TEST_CASE("light_that_differs_between_surfaces_makes_noise_of_coverage") {
    Rays rays;
    for (const auto& [colour, irradiance] : {std::pair(0.5f, 2.0f), {0.8f, 0.0f}, {0.2f, 7.0f}})
        rays.insert(rays.end(), 2, {colour, irradiance, 0, 0});
    check_noise(rays, 2);
}

TEST_CASE("colours_inside_surfaces_make_noise_of_coverage") {
    Rays rays;
    for (const float colour : {0.9f, 0.0f, 0.1f, 0.4f}) rays.push_back({colour, 2, 0, 0});
    for (const float colour : {0.3f, 0.3f, 0.0f, 1.0f}) rays.push_back({colour, 5, 0, 0});
    check_noise(rays, 4);
}

TEST_CASE("one_surface_of_one_colour_has_no_noise_of_coverage") {
    SamplingKernels kernels;
    CHECK(double(kernels.coverage_noise(Rays(16, {0.7f, 3, 0, 0}), 16, 2)) < 1e-5);
}

}  // namespace
}  // namespace wedge::test
