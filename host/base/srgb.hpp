// The sRGB transfer function, IEC 61966-2-1.
#pragma once

#include <cmath>

namespace wedge {

/// Linear light to the code value, both [0, 1]. Clamps; NaN gives 0.
inline float srgb_encode(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 1;
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// The code value to linear light, both [0, 1].
inline float srgb_decode(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

}  // namespace wedge
