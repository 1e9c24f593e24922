#include "host/scene/triangulate.hpp"

#include <numeric>

namespace wedge::scene {
namespace {

using DVec2 = glm::dvec2;
using DVec3 = glm::dvec3;

/// Twice the signed area of a triangle.
double area2(const DVec2& a, const DVec2& b, const DVec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon in the plane that shows most of it, counter-clockwise.
std::vector<DVec2> flattened(const std::vector<Vec3>& corners) {
    // Newell's normal: right for any planar polygon, and a fit for those not quite planar. Measured
    // from the first corner, so that large coordinates cost no digits.
    const DVec3 origin(corners[0]);
    DVec3 normal(0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += glm::cross(DVec3(corners[i]) - origin,
                             DVec3(corners[(i + 1) % corners.size()]) - origin);
    const DVec3 size = glm::abs(normal);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::vector<DVec2> result;
    for (const Vec3& corner : corners) {
        const DVec3 p = DVec3(corner) - origin;
        result.push_back(normal[axis] >= 0 ? DVec2(p[u], p[v]) : DVec2(p[v], p[u]));
    }
    return result;
}

/// Whether the corner at `i` of the remaining ring can be cut off.
bool is_ear(const std::vector<DVec2>& points, const std::vector<uint32_t>& ring, std::size_t i) {
    const std::size_t n = ring.size();
    const uint32_t a = ring[(i + n - 1) % n], b = ring[i], c = ring[(i + 1) % n];
    if (!(area2(points[a], points[b], points[c]) > 0)) return false;
    for (uint32_t other : ring) {
        if (other == a || other == b || other == c) continue;
        const DVec2& p = points[other];
        // A corner that repeats one of the ear's (a hole cut in with a bridge) does not block it.
        if (p == points[a] || p == points[b] || p == points[c]) continue;
        if (area2(points[a], points[b], p) >= 0 && area2(points[b], points[c], p) >= 0 &&
            area2(points[c], points[a], p) >= 0)
            return false;
    }
    return true;
}

}  // namespace

std::vector<std::array<uint32_t, 3>> triangulate(const std::vector<Vec3>& corners) {
    std::vector<std::array<uint32_t, 3>> triangles;
    if (corners.size() < 3) return triangles;
    if (corners.size() == 3) return {{0, 1, 2}};

    const std::vector<DVec2> points = flattened(corners);
    std::vector<uint32_t> ring(corners.size());
    std::iota(ring.begin(), ring.end(), 0u);
    if (corners.size() == 4) {
        // Starting at the first or second corner decides the diagonal; the ear test vetoes outside
        // ones.
        const bool second =
            glm::distance(points[1], points[3]) < glm::distance(points[0], points[2]);
        const uint32_t first = second ? 0 : 1;
        if (is_ear(points, ring, first) && is_ear(points, ring, first + 2)) {
            const uint32_t last = (first + 3) % 4;
            return {{last, first, first + 1}, {first + 1, first + 2, last}};
        }
    }

    std::size_t i = 0, refused = 0;
    while (ring.size() > 3) {
        const std::size_t n = ring.size();
        i %= n;
        // When no corner is an ear the polygon is not simple: cut anyway, the count stays right.
        if (is_ear(points, ring, i) || refused >= n) {
            triangles.push_back({ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]});
            ring.erase(ring.begin() + std::ptrdiff_t(i));
            refused = 0;
        } else {
            ++i;
            ++refused;
        }
    }
    triangles.push_back({ring[0], ring[1], ring[2]});
    return triangles;
}

}  // namespace wedge::scene
