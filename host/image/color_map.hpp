// Numbers to colours.
#pragma once

#include "host/image/rgb_canvas.hpp"

namespace wedge::image {

/// From dark violet at 0 over blue and green to yellow at 1; lightness grows all the way, so that
/// it can be read in grey and by the colour-blind. Clamps; NaN gives the colour of 0.
/// Within 4 codes of viridis (S. van der Walt and N. Smith, matplotlib 2.0, 2015).
RgbCode heat_colour(float t);

}  // namespace wedge::image
