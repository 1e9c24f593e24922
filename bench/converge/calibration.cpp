#include "bench/converge/calibration.hpp"

#include <algorithm>
#include <cmath>

namespace wedge::converge {
namespace {

constexpr double kSamples[2] = {4, 16};
constexpr double kMu[2] = {0.5, 2};

}  // namespace

Calibration calibrate(Knob knob, const std::function<double(double)>& seconds_at) {
    Calibration c;
    for (int i = 0; i < 2; ++i) {
        c.knob[i] = knob == Knob::spp ? kSamples[i] : kMu[i];
        c.seconds[i] = seconds_at(c.knob[i]);
    }
    return c;
}

double knob_for_seconds(const Calibration& c, Knob knob, double seconds) {
    if (knob == Knob::spp) {
        const double per_sample = std::max((c.seconds[1] - c.seconds[0]) / (c.knob[1] - c.knob[0]),
                                           1e-3 * c.seconds[1] / c.knob[1]);
        return std::max(1.0, std::round(c.knob[1] + (seconds - c.seconds[1]) / per_sample));
    }
    // Noise must not make time fall with mu: the power is kept to what samples can do.
    const double power = std::clamp(
        std::log(c.seconds[1] / c.seconds[0]) / std::log(c.knob[1] / c.knob[0]), 0.25, 2.0);
    return std::max(kLeastMu, c.knob[1] * std::pow(seconds / c.seconds[1], 1 / power));
}

}  // namespace wedge::converge
