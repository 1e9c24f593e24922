// Errors of single pixels and colours, from what the guard tells.
#pragma once

#include <span>
#include <vector>

#include "wedge/math.hpp"
#include "wedge/shared/filter.h"

namespace wedge::rendering {

/// Mean square errors of R, G and B by pixel: of light that is filtered, the noise of what is not,
/// and what edges in the pixel leave. `width`: pixels in a row.
///
/// The guard tells one error for all pixels around. Noise and bias go with the light, so that in a
/// dark pixel or colour they are the same share of it, not as large. What the guard tells is scaled
/// so that it adds up to no more than what pixels measure, and its standard error.
std::vector<Vec3> told_errors(std::span<const shared::GuardedPixel> guarded, std::size_t width);

}  // namespace wedge::rendering
