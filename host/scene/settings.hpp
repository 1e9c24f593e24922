// Camera, film and render defaults of a scene file.
#pragma once

#include "host/scene/json_reader.hpp"
#include "wedge/scene.hpp"

namespace wedge::scene {

/// Each reads one member of the root. Throws Error(bad_input).
Camera read_camera(const JsonView& view);
Film read_film(const JsonView& view);
RenderDefaults read_render_defaults(const JsonView& view);

inline constexpr int kLargestSide_px = 65536;
/// 4 GiB of RGBA in single precision.
inline constexpr long long kMostPixels = 1ll << 28;

}  // namespace wedge::scene
