#include "host/bvh/split.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "host/base/parallel.hpp"

namespace wedge::bvh {
namespace {

constexpr int kMaxBins = 64;
constexpr uint32_t kParallelChunk = 1 << 15;

/// Most divisions are of few triangles; there, emptying and sweeping bins is the greater part.
int bin_count_for(uint32_t triangles) {
    return std::min(kMaxBins, 6 + int(triangles / 16));
}

struct Bins {
    int count = 0;  ///< used on each axis
    std::array<std::array<Float4, kMaxBins>, 3> lower, upper;
    std::array<std::array<uint32_t, kMaxBins>, 3> counts;

    explicit Bins(int bin_count) : count(bin_count) {
        const Box empty;
        for (int axis = 0; axis < 3; ++axis) {
            std::fill_n(lower[axis].begin(), count, empty.lower);
            std::fill_n(upper[axis].begin(), count, empty.upper);
            std::fill_n(counts[axis].begin(), count, 0);
        }
    }
    Box box(int axis, int bin) const { return {lower[axis][bin], upper[axis][bin]}; }
    void include(int axis, int bin, const Box& box, uint32_t triangles) {
        lower[axis][bin] = minimum(lower[axis][bin], box.lower);
        upper[axis][bin] = maximum(upper[axis][bin], box.upper);
        counts[axis][bin] += triangles;
    }
};

/// Maps a centroid to a bin number per axis. Monotone in each coordinate and the same wherever it
/// is called, so binning and partition agree.
struct BinMapping {
    Float4 origin, scale;

    BinMapping(const Box& centroids, int bin_count) : origin(centroids.lower) {
        for (int axis = 0; axis < 4; ++axis) {
            const float extent = centroids.upper[axis] - centroids.lower[axis];
            const float bins_per_unit = float(bin_count) * 0.9999f / extent;
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
            bins.include(axis, bin[axis], ref.box(), 1);
        }
    }
}

void merge_bins(const Bins& from, Bins& into) {
    for (int axis = 0; axis < 3; ++axis)
        for (int bin = 0; bin < from.count; ++bin)
            into.include(axis, bin, from.box(axis, bin), from.counts[axis][bin]);
}

/// Minima, maxima and counts do not depend on the order, so neither do the bins.
Bins bin_refs(std::span<const PrimRef> refs, const BinMapping& mapping, int bin_count) {
    Bins bins(bin_count);
    if (refs.size() < 2 * kParallelChunk) {
        fill_bins(refs, mapping, bins);
        return bins;
    }
    std::vector<Bins> parts((refs.size() + kParallelChunk - 1) / kParallelChunk, bins);
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
    std::array<float, kMaxBins> right_cost;
    Box box;
    uint32_t count = 0;
    for (int bin = bins.count - 1; bin > 0; --bin) {
        box.include(bins.box(axis, bin));
        count += bins.counts[axis][bin];
        right_cost[bin] = half_area(box, scale) * block_count(count);
    }
    const uint32_t total = count + bins.counts[axis][0];
    box = Box();
    count = 0;
    for (int bin = 1; bin < bins.count; ++bin) {
        box.include(bins.box(axis, bin - 1));
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
    const int bin_count = bin_count_for(range.count);
    const BinMapping mapping(range.centroids, bin_count);
    const Bins bins = bin_refs(refs.subspan(range.first, range.count), mapping, bin_count);
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
