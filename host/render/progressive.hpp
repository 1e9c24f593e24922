// Plain Monte Carlo that knows its error: it stops where that is small enough.
#pragma once

#include "host/render/sampling_loop.hpp"

namespace wedge::rendering {

/// True if the error of a render with these options is to be estimated, and can be: not of films in
/// bands, nor of renders that are resumed.
bool estimates_error(const RenderOptions& options, std::size_t bands);

/// Brings all pixels from sample `first` to `first + samples`, or as far as the target error needs,
/// and fills `stats.estimated_error`.
void run_progressively(const RenderOptions& options, uint32_t first, uint32_t samples,
                       SamplingLoop& loop, PathTracer& tracer, RenderStats& stats);

}  // namespace wedge::rendering
