// The filters to compare with, on made-up layers.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "bench/baselines/denoise.hpp"
#include "tests/bench/approx.hpp"

using namespace wedge;
using namespace wedge::baselines;

namespace {

constexpr int kSide = 48;
constexpr double kPixelAngle = 0.01;
constexpr Filter kAll[] = {Filter::gaussian, Filter::bilateral, Filter::atrous, Filter::nlm,
                           Filter::svgf};
constexpr Filter kEdgeAware[] = {Filter::bilateral, Filter::atrous, Filter::svgf};

/// A wall at distance 1 (on the right half: at `right_distance`), `light` times a chequered
/// texture, with noise of this variance in the light.
Image wall(double variance, unsigned seed, double left_light = 1, double right_light = 1,
           double right_distance = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, std::sqrt(variance));
    Image image{kSide,
                kSide,
                {"R", "G", "B", "emission.R", "emission.G", "emission.B", "albedo.R", "albedo.G",
                 "albedo.B", "variance.R", "variance.G", "variance.B", "N.X", "N.Y", "N.Z", "Z",
                 "P.X", "P.Y", "P.Z"},
                {},
                {}};
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const bool right = x >= kSide / 2;
            const double albedo = (x + y) % 2 ? 0.8 : 0.2, z = right ? right_distance : 1;
            const double radiance = albedo * ((right ? right_light : left_light) + noise(random));
            const double v = albedo * albedo * variance;
            for (double value :
                 {radiance, radiance, radiance, 0.0, 0.0, 0.0, albedo, albedo, albedo, v, v, v, 0.0,
                  0.0, 1.0, z, z * kPixelAngle * x, z * kPixelAngle * y, -z})
                image.pixels.push_back(float(value));
        }
    return image;
}

Denoised apply(Denoiser& denoiser, Filter filter, const Image& noisy, const Image& other) {
    return denoiser.apply(filter, noisy, needs_halves(filter) ? &other : nullptr, kPixelAngle);
}

/// Mean of (light - expected)^2 over the columns [from, to).
double light_error(const Image& image, int from, int to, double expected) {
    double sum = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = from; x < to; ++x) {
            const double albedo = (x + y) % 2 ? 0.8 : 0.2;
            sum += std::pow(double(image.at(x, y, 0)) / albedo - expected, 2);
        }
    return sum / (kSide * (to - from));
}

}  // namespace

TEST_CASE("filters_leave_even_light_on_a_texture_as_it_is") {
    Denoiser denoiser("", "");
    const Image clean = wall(0, 1);
    for (const Filter filter : kAll) {
        CAPTURE(int(filter));
        const Denoised out = apply(denoiser, filter, clean, clean);
        CHECK(light_error(out.image, 0, kSide, 1) < 1e-10);
        CHECK(out.wall_s > 0);
        CHECK(out.pass.launches > 0);
    }
}

TEST_CASE("filters_remove_most_noise_from_a_flat_wall") {
    Denoiser denoiser("", "");
    constexpr double kVariance = 0.01;
    const Image noisy = wall(kVariance, 1), other = wall(kVariance, 2);
    for (const Filter filter : kAll) {
        CAPTURE(int(filter));
        const Denoised out = apply(denoiser, filter, noisy, other);
        CHECK(light_error(out.image, 0, kSide, 1) < 0.15 * kVariance);
    }
    // A Gaussian of 2 px leaves 1 / (4 pi sigma^2) of the variance; the border is left out.
    const Denoised out = apply(denoiser, Filter::gaussian, noisy, other);
    CHECK(light_error(out.image, 8, kSide - 8, 1) ==
          test::close_to(kVariance / (16 * 3.14159265), 0.35));
}

TEST_CASE("edge_aware_filters_do_not_mix_light_across_a_step_in_depth") {
    Denoiser denoiser("", "");
    const Image noisy = wall(0.01, 1, 1, 5, 2), other = wall(0.01, 2, 1, 5, 2);
    for (const Filter filter : kEdgeAware) {
        CAPTURE(int(filter));
        const Denoised out = apply(denoiser, filter, noisy, other);
        CHECK(light_error(out.image, kSide / 2 - 2, kSide / 2, 1) < 0.01);
        CHECK(light_error(out.image, kSide / 2, kSide / 2 + 2, 5) < 0.01);
    }
    const Denoised mixed = apply(denoiser, Filter::gaussian, noisy, other);
    CHECK(light_error(mixed.image, kSide / 2 - 2, kSide / 2, 1) > 1);
}

TEST_CASE("filters_guided_by_variance_keep_edges_of_light") {
    Denoiser denoiser("", "");
    const Image noisy = wall(0.01, 1, 1, 3), other = wall(0.01, 2, 1, 3);
    for (const Filter filter : {Filter::nlm, Filter::svgf}) {
        CAPTURE(int(filter));
        const Denoised out = apply(denoiser, filter, noisy, other);
        CHECK(light_error(out.image, kSide / 2 - 2, kSide / 2, 1) < 0.02);
        CHECK(light_error(out.image, kSide / 2, kSide / 2 + 2, 3) < 0.02);
    }
}
