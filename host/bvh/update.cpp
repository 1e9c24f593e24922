#include "host/bvh/update.hpp"

#include <fmt/format.h>

#include <atomic>

#include "host/base/parallel.hpp"
#include "host/bvh/box.hpp"
#include "host/bvh/prim_refs.hpp"
#include "wedge/error.hpp"

namespace wedge::bvh {
namespace {

constexpr int kWidth = 8;
constexpr std::size_t kGrain = 2048;

Box child_box(const shared::BvhNode& node, int slot) {
    return {Float4{node.bounds[0][slot], node.bounds[2][slot], node.bounds[4][slot], 0},
            Float4{node.bounds[1][slot], node.bounds[3][slot], node.bounds[5][slot], 0}};
}

void set_child_box(shared::BvhNode& node, int slot, const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
        node.bounds[2 * axis][slot] = box.lower[axis];
        node.bounds[2 * axis + 1][slot] = box.upper[axis];
    }
}

void check_triangles(std::span<const Vec3> positions, std::span<const UVec3> triangles) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const uint32_t largest = glm::max(glm::max(triangles[i].x, triangles[i].y), triangles[i].z);
        if (largest >= positions.size())
            throw Error(ErrorKind::bad_input,
                        fmt::format("triangle {}: vertex index {} is out of range: there are {} "
                                    "vertices",
                                    i, largest, positions.size()));
    }
}

/// Sets the block's triangles to where they are now. False if a coordinate cannot be used.
bool refit_block(shared::TriangleBlock& block, std::span<const Vec3> positions,
                 std::span<const UVec3> triangles, Box& box) {
    box = Box();
    for (int lane = 0; lane < 4; ++lane) {
        const uint32_t primitive = block.primitive[lane];
        if (primitive == WEDGE_NO_PRIMITIVE) continue;
        const UVec3 t = triangles[primitive];
        for (int corner = 0; corner < 3; ++corner) {
            const Vec3& p = positions[t[corner]];
            if (!is_usable(p)) return false;
            auto& rows = corner == 0 ? block.v0 : corner == 1 ? block.v1 : block.v2;
            for (int axis = 0; axis < 3; ++axis) rows[axis][lane] = p[axis];
            box.include(Float4{p.x, p.y, p.z, 0});
        }
    }
    return true;
}

/// Every child's box from what is below it. A child stands behind its parent, so that one pass from
/// the last node to the first meets children first.
Box refit_nodes(Bvh& tree, const RawVector<Box>& block_boxes) {
    RawVector<Box> node_boxes(tree.nodes.size());
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        shared::BvhNode& node = tree.nodes[i];
        Box all;
        for (int slot = 0; slot < kWidth; ++slot) {
            if (!is_used(node, slot)) continue;
            const int32_t child = node.child[slot];
            const Box box = child >= 0 ? node_boxes[child] : block_boxes[~child];
            set_child_box(node, slot, box);
            all.include(box);
        }
        node_boxes[i] = all;
    }
    return node_boxes[0];
}

bool refit(Bvh& tree, std::span<const Vec3> positions, std::span<const UVec3> triangles) {
    RawVector<Box> block_boxes(tree.blocks.size());
    std::atomic<bool> usable = true;
    parallel_ranges(tree.blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (!refit_block(tree.blocks[i], positions, triangles, block_boxes[i])) usable = false;
    });
    if (!usable) return false;
    const Box all = refit_nodes(tree, block_boxes);
    if (tree.blocks.empty()) return true;
    for (int axis = 0; axis < 3; ++axis) {
        tree.bounds.lower[axis] = all.lower[axis];
        tree.bounds.upper[axis] = all.upper[axis];
    }
    return true;
}

/// Whether a triangle that the tree does not hold could be hit now.
bool misses_triangles(const Bvh& tree, std::span<const Vec3> positions,
                      std::span<const UVec3> triangles) {
    if (tree.degenerate_count + tree.non_finite_count == 0) return false;
    std::vector<char> held(triangles.size());
    for (const shared::TriangleBlock& block : tree.blocks)
        for (const uint32_t primitive : block.primitive)
            if (primitive != WEDGE_NO_PRIMITIVE) held[primitive] = 1;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (held[i]) continue;
        const Vec3& v0 = positions[triangles[i].x];
        const Vec3& v1 = positions[triangles[i].y];
        const Vec3& v2 = positions[triangles[i].z];
        if (is_usable(v0) && is_usable(v1) && is_usable(v2) && !is_degenerate(v0, v1, v2))
            return true;
    }
    return false;
}

}  // namespace

double expected_visits(const Bvh& tree) {
    // In double precision, and relative to the largest extent, so that no square leaves the range.
    const Vec3 extent = tree.bounds.empty() ? Vec3(1) : tree.bounds.extent();
    const double largest = glm::max(glm::max(extent.x, extent.y), extent.z);
    const auto area = [&](const glm::dvec3& e) {
        const glm::dvec3 s = largest > 0 ? e / largest : e;
        return s.x * s.y + s.y * s.z + s.z * s.x;
    };
    double sum = 0;
    for (const shared::BvhNode& node : tree.nodes)
        for (int slot = 0; slot < kWidth; ++slot) {
            if (!is_used(node, slot)) continue;
            const Float4 e = child_box(node, slot).upper - child_box(node, slot).lower;
            sum += area({e[0], e[1], e[2]});
        }
    const double root = area(glm::dvec3(extent));
    return root > 0 ? 1 + sum / root : 1;
}

UpdateResult update_vertices(Bvh& tree, std::span<const Vec3> positions,
                             std::span<const UVec3> triangles, const UpdateOptions& options) {
    if (triangles.size() != tree.triangle_count)
        throw Error(ErrorKind::bad_input,
                    fmt::format("{} triangles for a tree of {}: only positions may change; build "
                                "a new tree",
                                triangles.size(), tree.triangle_count));
    check_triangles(positions, triangles);
    UpdateResult result;
    if (tree.built_visits == 0) tree.built_visits = expected_visits(tree);
    const bool refitted = options.rebuild_above > 0 &&
                          !misses_triangles(tree, positions, triangles) &&
                          refit(tree, positions, triangles);
    if (refitted) result.cost_ratio = expected_visits(tree) / tree.built_visits;
    if (!refitted || !(result.cost_ratio <= options.rebuild_above)) {
        tree = build(positions, triangles, options.quality);
        result.rebuilt = true;
    }
    return result;
}

}  // namespace wedge::bvh
