// Rectangular lamps that lie in a surface, as one in a ceiling does. Rounding would decide, ray by
// ray, which of the two is met: noise in what is seen, and light missing wherever scattered rays
// have to find what sampling of lights does not stand for.
#pragma once

#include "host/render/flatten.hpp"

namespace wedge::rendering {

/// Moves lamps that lie in the plane of triangles that they overlap to the side they shine to,
/// until they are as far in front as rounding may be off: some 2e-6 of the largest coordinate of
/// lamp, triangle and camera, and at most a thousandth of the lamp's shorter side. A lamp counts as
/// in the plane if it is no farther from it, to either side. Triangles that shine do not count, nor
/// do lamps beyond the 256 most powerful. Where nothing is in a lamp's plane nothing changes.
void clear_lamps(FlatScene& flat, const Vec3& camera);

}  // namespace wedge::rendering
