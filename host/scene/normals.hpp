// Shading normals made from geometry.
#pragma once

#include "wedge/scene.hpp"

namespace wedge::scene {

/// Replaces the mesh's normals by smooth ones: at each position the mean of the normals of the
/// faces that meet there, weighted by their angle (Thürmer and Wüthrich 1998), whichever vertices
/// they use. Positions no face with area meets get a zero normal, which means the face's own.
void make_smooth_normals(Mesh& mesh);

}  // namespace wedge::scene
