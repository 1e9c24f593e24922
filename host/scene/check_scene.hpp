// Scenes that were built in memory instead of read: what a reader would have refused.
#pragma once

#include "wedge/scene.hpp"

namespace wedge::scene {

/// Throws Error(bad_input) that names the first member of `scene` that cannot be rendered: indices
/// that name nothing, sizes that do not fit together, numbers that are not finite or out of range.
/// Vertices and texels are left alone: those that are not finite are counted and left out later.
void check_scene(const Scene& scene);

}  // namespace wedge::scene
