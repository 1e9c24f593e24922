// Tone curves, on single values.
#pragma once

#include "wedge/image_io.hpp"

namespace wedge::image {

/// Radiance (any value) to displayed linear light in [0, 1]. NaN and negative values give 0.
float apply_tone_curve(ToneCurve curve, float radiance);

/// Relative luminance of linear RGB with the primaries of BT.709.
template <typename T>
T luminance(T r, T g, T b) {
    return T(0.2126) * r + T(0.7152) * g + T(0.0722) * b;
}

}  // namespace wedge::image
