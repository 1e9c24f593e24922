// Divides a set of triangles in two.
#pragma once

#include <span>

#include "host/bvh/box.hpp"
#include "wedge/math.hpp"

namespace wedge::bvh {

/// Triangles of one node or leaf to be: refs[first, first + count).
struct Range {
    uint32_t first = 0, count = 0;
    uint32_t capacity = 0;  ///< refs that may be written from `first` on; at least `count`
    Box bounds;             ///< of the triangles
    Box centroids;          ///< of the centres of their boxes, doubled
};

struct RangePair {
    Range left, right;  ///< neither is empty
};

/// What divisions depend on besides the triangles at hand.
struct Splitter {
    std::span<const Vec3> positions;
    std::span<const UVec3> triangles;
    float scale = 1;           ///< 1 / the scene's largest extent
    float least_overlap = -1;  ///< of half areas, scaled, before triangles are cut; < 0: never
};

/// The unit of work in the surface-area heuristic: blocks of four.
inline float block_count(uint32_t triangles) {
    return float((triangles + 3) / 4);
}

/// Of `room` spare places, those for the left side: in proportion.
inline uint32_t room_of_left(uint32_t room, uint32_t left_count, uint32_t right_count) {
    return uint32_t(uint64_t(room) * left_count / (uint64_t(left_count) + right_count));
}

/// Range over all of `refs`, without spare places.
Range whole_range(std::span<const PrimRef> refs);

/// The cheapest of the divisions between equal bins of the centroids on the three axes, by the
/// surface-area heuristic (Wald 2007). Where all centroids are equal, halves by index. Reorders the
/// refs of the range. Where the sides overlap by more than `least_overlap`, divisions that cut
/// triangles are considered too (host/bvh/spatial.hpp). Spare places are shared out. Needs
/// count >= 2.
RangePair split_by_area(const Splitter& splitter, std::span<PrimRef> refs, const Range& range);

/// Halves by count along the widest axis of the centroids. Bounds the depth of the tree.
RangePair split_by_count(std::span<PrimRef> refs, const Range& range);

}  // namespace wedge::bvh
