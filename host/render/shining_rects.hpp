// Rectangles among shining triangles: most lamps of models are two triangles, and rectangles are
// sampled better and have shadows that can be filtered.
#pragma once

#include <cstddef>
#include <vector>

#include "wedge/scene.hpp"

namespace wedge::rendering {

/// Of light with less than this share of the power of all nothing is seen.
inline constexpr double kNegligiblePower = 1e-6;

/// Triangles `triangle` and `triangle` + 1 of an instance's mesh, in world space.
struct ShiningRect {
    std::size_t instance, triangle;
    RectLight light;
};

/// Pairs of neighbouring triangles of one evenly shining material that make a rectangle. In the
/// order of the instances and their triangles.
std::vector<ShiningRect> find_shining_rects(const Scene& scene);

/// Power of all shining triangles, those of rectangles too, in units of light_power(). Textures of
/// emission count as white.
double shining_power(const Scene& scene);

/// Whether triangles shine that are not part of such a rectangle, by more than what is seen.
bool shines_beside_rects(const Scene& scene);

}  // namespace wedge::rendering
