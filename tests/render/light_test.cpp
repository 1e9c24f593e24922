// Points on lights against their densities.
#include <doctest/doctest.h>

#include <cmath>

#include "host/render/lights.hpp"
#include "kernel_harness.hpp"
#include "statistics.hpp"

namespace wedge::test {
namespace {

constexpr uint32_t kSamples = 100000;
constexpr int kSide = 24;

RectLight test_rect(LightProfile profile, float sigma) {
    return {.center = {1, 2, 3},
            .edge_u = {2, 0, 1},
            .edge_v = {0, 1.5f, 0},
            .radiance = {3, 2, 1},
            .profile = profile,
            .sigma = sigma};
}

/// Coordinates along the edges, in [0, 1].
Vec2 local(const shared::Light& light, const float4& p) {
    const Vec3 d = Vec3(p.x, p.y, p.z) - Vec3(light.origin.x, light.origin.y, light.origin.z);
    const Vec3 u(light.edge_u.x, light.edge_u.y, light.edge_u.z);
    const Vec3 v(light.edge_v.x, light.edge_v.y, light.edge_v.z);
    return {glm::dot(d, u) / glm::dot(u, u), glm::dot(d, v) / glm::dot(v, v)};
}

double gaussian_share(double from, double to, double sigma) {
    const auto integral = [&](double x) { return std::erf((x - 0.5) / (sigma * std::sqrt(2.0))); };
    return (integral(to) - integral(from)) / (integral(1) - integral(0));
}

/// Solid angle of a triangle (Van Oosterom & Strackee 1983).
double triangle_solid_angle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    a = glm::normalize(a), b = glm::normalize(b), c = glm::normalize(c);
    return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))),
                          1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

struct Seen {
    double solid_angle;    ///< of a part of a light
    double area_to_solid;  ///< d^2 / cos at its first corner
};

/// The part [a0, a1] x [b0, b1] of a rectangle, seen from a point.
Seen see(const shared::Light& light, const float4& from, double a0, double a1, double b0,
         double b1) {
    const glm::dvec3 o(light.origin.x - from.x, light.origin.y - from.y, light.origin.z - from.z);
    const glm::dvec3 u(light.edge_u.x, light.edge_u.y, light.edge_u.z);
    const glm::dvec3 v(light.edge_v.x, light.edge_v.y, light.edge_v.z);
    const glm::dvec3 n(light.normal.x, light.normal.y, light.normal.z);
    const glm::dvec3 p = o + a0 * u + b0 * v, q = o + a1 * u + b0 * v;
    const glm::dvec3 r = o + a1 * u + b1 * v, s = o + a0 * u + b1 * v;
    return {triangle_solid_angle(p, q, r) + triangle_solid_angle(p, r, s),
            std::pow(glm::length(p), 3) / std::abs(glm::dot(p, n))};
}

/// A point in front of the test rectangle, `distance` from its centre and off its axis.
float4 viewpoint(const shared::Light& light, float distance) {
    const Vec3 n(light.normal.x, light.normal.y, light.normal.z);
    const Vec3 p = Vec3(1, 2, 3) + distance * glm::normalize(n + Vec3(0.2f, 0.4f, 0.1f));
    return {p.x, p.y, p.z, 0};
}

void check_rectangle(SamplingKernels& kernels, float sigma, float distance) {
    rendering::LightList list;
    list.add_rect(test_rect(sigma > 0 ? LightProfile::gaussian : LightProfile::uniform, sigma));
    const auto lights = list.take();
    const shared::Light& light = lights[0];
    const float4 from = viewpoint(light, distance);
    const double su = light.edge_u.w, sv = light.edge_v.w, area = light.origin.w;
    const double whole = see(light, from, 0, 1, 0, 1).solid_angle;
    // Uniform lights that look large are sampled by solid angle, others by area.
    const bool by_angle = sigma == 0 && whole > 0.05;

    std::vector<double> observed(kSide * kSide, 0.0), expected;
    for (const float4& p : kernels.light_points(lights, from, 5, kSamples)) {
        const Vec2 ab = local(light, p);
        REQUIRE((ab.x > -1e-5 && ab.x < 1 + 1e-5 && ab.y > -1e-5 && ab.y < 1 + 1e-5));
        const int i = glm::clamp(int(ab.x * kSide), 0, kSide - 1);
        const int j = glm::clamp(int(ab.y * kSide), 0, kSide - 1);
        observed[std::size_t(j) * kSide + i] += 1;
        const double h = 1e-4;
        const double pdf_area = sigma > 0 ? gaussian_share(ab.x - h, ab.x + h, su) *
                                                gaussian_share(ab.y - h, ab.y + h, sv) /
                                                (4 * h * h * area)
                                          : 1 / area;
        const double to_solid = see(light, from, ab.x, ab.x + h, ab.y, ab.y + h).area_to_solid;
        REQUIRE(
            p.w ==
            doctest::Approx(by_angle ? 1 / whole : pdf_area * to_solid).epsilon(2e-3).scale(1e-9));
    }
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i < kSide; ++i) {
            const double a0 = double(i) / kSide, a1 = double(i + 1) / kSide;
            const double b0 = double(j) / kSide, b1 = double(j + 1) / kSide;
            double share = 1.0 / (kSide * kSide);
            if (sigma > 0) share = gaussian_share(a0, a1, su) * gaussian_share(b0, b1, sv);
            if (by_angle) share = see(light, from, a0, a1, b0, b1).solid_angle / whole;
            expected.push_back(kSamples * share);
        }
    CAPTURE(sigma);
    CAPTURE(distance);
    CHECK(chi_square_p_value(observed, expected) > 1e-3);
}

TEST_CASE("rectangle_points_follow_their_density") {
    SamplingKernels kernels;
    for (float sigma : {0.1f, 0.5f, 4.0f}) check_rectangle(kernels, sigma, 2);
    for (float distance : {0.1f, 0.6f, 3.0f, 8.0f, 100.0f}) check_rectangle(kernels, 0, distance);
}

TEST_CASE("triangle_points_are_uniform") {
    SamplingKernels kernels;
    Material material;
    material.emission = Vec3(1);
    rendering::LightList list;
    list.add_triangle({0, 0, 0}, {2, 0, 0}, {0, 3, 0}, material, 0);
    const auto lights = list.take();
    std::vector<double> observed(kSide * kSide, 0.0), expected(kSide * kSide, 0.0);
    for (const float4& p : kernels.light_points(lights, {0, 0, 100, 0}, 6, kSamples)) {
        const Vec2 ab = local(lights[0], p);
        REQUIRE(ab.x + ab.y < 1 + 1e-5);
        const double d2 = p.x * p.x + p.y * p.y + 1e4, cos_light = 100 / std::sqrt(d2);
        REQUIRE(p.w == doctest::Approx(d2 / cos_light / 3.0));
        observed[std::size_t(ab.y * kSide) * kSide + std::size_t(ab.x * kSide)] += 1;
    }
    for (int j = 0; j < kSide; ++j)
        for (int i = 0; i + j < kSide; ++i)
            expected[std::size_t(j) * kSide + i] =
                kSamples * (i + j + 1 < kSide ? 2.0 : 1.0) / (kSide * kSide);
    CHECK(chi_square_p_value(observed, expected) > 1e-3);
}

TEST_CASE("lights_are_chosen_by_power") {
    SamplingKernels kernels;
    rendering::LightList list;
    std::vector<double> powers;
    for (int i = 0; i < 7; ++i) {
        list.add_point({.position = Vec3(float(i), 0, 0), .intensity = Vec3(float(1 + i * i))});
        powers.push_back(1 + i * i);
    }
    const auto lights = list.take();
    double total = 0;
    for (double p : powers) total += p;
    std::vector<double> observed(7, 0.0), expected;
    for (double p : powers) expected.push_back(kSamples * p / total);
    for (const float4& p : kernels.light_points(lights, {0, 0, 1, 0}, 8, kSamples)) {
        observed[std::size_t(p.x)] += 1;
        REQUIRE(p.w == doctest::Approx(powers[std::size_t(p.x)] / total));
    }
    CHECK(chi_square_p_value(observed, expected) > 1e-3);
}

TEST_CASE("three_nodes_have_the_moments_of_a_profile") {
    for (double sigma : {0.0, 0.02, 0.2, 0.5, 3.0, 99.0, 1e5}) {
        rendering::LightList list;
        const auto profile = sigma > 0 ? LightProfile::gaussian : LightProfile::uniform;
        RectLight rect = test_rect(profile, float(sigma));
        rect.edge_u = {1, 0, 0};  // sigma is a share of it
        list.add_rect(rect);
        const shared::float4 nodes = list.take()[0].nodes;
        double mass = 0, second = 0, fourth = 0;
        constexpr int kParts = 100000;
        for (int i = 0; i < kParts; ++i) {
            const double x = (i + 0.5) / kParts - 0.5;
            const double p = sigma > 0 ? std::exp(-x * x / (2 * sigma * sigma)) : 1;
            mass += p, second += p * x * x, fourth += p * std::pow(x, 4);
        }
        CAPTURE(sigma);
        const double x2 = double(nodes.x) * double(nodes.x), outer = 2 * double(nodes.z);
        CHECK(outer * x2 == doctest::Approx(second / mass).epsilon(2e-5).scale(1e-9));
        CHECK(outer * x2 * x2 == doctest::Approx(fourth / mass).epsilon(2e-5).scale(1e-9));
    }
}

TEST_CASE("lights_without_power_are_left_out") {
    rendering::LightList list;
    CHECK(list.add_point({.intensity = Vec3(0)}) == -1);
    CHECK(list.add_point({.intensity = Vec3(1)}) == 0);
    const auto lights = list.take();
    REQUIRE(lights.size() == 1);
    CHECK(lights[0].normal.w == 1.0f);
}

TEST_CASE("lights_are_chosen_as_often_as_is_said_however_weak_they_are") {
    constexpr double kSteps = 1 << 24;  // of random numbers
    for (const float weak : {1e-3f, 1e-6f, 3e-8f, 1e-12f}) {
        rendering::LightList list;
        for (const float intensity : {1.0f, weak, 0.3f, weak, weak})
            CHECK(list.add_point({.intensity = Vec3(intensity)}) >= 0);
        const auto lights = list.take();
        double before = 0;
        for (const shared::Light& light : lights) {
            // Numbers u = i / kSteps with before <= u < sum, which choose this light.
            const double end = double(light.radiance.w) * kSteps;
            CHECK(end == std::floor(end));
            CHECK(end - before == double(light.normal.w) * kSteps);
            CHECK(end > before);
            before = end;
        }
        CHECK(before == kSteps);
        const double all = 1.3 + 3 * double(weak);
        CHECK(std::abs(double(lights[0].normal.w) - 1 / all) <= 1 / kSteps);
        CHECK(std::abs(double(lights[1].normal.w) - double(weak) / all) <= 1 / kSteps);
    }
}

TEST_CASE("tiny_and_huge_rectangles_face_where_they_should") {
    for (const float side : {1e-17f, 1e-10f, 1.0f, 1e10f, 1e17f}) {
        rendering::LightList list;
        CHECK(list.add_rect(
                  {.edge_u = {0, 0, side}, .edge_v = {side, 0, 0}, .radiance = Vec3(1)}) == 0);
        const float4 normal = list.take()[0].normal;
        CHECK(normal.x == 0);
        CHECK(normal.y == 1);
        CHECK(normal.z == 0);
    }
}

}  // namespace
}  // namespace wedge::test
