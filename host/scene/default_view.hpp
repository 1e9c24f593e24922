// A camera and a light for a model that comes without.
#pragma once

#include "wedge/scene.hpp"

namespace wedge::scene {

/// Places the camera of `scene` (which has one mesh, placed once, y up) and, where the model gives
/// off too little light of its own, adds a rectangle and a grey background. Says in the log what it
/// chose. All sizes are fractions of the model's, so that scale does not matter.
///
/// A model is seen from outside unless it is a room: from a point in its middle three of four rays
/// meet fronts of surfaces, and either rays from outside meet mostly backs, or there are a level
/// floor and upright walls. Then the camera stands inside, or before the open side if there is one.
/// Throws Error(bad_input) if the model has no extent.
void add_default_view(Scene& scene);

}  // namespace wedge::scene
