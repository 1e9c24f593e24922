// What the tests of filters share.
#pragma once

#include "test_scenes.hpp"

namespace wedge::test {

/// A square that floats between a large lamp and the ground: wide penumbrae. 64x48 px.
Scene make_penumbra(LightProfile profile);

/// A film of 32x32 pixels, as wide as 1.94 on ground at height 0, seen from straight above but
/// turned (edges along the film's axes are found far better), under a lamp of 3x3 at height 10.
void look_down_aslant(Scene& scene);

/// Filtering without bounces.
RenderOptions filtered(float mu, uint32_t seed = 0);

/// Root mean square difference of one channel.
double channel_rmse(const Image& a, const Image& b, const char* channel);
/// The same of lists of equal length.
double rmse_of(const std::vector<double>& x, const std::vector<double>& y);
/// Of green.
double rmse(const Image& a, const Image& b);

}  // namespace wedge::test
