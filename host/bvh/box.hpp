// Boxes in vector registers, for the builder's inner loops.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace wedge::bvh {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));

inline Float4 minimum(Float4 a, Float4 b) {
    return a < b ? a : b;
}
inline Float4 maximum(Float4 a, Float4 b) {
    return a > b ? a : b;
}
inline Float4 splat(float x) {
    return Float4{x, x, x, x};
}

/// x, y, z; the fourth lane is free for the user.
struct Box {
    Float4 lower = splat(std::numeric_limits<float>::infinity());
    Float4 upper = splat(-std::numeric_limits<float>::infinity());

    void include(const Box& b) {
        lower = minimum(lower, b.lower);
        upper = maximum(upper, b.upper);
    }
    void include(Float4 p) {
        lower = minimum(lower, p);
        upper = maximum(upper, p);
    }
};

/// Half the surface area, after scaling all lengths: without the scale, areas of tiny or huge
/// scenes leave the range of float. 0 for an empty box. The fourth lane, often an index, is cleared
/// first: as a float it is denormal, and multiplying it would cost a hundred cycles.
inline float half_area(const Box& box, float scale) {
    const Float4 e = Float4(Int4(box.upper - box.lower) & Int4{-1, -1, -1, 0}) * splat(scale);
    return e[0] < 0 ? 0 : e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
}

/// A triangle as the builder sees it: its box, and its index in the fourth lane of `lower`.
struct PrimRef {
    Float4 lower, upper;  // left without a value, so that arrays of them are not written twice

    uint32_t primitive() const { return std::bit_cast<uint32_t>(float(lower[3])); }
    Box box() const { return {lower, upper}; }
    /// Twice the centre of the box: no coordinate exceeds FLT_MAX / 4, so it is finite. The fourth
    /// lane is 0.
    Float4 centroid() const { return Float4(Int4(lower + upper) & Int4{-1, -1, -1, 0}); }
};

}  // namespace wedge::bvh
