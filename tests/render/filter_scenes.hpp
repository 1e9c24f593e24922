// What the tests of filters share.
#pragma once

#include "test_scenes.hpp"

namespace wedge::test {

/// A square that floats between a large lamp and the ground: wide penumbrae. 64x48 px.
Scene make_penumbra(LightProfile profile);

/// Filtering without bounces.
RenderOptions filtered(float mu, uint32_t seed = 0);

/// Root mean square difference of one channel.
double channel_rmse(const Image& a, const Image& b, const char* channel);
/// The same of lists of equal length.
double rmse_of(const std::vector<double>& x, const std::vector<double>& y);
/// Of green.
double rmse(const Image& a, const Image& b);

}  // namespace wedge::test
