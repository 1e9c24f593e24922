// Letters and numerals of 5 x 9 dots, for legends in pictures.
#pragma once

#include <string_view>

#include "host/image/rgb_canvas.hpp"

namespace wedge::image {

inline constexpr int kGlyphWidth = 5;    ///< dots
inline constexpr int kGlyphHeight = 9;   ///< dots; the lowest two are below the base line
inline constexpr int kGlyphAdvance = 6;  ///< dots from one glyph to the next

/// Whether a dot of a glyph is set; (0, 0) is the upper left. Drawn are digits, small letters, `Z`,
/// space and `%(),-+./:^`; any other character is a full box.
bool glyph_dot(char c, int x, int y);

/// px, without a gap at the end. `scale`: px a dot.
int text_width(std::string_view text, int scale);

/// `left`, `top`: px, of the first glyph's upper left corner.
void draw_text(RgbCanvas& canvas, int left, int top, std::string_view text, int scale,
               RgbCode colour);

}  // namespace wedge::image
