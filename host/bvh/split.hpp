// Divides a set of triangles in two.
#pragma once

#include <span>

#include "host/bvh/box.hpp"

namespace wedge::bvh {

/// Triangles of one node or leaf to be: refs[first, first + count).
struct Range {
    uint32_t first = 0, count = 0;
    Box bounds;     ///< of the triangles
    Box centroids;  ///< of the centres of their boxes
};

struct RangePair {
    Range left, right;  ///< neither is empty
};

/// Range over all of `refs`.
Range whole_range(std::span<const PrimRef> refs);

/// The cheapest of the divisions between equal bins of the centroids on the three axes, by the
/// surface-area heuristic (Wald 2007) with blocks of four triangles as the unit of work. Where all
/// centroids are equal, halves by index. Reorders the refs of the range. `scale` is 1 / the scene's
/// largest extent. Needs count >= 2.
RangePair split_by_area(std::span<PrimRef> refs, const Range& range, float scale);

/// Halves by count along the widest axis of the centroids. Bounds the depth of the tree.
RangePair split_by_count(std::span<PrimRef> refs, const Range& range);

}  // namespace wedge::bvh
