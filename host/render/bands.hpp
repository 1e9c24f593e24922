// Films that do not fit a buffer of the device are rendered in bands of rows, one after the other.
// Random numbers go by the place on the film, so that the bits are those of the whole.
#pragma once

#include <vector>

#include "wedge/render.hpp"

namespace wedge::rendering {

/// The crop in as few bands of full rows as fit, of about equal height, from the top. What fits is
/// what the device and options.film_bytes allow. Throws Error(usage) where there must be several
/// and the options do not go with that.
std::vector<Rect> cut_into_bands(const Rect& crop, const RenderOptions& options,
                                 const DeviceInfo& device);

}  // namespace wedge::rendering
