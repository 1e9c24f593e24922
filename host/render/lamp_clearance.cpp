#include "host/render/lamp_clearance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>

#include "host/base/parallel.hpp"

namespace wedge::rendering {
namespace {

constexpr std::size_t kGrain = 1 << 14;  // triangles a task
constexpr double kRounding = 0x1p-19;    // of distances along rays, in units of coordinates
constexpr double kLargestLift = 1e-3;    // of the shorter side
constexpr double kTouching = 1e-4;       // of the sides: what overlaps by less only touches

/// Those of more rectangles would take long to compare; the most powerful come first.
constexpr std::size_t kMostLamps = 256;

using Triangle = std::array<glm::dvec3, 3>;

struct Lamp {
    std::size_t light = 0;
    glm::dvec3 corner, normal, u, v;
    glm::dvec3 lower, upper;  ///< of a box around it and all places that are near enough
    double largest = 0;       ///< coordinate, of a corner or the camera
    double most_lift = 0;
    double lift = 0;
};

glm::dvec3 to_double(const shared::float4& v) {
    return {v.x, v.y, v.z};
}

double largest_coordinate(const glm::dvec3& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

std::array<glm::dvec3, 4> corners_of(const Lamp& lamp) {
    return {lamp.corner, lamp.corner + lamp.u, lamp.corner + lamp.v, lamp.corner + lamp.u + lamp.v};
}

Lamp make_lamp(const shared::Light& light, std::size_t index, const Vec3& camera) {
    Lamp lamp{index, to_double(light.origin), to_double(light.normal), to_double(light.edge_u),
              to_double(light.edge_v)};
    lamp.most_lift = kLargestLift * std::min(glm::length(lamp.u), glm::length(lamp.v));
    lamp.largest = largest_coordinate(glm::dvec3(camera));
    lamp.lower = lamp.upper = lamp.corner;
    for (const glm::dvec3& p : corners_of(lamp)) {
        lamp.largest = std::max(lamp.largest, largest_coordinate(p));
        lamp.lower = glm::min(lamp.lower, p);
        lamp.upper = glm::max(lamp.upper, p);
    }
    lamp.lower -= lamp.most_lift;
    lamp.upper += lamp.most_lift;
    return lamp;
}

std::vector<Lamp> lamps_of(const FlatScene& flat, const Vec3& camera) {
    std::vector<Lamp> lamps;
    for (std::size_t i = 0; i < flat.lights.size() && lamps.size() < kMostLamps; ++i)
        if (flat.lights[i].kind == WEDGE_LIGHT_RECT)
            lamps.push_back(make_lamp(flat.lights[i], i, camera));
    return lamps;
}

/// Both convex: they overlap unless a side of one has all of the other beyond it.
bool overlaps(const Lamp& lamp, const Triangle& triangle) {
    std::array<glm::dvec2, 3> t;  // in shares of the lamp's sides, from its middle
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 d = triangle[k] - lamp.corner;
        t[k] = {glm::dot(d, lamp.u) / glm::dot(lamp.u, lamp.u) - 0.5,
                glm::dot(d, lamp.v) / glm::dot(lamp.v, lamp.v) - 0.5};
    }
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

/// How far points lie beyond a plane, along its normal.
struct Range {
    double least, most;
};

template <typename Points>
Range heights(const Points& points, const glm::dvec3& origin, const glm::dvec3& normal) {
    Range range{HUGE_VAL, -HUGE_VAL};
    for (const glm::dvec3& p : points) {
        const double height = glm::dot(p - origin, normal);
        range = {std::min(range.least, height), std::max(range.most, height)};
    }
    return range;
}

bool is_within(const Range& range, double limit) {
    return range.least >= -limit && range.most <= limit;
}

/// How far the triangle is in front of the lamp, at most, if one lies in the other's plane within
/// `limit`. The plane of the larger is known better: both are tried.
std::optional<double> front_of(const Lamp& lamp, const Triangle& t, double limit) {
    const Range above = heights(t, lamp.corner, lamp.normal);
    if (is_within(above, limit)) return above.most;
    const glm::dvec3 across = glm::cross(t[1] - t[0], t[2] - t[0]);
    if (!(glm::length(across) > 0)) return std::nullopt;
    const double side = glm::dot(across, lamp.normal) < 0 ? -1 : 1;
    const Range beyond = heights(corners_of(lamp), t[0], glm::normalize(side * across));
    if (is_within(beyond, limit)) return -beyond.least;
    return std::nullopt;
}

bool is_apart(const Lamp& lamp, const Triangle& t) {
    const glm::dvec3 lower = glm::min(glm::min(t[0], t[1]), t[2]);
    const glm::dvec3 upper = glm::max(glm::max(t[0], t[1]), t[2]);
    return glm::any(glm::lessThan(upper, lamp.lower)) || glm::any(glm::lessThan(lamp.upper, lower));
}

/// What the lamp has to move to be clear of a triangle; 0: nothing.
double lift_over(const Lamp& lamp, const Triangle& t) {
    if (is_apart(lamp, t)) return 0;
    double largest = lamp.largest;
    for (const glm::dvec3& p : t) largest = std::max(largest, largest_coordinate(p));
    const double needed = std::min(kRounding * largest, lamp.most_lift);
    const std::optional<double> front = front_of(lamp, t, needed);
    return front && overlaps(lamp, t) ? *front + needed : 0;
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

}  // namespace

void clear_lamps(FlatScene& flat, const Vec3& camera) {
    std::vector<Lamp> lamps = lamps_of(flat, camera);
    if (lamps.empty()) return;
    find_lifts(flat, lamps);
    std::vector<Vec3> moves(flat.lights.size(), Vec3(0));
    for (const Lamp& lamp : lamps) moves[lamp.light] = Vec3(lamp.normal * lamp.lift);
    for (std::size_t i = 0; i < moves.size(); ++i) {
        shared::float4& origin = flat.lights[i].origin;
        origin.x += moves[i].x, origin.y += moves[i].y, origin.z += moves[i].z;
    }
    for (std::size_t i = 0; i < flat.shading.size(); ++i) {
        const int light = flat.shading[i].light;
        if (light >= 0 && moves[std::size_t(light)] != Vec3(0))
            move_triangle(flat, i, moves[std::size_t(light)]);
    }
}

}  // namespace wedge::rendering
