// Moving geometry: a tree follows its vertices, or is built anew.
#pragma once

#include "host/bvh/bvh.hpp"

namespace wedge::bvh {

struct UpdateOptions {
    BvhQuality quality = BvhQuality::medium;  ///< where the tree is built anew
    /// A tree whose cost (expected visits of a ray, by the surface-area heuristic) exceeds that of
    /// the last build by this factor is built anew. 0: always.
    double rebuild_above = 1.5;
};

struct UpdateResult {
    bool rebuilt = false;
    double cost_ratio = 1;  ///< after refitting, to that of the last build
};

/// Expected number of nodes and blocks that a ray through the scene's box visits.
double expected_visits(const Bvh& tree);

/// `positions` have moved, `triangles` are those the tree was built from: boxes and triangles are
/// set anew, which takes a tenth of the time of a build, or the tree is built anew if it got too
/// bad, if a coordinate is not finite, or if triangles that were dropped can now be hit. The bits
/// do not depend on the number of threads. Throws Error(bad_input) if an index is out of range or
/// the number of triangles differs.
UpdateResult update_vertices(Bvh& tree, std::span<const Vec3> positions,
                             std::span<const UVec3> triangles, const UpdateOptions& options = {});

}  // namespace wedge::bvh
