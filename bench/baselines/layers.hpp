// Layers of a render as the kernels in kernels/baselines take them.
#pragma once

#include <vector>

#include "wedge/image.hpp"

namespace wedge::baselines {

struct Float4 {
    float x, y, z, w;
};

struct Layers {
    std::vector<Float4> radiance, emission, albedo, variance;
    std::vector<Float4> surface;  ///< normal; distance, 0 where nothing is hit
    std::vector<Float4> place;    ///< position; width of a pixel there
};

/// Throws Error(internal) if a layer is missing.
Layers layers_of(const Image& image, double pixel_angle);

}  // namespace wedge::baselines
