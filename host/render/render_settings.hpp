// Options and scene defaults to the numbers a render runs with, checked.
#pragma once

#include "host/render/path_tracer.hpp"
#include "wedge/render.hpp"

namespace wedge::rendering {

/// Throws Error(usage) where an option is out of range.
PathSettings make_path_settings(const Scene& scene, const RenderOptions& options);

/// Samples a pixel gets if nothing stops the render.
uint32_t sample_count(const Scene& scene, const RenderOptions& options);

}  // namespace wedge::rendering
