// Triangles to an 8-wide bounding volume hierarchy, on the host.
#pragma once

#include <cstdint>
#include <span>

#include "host/bvh/raw_vector.hpp"
#include "wedge/bvh.hpp"
#include "wedge/math.hpp"
#include "wedge/shared/bvh.h"

namespace wedge::bvh {

/// nodes[0] is the root and is there even for an empty scene (all slots unused).
struct Bvh {
    RawVector<shared::BvhNode> nodes;
    RawVector<shared::TriangleBlock> blocks;
    Bounds bounds;                  ///< of the triangles kept
    uint64_t degenerate_count = 0;  ///< dropped: two corners equal, or corners in one line
    uint64_t non_finite_count = 0;  ///< dropped: a corner is NaN, infinite or beyond FLT_MAX / 4
    uint32_t depth = 0;             ///< levels of nodes, at most WEDGE_MAX_DEPTH
    uint64_t triangle_count = 0;    ///< it was built from, dropped ones included
    double built_visits = 0;  ///< expected_visits when built; 0: not yet asked for (update.hpp)
    double build_s = 0;
};

/// False for a slot without a child.
inline bool is_used(const shared::BvhNode& node, int slot) {
    return node.bounds[0][slot] <= node.bounds[1][slot];
}

/// Binned surface-area heuristic (Wald 2007), cut into nodes of 8 children. `triangles` index
/// `positions`; TriangleBlock::primitive is the index into `triangles`. The same input gives the
/// same bits whatever the number of threads. Throws Error(bad_input) if an index is out of range.
Bvh build(std::span<const Vec3> positions, std::span<const UVec3> triangles,
          BvhQuality quality = BvhQuality::medium);

}  // namespace wedge::bvh
