// Camera, film and render defaults of a scene file.
#pragma once

#include "host/scene/json_reader.hpp"
#include "wedge/scene.hpp"

namespace wedge::scene {

/// Each reads one member of the root. Throws Error(bad_input).
Camera read_camera(const JsonView& view);
Film read_film(const JsonView& view);
RenderDefaults read_render_defaults(const JsonView& view);

}  // namespace wedge::scene
