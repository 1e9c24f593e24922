// Where a method is worse than plain Monte Carlo in the same time: a mean over the image hides it.
#include <algorithm>
#include <cmath>

#include "bench/converge/analysis.hpp"

namespace wedge::converge {
namespace {

constexpr int kBlock_px = 16;
constexpr double kClearly = 2;        // times the mean squared error
constexpr double kTenth = 1.1 * 1.1;  // a tenth more, as RMSE
constexpr double kRounding = 1e-4;    // of the image's mean: smaller errors are none

/// Mean squared error by block, over the seeds of a rung.
std::vector<double> block_errors(const Reference& reference, const Rung& rung) {
    const int width = reference.mean.width, height = reference.mean.height;
    const int across = (width + kBlock_px - 1) / kBlock_px;
    const int down = (height + kBlock_px - 1) / kBlock_px;
    std::vector<double> sums(std::size_t(across) * down, 0.0), counts(sums.size(), 0.0);
    for (const Image* image : rung.images) {
        const std::vector<double> map = squared_error_map(*image, reference);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const auto block = std::size_t(y / kBlock_px * across + x / kBlock_px);
                sums[block] += map[std::size_t(y) * width + x];
                counts[block] += 1;
            }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
    return sums;
}

/// Error times time of the yardstick, by block. Its error falls as 1 / time, so that this changes
/// little from rung to rung: it is interpolated between rungs and kept beyond them.
struct YardstickRung {
    double log_time;
    std::vector<double> error_times_time;
};

double expected_error(const std::vector<YardstickRung>& rungs, std::size_t block, double time) {
    const double at = std::log(time);
    std::size_t next = 0;
    while (next < rungs.size() && rungs[next].log_time < at) ++next;
    if (next == 0) return rungs.front().error_times_time[block] / time;
    if (next == rungs.size()) return rungs.back().error_times_time[block] / time;
    const YardstickRung &a = rungs[next - 1], &b = rungs[next];
    const double share = (at - a.log_time) / (b.log_time - a.log_time);
    return ((1 - share) * a.error_times_time[block] + share * b.error_times_time[block]) / time;
}

/// Mean squared error that rounding may make.
double smallest_that_counts(const Image& reference) {
    double sum = 0;
    for (float value : reference.pixels) sum += double(value);
    const double mean = sum / double(std::max<std::size_t>(reference.pixels.size(), 1));
    return kRounding * kRounding * mean * mean;
}

}  // namespace

void measure_blocks(const Reference& reference, const Curve& yardstick, Curve& curve) {
    if (&curve == &yardstick) return;
    std::vector<YardstickRung> rungs;
    for (const Rung& rung : yardstick.rungs) {
        YardstickRung y{std::log(rung.time_s.median), block_errors(reference, rung)};
        for (double& value : y.error_times_time) value *= rung.time_s.median;
        rungs.push_back(std::move(y));
    }
    std::sort(rungs.begin(), rungs.end(),
              [](const auto& a, const auto& b) { return a.log_time < b.log_time; });
    const double least = smallest_that_counts(reference.mean);
    for (Rung& rung : curve.rungs) {
        const std::vector<double> errors = block_errors(reference, rung);
        std::size_t worse = 0, twice = 0, tenth = 0;
        for (std::size_t block = 0; block < errors.size(); ++block) {
            const double expected = expected_error(rungs, block, rung.time_s.median);
            worse += errors[block] > expected;
            twice += errors[block] > kClearly * std::max(expected, 0.0);
            tenth += errors[block] > kTenth * std::max(expected, 0.0) + least;
        }
        rung.blocks_worse = double(worse) / double(errors.size());
        rung.blocks_twice = double(twice) / double(errors.size());
        rung.blocks_tenth = double(tenth) / double(errors.size());
    }
}

}  // namespace wedge::converge
