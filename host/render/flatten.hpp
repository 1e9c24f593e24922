// A scene with its instances laid out in world space: what the device gets.
#pragma once

#include <vector>

#include "wedge/scene.hpp"
#include "wedge/shared/scene.h"

namespace wedge::rendering {

/// Triangles keep the order of the instances; those of rectangular lights come last. Rectangles
/// that shine and lie in a surface have been moved in front of it (lamp_clearance.hpp).
struct FlatScene {
    std::vector<Vec3> positions;   ///< of `vertices`, for the builder
    std::vector<UVec3> triangles;  ///< vertex indices, for the builder
    std::vector<shared::ShadingVertex> vertices;
    std::vector<shared::ShadingTriangle> shading;  ///< one per triangle
    std::vector<shared::SurfaceMaterial>
        materials;  ///< the scene's, then one black for light sources
    /// With probabilities proportional to power. Rectangles come first, the most powerful first of
    /// all.
    std::vector<shared::Light> lights;
};

/// Instances become triangles of their own: the scenes this renderer is for repeat little, and one
/// level of hierarchy traces faster than two. Throws Error(bad_input) where 32-bit indices do not
/// suffice.
FlatScene flatten(const Scene& scene);

}  // namespace wedge::rendering
