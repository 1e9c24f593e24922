#include "bench/stability/luck.hpp"

#include <cmath>
#include <numeric>

#include "bench/converge/statistics.hpp"

namespace wedge::stability {

bool positive_beyond_luck(std::span<const double> margins) {
    if (margins.empty()) return false;
    const auto n = double(margins.size());
    const double mean = std::accumulate(margins.begin(), margins.end(), 0.0) / n;
    if (!(mean > 0)) return false;
    if (margins.size() == 1) return true;
    double squares = 0;
    for (double margin : margins) squares += (margin - mean) * (margin - mean);
    const double error_of_mean = std::sqrt(squares / (n * (n - 1)));
    if (error_of_mean == 0) return true;
    return converge::student_p_value(mean / error_of_mean, n - 1) < 2 * kLevel;
}

}  // namespace wedge::stability
