// Sines, arcs, exponentials and the inverse error function of the kernels against double precision.
#include <doctest/doctest.h>

#include <cmath>

#include "kernel_harness.hpp"

namespace wedge::test {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr int kSteps = 100000;

TEST_CASE("sines_and_cosines_are_precise") {
    SamplingKernels kernels;
    std::vector<float4> in;
    for (int i = -kSteps; i <= kSteps; ++i) in.push_back({2.5f * float(i) / kSteps, 0, 1, 0});
    const auto found = kernels.angles(in);
    double worst = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
        worst = std::max(worst, std::abs(found[i].x - std::sin(2 * kPi * double(in[i].x))));
        worst = std::max(worst, std::abs(found[i].y - std::cos(2 * kPi * double(in[i].x))));
    }
    CHECK(worst < 2e-7);
}

TEST_CASE("arcs_are_precise_to_the_ends_of_their_range") {
    SamplingKernels kernels;
    std::vector<float4> in;
    for (int i = 0; i <= kSteps; ++i) {
        const double angle = kPi * i / kSteps;
        const float size = std::exp2(float(i % 60 - 30));
        in.push_back({0, float(std::cos(angle)), size * float(std::sin(angle)),
                      size * float(std::cos(angle))});
    }
    in.push_back({0, -1, 0, -1});
    in.push_back({0, 1, 1e-20f, 1});
    const auto found = kernels.angles(in);
    double worst = 0, worst_small = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const double arc = std::atan2(std::abs(double(in[i].z)), double(in[i].w));
        worst = std::max(worst, std::abs(found[i].z - std::acos(double(in[i].y))));
        worst = std::max(worst, std::abs(found[i].w - arc));
        if (arc > 0) worst_small = std::max(worst_small, std::abs(found[i].w / arc - 1));
    }
    CHECK(worst < 4e-7);
    CHECK(worst_small < 4e-7);
}

TEST_CASE("the_inverse_error_function_undoes_the_error_function") {
    SamplingKernels kernels;
    std::vector<float4> in;
    for (int i = -kSteps + 1; i < kSteps; ++i) in.push_back({0.9999f * float(i) / kSteps, 0, 0, 0});
    const auto found = kernels.erf_and_exp(in);
    double worst = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const double y = found[i].x, slope = 2 / std::sqrt(kPi) * std::exp(-y * y);
        const double off = (std::erf(y) - double(in[i].x)) / slope;  // of y, to first order
        if (y != 0) worst = std::max(worst, std::abs(off / y));
    }
    CHECK(worst < 3e-6);  // beside the ends the argument itself is that coarse
}

TEST_CASE("falling_exponentials_are_precise_and_never_nothing") {
    SamplingKernels kernels;
    std::vector<float4> in;
    for (int i = 0; i <= kSteps; ++i) in.push_back({0, 86.0f * float(i) / kSteps, 0, 0});
    in.push_back({0, 1e9f, 0, 0});
    const auto found = kernels.erf_and_exp(in);
    double worst = 0;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const double truth = std::exp(-std::min(double(in[i].y), 86.0));
        worst = std::max(worst, std::abs(found[i].y / truth - 1));
    }
    CHECK(worst < 3e-7);
}

}  // namespace
}  // namespace wedge::test
