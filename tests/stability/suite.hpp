// The stability suite's scenes, small, for rules that do not depend on time.
#pragma once

#include "tests/render/test_scenes.hpp"
#include "wedge/render.hpp"

namespace wedge::test {

/// scenes/stability/NAME.json at `width` x `height` pixels. Textures too, where images are built
/// in.
Scene suite_scene(const std::string& name, int width, int height);

/// Every scene of the suite that is rendered, in the order of bench/stability.json.
std::vector<std::string> suite_scene_names();

/// aaf, guarded or plain, with at most `most_samples` a pixel.
RenderOptions filtered(FilterMode mode, float mu = 1, int most_samples = 64, uint64_t seed = 0);

/// Over R, G, B and all pixels.
double mean_of(const Image& image);
double rmse_between(const Image& a, const Image& b);
bool all_finite(const Image& image);

}  // namespace wedge::test
