#include "host/bvh/split.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "host/base/parallel.hpp"

namespace wedge::bvh {
namespace {

constexpr int kBinCount = 16;
constexpr uint32_t kParallelChunk = 1 << 15;

struct Bins {
    std::array<std::array<Box, kBinCount>, 3> boxes;
    std::array<std::array<uint32_t, kBinCount>, 3> counts{};
};

/// Maps a centroid to a bin number per axis. Monotone in each coordinate and the same wherever it
/// is called, so binning and partition agree.
struct BinMapping {
    Float4 origin, scale;

    explicit BinMapping(const Box& centroids) : origin(centroids.lower) {
        for (int axis = 0; axis < 4; ++axis) {
            const float extent = centroids.upper[axis] - centroids.lower[axis];
            const float bins_per_unit = float(kBinCount) * 0.9999f / extent;
            // An axis without extent, or one so short or long that the scale is not finite, has one
            // bin.
            const bool usable = axis < 3 && extent > 0 && bins_per_unit > 0 &&
                                bins_per_unit <= std::numeric_limits<float>::max();
            scale[axis] = usable ? bins_per_unit : 0.0f;
        }
    }
    Int4 operator()(Float4 centroid) const {
        return __builtin_convertvector((centroid - origin) * scale, Int4);
    }
};

void fill_bins(std::span<const PrimRef> refs, const BinMapping& mapping, Bins& bins) {
    for (const PrimRef& ref : refs) {
        const Int4 bin = mapping(ref.centroid());
        for (int axis = 0; axis < 3; ++axis) {
            bins.boxes[axis][bin[axis]].include(ref.box());
            ++bins.counts[axis][bin[axis]];
        }
    }
}

void merge_bins(const Bins& from, Bins& into) {
    for (int axis = 0; axis < 3; ++axis)
        for (int bin = 0; bin < kBinCount; ++bin) {
            into.boxes[axis][bin].include(from.boxes[axis][bin]);
            into.counts[axis][bin] += from.counts[axis][bin];
        }
}

/// Minima, maxima and counts do not depend on the order, so neither do the bins.
Bins bin_refs(std::span<const PrimRef> refs, const BinMapping& mapping) {
    Bins bins;
    if (refs.size() < 2 * kParallelChunk) {
        fill_bins(refs, mapping, bins);
        return bins;
    }
    std::vector<Bins> parts((refs.size() + kParallelChunk - 1) / kParallelChunk);
    parallel_ranges(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t first = i * kParallelChunk;
            const std::size_t count = std::min<std::size_t>(kParallelChunk, refs.size() - first);
            fill_bins(refs.subspan(first, count), mapping, parts[i]);
        }
    });
    for (const Bins& part : parts) merge_bins(part, bins);
    return bins;
}

float block_count(uint32_t triangles) {
    return float((triangles + 3) / 4);
}

struct Plane {
    int axis = -1;  ///< -1: no division leaves triangles on both sides
    int bin = 0;    ///< the first bin on the right
    float cost = std::numeric_limits<float>::infinity();
};

/// Keeps the better of `best` and the best plane of one axis.
void sweep_axis(const Bins& bins, int axis, float scale, Plane& best) {
    std::array<float, kBinCount> right_cost{};
    Box box;
    uint32_t count = 0;
    for (int bin = kBinCount - 1; bin > 0; --bin) {
        box.include(bins.boxes[axis][bin]);
        count += bins.counts[axis][bin];
        right_cost[bin] = half_area(box, scale) * block_count(count);
    }
    const uint32_t total = count + bins.counts[axis][0];
    box = Box();
    count = 0;
    for (int bin = 1; bin < kBinCount; ++bin) {
        box.include(bins.boxes[axis][bin - 1]);
        count += bins.counts[axis][bin - 1];
        if (count == 0 || count == total) continue;
        const float cost = half_area(box, scale) * block_count(count) + right_cost[bin];
        if (cost < best.cost) best = {axis, bin, cost};
    }
}

void include_ref(const PrimRef& ref, Float4 centroid, Range& range) {
    range.bounds.include(ref.box());
    range.centroids.include(centroid);
    ++range.count;
}

RangePair partition_at(std::span<PrimRef> refs, const Range& range, const BinMapping& mapping,
                       const Plane& plane) {
    RangePair pair;
    PrimRef* left = refs.data() + range.first;
    PrimRef* right = left + range.count;
    while (left < right) {
        const Float4 centroid = left->centroid();
        if (mapping(centroid)[plane.axis] < plane.bin) {
            include_ref(*left, centroid, pair.left);
            ++left;
        } else {
            include_ref(*left, centroid, pair.right);
            std::swap(*left, *--right);
        }
    }
    pair.left.first = range.first;
    pair.right.first = range.first + pair.left.count;
    return pair;
}

RangePair halve_by_index(std::span<const PrimRef> refs, const Range& range) {
    RangePair pair;
    const uint32_t half = range.count / 2;
    for (uint32_t i = 0; i < range.count; ++i) {
        const PrimRef& ref = refs[range.first + i];
        include_ref(ref, ref.centroid(), i < half ? pair.left : pair.right);
    }
    pair.left.first = range.first;
    pair.right.first = range.first + half;
    return pair;
}

}  // namespace

Range whole_range(std::span<const PrimRef> refs) {
    Range range;
    for (const PrimRef& ref : refs) include_ref(ref, ref.centroid(), range);
    return range;
}

RangePair split_by_area(std::span<PrimRef> refs, const Range& range, float scale) {
    const BinMapping mapping(range.centroids);
    const Bins bins = bin_refs(refs.subspan(range.first, range.count), mapping);
    Plane plane;
    for (int axis = 0; axis < 3; ++axis) sweep_axis(bins, axis, scale, plane);
    if (plane.axis < 0) return halve_by_index(refs, range);
    return partition_at(refs, range, mapping, plane);
}

RangePair split_by_count(std::span<PrimRef> refs, const Range& range) {
    int axis = 0;
    const Float4 extent = range.centroids.upper - range.centroids.lower;
    for (int i = 1; i < 3; ++i)
        if (extent[i] > extent[axis]) axis = i;
    const auto first = refs.begin() + range.first;
    // The index settles ties, so that the order does not depend on the library's algorithm.
    std::nth_element(first, first + range.count / 2, first + range.count,
                     [axis](const PrimRef& a, const PrimRef& b) {
                         const float ca = a.centroid()[axis], cb = b.centroid()[axis];
                         return ca != cb ? ca < cb : a.primitive() < b.primitive();
                     });
    return halve_by_index(refs, range);
}

}  // namespace wedge::bvh
