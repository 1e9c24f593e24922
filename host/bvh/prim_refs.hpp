// Which triangles go into the tree.
#pragma once

#include <span>

#include "host/bvh/box.hpp"
#include "host/bvh/raw_vector.hpp"
#include "wedge/math.hpp"

namespace wedge::bvh {

struct PrimRefs {
    RawVector<PrimRef> refs;  ///< in the order of the triangles
    uint64_t degenerate_count = 0;
    uint64_t non_finite_count = 0;
};

/// Boxes of all triangles that a ray can hit. Throws Error(bad_input) if an index is out of range.
PrimRefs collect_prim_refs(std::span<const Vec3> positions, std::span<const UVec3> triangles);

/// False if a coordinate is not finite, or so large that differences might not be.
bool is_usable(const Vec3& position);

/// True if the corners lie in one line (or point) as far as the rounding of the cross product in
/// double precision can tell; a sliver of any finite thickness is kept.
bool is_degenerate(const Vec3& v0, const Vec3& v1, const Vec3& v2);

}  // namespace wedge::bvh
