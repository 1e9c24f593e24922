#include "host/render/long_triangles.hpp"

#include <algorithm>
#include <mutex>

#include "host/base/parallel.hpp"

namespace wedge::rendering {
namespace {

constexpr std::size_t kGrain = 1 << 14;  // triangles a task
constexpr double kLong = 4;              // times as long as wide

/// In doubles, where no scene is too small or too large for squares.
bool is_long(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
    const glm::dvec3 a = q - p, b = r - q, c = p - r;
    const double longest = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
    const double twice_area = glm::length(glm::cross(a, b));
    return twice_area > 0 && kLong * twice_area <= longest;
}

}  // namespace

std::vector<uint32_t> find_long_triangles(const FlatScene& flat) {
    std::vector<uint32_t> all;
    std::mutex mutex;
    parallel_ranges(flat.triangles.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        std::vector<uint32_t> found;
        for (std::size_t i = begin; i < end; ++i) {
            const UVec3 t = flat.triangles[i];
            if (is_long(glm::dvec3(flat.positions[t.x]), glm::dvec3(flat.positions[t.y]),
                        glm::dvec3(flat.positions[t.z])))
                found.push_back(uint32_t(i));
        }
        const std::lock_guard lock(mutex);
        all.insert(all.end(), found.begin(), found.end());
    });
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace wedge::rendering
