// Divisions of space that cut triangles in two (Stich, Friedrich and Dietrich 2009).
#pragma once

#include <optional>
#include <span>

#include "host/bvh/split.hpp"
#include "wedge/math.hpp"

namespace wedge::bvh {

struct SpatialPlane {
    int axis = -1;  ///< -1: none
    float position = 0;
    float cost = std::numeric_limits<float>::infinity();  ///< in the units of split_by_area
};

/// The cheapest of equally spaced planes through the range's box on the three axes, counting a cut
/// triangle on both sides with the boxes of its parts.
SpatialPlane find_spatial_plane(const Splitter& splitter, std::span<const PrimRef> refs,
                                const Range& range);

/// Divides the range there. Triangles across the plane become two refs while there is room within
/// the range's capacity and while that is cheaper than to leave them whole on one side. Nothing if
/// one side would be empty.
std::optional<RangePair> split_by_space(const Splitter& splitter, std::span<PrimRef> refs,
                                        const Range& range, const SpatialPlane& plane);

/// The parts of a ref on the two sides of a plane that goes through its box. Their boxes contain
/// all points of the triangle within the ref's box, whatever the rounding.
struct CutRef {
    PrimRef left, right;
};
CutRef cut_ref(const Splitter& splitter, const PrimRef& ref, int axis, float position);

}  // namespace wedge::bvh
