// A reference must be much better than what is measured with it: it gets samples until it is.
#pragma once

#include <functional>
#include <vector>

#include "bench/converge/reference.hpp"
#include "bench/converge/run_record.hpp"

namespace wedge::converge {

/// How many times smaller than the smallest error that is plotted its own has to be (RMSE).
inline constexpr double kReferenceMargin = 5;

/// Of the methods and budgets among `runs`, the least median RMSE over seeds. `mean_squares`: one a
/// run. Infinity if there are no runs.
double least_median_rmse(const std::vector<RunRecord>& runs,
                         const std::vector<double>& mean_squares);

/// Samples per pixel that would make `own_rmse` kReferenceMargin times smaller than `least_rmse`,
/// if its square falls with 1 / n; whole pairs of `piece_samples`. Not more than kLargestGrowth
/// times what there is, because both errors are estimates, the poorer the reference the rougher.
uint64_t samples_wanted(uint64_t spp, int piece_samples, double own_rmse, double least_rmse);
inline constexpr double kLargestGrowth = 4;

/// Adds to `reference` until it is good enough or a limit of `Config` is reached. `more` renders: a
/// reference of the samples asked for, or fewer if time is up.
void improve_reference(const Config& config, const std::vector<RunRecord>& runs,
                       const std::function<Reference(uint64_t spp)>& more,
                       const std::function<void(const std::string&)>& say, Reference& reference);

}  // namespace wedge::converge
