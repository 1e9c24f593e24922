#include "host/bvh/spatial.hpp"

#include <algorithm>
#include <array>
#include <cfloat>
#include <vector>

#include "host/base/parallel.hpp"

namespace wedge::bvh {
namespace {

constexpr int kMaxBins = 16;
constexpr uint32_t kChunk = 1 << 14;
// Of a point between two vertices, relative to their larger coordinate: the sum, the share and the
// product each round once.
constexpr float kCutError = 4 * FLT_EPSILON;

int bin_count_for(uint32_t triangles) {
    return triangles < 64 ? 8 : kMaxBins;
}

struct SpatialBins {
    std::array<std::array<Box, kMaxBins>, 3> boxes;
    std::array<std::array<uint32_t, kMaxBins>, 3> entries{}, exits{};
};

/// Planes between bins, equally spaced in a box.
struct Planes {
    Float4 origin, width, per_unit;
    int count;

    Planes(const Box& box, int bin_count) : origin(box.lower), count(bin_count) {
        const Float4 extent = Float4(Int4(box.upper - box.lower) & Int4{-1, -1, -1, 0});
        width = extent * splat(1.0f / float(bin_count));
        for (int axis = 0; axis < 4; ++axis) {
            const float inverse = float(bin_count) / extent[axis];
            const bool usable = axis < 3 && extent[axis] > 0 && inverse <= FLT_MAX;
            per_unit[axis] = usable ? inverse : 0;
        }
    }
    bool usable(int axis) const { return per_unit[axis] > 0; }
    float position(int axis, int bin) const { return origin[axis] + float(bin) * width[axis]; }
    /// Only where costs are estimated, so its rounding does not matter.
    Int4 bins_of(Float4 p) const {
        const Int4 xyz{-1, -1, -1, 0};
        const Float4 at = Float4(Int4(p - origin) & xyz) * per_unit;
        const Float4 within = maximum(splat(0), minimum(at, splat(float(count - 1))));
        return __builtin_convertvector(within, Int4);
    }
};

/// What planes across an axis cut out of a triangle. Unlike cut_ref not safe from rounding: it is
/// for estimates, and fast.
class CrossSections {
  public:
    CrossSections(const std::array<Float4, 3>& corners, int axis) : axis_(axis), c_(corners) {
        const auto swap_if_above = [&](int i, int j) {
            if (c_[i][axis] > c_[j][axis]) std::swap(c_[i], c_[j]);
        };
        swap_if_above(0, 1), swap_if_above(1, 2), swap_if_above(0, 1);
        whole_ = slope(c_[0], c_[2]);
        low_ = slope(c_[0], c_[1]);
        high_ = slope(c_[1], c_[2]);
    }
    /// Box of the triangle's points in the plane, or of its nearest corner.
    Box at(float position) const {
        const float p = std::clamp(position, float(c_[0][axis_]), float(c_[2][axis_]));
        const Float4 along = c_[0] + splat(p - c_[0][axis_]) * whole_;
        const Float4 around = p <= c_[1][axis_] ? c_[0] + splat(p - c_[0][axis_]) * low_
                                                : c_[1] + splat(p - c_[1][axis_]) * high_;
        return {minimum(along, around), maximum(along, around)};
    }
    Float4 middle() const { return c_[1]; }

  private:
    Float4 slope(Float4 from, Float4 to) const {
        const float extent = to[axis_] - from[axis_];
        return extent > 0 ? (to - from) * splat(1 / extent) : splat(0);
    }

    int axis_;
    std::array<Float4, 3> c_;  ///< sorted along the axis
    Float4 whole_, low_, high_;
};

std::array<Float4, 3> corners_of(const Splitter& splitter, const PrimRef& ref) {
    const UVec3 triangle = splitter.triangles[ref.primitive()];
    std::array<Float4, 3> corners;
    for (int i = 0; i < 3; ++i) {
        const Vec3& p = splitter.positions[triangle[i]];
        corners[i] = Float4{p.x, p.y, p.z, 0};
    }
    return corners;
}

/// Adds to each bin the box of the ref's part in it.
void add_parts(const std::array<Float4, 3>& corners, const Planes& planes, const PrimRef& ref,
               int axis, int first, int last, SpatialBins& bins) {
    const CrossSections sections(corners, axis);
    const float middle = sections.middle()[axis];
    float from = ref.lower[axis];
    Box below = sections.at(from);
    for (int bin = first; bin <= last; ++bin) {
        const float to = bin == last ? float(ref.upper[axis]) : planes.position(axis, bin + 1);
        const Box above = sections.at(to);
        Box part = below;
        part.include(above);
        if (middle >= from && middle <= to) part.include(sections.middle());
        part.lower = maximum(part.lower, ref.lower);
        part.upper = minimum(part.upper, ref.upper);
        bins.boxes[axis][bin].include(part);
        from = to;
        below = above;
    }
}

void add_ref(const Splitter& splitter, const Planes& planes, const PrimRef& ref,
             SpatialBins& bins) {
    const Int4 first = planes.bins_of(ref.lower), last = planes.bins_of(ref.upper);
    const bool is_cut = first[0] < last[0] || first[1] < last[1] || first[2] < last[2];
    std::array<Float4, 3> corners;
    if (is_cut) corners = corners_of(splitter, ref);
    for (int axis = 0; axis < 3; ++axis) {
        if (!planes.usable(axis)) continue;
        ++bins.entries[axis][first[axis]];
        ++bins.exits[axis][last[axis]];
        if (first[axis] == last[axis])
            bins.boxes[axis][first[axis]].include(ref.box());
        else
            add_parts(corners, planes, ref, axis, first[axis], last[axis], bins);
    }
}

void merge(const SpatialBins& from, SpatialBins& into) {
    for (int axis = 0; axis < 3; ++axis)
        for (int bin = 0; bin < kMaxBins; ++bin) {
            into.boxes[axis][bin].include(from.boxes[axis][bin]);
            into.entries[axis][bin] += from.entries[axis][bin];
            into.exits[axis][bin] += from.exits[axis][bin];
        }
}

SpatialBins fill_bins(const Splitter& splitter, const Planes& planes,
                      std::span<const PrimRef> refs) {
    SpatialBins bins;
    if (refs.size() < 2 * kChunk) {
        for (const PrimRef& ref : refs) add_ref(splitter, planes, ref, bins);
        return bins;
    }
    std::vector<SpatialBins> parts((refs.size() + kChunk - 1) / kChunk);
    parallel_ranges(parts.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::size_t first = i * kChunk;
            const std::size_t last = std::min<std::size_t>(first + kChunk, refs.size());
            for (const PrimRef& ref : refs.subspan(first, last - first))
                add_ref(splitter, planes, ref, parts[i]);
        }
    });
    for (const SpatialBins& part : parts) merge(part, bins);
    return bins;
}

void sweep_axis(const SpatialBins& bins, const Planes& planes, int axis, float scale,
                SpatialPlane& best) {
    std::array<float, kMaxBins> right_cost;
    std::array<uint32_t, kMaxBins> right_count;
    Box box;
    uint32_t count = 0;
    for (int bin = planes.count - 1; bin > 0; --bin) {
        box.include(bins.boxes[axis][bin]);
        count += bins.exits[axis][bin];
        right_count[bin] = count;
        right_cost[bin] = half_area(box, scale) * block_count(count);
    }
    box = Box();
    count = 0;
    for (int bin = 1; bin < planes.count; ++bin) {
        box.include(bins.boxes[axis][bin - 1]);
        count += bins.entries[axis][bin - 1];
        if (count == 0 || right_count[bin] == 0) continue;
        const float cost = half_area(box, scale) * block_count(count) + right_cost[bin];
        if (cost < best.cost) best = {axis, planes.position(axis, bin), cost};
    }
}

/// Refs on the two sides, in the making. Boxes and counts are those expected in the end.
struct Sides {
    std::vector<PrimRef> left, right;
    Box left_box, right_box;
    float left_count = 0, right_count = 0;
};

Box joined(Box box, const PrimRef& ref) {
    box.include(ref.box());
    return box;
}

/// Cuts the ref, or leaves it whole on one side where that is cheaper (Stich et al., section 4.4)
/// or there is no room.
void place_across(const PrimRef& ref, const CutRef& cut, float scale, uint32_t& room,
                  Sides& sides) {
    const float left_area = half_area(sides.left_box, scale);
    const float right_area = half_area(sides.right_box, scale);
    const Box wide_left = joined(sides.left_box, ref), wide_right = joined(sides.right_box, ref);
    const float both = left_area * sides.left_count + right_area * sides.right_count;
    const float whole_left =
        half_area(wide_left, scale) * sides.left_count + right_area * (sides.right_count - 1);
    const float whole_right =
        left_area * (sides.left_count - 1) + half_area(wide_right, scale) * sides.right_count;
    if (room > 0 && both <= std::min(whole_left, whole_right)) {
        --room;
        sides.left.push_back(cut.left);
        sides.right.push_back(cut.right);
    } else if (whole_left <= whole_right) {
        sides.left.push_back(ref);
        sides.left_box = wide_left;
        --sides.right_count;
    } else {
        sides.right.push_back(ref);
        sides.right_box = wide_right;
        --sides.left_count;
    }
}

Range store_side(const std::vector<PrimRef>& side, uint32_t first, uint32_t capacity,
                 std::span<PrimRef> refs) {
    std::copy(side.begin(), side.end(), refs.begin() + first);
    Range range = whole_range(refs.subspan(first, side.size()));
    range.first = first;
    range.capacity = capacity;
    return range;
}

}  // namespace

CutRef cut_ref(const Splitter& splitter, const PrimRef& ref, int axis, float position) {
    const std::array<Float4, 3> corners = corners_of(splitter, ref);
    Box left, right;
    for (int i = 0; i < 3; ++i) {
        const Float4 a = corners[i], b = corners[(i + 1) % 3];
        const float from = a[axis], to = b[axis];
        if (from <= position) left.include(a);
        if (from >= position) right.include(a);
        if ((from < position && to > position) || (from > position && to < position)) {
            const Float4 share = splat((position - from) / (to - from));
            const Float4 point = a + share * (b - a);
            const Float4 error = splat(kCutError) * maximum(maximum(a, -a), maximum(b, -b));
            left.include(point - error), left.include(point + error);
            right.include(point - error), right.include(point + error);
        }
    }
    CutRef cut{ref, ref};
    cut.left.lower = maximum(left.lower, ref.lower);
    cut.left.upper = minimum(left.upper, ref.upper);
    cut.right.lower = maximum(right.lower, ref.lower);
    cut.right.upper = minimum(right.upper, ref.upper);
    cut.left.upper[axis] = std::min(position, float(ref.upper[axis]));
    cut.right.lower[axis] = std::max(position, float(ref.lower[axis]));
    // Where rounding leaves nothing of a part, it is a point within the ref.
    for (PrimRef* part : {&cut.left, &cut.right}) {
        part->lower = minimum(part->lower, ref.upper);
        part->upper = maximum(part->upper, ref.lower);
        part->upper = maximum(part->upper, part->lower);
        part->lower[3] = ref.lower[3];
        part->upper[3] = 0;
    }
    return cut;
}

SpatialPlane find_spatial_plane(const Splitter& splitter, std::span<const PrimRef> refs,
                                const Range& range) {
    const Planes planes(range.bounds, bin_count_for(range.count));
    const SpatialBins bins = fill_bins(splitter, planes, refs.subspan(range.first, range.count));
    SpatialPlane best;
    for (int axis = 0; axis < 3; ++axis)
        if (planes.usable(axis)) sweep_axis(bins, planes, axis, splitter.scale, best);
    return best;
}

std::optional<RangePair> split_by_space(const Splitter& splitter, std::span<PrimRef> refs,
                                        const Range& range, const SpatialPlane& plane) {
    Sides sides;
    std::vector<PrimRef> across;
    std::vector<CutRef> cuts;
    for (const PrimRef& ref : refs.subspan(range.first, range.count)) {
        if (ref.upper[plane.axis] <= plane.position) {
            sides.left.push_back(ref);
            sides.left_box.include(ref.box());
        } else if (ref.lower[plane.axis] >= plane.position) {
            sides.right.push_back(ref);
            sides.right_box.include(ref.box());
        } else {
            across.push_back(ref);
            cuts.push_back(cut_ref(splitter, ref, plane.axis, plane.position));
            sides.left_box.include(cuts.back().left.box());
            sides.right_box.include(cuts.back().right.box());
        }
    }
    sides.left_count = float(sides.left.size() + across.size());
    sides.right_count = float(sides.right.size() + across.size());
    uint32_t room = range.capacity - range.count;
    for (std::size_t i = 0; i < across.size(); ++i)
        place_across(across[i], cuts[i], splitter.scale, room, sides);
    if (sides.left.empty() || sides.right.empty()) return std::nullopt;

    const auto left_count = uint32_t(sides.left.size()), right_count = uint32_t(sides.right.size());
    const uint32_t left_room =
        room_of_left(range.capacity - left_count - right_count, left_count, right_count);
    const uint32_t middle = range.first + left_count + left_room;
    RangePair pair;
    pair.left = store_side(sides.left, range.first, left_count + left_room, refs);
    pair.right = store_side(sides.right, middle, range.first + range.capacity - middle, refs);
    return pair;
}

}  // namespace wedge::bvh
