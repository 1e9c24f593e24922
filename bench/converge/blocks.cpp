#include "bench/converge/blocks.hpp"

#include <algorithm>
#include <cmath>

namespace wedge::converge {
namespace {

constexpr int kBlock_px = 16;
constexpr double kClearly = 2;      // times the mean squared error
constexpr double kRounding = 1e-4;  // of the image's mean: smaller errors are none

/// Over the seeds of a rung.
BlockErrors mean_block_errors(const Reference& reference, const Rung& rung) {
    BlockErrors mean;
    for (const Image* image : rung.images) {
        const BlockErrors errors = block_errors(reference, *image);
        mean.resize(errors.size(), 0.0);
        for (std::size_t i = 0; i < errors.size(); ++i)
            mean[i] += errors[i] / double(rung.images.size());
    }
    return mean;
}

}  // namespace

BlockErrors block_errors(const Reference& reference, const Image& image) {
    const int width = reference.mean.width, height = reference.mean.height;
    const int across = (width + kBlock_px - 1) / kBlock_px;
    const int down = (height + kBlock_px - 1) / kBlock_px;
    BlockErrors sums(std::size_t(across) * down, 0.0), counts(sums.size(), 0.0);
    const std::vector<double> map = squared_error_map(image, reference);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto block = std::size_t(y / kBlock_px * across + x / kBlock_px);
            sums[block] += map[std::size_t(y) * width + x];
            counts[block] += 1;
        }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i];
    return sums;
}

void BlockErrorsOverTime::add(double time_s, BlockErrors errors) {
    for (double& value : errors) value *= time_s;
    const double log_time = std::log(time_s);
    const auto later = std::find_if(measured_.begin(), measured_.end(),
                                    [&](const Measured& m) { return m.log_time > log_time; });
    measured_.insert(later, {log_time, std::move(errors)});
}

double BlockErrorsOverTime::at(std::size_t block, double time_s) const {
    const double log_time = std::log(time_s);
    std::size_t next = 0;
    while (next < measured_.size() && measured_[next].log_time < log_time) ++next;
    if (next == 0) return measured_.front().error_times_time[block] / time_s;
    if (next == measured_.size()) return measured_.back().error_times_time[block] / time_s;
    const Measured &a = measured_[next - 1], &b = measured_[next];
    const double share = (log_time - a.log_time) / (b.log_time - a.log_time);
    return ((1 - share) * a.error_times_time[block] + share * b.error_times_time[block]) / time_s;
}

double rounding_error(const Reference& reference) {
    double sum = 0;
    for (float value : reference.mean.pixels) sum += double(value);
    const double mean = sum / double(std::max<std::size_t>(reference.mean.pixels.size(), 1));
    return kRounding * kRounding * mean * mean;
}

void measure_blocks(const Reference& reference, const Curve& yardstick, Curve& curve) {
    if (&curve == &yardstick) return;
    BlockErrorsOverTime plain;
    for (const Rung& rung : yardstick.rungs)
        plain.add(rung.time_s.median, mean_block_errors(reference, rung));
    const double rounding = rounding_error(reference);
    for (Rung& rung : curve.rungs) {
        const BlockErrors errors = mean_block_errors(reference, rung);
        std::size_t worse = 0, twice = 0;
        for (std::size_t block = 0; block < errors.size(); ++block) {
            const double expected = std::max(plain.at(block, rung.time_s.median), 0.0);
            worse += errors[block] > kTenthMore * expected + rounding;
            twice += errors[block] > kClearly * expected + rounding;
        }
        rung.blocks_worse = double(worse) / double(errors.size());
        rung.blocks_twice = double(twice) / double(errors.size());
    }
}

}  // namespace wedge::converge
