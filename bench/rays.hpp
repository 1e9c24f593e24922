// The rays that rates are measured with: those a path tracer makes, kind by kind.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "host/render/flatten.hpp"
#include "wedge/math.hpp"
#include "wedge/scene.hpp"
#include "wedge/shared/bvh.h"

namespace wedge::bench {

/// As kernels/trace.cl reads and writes them.
struct PackedRay {
    float ox, oy, oz, t_max;
    float dx, dy, dz;
    uint32_t source;  ///< the triangle the ray leaves
};
struct PackedHit {
    float t, u, v;
    uint32_t primitive;
};

struct RaySet {
    std::string kind;
    bool occlusion = false;  ///< any hit will do
    std::vector<PackedRay> rays;
};

using TraceClosest = std::function<std::vector<PackedHit>(std::span<const PackedRay>)>;

/// `primary`: one ray for each of width x height pixels of the scene's camera. `bounce 1`, `bounce
/// 2`: cosine-distributed from where the rays before hit. `shadow`: from the primary hits to points
/// of the scene's first rectangular light, or of a square under the top of a scene that has none.
/// `ambient`: as bounce 1, no longer than a tenth of the scene's diagonal. The same scene gives the
/// same rays.
std::vector<RaySet> make_ray_sets(const Scene& scene, const rendering::FlatScene& flat,
                                  const Bounds& bounds, int width, int height,
                                  const TraceClosest& trace);

}  // namespace wedge::bench
