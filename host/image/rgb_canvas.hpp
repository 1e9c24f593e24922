// A picture of 8-bit sRGB codes to draw on.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace wedge::image {

using RgbCode = std::array<uint8_t, 3>;

/// Row 0 at the top. Nothing that reaches beyond the border is drawn there.
struct RgbCanvas {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> codes;  ///< 3 * width * height

    RgbCanvas(int w, int h, RgbCode background)
        : width(w), height(h), codes(3 * std::size_t(w) * std::size_t(h)) {
        fill(0, 0, w, h, background);
    }

    std::size_t index(int x, int y) const {
        return 3 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
    }
    RgbCode at(int x, int y) const {
        const uint8_t* code = &codes[index(x, y)];
        return {code[0], code[1], code[2]};
    }
    void fill(int left, int top, int w, int h, RgbCode code) {
        const int right = std::min(left + w, width), bottom = std::min(top + h, height);
        for (int y = std::max(top, 0); y < bottom; ++y)
            for (int x = std::max(left, 0); x < right; ++x)
                std::copy(code.begin(), code.end(), &codes[index(x, y)]);
    }
};

}  // namespace wedge::image
