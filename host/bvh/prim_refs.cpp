#include "host/bvh/prim_refs.hpp"

#include <fmt/format.h>

#include <cfloat>
#include <vector>

#include "host/base/parallel.hpp"
#include "wedge/error.hpp"

namespace wedge::bvh {
namespace {

// Fixed, so that the chunks and with them the order do not depend on the number of threads.
constexpr std::size_t kChunk = 1 << 14;

// Larger coordinates could have differences that are not finite.
constexpr float kLargestCoordinate = 0.25f * FLT_MAX;

PrimRef make_ref(const Vec3& v0, const Vec3& v1, const Vec3& v2, uint32_t primitive) {
    const Vec3 lower = glm::min(glm::min(v0, v1), v2);
    const Vec3 upper = glm::max(glm::max(v0, v1), v2);
    PrimRef ref;
    ref.lower = Float4{lower.x, lower.y, lower.z, std::bit_cast<float>(primitive)};
    ref.upper = Float4{upper.x, upper.y, upper.z, 0.0f};
    return ref;
}

void check_indices(std::span<const UVec3> triangles, std::size_t first, std::size_t last,
                   std::size_t vertex_count) {
    for (std::size_t i = first; i < last; ++i) {
        const uint32_t largest = glm::max(glm::max(triangles[i].x, triangles[i].y), triangles[i].z);
        if (largest < vertex_count) continue;
        throw Error(
            ErrorKind::bad_input,
            fmt::format("triangle {}: vertex index {} is out of range: there are {} vertices", i,
                        largest, vertex_count));
    }
}

/// What became of triangles [first, last).
struct Chunk {
    std::size_t kept = 0;
    uint64_t degenerate_count = 0, non_finite_count = 0;
};

/// Writes the refs of triangles [first, last) to `refs`, without gaps.
Chunk collect_chunk(std::span<const Vec3> positions, std::span<const UVec3> triangles,
                    std::size_t first, std::size_t last, PrimRef* refs) {
    check_indices(triangles, first, last, positions.size());
    Chunk chunk;
    for (std::size_t i = first; i < last; ++i) {
        const Vec3& v0 = positions[triangles[i].x];
        const Vec3& v1 = positions[triangles[i].y];
        const Vec3& v2 = positions[triangles[i].z];
        if (!is_usable(v0) || !is_usable(v1) || !is_usable(v2))
            ++chunk.non_finite_count;
        else if (is_degenerate(v0, v1, v2))
            ++chunk.degenerate_count;
        else
            refs[chunk.kept++] = make_ref(v0, v1, v2, uint32_t(i));
    }
    return chunk;
}

}  // namespace

bool is_usable(const Vec3& v) {
    return std::abs(v.x) <= kLargestCoordinate && std::abs(v.y) <= kLargestCoordinate &&
           std::abs(v.z) <= kLargestCoordinate;
}

bool is_degenerate(const Vec3& v0, const Vec3& v1, const Vec3& v2) {
    using Double3 = glm::dvec3;
    const Double3 a = Double3(v1) - Double3(v0);
    const Double3 b = Double3(v2) - Double3(v0);
    const Double3 p{a.y * b.z, a.z * b.x, a.x * b.y};
    const Double3 q{a.z * b.y, a.x * b.z, a.y * b.x};
    // Differences of floats are exact in double but for extreme ratios; what is left is the
    // rounding of the products.
    const Double3 noise = 4 * DBL_EPSILON * (glm::abs(p) + glm::abs(q));
    const Double3 normal = glm::abs(p - q);
    return normal.x <= noise.x && normal.y <= noise.y && normal.z <= noise.z;
}

PrimRefs collect_prim_refs(std::span<const Vec3> positions, std::span<const UVec3> triangles) {
    PrimRefs all;
    all.refs.resize(triangles.size());
    std::vector<Chunk> chunks((triangles.size() + kChunk - 1) / kChunk);
    parallel_ranges(chunks.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            chunks[c] = collect_chunk(positions, triangles, c * kChunk,
                                      std::min((c + 1) * kChunk, triangles.size()),
                                      all.refs.data() + c * kChunk);
    });

    // Close the gaps that dropped triangles left; most often there are none.
    std::size_t kept = 0;
    for (std::size_t c = 0; c < chunks.size(); ++c) {
        all.degenerate_count += chunks[c].degenerate_count;
        all.non_finite_count += chunks[c].non_finite_count;
        const auto first = all.refs.begin() + c * kChunk;
        if (kept != c * kChunk) std::copy(first, first + chunks[c].kept, all.refs.begin() + kept);
        kept += chunks[c].kept;
    }
    all.refs.resize(kept);
    return all;
}

}  // namespace wedge::bvh
