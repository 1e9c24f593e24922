// What a finished render says about itself: lines for people, JSON for `--stats`.
#pragma once

#include <string>

#include "wedge/render.hpp"
#include "wedge/scene.hpp"

namespace wedge::cli {

/// Average over the pixels that were to be rendered.
double samples_per_pixel(const RenderStats& stats, const Scene& scene,
                         const RenderOptions& options);

/// stats_to_json of the library, with `scene`, `load_s` and `samples_per_pixel` added.
std::string stats_json(const RenderStats& stats, const Scene& scene, const RenderOptions& options,
                       const std::string& scene_file, double load_s);

/// Size, samples, rate and times on stderr.
void report(const RenderStats& stats, const Scene& scene, const RenderOptions& options,
            double load_s);

}  // namespace wedge::cli
