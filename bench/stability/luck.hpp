// What seeds alone may do.
#pragma once

#include <span>

namespace wedge::stability {

/// Chance that luck alone passes for harm in one comparison.
inline constexpr double kLevel = 0.025;

/// True if the mean of `margins`, one a seed, is positive by more than their scatter explains:
/// Student's test, one-sided, at kLevel. One margin says nothing of scatter and is believed.
bool positive_beyond_luck(std::span<const double> margins);

}  // namespace wedge::stability
