// A look around in a mesh, before there is any acceleration structure.
#pragma once

#include <vector>

#include "wedge/scene.hpp"

namespace wedge::scene {

struct ProbeHit {
    float distance = INFINITY;  ///< in lengths of the direction; infinite where nothing is hit
    Vec3 normal{0};             ///< of the triangle's front, unit
    bool front = false;         ///< the front was hit
    uint32_t triangle = ~0u;    ///< which; ~0 where nothing is hit
};

/// Nearest hits of rays from one point, by trying every triangle: for a few dozen rays, once.
std::vector<ProbeHit> probe(const Mesh& mesh, const Vec3& origin,
                            const std::vector<Vec3>& directions);

/// `count` unit vectors spread evenly over the sphere (Fibonacci lattice).
std::vector<Vec3> sphere_directions(int count);

}  // namespace wedge::scene
