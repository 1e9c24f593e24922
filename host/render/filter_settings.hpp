// How much is filtered and sampled: the settings of the method, and how they go with mu.
#pragma once

#include "wedge/render.hpp"
#include "wedge/scene.hpp"
#include "wedge/shared/filter.h"

namespace wedge::rendering {

/// The most that a pixel gets, for each of mu. (The thesis has 100; this is a power of two.)
inline constexpr float kSamplesPerMu = 128;
/// With so many samples for each, what a film can count.
inline constexpr float kLargestMu = 10000;

/// Settings of the thesis (docs/filtering.md), one set for all scenes.
shared::FilterSettings make_filter_settings(const Scene& scene, const RenderOptions& options,
                                            float mu);

/// Rows and columns that a filter may reach to each side.
int largest_filter_radius_px(const Film& film);

/// Whether mu rises until an end is met.
bool goes_in_rounds(const RenderOptions& options);

}  // namespace wedge::rendering
