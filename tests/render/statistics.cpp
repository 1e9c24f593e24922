#include "statistics.hpp"

#include <algorithm>
#include <cmath>

namespace wedge::test {
namespace {

/// Regularised upper incomplete gamma function Q(a, x): series or continued fraction (Abramowitz &
/// Stegun 6.5.29, 6.5.31).
double gamma_q(double a, double x) {
    if (x <= 0) return 1;
    const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (int n = 1; n < 10000 && std::abs(term) > 1e-16 * std::abs(sum); ++n)
            sum += term *= x / (a + n);
        return 1 - front * sum;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
    for (int i = 1; i < 10000; ++i) {
        const double an = -i * (i - a);
        b += 2;
        d = 1 / (an * d + b);
        c = b + an / c;
        h *= d * c;
        if (std::abs(d * c - 1) < 1e-15) break;
    }
    return front * h;
}

/// Regularised incomplete beta function I_x(a, b) by its continued fraction (A&S 26.5.8).
double beta_i(double a, double b, double x) {
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    if (x > (a + 1) / (a + b + 2)) return 1 - beta_i(b, a, 1 - x);
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                  a * std::log(x) + b * std::log1p(-x)) /
                         a;
    double c = 1, d = 1 - (a + b) * x / (a + 1);
    d = 1 / d;
    double h = d;
    for (int m = 1; m < 10000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1 / (1 + even * d);
        c = 1 + even / c;
        h *= d * c;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / (1 + odd * d);
        c = 1 + odd / c;
        h *= d * c;
        if (std::abs(d * c - 1) < 1e-15) break;
    }
    return front * h;
}

}  // namespace

double chi_square_p_value(std::span<const double> observed, std::span<const double> expected) {
    double chi2 = 0, pooled_observed = 0, pooled_expected = 0;
    int cells = 0;
    const auto add = [&](double o, double e) {
        chi2 += (o - e) * (o - e) / e;
        ++cells;
    };
    for (std::size_t i = 0; i < observed.size(); ++i) {
        if (expected[i] >= 5) {
            add(observed[i], expected[i]);
        } else {
            pooled_observed += observed[i];
            pooled_expected += expected[i];
        }
    }
    if (pooled_expected > 0) add(pooled_observed, std::max(pooled_expected, 1e-3));
    if (pooled_expected <= 0 && pooled_observed > 0) return 0;  // where nothing can fall
    return cells > 1 ? gamma_q(0.5 * (cells - 1), 0.5 * chi2) : 1;
}

MeanAndError mean_and_error(std::span<const double> values) {
    MeanAndError result;
    const double n = double(values.size());
    for (double v : values) result.mean += v / n;
    double squares = 0;
    for (double v : values) squares += (v - result.mean) * (v - result.mean);
    if (n > 1) result.standard_error = std::sqrt(squares / (n * (n - 1)));
    return result;
}

double welch_p_value(std::span<const double> a, std::span<const double> b) {
    const MeanAndError x = mean_and_error(a), y = mean_and_error(b);
    const double va = x.standard_error * x.standard_error, vb = y.standard_error * y.standard_error;
    const double difference = std::abs(x.mean - y.mean);
    // Constant pixels differ by rounding only.
    if (difference <= 1e-5 * (std::abs(x.mean) + std::abs(y.mean))) return 1;
    if (va + vb == 0) return 0;
    const double t = difference / std::sqrt(va + vb);
    const double freedom =
        (va + vb) * (va + vb) / (va * va / double(a.size() - 1) + vb * vb / double(b.size() - 1));
    return beta_i(0.5 * freedom, 0.5, freedom / (freedom + t * t));
}

double sidak(double level, std::size_t tests) {
    return 1 - std::pow(1 - level, 1 / double(tests));
}

}  // namespace wedge::test
