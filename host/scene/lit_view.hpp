// Whether a made-up view shows anything by the model's own light.
#pragma once

#include "wedge/scene.hpp"

namespace wedge::scene {

/// What a camera sees, of a few points of the film.
struct ViewLight {
    int seen = 0;          ///< on surfaces
    int shining = 0;       ///< of these, on emitters
    int lit = 0;           ///< of these, on surfaces that one of the strongest emitters shines upon
    float irradiance = 0;  ///< on the lit ones, by these emitters, mean of the channels
};

/// A guess, not a render: direct light only, in `scene.meshes[0]`.
ViewLight look_for_light(const Scene& scene, const Camera& camera);

}  // namespace wedge::scene
