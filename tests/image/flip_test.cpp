// Expected values: the authors' own implementation, the PyPI package flip-evaluator 1.7, in its
// default settings (67.0206 pixels per degree, ACES, automatic exposures), on images made by the
// formulas below. It works in float32 as this code does, with other orders of summation.
#include "host/image/flip.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/base/srgb.hpp"
#include "host/image/metrics.hpp"

using namespace wedge;
using namespace wedge::image;

namespace {

constexpr double kTolerance = 2e-4;  // relative; float32 in both implementations

using Formula = std::function<double(int x, int y, int channel)>;

Image image_of(int width, int height, const Formula& formula) {
    Image image{width, height, {"R", "G", "B"}, {}, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.pixels.push_back(float(formula(x, y, c)));
    return image;
}

/// LDR-FLIP of images given as sRGB code values in [0, 1].
Plane<float> ldr_flip(int width, int height, const Formula& test, const Formula& reference) {
    ImagePair pair = pair_images(image_of(width, height, test), image_of(width, height, reference));
    for (Planes* planes : {&pair.test, &pair.reference})
        for (auto& plane : *planes)
            for (float& value : plane.values) value = srgb_decode(value);
    return ldr_flip_map(pair.test, pair.reference);
}

Plane<float> hdr_flip(int width, int height, const Formula& test, const Formula& reference) {
    return flip_map(pair_images(image_of(width, height, test), image_of(width, height, reference)));
}

double mean(const Plane<float>& map) {
    double sum = 0;
    for (float value : map.values) sum += double(value);
    return sum / double(map.values.size());
}

doctest::Approx near(double value) {
    return doctest::Approx(value).epsilon(kTolerance);
}

double waves(int x, int y, int c) {
    if (c == 0) return 0.5 + 0.4 * std::sin(x * 0.3);
    if (c == 1) return 0.5 + 0.4 * std::cos(y * 0.25);
    return (x * 7 + y * 13) % 32 / 31.0;
}

double waves_with_errors(int x, int y, int c) {
    const double value = waves(x, y, c);
    if (c == 0) return std::clamp(value + 0.1 * ((x / 4 + y / 4) % 2), 0.0, 1.0);
    return c == 1 ? value : value * 0.9;
}

double high_range(int x, int y, int c) {
    if (c == 0) return std::exp2(x / 6.0 - 3);
    if (c == 1) return 0.2;
    return 50 * std::exp(-((x - 20) * (x - 20) + (y - 10) * (y - 10)) / 30.0);
}

double high_range_with_errors(int x, int y, int c) {
    return high_range(x, y, c) * 1.2 + (c == 1 && (x + y) % 3 == 0 ? 0.05 : 0);
}

double black(int, int, int) {
    return 0;
}

}  // namespace

TEST_CASE("ldr_flip_agrees_with_the_authors_program") {
    const Plane<float> map = ldr_flip(48, 32, waves_with_errors, waves);
    CHECK(mean(map) == near(0.24887005984783173));
    CHECK(map.row(0)[0] == near(0.19993776));
    CHECK(map.row(16)[24] == near(0.25123683));
    CHECK(map.row(31)[47] == near(0.2878091));
}

TEST_CASE("ldr_flip_of_flat_and_of_single_pixel_differences") {
    const auto white = [](int, int, int) { return 1.0; };
    const auto green = [](int, int, int c) { return c == 1 ? 1.0 : 0.0; };
    const auto blue = [](int, int, int c) { return c == 2 ? 1.0 : 0.0; };
    const auto dot = [](int x, int y, int) { return x == 24 && y == 16 ? 1.0 : 0.0; };
    CHECK(mean(ldr_flip(48, 32, white, black)) == near(0.9673991203308105));
    CHECK(mean(ldr_flip(48, 32, blue, green)) == near(1));  // the largest colour difference
    const Plane<float> map = ldr_flip(48, 32, dot, black);
    CHECK(mean(map) == near(0.00931593868881464));
    CHECK(map.row(16)[24] == near(0.8649065));
}

TEST_CASE("hdr_flip_agrees_with_the_authors_program") {
    const Plane<float> map = hdr_flip(48, 32, high_range_with_errors, high_range);
    CHECK(mean(map) == near(0.3154003918170929));
    CHECK(map.row(0)[0] == near(0.40766168));
    CHECK(map.row(16)[24] == near(0.2906092));
    CHECK(map.row(31)[47] == near(0.39244953));
}

TEST_CASE("hdr_flip_takes_the_upper_median_of_even_counts") {
    // The lower median, 0.01, would ask for eight exposures instead of two.
    const double values[] = {0.01, 0.01, 0.01, 1, 1, 2};
    const auto steps = [&](int x, int, int) { return values[x]; };
    const auto brighter = [&](int x, int, int) { return values[x] * 1.1f; };
    CHECK(mean(hdr_flip(6, 3, brighter, steps)) == near(0.06965535879135132));
}

TEST_CASE("hdr_flip_of_ramps_agrees_with_the_authors_program") {
    const auto ramp = [](int x, int, int) { return x + 1.0; };
    const auto brighter = [](int x, int, int) { return (x + 1) * 1.1; };
    CHECK(mean(hdr_flip(6, 3, brighter, ramp)) == near(0.0883421003818512));
    CHECK(mean(hdr_flip(7, 3, brighter, ramp)) == near(0.08730930089950562));
}

TEST_CASE("flip_of_references_without_a_range_is_finite") {
    const auto grey = [](int, int, int) { return 0.5; };
    const auto dot = [](int x, int y, int) { return x == 3 && y == 3 ? 10.0 : 0.0; };
    const auto huge = [](int x, int, int) { return x == 0 ? 3e38 : 1e-38; };
    for (const Formula& reference : {Formula(black), Formula(grey), Formula(dot), Formula(huge)})
        for (const Formula& test : {Formula(black), Formula(grey), Formula(dot), Formula(huge)}) {
            const double flip = mean(hdr_flip(8, 8, test, reference));
            CHECK(flip >= 0);
            CHECK(flip <= 1);
        }
    CHECK(mean(hdr_flip(8, 8, grey, black)) > 0.1);
    CHECK(mean(hdr_flip(8, 8, dot, dot)) == 0);
}
