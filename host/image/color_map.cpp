#include "host/image/color_map.hpp"

namespace wedge::image {

RgbCode heat_colour(float t) {
    // Least squares over the 256 published colours, sRGB codes / 255, by powers of t; the ends
    // weigh six times as much as the rest.
    constexpr int kCoefficients = 7;
    constexpr float kViridis[3][kCoefficients] = {
        {0.2683f, 0.2083f, -0.7284f, -4.4398f, 7.8818f, 1.8556f, -4.0547f},
        {0.0050f, 1.4103f, 0.1414f, -5.6152f, 14.0856f, -13.8288f, 4.7077f},
        {0.3301f, 1.3954f, 0.4149f, -21.6616f, 62.7006f, -71.8639f, 28.8259f}};

    const float x = t > 0 ? std::min(t, 1.0f) : 0.0f;
    RgbCode code;
    for (int c = 0; c < 3; ++c) {
        float value = 0;
        for (int i = kCoefficients - 1; i >= 0; --i) value = value * x + kViridis[c][i];
        code[std::size_t(c)] = uint8_t(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f);
    }
    return code;
}

}  // namespace wedge::image
