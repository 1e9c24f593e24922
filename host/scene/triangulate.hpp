// Polygons into triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "wedge/math.hpp"

namespace wedge::scene {

/// Corners (positions in `corners`, 0-based) of the triangles that cover a simple polygon, convex
/// or not, in its winding. Always size - 2 of them; where the polygon has no area or crosses
/// itself, they are some fan. Quads are cut along the shorter diagonal that lies inside.
std::vector<std::array<uint32_t, 3>> triangulate(const std::vector<Vec3>& corners);

}  // namespace wedge::scene
