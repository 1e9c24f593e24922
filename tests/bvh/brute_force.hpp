// What is true of a ray and a set of triangles, in double precision and with error bounds: the
// judge of the kernels' answers.
#pragma once

#include <span>
#include <vector>

#include "meshes.hpp"
#include "tracer.hpp"

namespace wedge::test {

/// One triangle against one ray.
struct Verdict {
    enum Kind {
        miss,    ///< no arithmetic in single precision may report a hit
        unsure,  ///< within the rounding error of single precision of an edge, or edge-on
        hit,     ///< any sound arithmetic must report a hit
    } kind = miss;
    double t = 0;
    double t_error = 0;  ///< that single precision may make
};

/// The margins follow from the roundings of vertices relative to the origin and of the products
/// made of them, not from what the kernels return.
Verdict judge(const Triangles& triangles, uint32_t primitive, const PackedRay& ray);

struct Score {
    uint64_t wrong = 0;   ///< answers that are neither right nor a tie
    uint64_t unsure = 0;  ///< rays for which more than one answer is right
    uint64_t hits = 0;
    uint64_t first_wrong = 0;  ///< index of a ray, if wrong != 0
};

/// Compares closest hits with the truth about each ray.
Score score_closest(const Triangles& triangles, std::span<const PackedRay> rays,
                    std::span<const PackedHit> hits);

/// The same for occlusion.
Score score_occluded(const Triangles& triangles, std::span<const PackedRay> rays,
                     std::span<const PackedHit> hits);

}  // namespace wedge::test
