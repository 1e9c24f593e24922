// The samplers' points against what their definitions promise.
#include <doctest/doctest.h>

#include <cmath>

#include "kernel_harness.hpp"
#include "statistics.hpp"
#include "wedge/shared/frame.h"

namespace wedge::test {
namespace {

constexpr int kSamplers[] = {WEDGE_SAMPLER_HASH, WEDGE_SAMPLER_SOBOL, WEDGE_SAMPLER_STRATIFIED,
                             WEDGE_SAMPLER_LATTICE};

constexpr uint32_t kFilmDimension = 0;  // WEDGE_DIMENSION_FILM

/// True if every box of 2^-a x 2^-(m - a) holds exactly one of the 2^m points, for all a: a (0, m,
/// 2)-net.
bool is_net(const std::vector<float2>& points, int m) {
    if (points.size() != std::size_t(1) << m) return false;
    for (int a = 0; a <= m; ++a) {
        std::vector<int> hits(points.size(), 0);
        for (const float2& p : points) {
            const auto column = std::size_t(std::ldexp(p.x, a));
            const auto row = std::size_t(std::ldexp(p.y, m - a));
            if (++hits[(row << a) + column] > 1) return false;
        }
    }
    return true;
}

/// Every second one, from the first or the second on.
std::vector<float2> every_second(const std::vector<float2>& points, std::size_t first) {
    std::vector<float2> half;
    for (std::size_t i = first; i < points.size(); i += 2) half.push_back(points[i]);
    return half;
}

void append(std::vector<float2>& all, const std::vector<float2>& points) {
    all.insert(all.end(), points.begin(), points.end());
}

TEST_CASE("sobol_points_of_a_pixel_are_a_net") {
    SamplingKernels kernels;
    for (uint32_t dimension : {0u, 1u, 7u})
        for (uint32_t pixel : {0u, 1u, 12345u, 0xffffffffu})
            for (int m : {0, 1, 2, 3, 4, 5, 6, 10})
                CHECK(is_net(
                    kernels.points(WEDGE_SAMPLER_SOBOL, 3, 1, pixel, 0, dimension, 1u << m), m));
}

TEST_CASE("aligned_stretches_of_sobol_points_are_nets") {
    SamplingKernels kernels;
    for (int m : {2, 4, 6})
        for (uint32_t first : {0u, 64u, 960u})
            CHECK(is_net(kernels.points(WEDGE_SAMPLER_SOBOL, 9, 1, 77, first, 2, 1u << m), m));
}

TEST_CASE("halves_are_nets_that_know_nothing_of_each_other") {
    SamplingKernels kernels;
    const auto points = [&](uint32_t pixel, int m) {
        return kernels.points(WEDGE_SAMPLER_SOBOL, 5, 2, pixel, 0, 4, 2u << m);
    };
    for (int m : {2, 3, 4, 7})
        for (std::size_t half : {0, 1}) {
            CHECK(is_net(every_second(points(77, m), half), m));
            std::vector<float2> all;
            for (uint32_t i = 0; i < 16; ++i) append(all, every_second(points(48 + i, m), half));
            CHECK(is_net(all, m + 4));
        }
    CHECK_FALSE(is_net(points(77, 4), 5));
}

TEST_CASE("places_in_a_pixel_are_of_one_sequence_however_many_they_become") {
    SamplingKernels kernels;
    const auto places = [&](uint32_t pixel, uint32_t first, uint32_t count) {
        return kernels.points(WEDGE_SAMPLER_SOBOL, 5, 2, pixel, first, kFilmDimension, count);
    };
    for (uint32_t pixel : {0u, 77u, 0xffffffffu})
        for (int m : {2, 3, 4, 6}) CHECK(is_net(places(pixel, 0, 1u << m), m));
    // Neighbours look at places of their own.
    CHECK(places(77, 0, 1)[0].x != places(78, 0, 1)[0].x);
    CHECK(places(0, 0, 1)[0].x != places(0x80000000u, 0, 1)[0].x);
}

TEST_CASE("first_sobol_points_of_a_block_of_pixels_are_a_net_however_many_they_are") {
    SamplingKernels kernels;
    for (uint32_t block : {0u, 3u, 0x2aau, 0x3ffffffu})
        for (int m : {2, 3, 4, 5})          // 4 to 32 samples a pixel
            for (int pixels : {2, 4, 6}) {  // over 2x2, 4x4, 8x8 pixels
                std::vector<float2> all;
                for (uint32_t i = 0; i < 1u << pixels; ++i)
                    append(all, kernels.points(WEDGE_SAMPLER_SOBOL, 5, 1, (block << pixels) + i, 0,
                                               4, 1u << m));
                CHECK(is_net(all, m + pixels));
            }
}

TEST_CASE("samples_in_the_place_of_one_are_those_that_would_follow") {
    SamplingKernels kernels;
    const auto same = [](const std::vector<float2>& a, const std::vector<float2>& b) {
        bool all = a.size() == b.size();
        for (std::size_t i = 0; all && i < a.size(); ++i)
            all = a[i].x == b[i].x && a[i].y == b[i].y;
        return all;
    };
    for (int kind : {WEDGE_SAMPLER_SOBOL, WEDGE_SAMPLER_LATTICE})
        for (uint32_t parts : {1u, 2u, 4u})
            CHECK(same(kernels.parts(kind, 5, 1, 77, parts, 4, 32),
                       kernels.points(kind, 5, 1, 77, 0, 4, 32)));
    // Strata are as many more, and one sample is in each.
    CHECK(same(kernels.parts(WEDGE_SAMPLER_STRATIFIED, 5, 1, 77, 2, 4, 32, 16),
               kernels.points(WEDGE_SAMPLER_STRATIFIED, 5, 1, 77, 0, 4, 32, 32)));
    // Halves of the samples have their own.
    const auto halves = kernels.parts(WEDGE_SAMPLER_SOBOL, 5, 2, 77, 2, 4, 32);
    const auto single = kernels.points(WEDGE_SAMPLER_SOBOL, 5, 2, 77, 0, 4, 32);
    std::vector<float2> first;
    for (std::size_t i = 0; i < halves.size(); i += 4) append(first, {halves[i], halves[i + 1]});
    CHECK(same(first, every_second(single, 0)));
    const auto independent = kernels.parts(WEDGE_SAMPLER_HASH, 5, 1, 77, 2, 4, 2);
    CHECK(independent[0].x != independent[1].x);
}

/// Chi-square over its degrees of freedom, of the coarse cells of two dimensions that the first
/// samples of a block of pixels fall into: 1 for independent pairs.
double pairing_excess(SamplingKernels& kernels, uint32_t a, uint32_t b, uint32_t samples) {
    constexpr uint32_t kPixels = 64, kSeeds = 40, kSide = 4, kCells = kSide * kSide;
    double sum = 0;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        std::vector<double> hits(kCells, 0.0);
        for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
            const auto p = kernels.points(WEDGE_SAMPLER_SOBOL, seed, 1, pixel, 0, a, samples);
            const auto q = kernels.points(WEDGE_SAMPLER_SOBOL, seed, 1, pixel, 0, b, samples);
            for (std::size_t i = 0; i < p.size(); ++i)
                hits[std::size_t(p[i].x * kSide) * kSide + std::size_t(q[i].x * kSide)] += 1;
        }
        const double expected = double(kPixels * samples) / kCells;
        for (double h : hits) sum += (h - expected) * (h - expected) / expected;
    }
    // Rows and columns are even by themselves.
    return sum / (kSeeds * (kSide - 1) * (kSide - 1));
}

// Dimensions whose points go together would leave noise that neighbours share. Two pixels or
// samples next to each other in a tree stay so in all of its shuffles: that alone makes up to 2 of
// it.
TEST_CASE("sobol_dimension_pairs_of_neighbouring_pixels_are_paired_at_random") {
    SamplingKernels kernels;
    for (uint32_t samples : {1u, 4u, 8u})
        for (uint32_t b : {2u, 3u, 4096u}) {
            const double excess = pairing_excess(kernels, 1, b, samples);
            CAPTURE(samples);
            CAPTURE(b);
            CAPTURE(excess);
            CHECK(excess < 2);
        }
}

TEST_CASE("strata_hold_one_sample_each") {
    SamplingKernels kernels;
    struct Grid {
        uint32_t strata, columns, rows;
    };
    for (const Grid& grid : {Grid{1, 1, 1}, {9, 3, 3}, {16, 4, 4}, {28, 5, 5}, {1000, 31, 32}})
        for (uint32_t dimension : {0u, 5u})
            for (uint32_t first : {0u, grid.strata}) {
                std::vector<int> hits(grid.columns * grid.rows, 0);
                int twice = 0;
                for (const float2& p : kernels.points(WEDGE_SAMPLER_STRATIFIED, 3, 1, 17, first,
                                                      dimension, grid.strata, grid.strata)) {
                    const auto column = std::size_t(p.x * float(grid.columns));
                    const auto row = std::size_t(p.y * float(grid.rows));
                    twice += ++hits[row * grid.columns + column] > 1;
                }
                // Those that do not fit the grid fall anywhere.
                CHECK(twice == int(grid.strata - grid.columns * grid.rows));
            }
}

TEST_CASE("strata_of_two_dimensions_are_paired_at_random") {
    SamplingKernels kernels;
    // The columns of two dimension pairs, over many pixels: all combinations alike (chi-square).
    constexpr uint32_t kSide = 4, kStrata = kSide * kSide;
    std::vector<double> observed(kSide * kSide, 0.0);
    for (uint32_t pixel = 0; pixel < 400; ++pixel) {
        const auto a =
            kernels.points(WEDGE_SAMPLER_STRATIFIED, 1, 1, pixel, 0, 2, kStrata, kStrata);
        const auto b =
            kernels.points(WEDGE_SAMPLER_STRATIFIED, 1, 1, pixel, 0, 3, kStrata, kStrata);
        for (std::size_t i = 0; i < a.size(); ++i)
            observed[std::size_t(a[i].x * kSide) * kSide + std::size_t(b[i].x * kSide)] += 1;
    }
    const std::vector<double> expected(observed.size(), 400.0 * kStrata / double(observed.size()));
    CHECK(chi_square_p_value(observed, expected) > 1e-4);
}

/// Of the share of a pixel's samples that fall into a disc, over pixels: mean squared error over
/// that of independent samples, p (1 - p) / n.
double disc_error(SamplingKernels& kernels, uint32_t first, uint32_t count) {
    constexpr uint32_t kPixels = 200;
    constexpr double kRadius = 0.4, kArea = 3.14159265358979 * kRadius * kRadius;
    double sum = 0;
    for (uint32_t pixel = 0; pixel < kPixels; ++pixel) {
        int inside = 0;
        for (const float2& p :
             kernels.points(WEDGE_SAMPLER_LATTICE, 1, 1, pixel, first, pixel % 7, count))
            inside += std::hypot(p.x - 0.5, p.y - 0.5) < kRadius;
        const double error = inside / double(count) - kArea;
        sum += error * error;
    }
    return sum / kPixels / (kArea * (1 - kArea) / count);
}

// At an edge the variance of evenly spread points falls with n^-3/2.
TEST_CASE("lattice_points_find_an_area_sooner_than_independent_ones") {
    SamplingKernels kernels;
    const double few = disc_error(kernels, 0, 256), many = disc_error(kernels, 0, 4096);
    CHECK(few < 0.2);
    CHECK(many < 0.4 * few);
    // Wherever an aligned stretch begins, and for numbers that are no powers of two.
    CHECK(disc_error(kernels, 1280, 256) < 1.5 * few);
    CHECK(disc_error(kernels, 0, 1000) < 0.2);
}

TEST_CASE("seeds_pixels_and_dimensions_give_different_points") {
    SamplingKernels kernels;
    for (int sampler : kSamplers) {
        const float2 p = kernels.points(sampler, 1, 1, 10, 0, 0, 1)[0];
        for (const float2& q : {kernels.points(sampler, 2, 1, 10, 0, 0, 1)[0],
                                kernels.points(sampler, 1, 1, 11, 0, 0, 1)[0],
                                kernels.points(sampler, 1, 1, 10, 0, 1, 1)[0],
                                kernels.points(sampler, 1, 1, 10, 64, 0, 1)[0]})
            CHECK((p.x != q.x || p.y != q.y));
    }
}

TEST_CASE("points_are_uniform_over_the_square") {
    SamplingKernels kernels;
    constexpr int kSide = 32;
    for (int sampler : kSamplers) {
        std::vector<double> observed(kSide * kSide, 0.0);
        // One sample each of many pixels of different seeds: for Sobol, its scrambling alone.
        const uint32_t count = 100;
        for (uint32_t seed = 0; seed < 200; ++seed) {
            const uint32_t samples = sampler == WEDGE_SAMPLER_HASH ? count : 1;
            for (uint32_t i = 0; i < (sampler == WEDGE_SAMPLER_HASH ? 1 : 20); ++i)
                for (const float2& p :
                     kernels.points(sampler, seed, 1, i * 977, 0, seed % 5, samples)) {
                    REQUIRE((p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1));
                    observed[int(p.y * kSide) * kSide + int(p.x * kSide)] += 1;
                }
        }
        double total = 0;
        for (double o : observed) total += o;
        const std::vector<double> expected(observed.size(), total / double(observed.size()));
        CHECK(chi_square_p_value(observed, expected) > 1e-4);
    }
}

TEST_CASE("dimension_pairs_are_not_correlated") {
    SamplingKernels kernels;
    constexpr uint32_t kCount = 1u << 14;
    for (int sampler : {WEDGE_SAMPLER_HASH, WEDGE_SAMPLER_SOBOL, WEDGE_SAMPLER_LATTICE})
        for (uint32_t dimension = 1; dimension < 6; ++dimension) {
            const auto a = kernels.points(sampler, 1, 1, 5, 0, 0, kCount);
            const auto b = kernels.points(sampler, 1, 1, 5, 0, dimension, kCount);
            double sum = 0;
            for (uint32_t i = 0; i < kCount; ++i) sum += (a[i].x - 0.5) * (b[i].x - 0.5);
            // Standard deviation of the correlation of independent pairs: 1 / sqrt(n).
            CHECK(std::abs(12 * sum / kCount) < 4.5 / std::sqrt(double(kCount)));
        }
}

}  // namespace
}  // namespace wedge::test
