#include "host/render/shining_rects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "host/render/lights.hpp"

namespace wedge::rendering {
namespace {

using Corners = std::array<glm::dvec3, 3>;

constexpr double kSameLength = 1e-5;  // relative: models store six or seven digits
constexpr double kRightAngle = 1e-4;  // cosine

uint32_t material_of(const Scene& scene, const Instance& instance, std::size_t triangle) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (instance.material) return *instance.material;
    return mesh.material_of.empty() ? 0u : mesh.material_of[triangle];
}

bool shines_evenly(const Material& m) {
    return m.emission != Vec3(0) && m.emission_texture < 0;
}

Corners corners_of(const Mesh& mesh, const Mat4& transform, std::size_t triangle) {
    Corners corners;
    for (int k = 0; k < 3; ++k) {
        const Vec3& p = mesh.positions[mesh.triangles[triangle][k]];
        corners[k] = glm::dvec3(Vec3(transform * Vec4(p, 1)));
    }
    return corners;
}

/// Corner and edges of the rectangle of triangles `a` and `b`, turned as `a` is.
std::optional<RectLight> rectangle(const Corners& a, const Corners& b, bool mirrored) {
    for (int k = 0; k < 3; ++k) {  // the corner of `a` that `b` has not
        const glm::dvec3 corner = a[k], u = a[(k + 1) % 3] - corner, v = a[(k + 2) % 3] - corner;
        const double size = std::max(glm::length(u), glm::length(v)), near = kSameLength * size;
        if (std::abs(glm::dot(u, v)) > kRightAngle * glm::length(u) * glm::length(v)) continue;
        const glm::dvec3 ends[3] = {corner + u, corner + u + v, corner + v};
        int met = 0;
        for (const glm::dvec3& end : ends)
            for (const glm::dvec3& p : b) met += glm::length(p - end) <= near;
        if (met != 3 || !(glm::length(glm::cross(u, v)) > 0)) continue;
        RectLight light;
        light.center = Vec3(corner + 0.5 * (u + v));
        light.edge_u = Vec3(mirrored ? v : u);
        light.edge_v = Vec3(mirrored ? u : v);
        return light;
    }
    return std::nullopt;
}

/// True if the triangles face the same side.
bool same_side(const Corners& a, const Corners& b) {
    return glm::dot(glm::cross(a[1] - a[0], a[2] - a[0]), glm::cross(b[1] - b[0], b[2] - b[0])) > 0;
}

}  // namespace

std::vector<ShiningRect> find_shining_rects(const Scene& scene) {
    std::vector<ShiningRect> found;
    if (std::none_of(scene.materials.begin(), scene.materials.end(), shines_evenly)) return found;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshes[instance.mesh];
        const bool mirrored = glm::determinant(glm::mat3(instance.transform)) < 0;
        for (std::size_t t = 0; t + 1 < mesh.triangles.size(); ++t) {
            const uint32_t material = material_of(scene, instance, t);
            const Material& m = scene.materials[material];
            if (!shines_evenly(m) || material_of(scene, instance, t + 1) != material) continue;
            const Corners a = corners_of(mesh, instance.transform, t),
                          b = corners_of(mesh, instance.transform, t + 1);
            if (!same_side(a, b)) continue;
            std::optional<RectLight> light = rectangle(a, b, mirrored);
            if (!light) continue;
            light->radiance = m.emission;
            found.push_back({i, t, *light});
            ++t;
        }
    }
    return found;
}

double shining_power(const Scene& scene) {
    double power = 0;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const Material& m = scene.materials[material_of(scene, instance, t)];
            if (m.emission == Vec3(0)) continue;
            const Corners c = corners_of(mesh, instance.transform, t);
            const double area = 0.5 * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
            if (std::isfinite(area)) power += light_power(area, m.emission);
        }
    }
    return power;
}

bool shines_beside_rects(const Scene& scene) {
    double rects = 0;
    for (const ShiningRect& rect : find_shining_rects(scene)) rects += light_power(rect.light);
    return shining_power(scene) > (1 + kNegligiblePower) * rects;
}

}  // namespace wedge::rendering
