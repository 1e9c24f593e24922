// LDR-FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, "FLIP: A
// Difference Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2).
#pragma once

#include "host/image/plane.hpp"

namespace wedge::image {

/// Pixels per degree of visual angle: 0.7 m from a screen 0.7 m and 3840 px wide.
inline constexpr double kFlipPixelsPerDegree = 67.0206433;

/// Perceived difference per pixel, [0, 1], of two images of linear light in [0, 1] as displayed.
Plane<float> ldr_flip_map(const Planes& test, const Planes& reference);

}  // namespace wedge::image
