#include "host/scene/probe.hpp"

#include <numbers>

namespace wedge::scene {

std::vector<ProbeHit> probe(const Mesh& mesh, const Vec3& origin,
                            const std::vector<Vec3>& directions) {
    std::vector<ProbeHit> hits(directions.size());
    for (uint32_t number = 0; number < mesh.triangles.size(); ++number) {
        const UVec3& triangle = mesh.triangles[number];
        const Vec3 a = mesh.positions[triangle.x] - origin;
        const Vec3 ab = mesh.positions[triangle.y] - origin - a;
        const Vec3 ac = mesh.positions[triangle.z] - origin - a;
        const Vec3 normal = glm::cross(ab, ac);
        const float volume = glm::dot(a, normal);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            // Cramer's rule on a + u ab + v ac = t d, after Möller and Trumbore 1997.
            const Vec3& d = directions[i];
            const float determinant = glm::dot(d, normal);
            const float t = volume / determinant;
            if (!(t > 0) || !(t < hits[i].distance)) continue;
            const Vec3 across = glm::cross(d, a);
            const float u = -glm::dot(ac, across) / determinant;
            const float v = glm::dot(ab, across) / determinant;
            if (u >= 0 && v >= 0 && u + v <= 1)
                hits[i] = {t, normal / glm::length(normal), determinant < 0, number};
        }
    }
    return hits;
}

std::vector<Vec3> sphere_directions(int count) {
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0));  // the golden angle
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) {
        const double y = 1 - (2 * i + 1) / double(count), r = std::sqrt(1 - y * y);
        result.emplace_back(r * std::cos(i * turn), y, r * std::sin(i * turn));
    }
    return result;
}

}  // namespace wedge::scene
