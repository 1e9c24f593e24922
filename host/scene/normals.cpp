#include "host/scene/normals.hpp"

#include <bit>
#include <unordered_map>

namespace wedge::scene {
namespace {

struct PositionHash {
    std::size_t operator()(const Vec3& p) const {
        uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) {
            // + 0 turns -0 into 0, which compares equal and must hash equal.
            hash = (hash ^ std::bit_cast<uint32_t>(p[axis] + 0.0f)) * 0x9e3779b97f4a7c15u;
            hash ^= hash >> 32;
        }
        return std::size_t(hash);
    }
};

/// Angle between two edges, radians; 0 where one has no length.
float angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

void make_smooth_normals(Mesh& mesh) {
    std::unordered_map<Vec3, Vec3, PositionHash> sum_at;
    sum_at.reserve(mesh.positions.size());
    for (const UVec3& triangle : mesh.triangles) {
        const Vec3 p[3] = {mesh.positions[triangle.x], mesh.positions[triangle.y],
                           mesh.positions[triangle.z]};
        // Scaled to its longest side, so that tiny and huge triangles keep their normals.
        const Vec3 ab = p[1] - p[0], ac = p[2] - p[0];
        const float longest = std::sqrt(std::max(glm::dot(ab, ab), glm::dot(ac, ac)));
        const Vec3 cross = glm::cross(ab / longest, ac / longest);
        const float length = glm::length(cross);
        if (!(length > 0) || !std::isfinite(length)) continue;
        for (int i = 0; i < 3; ++i) {
            const float angle =
                angle_between((p[(i + 1) % 3] - p[i]) / longest, (p[(i + 2) % 3] - p[i]) / longest);
            sum_at[p[i]] += cross / length * angle;
        }
    }

    mesh.normals.resize(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const auto sum = sum_at.find(mesh.positions[i]);
        const float length = sum == sum_at.end() ? 0 : glm::length(sum->second);
        mesh.normals[i] = length > 0 ? sum->second / length : Vec3(0);
    }
}

}  // namespace wedge::scene
