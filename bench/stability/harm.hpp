// Blocks in which a method is worse than plain Monte Carlo in the same time. What seeds do alone is
// told from harm by their scatter.
#pragma once

#include <vector>

#include "bench/converge/blocks.hpp"

namespace wedge::stability {

/// Shares of blocks with more than 1.1 times the RMSE of plain Monte Carlo.
struct Harm {
    double seen = 0;   ///< by the mean squared error over seeds
    double shown = 0;  ///< by more than luck explains
};

/// Compares seed by seed: a block counts as shown if its margins, mean squared error less 1.21
/// times that of plain Monte Carlo with the same seed number at the same time, are positive beyond
/// luck (luck.hpp).
class BlockYardstick {
  public:
    BlockYardstick(const converge::Reference& reference, const converge::Curve& plain);
    Harm harm(const converge::Rung& rung) const;

  private:
    const converge::Reference& reference_;
    std::vector<converge::BlockErrorsOverTime> by_seed_;
    double rounding_;
};

}  // namespace wedge::stability
