// A camera and a light for a model that comes without.
#pragma once

#include "wedge/scene.hpp"

namespace wedge::scene {

/// Places the camera of `scene` (which has one mesh, placed once, y up) and, where the model gives
/// off too little light of its own, adds a rectangle and a grey background. Says in the log what it
/// chose. All sizes are fractions of the model's, so that scale does not matter.
///
/// A model is seen from outside, unless most of what is seen from some point inside is the front of
/// surfaces far off: then it is an interior, and the camera stands in it.
/// Throws Error(bad_input) if the model has no extent.
void add_default_view(Scene& scene);

}  // namespace wedge::scene
