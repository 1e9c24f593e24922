// Takes what is on the device into the image.
#pragma once

#include "host/render/bands.hpp"
#include "host/render/path_tracer.hpp"
#include "host/render/signal_filter.hpp"

namespace wedge::rendering {

/// The band that is on the device, and what filters have made of it, if anything. `complete`: all
/// of it is filtered; then its error is joined to that of the bands before, all of `pixels_before`.
void finish_band(PathTracer& tracer, const RenderOptions& options, const Band& band,
                 const FilteredLight& filtered, bool complete, uint64_t pixels_before,
                 Frame& frame);

}  // namespace wedge::rendering
