// From the error of a stretch of pixels to that of each pixel and colour.
#include <doctest/doctest.h>

#include <cmath>
#include <tuple>

#include "host/render/told_error.hpp"

namespace wedge::test {
namespace {

using rendering::told_errors;
using shared::GuardedPixel;

constexpr int kWidth = 40, kHeight = 24;

std::vector<GuardedPixel> grey(float direct, float indirect) {
    GuardedPixel pixel{};
    pixel.direct = {direct, direct, direct, 0};
    pixel.indirect = {indirect, indirect, indirect, 0};
    return std::vector<GuardedPixel>(kWidth * kHeight, pixel);
}

TEST_CASE("alike_pixels_have_the_error_that_is_told") {
    std::vector<GuardedPixel> guarded = grey(2, 0.5f);
    for (GuardedPixel& pixel : guarded) {
        pixel.error = {0.01f, 0.02f, 0.03f, 0};
        pixel.measured = {0.01f, 0.02f, 0, 0};
    }
    for (const Vec3& error : told_errors(guarded, kWidth))
        for (int c = 0; c < 3; ++c)
            CHECK(error[c] == doctest::Approx(0.06).epsilon(1e-4).scale(1e-9));
}

TEST_CASE("dark_pixels_and_colours_have_the_same_share_of_their_light") {
    // Stripes of 1 and 0.1, twice as strong in green; told as a mean over both.
    std::vector<GuardedPixel> guarded = grey(0, 0);
    for (int i = 0; i < kWidth * kHeight; ++i) {
        GuardedPixel& pixel = guarded[std::size_t(i)];
        const float value = i % kWidth % 2 == 0 ? 1.0f : 0.1f;
        pixel.direct = {value, 2 * value, 0, 0};
        pixel.error.x = pixel.measured.x = 0.01f;
    }
    const std::vector<Vec3> errors = told_errors(guarded, kWidth);
    const std::size_t bright = 12 * kWidth + 20, dark = bright + 1;
    CHECK(errors[bright].x == doctest::Approx(100 * errors[dark].x).epsilon(0.25).scale(1e-9));
    CHECK(errors[bright].y == doctest::Approx(4 * errors[bright].x).epsilon(1e-4).scale(1e-9));
    CHECK(errors[bright].z == 0);
    double mean = 0;
    for (const Vec3& error : errors)
        mean += double(error.x + error.y + error.z) / 3 / double(errors.size());
    CHECK(mean == doctest::Approx(0.01).epsilon(0.1).scale(1e-9));
}

TEST_CASE("means_are_those_of_the_guard") {
    // One bright pixel, whose weight is 8 of 64 along a line of 15, and of 36 at the line's end.
    constexpr double kInside = 64.0 / 8, kAtEnd = 36.0 / 8;
    for (const auto& [x, y, share] : {std::tuple(0, 0, kAtEnd * kAtEnd),
                                      {20, 12, kInside * kInside},
                                      {kWidth - 1, 12, kAtEnd * kInside}}) {
        std::vector<GuardedPixel> guarded = grey(1e-3f, 0);
        const auto at = std::size_t(y * kWidth + x);
        guarded[at].direct = {100, 100, 100, 0};
        guarded[at].error.x = guarded[at].measured.x = 0.5f;
        CHECK(told_errors(guarded, kWidth)[at].x ==
              doctest::Approx(0.5 * share).epsilon(1e-3).scale(1e-9));
    }
}

TEST_CASE("in_all_no_more_is_told_than_what_was_measured_and_its_standard_error") {
    std::vector<GuardedPixel> guarded = grey(1, 1);
    // Mean 0.01, with luck a hundred times as large.
    for (std::size_t i = 0; i < guarded.size(); ++i) {
        guarded[i].error = {0.25f, 0.25f, 0.03f, 0};
        guarded[i].measured.x = 0.01f + (i % 2 ? 1.0f : -1.0f);
    }
    const double pixels = kWidth * kHeight, most = 0.01 + std::sqrt((1 + 0.01 * 0.01) / pixels);
    for (const Vec3& error : told_errors(guarded, kWidth))
        CHECK(error.x == doctest::Approx(most + 0.03).epsilon(1e-3).scale(1e-9));
    // What seems to be less than nothing is luck.
    for (GuardedPixel& pixel : guarded) pixel.measured.x -= 0.2f;
    const double luck = std::sqrt((1 + 0.19 * 0.19) / pixels);
    CHECK(told_errors(guarded, kWidth)[0].x ==
          doctest::Approx(luck + 0.03).epsilon(1e-3).scale(1e-9));
    // What is no number, or has no place in one, limits nothing.
    guarded[0].error.x = INFINITY;
    CHECK(told_errors(guarded, kWidth)[1].x == doctest::Approx(0.53).epsilon(1e-3).scale(1e-9));
    guarded[0].error.x = 0.25f;
    for (GuardedPixel& pixel : guarded) pixel.measured.x = NAN;
    CHECK(told_errors(guarded, kWidth)[0].x == doctest::Approx(0.53).epsilon(1e-3).scale(1e-9));
}

TEST_CASE("black_pixels_and_no_pixels_have_no_error") {
    std::vector<GuardedPixel> guarded = grey(0, 0);
    for (GuardedPixel& pixel : guarded) pixel.error.x = 1;
    for (const Vec3& error : told_errors(guarded, kWidth)) CHECK(error == Vec3(0));
    CHECK(told_errors({}, 0).empty());
}

}  // namespace
}  // namespace wedge::test
