// Which values a heat map's colours stand for.
#pragma once

#include <span>
#include <string>

namespace wedge::image {

/// Share of the values that is darker, and that is brighter, than the ends of the colours.
inline constexpr double kHeatTail = 0.01;
/// Ratio of the ends of the colours above which they are spaced by logarithms: two decades.
inline constexpr float kHeatLogRatio = 100;

struct HeatRange {
    float least = 0, most = 0;        ///< values of the first and last colour
    float smallest = 0, largest = 0;  ///< of all values
    bool empty = true;                ///< there is no value
    bool covers_all = true;           ///< else `least` and `most` are percentiles
    bool logarithmic = false;
};

/// From the percentiles 100 kHeatTail and 100 (1 - kHeatTail) (nearest rank) of the values above 0;
/// from all of them where those two are equal. NaN and infinity are no values. Zeros, which would
/// rule out logarithms, count only if there is nothing else. Values must not be negative.
HeatRange heat_range(std::span<const float> values);

/// The same, but with colours from `least` to `most`, spaced evenly.
HeatRange fixed_heat_range(std::span<const float> values, float least, float most);

/// Place of a value among the colours: 0 at range.least, 1 at range.most, clamped; 0.5 where these
/// are equal.
float heat_place(const HeatRange& range, float value);

/// The value at a place in [0, 1].
float heat_value(const HeatRange& range, float place);

/// Three significant digits, without trailing zeros; with an exponent only below 0.001 and from
/// 1 000 000.
std::string heat_numeral(float value);

}  // namespace wedge::image
