// How much more is seen of each colour than of all, from the rays of a pixel to a lamp.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "kernel_harness.hpp"

namespace wedge::test {
namespace {

constexpr float kHidden = 0, kSeen = 2;

float4 red(int half, float seen) {
    return {0.8f, 0, 0, float(half) + seen};
}

float4 blue(int half, float seen) {
    return {0, 0, 0.5f, float(half) + seen};
}

/// By luminance, of the light of `reds` and `blues` rays.
double brightness(double reds, double blues) {
    return 0.2126 * 0.8 * reds + 0.0722 * 0.5 * blues;
}

void check_factor(const float4& found, double r, double b) {
    CHECK(found.x == doctest::Approx(r).epsilon(1e-5).scale(1e-9));
    CHECK(std::abs(found.y - 1) < 1e-6f);  // nothing is green
    CHECK(std::abs(found.z - b) < 1e-5f);
}

TEST_CASE("shadows_on_one_colour_have_no_hue") {
    SamplingKernels kernels;
    std::vector<float4> rays;
    for (float seen : {kHidden, kSeen, kSeen})
        for (int half : {0, 1}) rays.push_back({0.7f, 0.3f, 0.1f, float(half) + seen});
    for (const float4& factor : kernels.shadow_hues(rays))
        for (float f : {factor.x, factor.y, factor.z}) CHECK(std::abs(f - 1) < 1e-6f);
    // Nor where nothing is seen, or where there are no rays.
    for (const float4& factor : kernels.shadow_hues({red(0, kHidden), blue(1, kHidden)}))
        check_factor(factor, 1, 1);
}

TEST_CASE("what_both_halves_see_of_a_colour_is_taken") {
    SamplingKernels kernels;
    std::vector<float4> rays;
    for (int half : {0, 1}) rays.insert(rays.end(), {red(half, kSeen), blue(half, kHidden)});
    for (const float4& factor : kernels.shadow_hues(rays))
        check_factor(factor, brightness(1, 1) / brightness(1, 0), 0);
}

TEST_CASE("no_colour_is_seen_more_than_wholly") {
    SamplingKernels kernels;
    std::vector<float4> rays;
    for (int half : {0, 1}) rays.insert(rays.end(), {red(half, kSeen), blue(half, kHidden)});
    const float share = 0.9f;  // filtered: more than the half of the rays
    for (const float4& factor : kernels.shadow_hues(rays, share))
        check_factor(factor, 1 / share, 0);
}

TEST_CASE("what_one_half_sees_of_a_colour_is_luck") {
    SamplingKernels kernels;
    const float4 first[] = {red(0, kSeen), blue(0, kHidden)};
    for (const std::vector<float4>& second :
         {std::vector<float4>{red(1, kHidden), blue(1, kSeen)}, {red(1, kSeen), blue(1, kSeen)}}) {
        std::vector<float4> rays(std::begin(first), std::end(first));
        rays.insert(rays.end(), second.begin(), second.end());
        for (const float4& factor : kernels.shadow_hues(rays)) check_factor(factor, 1, 1);
    }
}

TEST_CASE("halves_that_agree_in_part_give_a_part") {
    SamplingKernels kernels;
    const auto found =
        kernels.shadow_hues({red(0, kSeen), blue(0, kHidden), red(1, kSeen), red(1, kSeen),
                             red(1, kSeen), blue(1, kSeen), blue(1, kHidden)});
    const double seen0 = brightness(1, 0) / brightness(1, 1);
    const double seen1 = brightness(3, 1) / brightness(3, 2);
    const double r0 = 1 / seen0 - 1, b0 = -1, r1 = 1 / seen1 - 1, b1 = 0.5 / seen1 - 1;
    const double agreed = r0 * r1 + b0 * b1;
    const double apart = (r0 - r1) * (r0 - r1) + (b0 - b1) * (b0 - b1);
    const double share = agreed / (agreed + apart / 4);
    REQUIRE(share > 0.5);
    REQUIRE(share < 0.95);
    check_factor(found[0], 1 + share * r0, 1 + share * b0);
    check_factor(found[1], 1 + share * r1, 1 + share * b1);
}

}  // namespace
}  // namespace wedge::test
