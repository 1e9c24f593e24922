// Tone curves and the sRGB transfer function, on single values.
#pragma once

#include "wedge/image_io.hpp"

namespace wedge::image {

/// Linear light to the sRGB code value (IEC 61966-2-1), both [0, 1]. Clamps; NaN gives 0.
float srgb_encode(float linear);

/// The sRGB code value to linear light, both [0, 1].
float srgb_decode(float encoded);

/// Radiance (any value) to displayed linear light in [0, 1]. NaN and negative values give 0.
float apply_tone_curve(ToneCurve curve, float radiance);

/// Relative luminance of linear RGB with the primaries of BT.709.
template <typename T>
T luminance(T r, T g, T b) {
    return T(0.2126) * r + T(0.7152) * g + T(0.0722) * b;
}

}  // namespace wedge::image
