#include "bench/converge/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wedge::converge {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool is_positive(double value) {
    return std::isfinite(value) && value > 0;
}

double log_log_between(const Point& a, const Point& b, double x) {
    if (a.x == b.x) return std::min(a.y, b.y);
    const double share = std::log(x / a.x) / std::log(b.x / a.x);
    return std::exp((1 - share) * std::log(a.y) + share * std::log(b.y));
}

}  // namespace

double quantile(std::span<const double> values, double share) {
    if (values.empty()) return kNaN;
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const double position = share * double(sorted.size() - 1);
    const auto below = std::size_t(position);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (position - double(below)) * (sorted[above] - sorted[below]);
}

Spread spread_of(std::span<const double> values) {
    return {quantile(values, 0.1), quantile(values, 0.5), quantile(values, 0.9)};
}

std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y) {
    std::vector<Point> logs;
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
        if (is_positive(x[i]) && is_positive(y[i]))
            logs.push_back({std::log(x[i]), std::log(y[i])});
    if (logs.size() < 2) return {};
    const double n = double(logs.size());
    Point mean;
    for (const Point& p : logs) {
        mean.x += p.x / n;
        mean.y += p.y / n;
    }
    double xx = 0, xy = 0;
    for (const Point& p : logs) {
        xx += (p.x - mean.x) * (p.x - mean.x);
        xy += (p.x - mean.x) * (p.y - mean.y);
    }
    // Distinct x only: relative to rounding, not to any unit.
    if (xx <= 1e-20 * n * (1 + mean.x * mean.x)) return {};
    PowerLaw fit;
    fit.slope = xy / xx;
    fit.log_scale = mean.y - fit.slope * mean.x;
    double residue = 0;
    for (const Point& p : logs) {
        const double off = p.y - fit.log_scale - fit.slope * p.x;
        residue += off * off;
    }
    if (logs.size() > 2) fit.slope_error = std::sqrt(residue / (n - 2) / xx);
    return fit;
}

LogLogCurve::LogLogCurve(std::vector<Point> points) : points_(std::move(points)) {
    std::erase_if(points_, [](const Point& p) { return !is_positive(p.x) || !is_positive(p.y); });
    std::sort(points_.begin(), points_.end(),
              [](const Point& a, const Point& b) { return a.x < b.x; });
}

std::optional<double> LogLogCurve::at(double x) const {
    if (points_.empty() || x < points_.front().x || x > points_.back().x) return {};
    for (std::size_t i = 0; i + 1 < points_.size(); ++i)
        if (x <= points_[i + 1].x) return log_log_between(points_[i], points_[i + 1], x);
    return points_.back().y;
}

LogLogCurve::Crossing LogLogCurve::comes_down_to(double y) const {
    if (points_.empty()) return {};
    if (points_.front().y <= y) return {Crossing::below, points_.front().x};
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
        const Point &a = points_[i], &b = points_[i + 1];
        if (b.y > y) continue;
        const double share = std::log(y / a.y) / std::log(b.y / a.y);
        return {Crossing::found, a.x * std::pow(b.x / a.x, share)};
    }
    return {};
}

namespace {

/// Regularised incomplete beta function I_x(a, b): continued fraction 26.5.8 of Abramowitz and
/// Stegun, evaluated from the front (Lentz).
double incomplete_beta(double a, double b, double x) {
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    if (x > (a + 1) / (a + b + 2)) return 1 - incomplete_beta(b, a, 1 - x);
    constexpr double kTiny = 1e-300;
    const auto guarded = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
    double value = 1, c = 1, d = 0;
    for (int i = 1; i < 2000; ++i) {
        const double m = i / 2;  // whole: the terms come in pairs
        const double term = i % 2 == 0
                                ? m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
                                : -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / guarded(1 + term * d);
        c = guarded(1 + term / c);
        value *= c * d;
        if (std::abs(c * d - 1) < 1e-14) break;
    }
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                  a * std::log(x) + b * std::log1p(-x)) /
                         a;
    return front / value;
}

}  // namespace

double student_p_value(double t, double freedom) {
    return incomplete_beta(0.5 * freedom, 0.5, freedom / (freedom + t * t));
}

double geometric_mean(std::span<const double> values) {
    double sum = 0;
    for (double value : values) sum += std::log(value);
    return values.empty() ? kNaN : std::exp(sum / double(values.size()));
}

}  // namespace wedge::converge
