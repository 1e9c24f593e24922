#include "bench/converge/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/converge/html.hpp"

namespace wedge::converge {
namespace {

constexpr double kWidth = 480, kHeight = 340;
constexpr double kLeft = 62, kRight = 12, kTop = 10, kBottom = 46;
constexpr double kMargin = 0.06;  // of the range, around the data, in log10

/// A logarithmic axis from value to place.
struct Axis {
    double low = 0, high = 1;  // log10
    double from = 0, to = 1;   // places
    double at(double value) const {
        return from + (std::log10(value) - low) / (high - low) * (to - from);
    }
};

bool is_shown(const Series::Place& p) {
    return p.x.low > 0 && p.y.median > 0 && std::isfinite(p.x.high) && std::isfinite(p.y.high);
}

/// The low end of a ribbon may be 0 where the reference's part was subtracted.
double low_y(const Series::Place& p) {
    return p.y.low > 0 ? p.y.low : 0.5 * p.y.median;
}

Axis axis_over(double smallest, double largest, double from, double to) {
    double low = std::log10(smallest), high = std::log10(largest);
    const double margin = std::max(kMargin * (high - low), 0.03);
    return {low - margin, high + margin, from, to};
}

/// 1, 2, 5 in each decade if there are few decades, else 1 only.
std::vector<double> ticks_of(const Axis& axis) {
    std::vector<double> ticks;
    const double decades = axis.high - axis.low;
    for (int e = int(std::floor(axis.low)); e <= int(std::ceil(axis.high)); ++e)
        for (double digit : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
            if (decades > 2.5 && digit != 1) continue;
            if (decades > 0.7 && (digit == 1.5 || digit == 3 || digit == 7)) continue;
            const double value = digit * std::pow(10.0, e);
            if (std::log10(value) >= axis.low && std::log10(value) <= axis.high)
                ticks.push_back(value);
        }
    return ticks;
}

std::string tick_text(double value) {
    if (value >= 1e9) return fmt::format("{:g} G", value / 1e9);
    if (value >= 1e6) return fmt::format("{:g} M", value / 1e6);
    if (value >= 1e4) return fmt::format("{:g} k", value / 1e3);
    if (value >= 1e-4) return fmt::format("{:g}", value);
    return fmt::format("{:.0e}", value);
}

std::string axes_svg(const Axis& x, const Axis& y, const Chart& chart) {
    std::string svg;
    for (double t : ticks_of(x)) {
        svg += fmt::format(
            "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>", x.at(t),
            y.to, y.from);
        svg += fmt::format(
            "<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
            x.at(t), y.from + 16, tick_text(t));
    }
    for (double t : ticks_of(y)) {
        svg += fmt::format(
            "<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>", y.at(t),
            x.from, x.to);
        svg += fmt::format(
            "<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>",
            x.from - 6, y.at(t) + 4, tick_text(t));
    }
    svg += fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n",
                       x.from, y.to, x.to - x.from, y.from - y.to);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
                       0.5 * (x.from + x.to), kHeight - 8, escaped(chart.x_label));
    svg += fmt::format(
        "<text x=\"14\" y=\"{0:.1f}\" text-anchor=\"middle\" transform=\"rotate(-90 14 "
        "{0:.1f})\">{1}</text>\n",
        0.5 * (y.from + y.to), escaped(chart.y_label));
    return svg;
}

std::string series_svg(const Series& series, bool joined, const Axis& x, const Axis& y) {
    std::string line, upper, lower, marks;
    for (const Series::Place& p : series.places) {
        if (!is_shown(p)) continue;
        const double px = x.at(p.x.median), py = y.at(p.y.median);
        line += fmt::format("{:.1f},{:.1f} ", px, py);
        upper += fmt::format("{:.1f},{:.1f} ", px, y.at(p.y.high));
        lower = fmt::format("{:.1f},{:.1f} ", px, y.at(low_y(p))) + lower;
        marks += fmt::format("<g><title>{}</title>", escaped(series.name + ": " + p.note));
        marks += fmt::format(
            "<line class=\"line {0}\" x1=\"{1:.1f}\" x2=\"{2:.1f}\" y1=\"{3:.1f}\" "
            "y2=\"{3:.1f}\"/>",
            series_class(series.index), x.at(p.x.low), x.at(p.x.high), py);
        marks += marker_svg(series.index, px, py) + "</g>";
    }
    if (!joined) return marks + "\n";
    const std::string name = series_class(series.index);
    return fmt::format(
        "<polygon class=\"ribbon {0}\" points=\"{1}{2}\"/><polyline class=\"line {0}\" "
        "points=\"{3}\"/>{4}\n",
        name, upper, lower, line, marks);
}

std::string guide_svg(const Chart& chart, const Axis& x, const Axis& y) {
    const double low = x.low, high = x.high;
    if (chart.scatter)
        return fmt::format("<line class=\"guide\" x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/>\n",
                           x.from, y.from, x.to, y.to);
    if (chart.guide_slope == 0 || chart.series.empty()) return "";
    const auto& places = chart.series.front().places;
    const auto first = std::find_if(places.begin(), places.end(), is_shown);
    if (first == places.end()) return "";
    const double offset =
        std::log10(first->y.median) - chart.guide_slope * std::log10(first->x.median);
    return fmt::format(
        "<line class=\"guide\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" "
        "y2=\"{:.1f}\"/>\n",
        x.at(std::pow(10, low)), y.at(std::pow(10, offset + chart.guide_slope * low)),
        x.at(std::pow(10, high)), y.at(std::pow(10, offset + chart.guide_slope * high)));
}

}  // namespace

std::string chart_svg(const Chart& chart) {
    double x_low = INFINITY, x_high = 0, y_low = INFINITY, y_high = 0;
    for (const Series& series : chart.series)
        for (const Series::Place& p : series.places) {
            if (!is_shown(p)) continue;
            x_low = std::min(x_low, p.x.low);
            x_high = std::max(x_high, p.x.high);
            y_low = std::min(y_low, low_y(p));
            y_high = std::max(y_high, p.y.high);
        }
    if (!(x_high > 0))
        return "<p class=\"soft\">Nothing to draw: no error is above zero, or "
               "far enough above the reference's.</p>";
    if (chart.scatter) {
        x_low = y_low = std::min(x_low, y_low);
        x_high = y_high = std::max(x_high, y_high);
    }
    const Axis x = axis_over(x_low, x_high, kLeft, kWidth - kRight);
    const Axis y = axis_over(y_low, y_high, kHeight - kBottom, kTop);
    std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n",
                                  kWidth, kHeight, escaped(chart.title));
    svg += axes_svg(x, y, chart);
    svg += fmt::format(
        "<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} "
        "{3}\">{4}</svg>\n",
        x.from, y.to, x.to - x.from, y.from - y.to, guide_svg(chart, x, y));
    for (const Series& series : chart.series) svg += series_svg(series, !chart.scatter, x, y);
    return svg + "</svg>\n";
}

}  // namespace wedge::converge
