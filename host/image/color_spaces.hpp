// The colour spaces FLIP works in, from linear RGB with the primaries and white of sRGB.
#pragma once

#include <array>
#include <cmath>

namespace wedge::image {

using Colour = std::array<float, 3>;

/// XYZ divided by the XYZ of white, so that white is (1, 1, 1). IEC 61966-2-1, rows scaled.
inline Colour white_relative_xyz(const Colour& rgb) {
    constexpr float kWhiteX = 0.9504700f, kWhiteZ = 1.0888300f;
    const auto [r, g, b] = rgb;
    return {(0.4124564f * r + 0.3575761f * g + 0.1804375f * b) / kWhiteX,
            0.2126729f * r + 0.7151522f * g + 0.0721750f * b,
            (0.0193339f * r + 0.1191920f * g + 0.9503041f * b) / kWhiteZ};
}

inline Colour rgb_from_white_relative_xyz(const Colour& xyz) {
    const float x = xyz[0] * 0.9504700f, y = xyz[1], z = xyz[2] * 1.0888300f;
    return {3.2404542f * x - 1.5371385f * y - 0.4985314f * z,
            -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
            0.0556434f * x - 0.2040259f * y + 1.0572252f * z};
}

/// Opponent space, linear in light: Y in [-16, 100], Cx red-green, Cz blue-yellow.
inline Colour ycxcz_from_rgb(const Colour& rgb) {
    const auto [x, y, z] = white_relative_xyz(rgb);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

inline Colour rgb_from_ycxcz(const Colour& ycxcz) {
    const float y = (ycxcz[0] + 16) / 116;
    return rgb_from_white_relative_xyz({y + ycxcz[1] / 500, y, y - ycxcz[2] / 200});
}

/// CIE 1976 L*a*b*.
inline Colour lab_from_rgb(const Colour& rgb) {
    constexpr float kDelta = 6.0f / 29.0f;
    Colour f = white_relative_xyz(rgb);
    for (float& t : f)
        t = t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29.0f;
    return {116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])};
}

}  // namespace wedge::image
