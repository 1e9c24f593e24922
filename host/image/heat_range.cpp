#include "host/image/heat_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace wedge::image {
namespace {

/// Nearest rank: the smallest value that at least `share` of all are not above.
float percentile(std::vector<float>& values, double share) {
    const double rank = std::ceil(share * double(values.size()));
    const auto index = std::min(std::size_t(std::max(rank, 1.0)), values.size()) - 1;
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(index), values.end());
    return values[index];
}

/// Smallest and largest; the rest as it is by default.
HeatRange extent(std::span<const float> values) {
    HeatRange range;
    for (const float value : values) {
        if (!std::isfinite(value)) continue;
        range.smallest = range.empty ? value : std::min(range.smallest, value);
        range.largest = range.empty ? value : std::max(range.largest, value);
        range.empty = false;
    }
    return range;
}

}  // namespace

HeatRange heat_range(std::span<const float> values) {
    HeatRange range = extent(values);
    std::vector<float> positive;
    for (const float value : values)
        if (std::isfinite(value) && value > 0) positive.push_back(value);
    if (positive.empty()) return range;  // from 0 to 0

    range.least = percentile(positive, kHeatTail);
    range.most = percentile(positive, 1 - kHeatTail);
    if (range.least == range.most) {
        range.least = range.smallest;
        range.most = range.largest;
    }
    range.covers_all = range.least == range.smallest && range.most == range.largest;
    range.logarithmic = range.least > 0 && range.most > kHeatLogRatio * range.least;
    return range;
}

HeatRange fixed_heat_range(std::span<const float> values, float least, float most) {
    HeatRange range = extent(values);
    range.least = least;
    range.most = most;
    return range;
}

float heat_place(const HeatRange& range, float value) {
    if (!(range.least < range.most)) return 0.5f;
    const double v = std::clamp(value, range.least, range.most);
    const double least = range.least, most = range.most;
    if (range.logarithmic) return float(std::log(v / least) / std::log(most / least));
    return float((v - least) / (most - least));
}

float heat_value(const HeatRange& range, float place) {
    const double least = range.least, most = range.most;
    if (range.logarithmic) return float(least * std::pow(most / least, double(place)));
    return float(least + (most - least) * double(place));
}

std::string heat_numeral(float value) {
    if (value == 0) return "0";
    const double magnitude = std::abs(double(value));
    if (magnitude < 0.001 || magnitude >= 999999.5) return fmt::format("{:.3g}", value);
    const int decimals = std::clamp(2 - int(std::floor(std::log10(magnitude))), 0, 5);
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (decimals == 0) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text;
}

}  // namespace wedge::image
