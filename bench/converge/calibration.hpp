// From seconds to the knob that takes them.
#pragma once

#include <functional>
#include <vector>

#include "bench/converge/methods.hpp"

namespace wedge::converge {

/// Seconds measured at two settings of a knob.
struct Calibration {
    double knob[2] = {0, 0};
    double seconds[2] = {0, 0};
};

/// `seconds_at` renders. The first setting is small, the second larger.
Calibration calibrate(Knob knob, const std::function<double(double)>& seconds_at);

/// Along the line through both measurements: in seconds and samples for samples per pixel, which
/// cost the same each beside a fixed part; in logarithms for mu, whose samples grow with a power.
/// At least one sample; at least kLeastMu.
double knob_for_seconds(const Calibration& calibration, Knob knob, double seconds);

inline constexpr double kLeastMu = 0.05;

}  // namespace wedge::converge
