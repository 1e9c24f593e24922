// The solids that several kinds are made of.
#include <cmath>

#include "scenes/generators/mesh_builder.hpp"

namespace wedge::scenes {
namespace {

/// Point of a circle divided into `count`, in the plane of two unit vectors.
Vec3 on_circle(int index, int count, const Vec3& u, const Vec3& v) {
    const double angle = 2 * double(kPi) * index / count;
    return float(std::cos(angle)) * u + float(std::sin(angle)) * v;
}

Vec3 any_perpendicular(const Vec3& d) {
    const Vec3 away = std::abs(d.x) < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
    return glm::normalize(glm::cross(d, away));
}

/// Direction of the line at point i: the mean of its two segments.
Vec3 tangent(const std::vector<Vec3>& points, std::size_t i) {
    const Vec3& before = points[i == 0 ? 0 : i - 1];
    const Vec3& after = points[i + 1 < points.size() ? i + 1 : i];
    return glm::normalize(after - before);
}

}  // namespace

void add_ground(MeshBuilder& builder, float side, float height, uint32_t material) {
    const float h = side / 2;
    builder.face({-h, height, -h}, {-h, height, h}, {h, height, h}, {h, height, -h}, material);
}

void add_box(MeshBuilder& builder, const Vec3& center, const Vec3& half, float angle_rad,
             uint32_t material) {
    const float c = std::cos(angle_rad), s = std::sin(angle_rad);
    const auto corner = [&](int x, int y, int z) {
        const Vec3 p(x * half.x, y * half.y, z * half.z);
        return center + Vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
    };
    const Vec3 p[2][2][2] = {
        {{corner(-1, -1, -1), corner(-1, -1, 1)}, {corner(-1, 1, -1), corner(-1, 1, 1)}},
        {{corner(1, -1, -1), corner(1, -1, 1)}, {corner(1, 1, -1), corner(1, 1, 1)}}};
    builder.face(p[0][0][0], p[0][0][1], p[0][1][1], p[0][1][0], material);  // -x
    builder.face(p[1][0][1], p[1][0][0], p[1][1][0], p[1][1][1], material);  // +x
    builder.face(p[0][0][0], p[1][0][0], p[1][0][1], p[0][0][1], material);  // -y
    builder.face(p[0][1][1], p[1][1][1], p[1][1][0], p[0][1][0], material);  // +y
    builder.face(p[1][0][0], p[0][0][0], p[0][1][0], p[1][1][0], material);  // -z
    builder.face(p[0][0][1], p[1][0][1], p[1][1][1], p[0][1][1], material);  // +z
}

void add_sphere(MeshBuilder& builder, const Vec3& center, float radius, int rings, float bumps,
                uint32_t material) {
    const int meridians = 2 * rings;
    const uint32_t north = builder.vertex(center + Vec3(0, radius, 0), {0, 1, 0});
    const uint32_t first = north + 1;
    for (int i = 1; i < rings; ++i) {
        const double t = double(kPi) * i / rings;
        const double st = std::sin(t), ct = std::cos(t), s7 = std::sin(7 * t), c7 = std::cos(7 * t);
        for (int j = 0; j < meridians; ++j) {
            const double p = 2 * double(kPi) * j / meridians;
            const double sp = std::sin(p), cp = std::cos(p), s5 = std::sin(5 * p),
                         c5 = std::cos(5 * p);
            const Vec3 outward(st * cp, ct, st * sp), along_t(ct * cp, -st, ct * sp),
                along_p(-sp, 0, cp);
            // The normal of r(t, p) is r outward - dr/dt along_t - (dr/dp / sin t) along_p. The
            // factor sin(t) in the bumps makes both derivatives vanish at the poles.
            const double r = 1 + bumps * st * s7 * c5;
            const double dr_dt = bumps * (ct * s7 + 7 * st * c7) * c5;
            const double dr_dp_over_sin = -5 * bumps * s7 * s5;
            const Vec3 normal =
                float(r) * outward - float(dr_dt) * along_t - float(dr_dp_over_sin) * along_p;
            builder.vertex(center + float(radius * r) * outward, glm::normalize(normal));
        }
    }
    const uint32_t south = builder.vertex(center - Vec3(0, radius, 0), {0, -1, 0});

    const auto at = [&](int ring, int j) {
        return first + uint32_t((ring - 1) * meridians + j % meridians);
    };
    for (int j = 0; j < meridians; ++j) {
        builder.triangle(north, at(1, j + 1), at(1, j), material);
        for (int i = 1; i + 1 < rings; ++i)
            builder.quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j), material);
        builder.triangle(at(rings - 1, j), at(rings - 1, j + 1), south, material);
    }
}

namespace {

/// Disc over a ring of points; `outward` is its normal and decides the winding.
void add_cap(MeshBuilder& builder, const Vec3& center, const std::vector<Vec3>& ring,
             const Vec3& outward, bool reversed, uint32_t material) {
    const uint32_t middle = builder.vertex(center, outward);
    for (const Vec3& p : ring) builder.vertex(p, outward);
    const auto sides = uint32_t(ring.size());
    for (uint32_t j = 0; j < sides; ++j) {
        const uint32_t a = middle + 1 + j, b = middle + 1 + (j + 1) % sides;
        builder.triangle(middle, reversed ? b : a, reversed ? a : b, material);
    }
}

}  // namespace

void add_tube(MeshBuilder& builder, const std::vector<Vec3>& points,
              const std::vector<float>& radii, int sides, uint32_t material) {
    const bool has_tip = radii.back() == 0;
    const std::size_t rings = points.size() - (has_tip ? 1 : 0);
    std::vector<Vec3> first_ring, last_ring;
    uint32_t first = 0;
    Vec3 u = any_perpendicular(tangent(points, 0));
    for (std::size_t i = 0; i < rings; ++i) {
        // Carry the frame along by projection, so that the tube does not twist.
        const Vec3 d = tangent(points, i);
        u = glm::normalize(u - glm::dot(u, d) * d);
        const Vec3 v = glm::cross(d, u);
        // The cone's slope tilts the normal: (radius change) / (length) along the line.
        const std::size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, points.size() - 1);
        const float slope = (radii[b] - radii[a]) / glm::length(points[b] - points[a]);
        last_ring.clear();
        for (int j = 0; j < sides; ++j) {
            const Vec3 out = on_circle(j, sides, u, v);
            last_ring.push_back(points[i] + radii[i] * out);
            const uint32_t index =
                builder.vertex(last_ring.back(), glm::normalize(out - slope * d));
            if (i == 0 && j == 0) first = index;
        }
        if (i == 0) first_ring = last_ring;
    }
    const auto at = [&](std::size_t ring, int j) {
        return first + uint32_t(ring) * uint32_t(sides) + uint32_t(j % sides);
    };
    for (std::size_t i = 0; i + 1 < rings; ++i)
        for (int j = 0; j < sides; ++j)
            builder.quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j), material);

    const Vec3 start = tangent(points, 0), end = tangent(points, points.size() - 1);
    if (has_tip) {
        const uint32_t tip = builder.vertex(points.back(), end);
        for (int j = 0; j < sides; ++j)
            builder.triangle(at(rings - 1, j), at(rings - 1, j + 1), tip, material);
    } else {
        add_cap(builder, points.back(), last_ring, end, false, material);
    }
    add_cap(builder, points.front(), first_ring, -start, true, material);
}

}  // namespace wedge::scenes
