// The few statistics that a chart of error against cost needs.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace wedge::converge {

/// Quantile of the values, linear between order statistics (Hyndman and Fan 1996, type 7). `share`
/// in [0, 1]. NaN if there are none.
double quantile(std::span<const double> values, double share);

/// Median, with the quantiles that a ribbon shows. Of few values they lie near the extremes.
struct Spread {
    double low = 0, median = 0, high = 0;  ///< 10 %, 50 %, 90 %
};
Spread spread_of(std::span<const double> values);

/// y = a x^slope, by least squares of log y over log x.
struct PowerLaw {
    double slope = 0;
    double slope_error = 0;  ///< standard error; 0 where there are two points only
    double log_scale = 0;    ///< log a
};
/// Points with a coordinate that is not positive are left out; nothing if fewer than two distinct x
/// are left.
std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

struct Point {
    double x = 0, y = 0;
};

/// A curve of positive points, straight in log-log between them, in order of x.
class LogLogCurve {
  public:
    LogLogCurve() = default;
    /// Sorts; points that are not positive and finite are left out.
    explicit LogLogCurve(std::vector<Point> points);

    bool empty() const { return points_.empty(); }
    const std::vector<Point>& points() const { return points_; }

    /// Value at `x`; nothing outside the points.
    std::optional<double> at(double x) const;

    /// Smallest x at which the curve comes down to `y`. `above`: no point gets there. `below`: the
    /// first point is there already, and `x` is its place: an upper bound.
    struct Crossing {
        enum Kind { found, above, below } kind = above;
        double x = 0;
    };
    Crossing comes_down_to(double y) const;

  private:
    std::vector<Point> points_;
};

/// Two-sided p-value of Student's t with `freedom` degrees (> 0, need not be whole).
double student_p_value(double t, double freedom);

/// exp of the mean logarithm of positive values; NaN if there are none.
double geometric_mean(std::span<const double> values);

}  // namespace wedge::converge
