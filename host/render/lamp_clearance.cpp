#include "host/render/lamp_clearance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "host/base/parallel.hpp"

namespace wedge::rendering {
namespace {

constexpr std::size_t kGrain = 1 << 14;  // triangles a task
constexpr double kRounding = 0x1p-19;    // of distances along rays, in units of coordinates
constexpr double kLargestLift = 1e-3;    // of the shorter side
constexpr double kTouching = 1e-4;       // of the sides: what overlaps by less only touches

using Triangle = std::array<glm::dvec3, 3>;

struct Lamp {
    std::size_t light = 0;
    glm::dvec3 center, normal, u, v;
    double largest = 0;  ///< coordinate, of a corner or the camera
    double lift = 0;
};

glm::dvec3 to_double(const shared::float4& v) {
    return {v.x, v.y, v.z};
}

double largest_coordinate(const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

std::vector<Lamp> lamps_of(const FlatScene& flat, const Vec3& camera) {
    std::vector<Lamp> lamps;
    for (std::size_t i = 0; i < flat.lights.size(); ++i) {
        const shared::Light& light = flat.lights[i];
        if (light.kind != WEDGE_LIGHT_RECT) continue;
        const glm::dvec3 corner = to_double(light.origin);
        Lamp lamp{i, corner, to_double(light.normal), to_double(light.edge_u),
                  to_double(light.edge_v)};
        lamp.center += 0.5 * (lamp.u + lamp.v);
        lamp.largest = std::max({largest_coordinate(glm::dvec3(camera)), largest_coordinate(corner),
                                 largest_coordinate(corner + lamp.u + lamp.v)});
        lamps.push_back(lamp);
    }
    return lamps;
}

double most_lift(const Lamp& lamp) {
    return kLargestLift * std::min(glm::length(lamp.u), glm::length(lamp.v));
}

/// Both convex: they overlap unless a side of one has all of the other beyond it. `t` in shares of
/// the lamp's sides from its centre.
bool overlaps(const std::array<glm::dvec2, 3>& t) {
    for (int axis = 0; axis < 2; ++axis) {
        const auto [least, most] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
        if (least > 0.5 - kTouching || most < -0.5 + kTouching) return false;
    }
    for (int k = 0; k < 3; ++k) {
        const glm::dvec2 edge = t[(k + 1) % 3] - t[k], across(edge.y, -edge.x);
        const double length = glm::length(across);
        if (!(length > 0)) return false;
        const double side = glm::dot(across, t[(k + 2) % 3] - t[k]) < 0 ? -1 : 1;
        const double reach = 0.5 * (std::abs(across.x) + std::abs(across.y));
        if (reach - side * glm::dot(across, t[k]) < kTouching * length) return false;
    }
    return true;
}

/// What the lamp has to move to be clear of a triangle; 0: nothing.
double lift_over(const Lamp& lamp, const Triangle& t) {
    const double most = most_lift(lamp);
    double highest = -most;
    for (const glm::dvec3& p : t) {
        const double height = glm::dot(p - lamp.center, lamp.normal);
        if (!(std::abs(height) <= most)) return 0;
        highest = std::max(highest, height);
    }
    double largest = lamp.largest;
    std::array<glm::dvec2, 3> inside;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 d = t[k] - lamp.center;
        largest = std::max(largest, largest_coordinate(t[k]));
        inside[k] = {glm::dot(d, lamp.u) / glm::dot(lamp.u, lamp.u),
                     glm::dot(d, lamp.v) / glm::dot(lamp.v, lamp.v)};
    }
    const double needed = std::min(kRounding * largest, most);
    return std::abs(highest) < needed && overlaps(inside) ? highest + needed : 0;
}

Triangle triangle_of(const FlatScene& flat, std::size_t i) {
    const UVec3 t = flat.triangles[i];
    return {glm::dvec3(flat.positions[t.x]), glm::dvec3(flat.positions[t.y]),
            glm::dvec3(flat.positions[t.z])};
}

void find_lifts(const FlatScene& flat, std::vector<Lamp>& lamps) {
    std::mutex mutex;
    parallel_ranges(flat.triangles.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        std::vector<double> lifts(lamps.size(), 0.0);
        for (std::size_t i = begin; i < end; ++i) {
            if (flat.shading[i].light >= 0) continue;
            const Triangle t = triangle_of(flat, i);
            for (std::size_t k = 0; k < lamps.size(); ++k)
                lifts[k] = std::max(lifts[k], lift_over(lamps[k], t));
        }
        const std::lock_guard lock(mutex);
        for (std::size_t k = 0; k < lamps.size(); ++k)
            lamps[k].lift = std::max(lamps[k].lift, lifts[k]);
    });
}

/// With vertices of its own: others may share those it has.
void move_triangle(FlatScene& flat, std::size_t i, const Vec3& by) {
    for (int k = 0; k < 3; ++k) {
        const uint32_t before = flat.triangles[i][k];
        flat.triangles[i][k] = uint32_t(flat.positions.size());
        flat.positions.push_back(flat.positions[before] + by);
        shared::ShadingVertex vertex = flat.vertices[before];
        vertex.px = flat.positions.back().x;
        vertex.py = flat.positions.back().y;
        vertex.pz = flat.positions.back().z;
        flat.vertices.push_back(vertex);
    }
    const UVec3 t = flat.triangles[i];
    flat.shading[i].v0 = t.x, flat.shading[i].v1 = t.y, flat.shading[i].v2 = t.z;
}

void move_lamp(FlatScene& flat, const Lamp& lamp) {
    const Vec3 by(lamp.normal * lamp.lift);
    shared::float4& origin = flat.lights[lamp.light].origin;
    origin.x += by.x, origin.y += by.y, origin.z += by.z;
    for (std::size_t i = 0; i < flat.shading.size(); ++i)
        if (flat.shading[i].light == int(lamp.light)) move_triangle(flat, i, by);
}

}  // namespace

void clear_lamps(FlatScene& flat, const Vec3& camera) {
    std::vector<Lamp> lamps = lamps_of(flat, camera);
    if (lamps.empty()) return;
    find_lifts(flat, lamps);
    for (const Lamp& lamp : lamps)
        if (lamp.lift > 0) move_lamp(flat, lamp);
}

}  // namespace wedge::rendering
