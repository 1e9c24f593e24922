// A layer of numbers as a picture with a legend, for eyes.
#pragma once

#include <filesystem>
#include <string>

#include "host/image/heat_range.hpp"
#include "host/image/plane.hpp"
#include "host/image/rgb_canvas.hpp"

namespace wedge::image {

/// Numbers >= 0, one a pixel; NaN and infinity: there is none.
struct HeatLayer {
    std::string title;      ///< for the legend: name and unit
    bool is_share = false;  ///< colours go from 0 to 1 whatever the values are
    Plane<float> values;
};

/// Films whose longer side is shorter are enlarged, by a whole factor, to at most this.
inline constexpr int kLeastHeatSide_px = 192;

/// How a film is laid on the canvas.
struct HeatLayout {
    int enlargement = 1;  ///< px of the canvas for one of the film, in both directions
    int left = 0;         ///< of the film on the canvas, px; its top is the canvas's
    int legend_top = 0;   ///< px
    int text_scale = 1;   ///< px a dot: letters grow with the picture
};

struct HeatMap {
    RgbCanvas canvas;
    HeatLayout layout;
    HeatRange range;
};

/// The film above its legend. The canvas is wider than the film where the legend's text needs it.
/// The layer must have at least one pixel.
HeatMap draw_heat_map(const HeatLayer& layer);

/// As a PNG, written as all files are. Throws Error(output).
void write_heat_map(const std::filesystem::path& file, const HeatLayer& layer);

}  // namespace wedge::image
