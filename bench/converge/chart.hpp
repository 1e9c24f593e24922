// Log-log charts as inline SVG.
#pragma once

#include <string>
#include <vector>

#include "bench/converge/statistics.hpp"

namespace wedge::converge {

/// One line of a chart: medians with 10-90 % in both directions.
struct Series {
    std::size_t index = 0;  ///< colour and mark
    std::string name;
    struct Place {
        Spread x, y;
        std::string note;  ///< shown where the pointer rests
    };
    std::vector<Place> places;  ///< those that are not positive are left out
};

struct Chart {
    std::string title, x_label, y_label;
    std::vector<Series> series;
    double guide_slope = 0;  ///< a dashed line of this slope through the first series; 0: none
    bool scatter = false;  ///< points are not joined, axes are alike, and the dashed line is y = x
};

/// 480 units wide; text stays readable at the width of a phone.
std::string chart_svg(const Chart& chart);

}  // namespace wedge::converge
