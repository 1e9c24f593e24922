// The strip below a heat map that says what its colours mean.
#pragma once

#include <string>
#include <vector>

#include "host/image/heat_range.hpp"
#include "host/image/rgb_canvas.hpp"

namespace wedge::image {

/// What there is no value for, in the picture and in the legend.
inline constexpr RgbCode kNoValue{96, 96, 96};
inline constexpr RgbCode kLegendBackground{24, 24, 24};
inline constexpr RgbCode kLegendInk{235, 235, 235};

/// Where everything goes, in px from the legend's upper left corner.
struct HeatLegend {
    struct Text {
        int left = 0, top = 0;
        std::string text;
    };
    int width = 0, height = 0;
    int scale = 1;               ///< px a dot
    std::vector<Text> lines;     ///< name, range, values
    std::vector<Text> numerals;  ///< below the bar, from the least value to the most
    std::vector<int> ticks;      ///< x of the values that the numerals name
    int bar_left = 0, bar_top = 0, bar_width = 0, bar_height = 0;
};

/// At least `wanted_width` px wide; more where the text needs it. `title`: layer and unit.
HeatLegend lay_out_legend(const std::string& title, const HeatRange& range, bool has_gaps,
                          int wanted_width, int scale);

/// With its upper left corner at (0, top). Fills the whole width of `canvas`.
void draw_legend(RgbCanvas& canvas, int top, const HeatLegend& legend, const HeatRange& range);

}  // namespace wedge::image
