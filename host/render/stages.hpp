// Adaptive samples as work that is dense: pixels that need many samples do not wait for those that
// need few.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wedge/shared/filter.h"

namespace wedge::rendering {

/// Samples [first, end) of the pixels that lack some of them.
struct Stage {
    uint32_t first = 0, end = 0;
    std::vector<uint32_t> pixels;  ///< those that trace whole paths come first
};

/// From `done` samples, which all pixels have, to the ends; a stage doubles the samples, as the
/// sampler's stretches do.
std::vector<Stage> cut_into_stages(std::span<const shared::SampleEnds> ends, uint32_t done);

}  // namespace wedge::rendering
