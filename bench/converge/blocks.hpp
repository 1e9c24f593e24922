// Errors by block of 16 x 16 px: a mean over the image hides where a method is worse.
#pragma once

#include <vector>

#include "bench/converge/analysis.hpp"

namespace wedge::converge {

/// Times a mean squared error: what counts as worse is a tenth more as RMSE.
constexpr double kTenthMore = 1.1 * 1.1;

/// Mean squared error by block, row by row; the reference's part is subtracted, so that it may be
/// slightly negative.
using BlockErrors = std::vector<double>;
BlockErrors block_errors(const Reference& reference, const Image& image);

/// Of a method by block, at any time. Error times time changes little for plain Monte Carlo: it is
/// interpolated between what was measured and kept beyond.
class BlockErrorsOverTime {
  public:
    void add(double time_s, BlockErrors errors);
    double at(std::size_t block, double time_s) const;  ///< at least one must have been added

  private:
    struct Measured {
        double log_time;
        BlockErrors error_times_time;
    };
    std::vector<Measured> measured_;  ///< in order of time
};

/// Mean squared error by block that rounding may make.
double rounding_error(const Reference& reference);

}  // namespace wedge::converge
