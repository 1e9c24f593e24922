// Lights of a scene file.
#pragma once

#include "host/scene/json_reader.hpp"
#include "wedge/scene.hpp"

namespace wedge::scene {

/// Reads `/lights` into the scene. Throws Error(bad_input).
void read_lights(const JsonView& lights, Scene& scene);

/// Radiant power per unit of radiance at the centre, m^2 sr: pi times the integral of the profile
/// over the rectangle.
double power_per_radiance(const RectLight& light);

}  // namespace wedge::scene
