// Loops over independent work on all cores: oneTBB where it is installed, one thread where not (a
// bare GPU machine). Results must not depend on the order or the split.
#pragma once

#include <cstddef>

#ifdef WEDGE_HAVE_TBB
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#endif

namespace wedge {

/// Calls body(begin, end) for disjoint ranges that cover [0, count), `grain` items or more at a
/// time.
template <typename Body>
void parallel_ranges(std::size_t count, std::size_t grain, const Body& body) {
#ifdef WEDGE_HAVE_TBB
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const auto& range) { body(range.begin(), range.end()); });
#else
    (void)grain;
    body(std::size_t(0), count);
#endif
}

/// Runs both, at the same time if a core is free.
template <typename First, typename Second>
void parallel_pair(const First& first, const Second& second) {
#ifdef WEDGE_HAVE_TBB
    tbb::parallel_invoke(first, second);
#else
    first();
    second();
#endif
}

}  // namespace wedge
