// Placement of instances.
#pragma once

#include "host/scene/json_reader.hpp"
#include "wedge/math.hpp"

namespace wedge::scene {

/// Object to world, from `{translate, rotate_deg, axis, scale}` (scaled, then rotated, then moved),
/// `{matrix}`, a bare 4x4 matrix, or a list of these, the first applied first. Matrices are
/// row-major, 16 numbers or 4 rows of 4, with the translation in the last column. Throws
/// Error(bad_input) where the result is not affine or not invertible.
Mat4 read_transform(const JsonView& view);

}  // namespace wedge::scene
