#include "host/image/heat_legend.hpp"

#include <fmt/format.h>

#include "host/image/bitmap_font.hpp"
#include "host/image/color_map.hpp"

namespace wedge::image {
namespace {

// Dots, to be multiplied by the scale.
constexpr int kMargin = 4, kLine = 11, kBarHeight = 10, kTickHeight = 3, kNumeralGap = 6;
constexpr int kNumerals = 4;  // both ends and two between

bool is_constant(const HeatRange& range) {
    return !(range.least < range.most);
}

std::string span_line(const HeatRange& range) {
    if (range.empty) return "no pixel has a value";
    if (is_constant(range)) return "one value";
    const std::string scale = range.logarithmic ? ", log scale" : "";
    if (range.covers_all) return "colours span all values" + scale;
    return fmt::format("colours span {:g}-{:g} %{}", 100 * kHeatTail, 100 * (1 - kHeatTail), scale);
}

std::vector<std::string> text_lines(const std::string& title, const HeatRange& range,
                                    bool has_gaps) {
    std::vector<std::string> lines{title, span_line(range)};
    if (range.empty) return lines;
    std::string values = "values " + heat_numeral(range.smallest);
    if (range.smallest < range.largest) values += " to " + heat_numeral(range.largest);
    lines.push_back(values + (has_gaps ? ", grey: none" : ""));
    return lines;
}

std::vector<std::string> numeral_texts(const HeatRange& range) {
    if (range.empty) return {};
    if (is_constant(range)) return {heat_numeral(range.least)};
    std::vector<std::string> texts;
    for (int i = 0; i < kNumerals; ++i)
        texts.push_back(heat_numeral(heat_value(range, float(i) / float(kNumerals - 1))));
    return texts;
}

/// Width of a bar below which the numerals do not run into each other: those at the ends are
/// flush with it, those between stand in the middle of their tick.
int bar_width_for(const std::vector<std::string>& numerals, int scale) {
    int interval = 0;
    for (std::size_t i = 1; i < numerals.size(); ++i) {
        const auto share = [&](std::size_t k) {
            const bool at_end = k == 0 || k + 1 == numerals.size();
            const int width = text_width(numerals[k], scale);
            return at_end ? width : (width + 1) / 2;
        };
        interval = std::max(interval, share(i - 1) + share(i) + kNumeralGap * scale);
    }
    return interval * int(numerals.size() > 1 ? numerals.size() - 1 : 1);
}

void place_numerals(HeatLegend& legend, const std::vector<std::string>& numerals, int top) {
    const int last = int(numerals.size()) - 1;
    for (int i = 0; i <= last; ++i) {
        const std::string& text = numerals[std::size_t(i)];
        const int width = text_width(text, legend.scale);
        // A value that is alone stands in the middle.
        const double place = last > 0 ? double(i) / last : 0.5;
        const int x = int(place * (legend.bar_width - 1) + 0.5);
        const int left = std::clamp(x - width / 2, 0, std::max(0, legend.bar_width - width));
        legend.ticks.push_back(legend.bar_left + x);
        legend.numerals.push_back({legend.bar_left + left, top, text});
    }
}

}  // namespace

HeatLegend lay_out_legend(const std::string& title, const HeatRange& range, bool has_gaps,
                          int wanted_width, int scale) {
    const std::vector<std::string> lines = text_lines(title, range, has_gaps);
    const std::vector<std::string> numerals = numeral_texts(range);

    HeatLegend legend;
    legend.scale = scale;
    int content = bar_width_for(numerals, scale);
    for (const std::string& line : lines) content = std::max(content, text_width(line, scale));
    legend.width = std::max(wanted_width, content + 2 * kMargin * scale);

    int top = kMargin * scale;
    for (const std::string& line : lines) {
        legend.lines.push_back({kMargin * scale, top, line});
        top += kLine * scale;
    }
    if (!range.empty) {
        legend.bar_left = kMargin * scale;
        legend.bar_top = top + scale;
        legend.bar_width = legend.width - 2 * kMargin * scale;
        legend.bar_height = kBarHeight * scale;
        top = legend.bar_top + legend.bar_height + (kTickHeight + 1) * scale;
        place_numerals(legend, numerals, top);
        top += kGlyphHeight * scale;
    }
    legend.height = top + kMargin * scale;
    return legend;
}

void draw_legend(RgbCanvas& canvas, int top, const HeatLegend& legend, const HeatRange& range) {
    canvas.fill(0, top, canvas.width, legend.height, kLegendBackground);
    for (const auto* texts : {&legend.lines, &legend.numerals})
        for (const HeatLegend::Text& text : *texts)
            draw_text(canvas, text.left, top + text.top, text.text, legend.scale, kLegendInk);
    for (int x = 0; x < legend.bar_width; ++x) {
        const float place =
            is_constant(range) ? 0.5f : float(x) / float(std::max(1, legend.bar_width - 1));
        canvas.fill(legend.bar_left + x, top + legend.bar_top, 1, legend.bar_height,
                    heat_colour(place));
    }
    for (const int x : legend.ticks)
        canvas.fill(x, top + legend.bar_top + legend.bar_height, 1, kTickHeight * legend.scale,
                    kLegendInk);
}

}  // namespace wedge::image
