// Probe, measure, sample, filter (docs/filtering.md): once, twice where mu is large, or in rounds
// of rising mu until time is over or the error is small enough.
#pragma once

#include <span>
#include <vector>

#include "host/render/sampling_loop.hpp"
#include "host/render/signal_filter.hpp"

namespace wedge::rendering {

/// Stopped early, it filters what there is, and returns false: too little is known to tell the
/// error. Fills `stats.mu`.
bool run_filtered(const Scene& scene, const RenderOptions& options, SamplingLoop& loop,
                  PathTracer& tracer, SignalFilter& filter, RenderStats& stats);

/// Puts filtered light in the place of what was not filtered, in sums over samples.
void replace_unfiltered(std::vector<shared::FilmPixel>& film, const FilteredLight& light);

}  // namespace wedge::rendering
