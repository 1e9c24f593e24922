#include "host/render/told_error.hpp"

#include <algorithm>
#include <cmath>

namespace wedge::rendering {
namespace {

Vec3 square(const shared::float4& v) {
    return {v.x * v.x, v.y * v.y, v.z * v.z};
}

float mean(const Vec3& v) {
    return (v.x + v.y + v.z) / 3;
}

/// Replaces `count` values, `stride` apart, by means over WEDGE_GUARD_RADIUS to either side, as far
/// as there are any, the nearer the more they count. Not by differences of running sums: one huge
/// value would spoil all after it.
void smooth_line(float* values, std::size_t count, std::size_t stride, std::vector<float>& line) {
    line.clear();
    for (std::size_t i = 0; i < count; ++i) line.push_back(values[i * stride]);
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t begin = i - std::min<std::size_t>(i, WEDGE_GUARD_RADIUS);
        const std::size_t end = std::min(count, i + WEDGE_GUARD_RADIUS + 1);
        float sum = 0, weights = 0;
        for (std::size_t k = begin; k < end; ++k) {
            const auto away = float(k < i ? i - k : k - i);
            const float weight = WEDGE_GUARD_RADIUS + 1 - away;
            sum += weight * line[k];
            weights += weight;
        }
        values[i * stride] = sum / weights;
    }
}

/// The same means as those of the guard.
void smooth(std::vector<float>& values, std::size_t width) {
    const std::size_t height = values.size() / width;
    std::vector<float> line;
    for (std::size_t y = 0; y < height; ++y) smooth_line(&values[y * width], width, 1, line);
    for (std::size_t x = 0; x < width; ++x) smooth_line(&values[x], height, width, line);
}

Vec3 share_of(float told, const shared::float4& light, float mean_square) {
    return told > 0 && mean_square > 0 ? told / mean_square * square(light) : Vec3(0);
}

/// What the guard tells adds up what seems to be bias from one filter to the next, and luck never
/// takes any away. What pixels measure by themselves is not known better, but right in the mean:
/// in all no more is told than that and its standard error. Returns the share of what is told.
float share_that_is_measured(std::span<const shared::GuardedPixel> guarded) {
    double told = 0, measured = 0, squares = 0;
    for (const shared::GuardedPixel& g : guarded) {
        const double pixel = double(g.measured.x) + double(g.measured.y);
        told += double(g.error.x) + double(g.error.y);
        measured += pixel;
        squares += pixel * pixel;
    }
    const double share = (std::max(measured, 0.0) + std::sqrt(squares)) / told;
    // Also if what is measured is no number.
    return share < 1 && std::isfinite(told) ? float(share) : 1.0f;
}

}  // namespace

std::vector<Vec3> told_errors(std::span<const shared::GuardedPixel> guarded, std::size_t width) {
    std::vector<Vec3> errors(guarded.size());
    if (guarded.empty()) return errors;
    std::vector<float> direct, indirect;
    for (const shared::GuardedPixel& g : guarded) {
        direct.push_back(mean(square(g.direct)));
        indirect.push_back(mean(square(g.indirect)));
    }
    smooth(direct, width);
    smooth(indirect, width);
    const float share = share_that_is_measured(guarded);
    for (std::size_t i = 0; i < guarded.size(); ++i) {
        const shared::GuardedPixel& g = guarded[i];
        errors[i] = share_of(share * g.error.x, g.direct, direct[i]) +
                    share_of(share * g.error.y, g.indirect, indirect[i]) +
                    Vec3(std::max(g.error.z, 0.0f) + std::max(g.error.w, 0.0f));
    }
    return errors;
}

}  // namespace wedge::rendering
