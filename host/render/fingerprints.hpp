// What decides about the bits of an image, part by part.
#pragma once

#include <string>
#include <vector>

#include "host/render/path_tracer.hpp"
#include "wedge/render.hpp"
#include "wedge/scene.hpp"

namespace wedge::rendering {

struct Fingerprint {
    const char* part;  ///< in words
    std::string hex;   ///< 64 digits; equal: the same, but for collisions
};

/// In one order. `stats`: tells the device.
std::vector<Fingerprint> fingerprints_of(const Scene& scene, const RenderOptions& options,
                                         const PathSettings& settings, const RenderStats& stats);

}  // namespace wedge::rendering
