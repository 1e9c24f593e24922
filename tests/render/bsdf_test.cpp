// Surfaces: sampling against density, and energy.
#include <doctest/doctest.h>

#include <cmath>

#include "kernel_harness.hpp"
#include "statistics.hpp"
#include "wedge/math.hpp"

namespace wedge::test {
namespace {

constexpr double kTau = 2 * 3.14159265358979323846;

float4 direction(double cos_theta, double phi) {
    const double s = std::sqrt(std::max(0.0, 1 - cos_theta * cos_theta));
    return {float(s * std::cos(phi)), float(s * std::sin(phi)), float(cos_theta), 0};
}

struct Case {
    float4 parameters;
    double cos_o;
};

std::vector<Case> cases() {
    std::vector<Case> list;
    for (float model : {0.0f, 1.0f, 2.0f})
        for (float exponent : {0.0f, 1.0f, 12.0f, 80.0f})
            for (double cos_o : {1.0, 0.7, 0.15}) {
                if (model == 0 && exponent > 0) continue;
                list.push_back({{0.3f, model == 0 ? 0.0f : 0.6f, exponent, model}, cos_o});
            }
    return list;
}

/// Integral of `pick` of (value, pdf) over each cell of cos theta x phi: two Gauss points a step
/// along cos theta, where lobes are steep, midpoints along phi.
template <typename Pick>
std::vector<double> integrate_cells(SamplingKernels& kernels, const Case& c, int rows, int columns,
                                    int fine, Pick pick) {
    std::vector<float4> directions;
    const int nr = rows * fine, nc = columns * fine;
    const auto cos_i = [nr](int i) {
        const double gauss = (i % 2 ? 0.5 : -0.5) / std::sqrt(3.0);
        return (i / 2 + 0.5 + gauss) / nr;
    };
    for (int i = 0; i < 2 * nr; ++i)
        for (int j = 0; j < nc; ++j)
            directions.push_back(direction(cos_i(i), kTau * (j + 0.5) / nc));
    const auto values = kernels.bsdf_values(c.parameters, direction(c.cos_o, 0.3), directions);
    std::vector<double> cells(std::size_t(rows) * columns, 0.0);
    for (int i = 0; i < 2 * nr; ++i)
        for (int j = 0; j < nc; ++j)
            cells[std::size_t(i / (2 * fine)) * columns + j / fine] +=
                pick(values[std::size_t(i) * nc + j], cos_i(i)) * kTau / (2.0 * nr * nc);
    return cells;
}

TEST_CASE("bsdf_sampling_follows_its_density") {
    SamplingKernels kernels;
    constexpr int kRows = 24, kColumns = 48;
    constexpr uint32_t kSamples = 200000;
    const auto list = cases();
    for (const Case& c : list) {
        CAPTURE(c.parameters.z);
        CAPTURE(c.parameters.w);
        CAPTURE(c.cos_o);
        std::vector<double> observed(kRows * kColumns, 0.0);
        double below = 0;
        for (const float4& d :
             kernels.bsdf_directions(c.parameters, direction(c.cos_o, 0.3), 7, kSamples)) {
            if (!(d.z > 0)) {
                below += 1;
                continue;
            }
            double phi = std::atan2(d.y, d.x);
            if (phi < 0) phi += kTau;
            const int row = std::min(int(d.z * kRows), kRows - 1);
            const int column = std::min(int(phi / kTau * kColumns), kColumns - 1);
            observed[std::size_t(row) * kColumns + column] += 1;
        }
        std::vector<double> expected =
            integrate_cells(kernels, c, kRows, kColumns, 16,
                            [](float2 v, double) { return double(v.y) * kSamples; });
        // Directions below the horizon are the rest of the density.
        double above = 0;
        for (double e : expected) above += e;
        observed.push_back(below);
        expected.push_back(std::max(0.0, kSamples - above));
        CHECK(chi_square_p_value(observed, expected) > sidak(0.01, list.size()));
    }
}

TEST_CASE("surfaces_reflect_at_most_what_arrives") {
    SamplingKernels kernels;
    for (float model : {1.0f, 2.0f})
        for (float exponent : {0.0f, 0.5f, 4.0f, 30.0f, 200.0f})
            for (double cos_o : {1.0, 0.9, 0.6, 0.3, 0.05}) {
                CAPTURE(model);
                CAPTURE(exponent);
                CAPTURE(cos_o);
                const Case c{{0.0f, 1.0f, exponent, model}, cos_o};
                double albedo = 0;
                for (double cell :
                     integrate_cells(kernels, c, 16, 16, 24,
                                     [](float2 v, double cos_i) { return double(v.x) * cos_i; }))
                    albedo += cell;
                CHECK(albedo <= 1.0 + 2e-3);
                // At normal incidence the lobes are normalised exactly.
                if (cos_o == 1.0) CHECK(albedo == doctest::Approx(1.0).epsilon(5e-3).scale(1e-9));
            }
}

TEST_CASE("narrow_lobes_keep_their_width") {
    SamplingKernels kernels;
    // Density (m + 1) cos^m alpha about the mirror direction: the mean of 1 - cos alpha is 1 / (m +
    // 2).
    for (float m : {1e3f, 1e4f, 1e5f, 1e6f}) {
        const float4 wo = direction(0.8, 0.0);
        const Vec3 mirror(-wo.x, -wo.y, wo.z);
        std::vector<double> values;
        for (const float4& d : kernels.bsdf_directions({0, 1, m, 1}, wo, 3, 100000)) {
            const Vec3 difference = Vec3(d.x, d.y, d.z) - mirror;
            values.push_back(0.5 * glm::dot(difference, difference));
        }
        const MeanAndError found = mean_and_error(values);
        CAPTURE(m);
        CHECK(found.mean == doctest::Approx(1.0 / (m + 2)).epsilon(0.02).scale(1e-9));
    }
}

TEST_CASE("sample_weights_average_to_the_albedo") {
    SamplingKernels kernels;
    for (const Case& c : cases()) {
        std::vector<double> weights;
        for (const float4& d :
             kernels.bsdf_directions(c.parameters, direction(c.cos_o, 0.3), 11, 100000))
            weights.push_back(d.w);
        double albedo = 0;
        for (double cell : integrate_cells(kernels, c, 16, 16, 24, [](float2 v, double cos_i) {
                 return double(v.x) * cos_i;
             }))
            albedo += cell;
        const MeanAndError found = mean_and_error(weights);
        CAPTURE(c.parameters.z);
        CAPTURE(c.parameters.w);
        CHECK(std::abs(found.mean - albedo) < 5 * found.standard_error + 2e-3);
    }
}

}  // namespace
}  // namespace wedge::test
