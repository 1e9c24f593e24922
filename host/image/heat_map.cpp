#include "host/image/heat_map.hpp"

#include <cmath>

#include "host/base/atomic_file.hpp"
#include "host/image/codec.hpp"
#include "host/image/color_map.hpp"
#include "host/image/heat_legend.hpp"

namespace wedge::image {
namespace {

/// Width of a film on whose picture letters are one px a dot; on larger ones they grow with it.
constexpr int kSmallText_px = 480;
constexpr int kLargestText = 8;

int enlargement_of(int width, int height) {
    return std::max(1, kLeastHeatSide_px / std::max(width, height));
}

int text_scale_of(int picture_width) {
    return std::clamp(picture_width / kSmallText_px, 1, kLargestText);
}

bool has_gaps(const Plane<float>& values) {
    return std::any_of(values.values.begin(), values.values.end(),
                       [](float value) { return !std::isfinite(value); });
}

void draw_film(RgbCanvas& canvas, const HeatLayout& layout, const Plane<float>& values,
               const HeatRange& range) {
    const int side = layout.enlargement;
    for (int y = 0; y < values.height; ++y)
        for (int x = 0; x < values.width; ++x) {
            const float value = values.row(y)[x];
            const RgbCode code =
                std::isfinite(value) ? heat_colour(heat_place(range, value)) : kNoValue;
            canvas.fill(layout.left + x * side, y * side, side, side, code);
        }
}

}  // namespace

HeatMap draw_heat_map(const HeatLayer& layer) {
    const Plane<float>& values = layer.values;
    const HeatRange range =
        layer.is_share ? fixed_heat_range(values.values, 0, 1) : heat_range(values.values);

    HeatLayout layout;
    layout.enlargement = enlargement_of(values.width, values.height);
    const int picture_width = values.width * layout.enlargement;
    layout.legend_top = values.height * layout.enlargement;
    layout.text_scale = text_scale_of(picture_width);
    const HeatLegend legend =
        lay_out_legend(layer.title, range, has_gaps(values), picture_width, layout.text_scale);
    layout.left = (legend.width - picture_width) / 2;

    HeatMap map{RgbCanvas(legend.width, layout.legend_top + legend.height, kLegendBackground),
                layout, range};
    draw_film(map.canvas, layout, values, range);
    draw_legend(map.canvas, layout.legend_top, legend, range);
    return map;
}

void write_heat_map(const std::filesystem::path& file, const HeatLayer& layer) {
    const RgbCanvas canvas = draw_heat_map(layer).canvas;
    write_file_atomically(file, encode_png(canvas.width, canvas.height, canvas.codes.data(), file));
}

}  // namespace wedge::image
