#include "host/render/lights.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "host/scene/lights.hpp"

namespace wedge::rendering {
namespace {

shared::float4 to_float4(const Vec3& v, double w) {
    return {v.x, v.y, v.z, float(w)};
}

/// Share of a Gaussian about an edge's middle that lies on the edge, with sigma as a fraction of
/// it.
double gaussian_share(double sigma) {
    return std::erf(0.5 / (sigma * std::sqrt(2.0)));
}

/// Mean of exp(-r^2 / (2 sigma^2)) along an edge.
double gaussian_mean(double sigma) {
    return sigma * std::sqrt(2 * std::numbers::pi) * gaussian_share(sigma);
}

/// Variance and fourth moment about its middle of a profile along an edge, as shares of the edge's
/// square and fourth power; sigma 0: uniform, as a Gaussian is that is much wider than the edge,
/// within 1e-5.
struct Moments {
    double second = 1.0 / 12, fourth = 1.0 / 80;
};

Moments profile_moments(double sigma) {
    constexpr double kUniform = 100;
    if (!(sigma > 0 && sigma < kUniform)) return {};
    const double end = 0.5 / sigma, s2 = sigma * sigma;
    const double density = std::exp(-0.5 * end * end) / std::sqrt(2 * std::numbers::pi);
    const double tail = 2 * end * density / gaussian_share(sigma);
    return {s2 * (1 - tail), s2 * s2 * (3 - tail * (end * end + 3))};
}

/// Of Light.nodes: the same moments up to the fifth.
struct Nodes {
    float distance, weight;
};

Nodes profile_nodes(double sigma) {
    const Moments m = profile_moments(sigma);
    return {float(std::sqrt(m.fourth / m.second)), float(0.5 * m.second * m.second / m.fourth)};
}

}  // namespace

double luminance(const Vec3& c) {
    return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

double light_power(const RectLight& rect) {
    return scene::power_per_radiance(rect) * luminance(rect.radiance);
}

double light_power(const PointLight& point) {
    return 4 * std::numbers::pi * luminance(point.intensity);
}

double light_power(double area, const Vec3& radiance) {
    return std::numbers::pi * area * luminance(radiance);
}

int LightList::add(shared::Light light, double power) {
    if (!(power > 0) || !std::isfinite(power)) return -1;
    lights_.push_back(light);
    powers_.push_back(power);
    return int(lights_.size()) - 1;
}

int LightList::add_rect(const RectLight& rect) {
    // Squares of what is tiny or huge have no place in a float.
    const glm::dvec3 normal = glm::cross(glm::dvec3(rect.edge_u), glm::dvec3(rect.edge_v));
    const double area = glm::length(normal);
    shared::Light light{};
    double sigma_u = 0, sigma_v = 0;
    light.profile = {1, 1, 1, 0};
    if (rect.profile == LightProfile::gaussian) {
        sigma_u = rect.sigma / glm::length(rect.edge_u);
        sigma_v = rect.sigma / glm::length(rect.edge_v);
        light.profile = {float(gaussian_share(sigma_u)), float(gaussian_share(sigma_v)),
                         float(gaussian_mean(sigma_u) * gaussian_mean(sigma_v)), 0};
    }
    const Nodes u = profile_nodes(sigma_u), v = profile_nodes(sigma_v);
    light.nodes = {u.distance, v.distance, u.weight, v.weight};
    light.origin = to_float4(rect.center - 0.5f * (rect.edge_u + rect.edge_v), area);
    light.edge_u = to_float4(rect.edge_u, sigma_u);
    light.edge_v = to_float4(rect.edge_v, sigma_v);
    light.normal = to_float4(Vec3(normal / area), 0);
    light.radiance = to_float4(rect.radiance, 0);
    light.kind = WEDGE_LIGHT_RECT;
    light.emission_texture = -1;
    return add(light, light_power(rect));
}

int LightList::add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Material& material,
                            uint32_t primitive) {
    const Vec3 normal = glm::cross(b - a, c - a);
    const double area = 0.5 * glm::length(glm::dvec3(normal));
    if (!(area > 0) || !std::isfinite(area)) return -1;
    shared::Light light{};
    light.origin = to_float4(a, area);
    light.edge_u = to_float4(b - a, 0);
    light.edge_v = to_float4(c - a, 0);
    light.normal = to_float4(Vec3(glm::normalize(glm::dvec3(normal))), 0);
    light.radiance = to_float4(material.emission, 0);
    light.kind = WEDGE_LIGHT_TRIANGLE;
    light.emission_texture = material.emission_texture;
    light.primitive = primitive;
    return add(light, light_power(area, material.emission));
}

int LightList::add_point(const PointLight& point) {
    shared::Light light{};
    light.origin = to_float4(point.position, 0);
    light.radiance = to_float4(point.intensity, 0);
    light.kind = WEDGE_LIGHT_POINT;
    light.emission_texture = -1;
    return add(light, light_power(point));
}

// Random numbers are multiples of a step. Were sums not, too, a light would be chosen more or less
// often than it is said to be, a weak one perhaps never: so each gets whole steps, and one at
// least.
std::vector<shared::Light> LightList::take() {
    constexpr double kSteps = 1 << 24;
    const auto count = double(lights_.size());
    double total = 0;
    for (double power : powers_) total += power;
    double sum = 0, before = 0;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        sum += powers_[i];
        const double least = before + 1, most = kSteps - (count - double(i + 1));
        const double end = count < kSteps
                               ? std::clamp(std::round(sum / total * kSteps), least, most)
                               : sum / total * kSteps;
        lights_[i].normal.w = float((end - before) / kSteps);
        lights_[i].radiance.w = float(end / kSteps);
        before = end;
    }
    if (!lights_.empty()) lights_.back().radiance.w = 1;
    powers_.clear();
    return std::exchange(lights_, {});
}

}  // namespace wedge::rendering
