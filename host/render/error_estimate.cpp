#include "host/render/error_estimate.hpp"

#include <algorithm>
#include <cmath>

namespace wedge::rendering {
namespace {

constexpr double kRelativeOffset = 0.01;  // of relMSE, docs/metrics.md
// Independent samples have 1. Of what is seen at few samples not more than 2 is believed, because
// smooth dimensions get exhausted first.
constexpr double kSlowest = 1, kFastest = 2;
// Of stratified samples, before it is known: the median over the stability suite, 4 to 64 samples.
constexpr double kTypical = 1.25;

double weight_of(double value) {
    const double scale = std::max(value, 0.0) + kRelativeOffset;
    return 1 / (scale * scale);
}

void add_means(const shared::FilmPixel& p, std::vector<float>& means) {
    const double paths = p.direct.w > 0 ? 1 / double(p.direct.w) : 0;
    const double seen = p.position.w > 0 ? 1 / double(p.position.w) : 0;
    means.push_back(float(seen * p.emission.x + paths * (double(p.direct.x) + p.indirect.x)));
    means.push_back(float(seen * p.emission.y + paths * (double(p.direct.y) + p.indirect.y)));
    means.push_back(float(seen * p.emission.z + paths * (double(p.direct.z) + p.indirect.z)));
}

}  // namespace

void ErrorEstimate::add(uint32_t samples, std::span<const shared::FilmPixel> film) {
    std::vector<float> means;
    means.reserve(3 * film.size());
    for (const shared::FilmPixel& p : film) add_means(p, means);
    const double share = means.empty() ? 0 : 1 / double(means.size());
    if (!mean_.empty()) {
        Change change;
        for (std::size_t i = 0; i < means.size(); ++i) {
            const double d = double(means[i]) - double(mean_[i]);
            change.mse += share * d * d;
            change.rel_mse += share * d * d * weight_of(means[i]);
        }
        changes_.push_back(change);
    } else {
        for (std::size_t i = 0; i < film.size(); ++i) {
            const double n = film[i].direct.w;
            const double squares[3] = {film[i].square.x, film[i].square.y, film[i].square.z};
            for (std::size_t c = 0; c < 3 && n > 1; ++c) {
                const double mean = means[3 * i + c];
                const double variance = std::max(0.0, squares[c] / n - mean * mean) / (n - 1);
                sampled_.mse += share * variance;
                sampled_.rel_mse += share * variance * weight_of(mean);
            }
        }
    }
    mean_ = std::move(means);
    samples_ = samples;
}

double ErrorEstimate::rate(double Change::*metric) const {
    const std::size_t n = changes_.size();
    if (n < 3) return sampler_ == Sampler::hash ? kSlowest : kTypical;
    const std::size_t apart = n < 4 ? 1 : 2;
    const double last = two_from(n - 2, metric), before = two_from(n - 2 - apart, metric);
    if (!(before > 0) || !(last > 0)) return kSlowest;
    return std::clamp(std::log2(before / last) / double(apart), kSlowest, kFastest);
}

double ErrorEstimate::two_from(std::size_t first, double Change::*metric) const {
    return changes_[first].*metric + changes_[first + 1].*metric;
}

double ErrorEstimate::level(double Change::*metric) const {
    if (changes_.empty()) return sampled_.*metric;
    if (changes_.size() >= 2)
        return two_from(changes_.size() - 2, metric) / (std::exp2(2 * rate(metric)) - 1);
    return changes_.back().*metric / (std::exp2(rate(metric)) - 1);
}

std::optional<EstimatedError> ErrorEstimate::at(uint32_t samples) const {
    if (samples_ == 0) return {};
    const auto value = [&](double Change::*metric) {
        return level(metric) * std::pow(double(samples_) / samples, rate(metric));
    };
    return EstimatedError{std::sqrt(value(&Change::mse)), value(&Change::rel_mse)};
}

double ErrorEstimate::samples_for(double target, ErrorMetric metric) const {
    const bool relative = metric == ErrorMetric::rel_mse;
    const auto which = relative ? &Change::rel_mse : &Change::mse;
    const double wanted = relative ? target : target * target;
    return samples_ * std::pow(level(which) / wanted, 1 / rate(which));
}

EstimatedError joined(const EstimatedError& a, double pixels_a, const EstimatedError& b,
                      double pixels_b) {
    const double share = pixels_a / (pixels_a + pixels_b);
    return {std::sqrt(std::lerp(b.rmse * b.rmse, a.rmse * a.rmse, share)),
            std::lerp(b.rel_mse, a.rel_mse, share)};
}

EstimatedError estimate_of_filtered(std::span<const shared::FilmPixel> film,
                                    std::span<const Vec3> squares) {
    EstimatedError sum;
    std::vector<float> means;
    for (std::size_t i = 0; i < squares.size(); ++i) {
        means.clear();
        add_means(film[i], means);
        for (int c = 0; c < 3; ++c) {
            sum.rmse += double(squares[i][c]);
            sum.rel_mse += double(squares[i][c]) * weight_of(means[std::size_t(c)]);
        }
    }
    const double share = squares.empty() ? 0 : 1 / (3 * double(squares.size()));
    return {std::sqrt(sum.rmse * share), sum.rel_mse * share};
}

}  // namespace wedge::rendering
