// The few statistics that the tests decide by.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace wedge::test {

/// Probability of a chi-square value this large or larger by chance. Cells that expect fewer than 5
/// are pooled. `expected` and `observed` are counts over the same cells.
double chi_square_p_value(std::span<const double> observed, std::span<const double> expected);

struct MeanAndError {
    double mean = 0, standard_error = 0;
};
MeanAndError mean_and_error(std::span<const double> values);

/// Two-sided p-value of Welch's t-test for equal means; 1 where both samples are constant and
/// equal.
double welch_p_value(std::span<const double> a, std::span<const double> b);

/// Level for one of `tests` independent tests so that all together err with probability `level`
/// (Sidak).
double sidak(double level, std::size_t tests);

}  // namespace wedge::test
