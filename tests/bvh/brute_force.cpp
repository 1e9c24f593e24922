#include "brute_force.hpp"

#include <mutex>

#include "host/base/parallel.hpp"

namespace wedge::test {
namespace {

using Double3 = glm::dvec3;
constexpr double kUnit = 0x1p-24;  // largest relative rounding error of float

/// A vertex in the ray's frame: the ray is the line x = y = 0, t = z / direction along the axis.
struct Sheared {
    double x, y, z;
    double error;  ///< of x and y in single precision
};

struct Frame {
    int ax, ay, az;
    double shear_x, shear_y, direction_z;
    Double3 origin;

    explicit Frame(const PackedRay& ray) : origin(ray.ox, ray.oy, ray.oz) {
        const Double3 d(ray.dx, ray.dy, ray.dz);
        const Double3 size = glm::abs(d);
        az = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
        ax = (az + 1) % 3;
        ay = (az + 2) % 3;
        shear_x = d[ax] / d[az];
        shear_y = d[ay] / d[az];
        direction_z = d[az];
    }
    Sheared operator()(const Vec3& vertex) const {
        const Double3 p = Double3(vertex) - origin;
        const double bent_x = shear_x * p[az], bent_y = shear_y * p[az];
        // Roundings: of p twice, of the shear, of the product and of the sum.
        const double size =
            std::max(std::abs(p[ax]) + std::abs(bent_x), std::abs(p[ay]) + std::abs(bent_y));
        return {p[ax] - bent_x, p[ay] - bent_y, p[az], 4 * kUnit * size};
    }
};

struct Area {
    double value, error;
};

Area area_between(const Sheared& a, const Sheared& b) {
    const double products = std::abs(a.x * b.y) + std::abs(a.y * b.x);
    const double from_vertices = a.error * (std::abs(b.x) + std::abs(b.y)) +
                                 b.error * (std::abs(a.x) + std::abs(a.y)) + 2 * a.error * b.error;
    return {a.x * b.y - a.y * b.x, from_vertices + 3 * kUnit * products};
}

Verdict judge_in_frame(const Frame& frame, const Vec3& p0, const Vec3& p1, const Vec3& p2) {
    const Sheared v0 = frame(p0), v1 = frame(p1), v2 = frame(p2);
    // Most triangles lie to one side of the ray, whatever the rounding.
    const auto beside = [](double a, double b, double c, double e) {
        return (a > e && b > e && c > e) || (a < -e && b < -e && c < -e);
    };
    const double e = std::max(std::max(v0.error, v1.error), v2.error);
    if (beside(v0.x, v1.x, v2.x, e) || beside(v0.y, v1.y, v2.y, e)) return {};

    const Area a0 = area_between(v1, v2), a1 = area_between(v2, v0), a2 = area_between(v0, v1);
    const bool positive = a0.value > a0.error && a1.value > a1.error && a2.value > a2.error;
    const bool negative = a0.value < -a0.error && a1.value < -a1.error && a2.value < -a2.error;
    const bool not_negative =
        a0.value >= -a0.error && a1.value >= -a1.error && a2.value >= -a2.error;
    const bool not_positive = a0.value <= a0.error && a1.value <= a1.error && a2.value <= a2.error;
    if (!not_negative && !not_positive) return {};

    const double det = a0.value + a1.value + a2.value;
    const double det_error = a0.error + a1.error + a2.error + 3 * kUnit * std::abs(det);
    const double weighted = a0.value * v0.z + a1.value * v1.z + a2.value * v2.z;
    const double weighted_size =
        std::abs(a0.value * v0.z) + std::abs(a1.value * v1.z) + std::abs(a2.value * v2.z);
    const double weighted_error = a0.error * std::abs(v0.z) + a1.error * std::abs(v1.z) +
                                  a2.error * std::abs(v2.z) + 8 * kUnit * weighted_size;
    Verdict verdict;
    verdict.kind = Verdict::unsure;
    verdict.t_error = INFINITY;
    if (std::abs(det) <= 2 * det_error) return verdict;  // edge-on, as far as one can tell
    verdict.t = weighted / det / frame.direction_z;
    const double scale = 1 / (std::abs(det) - det_error) / std::abs(frame.direction_z);
    verdict.t_error = (weighted_error + std::abs(weighted / det) * det_error) * scale +
                      4 * kUnit * std::abs(verdict.t);
    if (positive || negative) verdict.kind = Verdict::hit;
    return verdict;
}

/// What any triangle does to the ray.
struct Truth {
    double sure_t = INFINITY;  ///< no sound answer lies beyond this
    bool may_hit = false;
    bool unsure = false;
};

Truth find_truth(const Triangles& triangles, const PackedRay& ray) {
    const Frame frame(ray);
    Truth truth;
    for (uint32_t i = 0; i < triangles.indices.size(); ++i) {
        if (i == ray.source) continue;
        const UVec3 t = triangles.indices[i];
        const Verdict v = judge_in_frame(frame, triangles.positions[t.x], triangles.positions[t.y],
                                         triangles.positions[t.z]);
        if (v.kind == Verdict::miss) continue;
        if (v.t + v.t_error <= 0 || v.t - v.t_error >= ray.t_max) continue;
        truth.may_hit = true;
        const bool sure =
            v.kind == Verdict::hit && v.t - v.t_error > 0 && v.t + v.t_error < ray.t_max;
        if (sure)
            truth.sure_t = std::min(truth.sure_t, v.t + v.t_error);
        else
            truth.unsure = true;
    }
    return truth;
}

bool closest_is_right(const Triangles& triangles, const PackedRay& ray, const PackedHit& hit,
                      const Truth& truth) {
    if (hit.primitive == WEDGE_NO_PRIMITIVE) return truth.sure_t == INFINITY;
    if (hit.primitive == ray.source || hit.primitive >= triangles.indices.size()) return false;
    if (!(hit.t > 0 && hit.t < ray.t_max)) return false;
    const Verdict own = judge(triangles, hit.primitive, ray);
    if (own.kind == Verdict::miss || std::abs(hit.t - own.t) > own.t_error) return false;
    return hit.t <= truth.sure_t;
}

template <typename IsRight>
Score score(const Triangles& triangles, std::span<const PackedRay> rays, const IsRight& is_right) {
    Score total;
    std::mutex mutex;
    parallel_ranges(rays.size(), 1024, [&](std::size_t begin, std::size_t end) {
        Score part;
        for (std::size_t i = begin; i < end; ++i) {
            const Truth truth = find_truth(triangles, rays[i]);
            part.unsure += truth.unsure;
            part.hits += truth.sure_t < INFINITY;
            if (is_right(i, truth)) continue;
            part.first_wrong = part.wrong++ == 0 ? i : part.first_wrong;
        }
        const std::lock_guard lock(mutex);
        total.unsure += part.unsure;
        total.hits += part.hits;
        if (part.wrong) total.first_wrong = part.first_wrong;
        total.wrong += part.wrong;
    });
    return total;
}

}  // namespace

Verdict judge(const Triangles& triangles, uint32_t primitive, const PackedRay& ray) {
    const UVec3 t = triangles.indices[primitive];
    return judge_in_frame(Frame(ray), triangles.positions[t.x], triangles.positions[t.y],
                          triangles.positions[t.z]);
}

Score score_closest(const Triangles& triangles, std::span<const PackedRay> rays,
                    std::span<const PackedHit> hits) {
    return score(triangles, rays, [&](std::size_t i, const Truth& truth) {
        return closest_is_right(triangles, rays[i], hits[i], truth);
    });
}

Score score_occluded(const Triangles& triangles, std::span<const PackedRay> rays,
                     std::span<const PackedHit> hits) {
    return score(triangles, rays, [&](std::size_t i, const Truth& truth) {
        const bool occluded = hits[i].primitive != WEDGE_NO_PRIMITIVE;
        return occluded ? truth.may_hit : truth.sure_t == INFINITY;
    });
}

}  // namespace wedge::test
