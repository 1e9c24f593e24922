#include "host/scene/lights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "host/base/edit_distance.hpp"
#include "wedge/shared/radiance.h"

namespace wedge::scene {
namespace {

/// Cosine of the angle between edges that are perpendicular but for the rounding of what was typed.
constexpr double kPerpendicular = 1e-4;

constexpr float kNarrowest = 1e-9f;

LightProfile read_profile(const JsonView& view) {
    const std::string name = view.string();
    if (name == "uniform") return LightProfile::uniform;
    if (name == "gaussian") return LightProfile::gaussian;
    view.fail("unknown profile \"" + name + "\"" + suggestion(name, {"uniform", "gaussian"}));
}

float read_sigma(const JsonView& view, const RectLight& light) {
    const float sigma = view.number(kPositive);
    // As a fraction of a side it must not vanish: 0 there means uniform.
    const float side = std::max(glm::length(light.edge_u), glm::length(light.edge_v));
    if (sigma < kNarrowest * side)
        view.fail("is less than 1e-9 of the light's side; use a point light");
    return sigma;
}

void check_edges(const JsonView& view, const RectLight& light) {
    const glm::dvec3 u(light.edge_u), v(light.edge_v);
    const double area = glm::length(glm::cross(u, v));
    const double sides = glm::length(u) * glm::length(v);
    // Below the smallest normal float the area is zero for the device.
    if (!(float(sides) >= std::numeric_limits<float>::min()))
        view.fail("zero-area light: \"u\" and \"v\" must both have a length");
    if (!(area > kPerpendicular * sides))
        view.fail("zero-area light: \"u\" and \"v\" must not be parallel");
    if (std::abs(glm::dot(u, v)) > kPerpendicular * sides)
        view.fail("\"u\" and \"v\" must be perpendicular");
    if (!std::isfinite(float(sides))) view.fail("the area overflows single precision");
}

RectLight read_rect(const JsonView& view) {
    view.allow_only({"type", "center", "u", "v", "radiance", "power", "profile", "sigma"});
    RectLight light;
    light.center = view.require("center").vec3();
    light.edge_u = view.require("u").vec3();
    light.edge_v = view.require("v").vec3();
    check_edges(view, light);

    if (const auto profile = view.find("profile")) light.profile = read_profile(*profile);
    const auto sigma = view.find("sigma");
    if (light.profile == LightProfile::gaussian)
        light.sigma = read_sigma(view.require("sigma"), light);
    else if (sigma)
        sigma->fail("belongs to the profile \"gaussian\"");

    const auto radiance = view.find("radiance"), power = view.find("power");
    if (bool(radiance) == bool(power)) view.fail("needs either \"radiance\" or \"power\"");
    if (radiance) light.radiance = radiance->radiance();
    if (power) {
        light.radiance = Vec3(glm::dvec3(power->color()) / power_per_radiance(light));
        for (int channel = 0; channel < 3; ++channel)
            if (!(light.radiance[channel] <= WEDGE_LARGEST_RADIANCE))
                power->fail(fmt::format(
                    "is too much for so small a light: its radiance would be above {:g}",
                    WEDGE_LARGEST_RADIANCE));
    }
    return light;
}

PointLight read_point(const JsonView& view) {
    view.allow_only({"type", "position", "intensity"});
    return {view.require("position").vec3(), view.require("intensity").color()};
}

}  // namespace

double power_per_radiance(const RectLight& light) {
    const double u = glm::length(glm::dvec3(light.edge_u)),
                 v = glm::length(glm::dvec3(light.edge_v));
    if (light.profile == LightProfile::uniform) return std::numbers::pi * u * v;
    // The Gaussian separates: along a side of length a it integrates to
    // sigma sqrt(2 pi) erf(a / (2 sqrt(2) sigma)).
    const auto along = [&](double side) {
        const double sigma = light.sigma;
        return sigma * std::sqrt(2 * std::numbers::pi) *
               std::erf(side / (2 * std::sqrt(2.0) * sigma));
    };
    return std::numbers::pi * along(u) * along(v);
}

void read_lights(const JsonView& lights, Scene& scene) {
    for (const JsonView& view : lights.elements()) {
        const JsonView type = view.require("type");
        const std::string name = type.string();
        if (name == "rect")
            scene.rect_lights.push_back(read_rect(view));
        else if (name == "point")
            scene.point_lights.push_back(read_point(view));
        else
            type.fail("unknown type \"" + name + "\"" + suggestion(name, {"rect", "point"}));
    }
}

}  // namespace wedge::scene
