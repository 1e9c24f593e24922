// What a finished render says about itself: lines for people, JSON for `--stats`.
#pragma once

#include <string>

#include "wedge/render.hpp"
#include "wedge/scene.hpp"

namespace wedge::cli {

struct Outcome {
    double samples_per_pixel = 0;
    int samples_per_pixel_asked = 0;
    bool is_short = false;  ///< fewer than asked, and neither the user nor a time limit ended it
};

Outcome judge(const Scene& scene, const RenderOptions& options, const RenderStats& stats);

/// stats_to_json of the library, with `scene`, `load_s` and `samples_per_pixel` added.
std::string stats_json(const RenderStats& stats, const Outcome& outcome, const std::string& scene,
                       double load_s);

/// Size, samples, rate and times on stderr; a warning if samples were dropped.
void report(const RenderStats& stats, const Outcome& outcome, const Scene& scene,
            const RenderOptions& options, double load_s);

}  // namespace wedge::cli
