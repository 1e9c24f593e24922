#include "bench/converge/statistics.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "tests/bench/approx.hpp"

using namespace wedge::converge;

TEST_CASE("quantiles_are_linear_between_order_statistics") {
    // 1, 2, 3, 4: R's quantile(1:4, c(0, 0.1, 0.5, 0.9, 1)), type 7.
    const std::vector<double> values{4, 1, 3, 2};
    CHECK(quantile(values, 0) == 1);
    CHECK(quantile(values, 0.1) == wedge::test::close_to(1.3, 1e-6));
    CHECK(quantile(values, 0.5) == wedge::test::close_to(2.5, 1e-6));
    CHECK(quantile(values, 0.9) == wedge::test::close_to(3.7, 1e-6));
    CHECK(quantile(values, 1) == 4);
    CHECK(std::isnan(quantile({}, 0.5)));
}

TEST_CASE("ribbon_of_equal_runs_has_no_width") {
    const Spread spread = spread_of(std::vector<double>{7, 7, 7});
    CHECK(spread.low == 7);
    CHECK(spread.median == 7);
    CHECK(spread.high == 7);
}

TEST_CASE("ribbon_holds_eight_of_ten_normal_values") {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<double> values(20000);
    for (double& v : values) v = normal(random);
    const Spread spread = spread_of(values);
    CHECK(spread.low == wedge::test::close_to(-1.2816, 0.03));
    CHECK(spread.high == wedge::test::close_to(1.2816, 0.03));
}

TEST_CASE("slope_of_an_exact_power_law_is_found") {
    std::vector<double> x, y;
    for (double n = 1; n <= 1024; n *= 2) {
        x.push_back(n);
        y.push_back(3 * std::pow(n, -0.75));
    }
    const auto fit = fit_power_law(x, y);
    REQUIRE(fit);
    CHECK(fit->slope == wedge::test::close_to(-0.75, 1e-6));
    CHECK(std::exp(fit->log_scale) == wedge::test::close_to(3, 1e-6));
    CHECK(fit->slope_error < 1e-12);
}

TEST_CASE("slope_error_covers_the_truth_as_often_as_it_should") {
    // Two standard errors with 10 degrees of freedom: 92.7 % of 2000 trials, +- 4 deviations.
    std::mt19937 random(2);
    std::normal_distribution<double> noise(0, 0.2);
    int covered = 0;
    constexpr int kTrials = 2000;
    for (int trial = 0; trial < kTrials; ++trial) {
        std::vector<double> x, y;
        for (int i = 0; i < 12; ++i) {
            x.push_back(std::exp(0.4 * i));
            y.push_back(std::exp(1 - 0.5 * 0.4 * i + noise(random)));
        }
        const auto fit = fit_power_law(x, y);
        REQUIRE(fit);
        covered += std::abs(fit->slope + 0.5) < 2 * fit->slope_error;
    }
    CHECK(covered > kTrials * 0.904);
    CHECK(covered < kTrials * 0.950);
}

TEST_CASE("slope_needs_two_different_costs_and_positive_errors") {
    CHECK_FALSE(fit_power_law(std::vector<double>{1}, std::vector<double>{1}));
    CHECK_FALSE(fit_power_law(std::vector<double>{2, 2, 2}, std::vector<double>{1, 3, 2}));
    CHECK_FALSE(fit_power_law(std::vector<double>{1, 2}, std::vector<double>{1, 0}));
}

TEST_CASE("interpolation_is_exact_on_a_power_law_and_ends_with_the_data") {
    const LogLogCurve curve({{16, 0.25}, {1, 1}, {4, 0.5}});  // x^-0.5, not in order
    CHECK(*curve.at(1) == wedge::test::close_to(1, 1e-6));
    CHECK(*curve.at(2) == wedge::test::close_to(std::pow(2, -0.5), 1e-6));
    CHECK(*curve.at(9) == wedge::test::close_to(1.0 / 3, 1e-6));
    CHECK_FALSE(curve.at(0.99));
    CHECK_FALSE(curve.at(16.01));
}

TEST_CASE("equal_error_is_where_the_curve_comes_down_first") {
    const LogLogCurve curve({{1, 1}, {4, 0.5}, {8, 0.6}, {64, 0.1}});
    const auto crossing = curve.comes_down_to(0.5);
    CHECK(crossing.kind == LogLogCurve::Crossing::found);
    CHECK(crossing.x == wedge::test::close_to(4, 1e-6));
    CHECK(curve.comes_down_to(0.7).x == wedge::test::close_to(std::pow(0.7, -2), 1e-6));
    CHECK(curve.comes_down_to(0.05).kind == LogLogCurve::Crossing::above);
    CHECK(curve.comes_down_to(2).kind == LogLogCurve::Crossing::below);
    CHECK(LogLogCurve().comes_down_to(1).kind == LogLogCurve::Crossing::above);
}

TEST_CASE("student_p_values_agree_with_published_tables") {
    // Two-sided 5 % and 1 % points.
    CHECK(student_p_value(12.706, 1) == wedge::test::close_to(0.05, 1e-3));
    CHECK(student_p_value(4.303, 2) == wedge::test::close_to(0.05, 1e-3));
    CHECK(student_p_value(-2.228, 10) == wedge::test::close_to(0.05, 1e-3));
    CHECK(student_p_value(2.042, 30) == wedge::test::close_to(0.05, 2e-3));
    CHECK(student_p_value(3.169, 10) == wedge::test::close_to(0.01, 1e-3));
    CHECK(student_p_value(2.576, 1e6) == wedge::test::close_to(0.01, 2e-3));
    CHECK(student_p_value(0, 5) == wedge::test::close_to(1, 1e-6));
}
