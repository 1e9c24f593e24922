#include "host/bvh/split.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "host/base/parallel.hpp"
#include "host/bvh/spatial.hpp"

namespace wedge::bvh {
namespace {

constexpr int kMaxBins = 64;
constexpr uint32_t kParallelChunk = 1 << 15;

/// Most divisions are of few triangles; there, emptying and sweeping bins is the greater part.
int bin_count_for(uint32_t triangles) {
    return std::min(kMaxBins, 16 + int(triangles / 16));
}

/// A box that is not set by default: most bins are never used.
struct BinBox {
    Float4 lower, upper;
};

struct Bins {
    int count = 0;  ///< used on each axis
    std::array<std::array<BinBox, kMaxBins>, 3> boxes;
    std::array<std::array<uint32_t, kMaxBins>, 3> counts;

    explicit Bins(int bin_count) : count(bin_count) {
        const Box empty;
        for (int axis = 0; axis < 3; ++axis) {
            std::fill_n(boxes[axis].begin(), count, BinBox{empty.lower, empty.upper});
            std::fill_n(counts[axis].begin(), count, 0);
        }
    }
    Box box(int axis, int bin) const { return {boxes[axis][bin].lower, boxes[axis][bin].upper}; }
    void include(int axis, int bin, const Box& box, uint32_t triangles) {
        BinBox& at = boxes[axis][bin];
        at.lower = minimum(at.lower, box.lower);
        at.upper = maximum(at.upper, box.upper);
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

struct Division {
    BinMapping mapping;
    Plane plane;
    bool is_left(Float4 centroid) const { return mapping(centroid)[plane.axis] < plane.bin; }
};

/// Moves the refs of the left side to the front.
RangePair partition_alone(std::span<PrimRef> refs, const Division& division) {
    RangePair pair;
    PrimRef* left = refs.data();
    PrimRef* right = left + refs.size();
    while (left < right) {
        const Float4 centroid = left->centroid();
        if (division.is_left(centroid)) {
            include_ref(*left, centroid, pair.left);
            ++left;
        } else {
            include_ref(*left, centroid, pair.right);
            std::swap(*left, *--right);
        }
    }
    return pair;
}

/// Refs on the wrong side of the border, one chunk after the other.
struct Misplaced {
    std::vector<std::size_t> firsts, ends;  ///< of segments; ends counted over all of them

    void add(std::size_t first, std::size_t last) {
        if (first >= last) return;
        firsts.push_back(first);
        ends.push_back((ends.empty() ? 0 : ends.back()) + last - first);
    }
    std::size_t count() const { return ends.empty() ? 0 : ends.back(); }
    /// Place of the k-th.
    std::size_t place(std::size_t k) const {
        const std::size_t i = std::upper_bound(ends.begin(), ends.end(), k) - ends.begin();
        return firsts[i] + k - (i == 0 ? 0 : ends[i - 1]);
    }
};

void include_range(const Range& from, Range& into) {
    into.count += from.count;
    into.bounds.include(from.bounds);
    into.centroids.include(from.centroids);
}

/// As partition_alone, in chunks of fixed size on all cores; what then is on the wrong side of the
/// border changes places.
RangePair partition_chunks(std::span<PrimRef> refs, const Division& division) {
    const std::size_t chunk_count = (refs.size() + kParallelChunk - 1) / kParallelChunk;
    std::vector<RangePair> parts(chunk_count);
    const auto first_of = [](std::size_t chunk) { return chunk * kParallelChunk; };
    const auto last_of = [&](std::size_t chunk) {
        return std::min<std::size_t>(first_of(chunk) + kParallelChunk, refs.size());
    };
    parallel_ranges(chunk_count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            parts[i] =
                partition_alone(refs.subspan(first_of(i), last_of(i) - first_of(i)), division);
    });

    RangePair pair;
    for (const RangePair& part : parts) {
        include_range(part.left, pair.left);
        include_range(part.right, pair.right);
    }
    const std::size_t border = pair.left.count;
    Misplaced rights, lefts;
    for (std::size_t i = 0; i < chunk_count; ++i) {
        const std::size_t middle = first_of(i) + parts[i].left.count;
        lefts.add(std::max(first_of(i), border), middle);
        rights.add(middle, std::min(last_of(i), border));
    }
    parallel_ranges(rights.count(), kParallelChunk, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            std::swap(refs[rights.place(k)], refs[lefts.place(k)]);
    });
    return pair;
}

RangePair partition_at(std::span<PrimRef> refs, const Range& range, const Division& division) {
    const std::span<PrimRef> all = refs.subspan(range.first, range.count);
    RangePair pair = range.count < 2 * kParallelChunk ? partition_alone(all, division)
                                                      : partition_chunks(all, division);
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

/// Half the area of what the boxes on the two sides of the plane have in common; of everything
/// where no plane divides.
float overlap_at(const Bins& bins, const Plane& plane, float scale) {
    if (plane.axis < 0) return std::numeric_limits<float>::infinity();
    Box left, right;
    for (int bin = 0; bin < bins.count; ++bin)
        (bin < plane.bin ? left : right).include(bins.box(plane.axis, bin));
    const Box common{maximum(left.lower, right.lower), minimum(left.upper, right.upper)};
    for (int axis = 0; axis < 3; ++axis)
        if (common.lower[axis] > common.upper[axis]) return 0;
    return half_area(common, scale);
}

/// Gives each side its share of the range's spare places: the right one moves by that of the left.
RangePair share_room(std::span<PrimRef> refs, const Range& range, RangePair pair) {
    const uint32_t room = range.capacity - range.count;
    const uint32_t shift = room_of_left(room, pair.left.count, pair.right.count);
    // Any order will do: the first go behind the last.
    const uint32_t moved = std::min(shift, pair.right.count);
    const auto first = refs.begin() + pair.right.first;
    std::copy(first, first + moved, first + shift + pair.right.count - moved);
    pair.left.capacity = pair.left.count + shift;
    pair.right.first += shift;
    pair.right.capacity = pair.right.count + room - shift;
    return pair;
}

}  // namespace

Range whole_range(std::span<const PrimRef> refs) {
    std::vector<Range> parts((refs.size() + kParallelChunk - 1) / kParallelChunk);
    parallel_ranges(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t first = i * kParallelChunk;
            const std::size_t count = std::min<std::size_t>(kParallelChunk, refs.size() - first);
            for (const PrimRef& ref : refs.subspan(first, count))
                include_ref(ref, ref.centroid(), parts[i]);
        }
    });
    Range range;
    for (const Range& part : parts) include_range(part, range);
    range.capacity = range.count;
    return range;
}

RangePair split_by_area(const Splitter& splitter, std::span<PrimRef> refs, const Range& range) {
    const int bin_count = bin_count_for(range.count);
    const BinMapping mapping(range.centroids, bin_count);
    const Bins bins = bin_refs(refs.subspan(range.first, range.count), mapping, bin_count);
    Plane plane;
    for (int axis = 0; axis < 3; ++axis) sweep_axis(bins, axis, splitter.scale, plane);
    if (splitter.least_overlap >= 0 && range.capacity > range.count &&
        overlap_at(bins, plane, splitter.scale) > splitter.least_overlap) {
        const SpatialPlane space = find_spatial_plane(splitter, refs, range);
        if (space.cost < plane.cost)
            if (const auto pair = split_by_space(splitter, refs, range, space)) return *pair;
    }
    if (plane.axis < 0) return share_room(refs, range, halve_by_index(refs, range));
    return share_room(refs, range, partition_at(refs, range, {mapping, plane}));
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
    return share_room(refs, range, halve_by_index(refs, range));
}

}  // namespace wedge::bvh
