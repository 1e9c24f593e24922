#include <algorithm>
#include <array>
#include <chrono>
#include <memory>

#include "host/base/parallel.hpp"
#include "host/bvh/bvh.hpp"
#include "host/bvh/collapse.hpp"
#include "host/bvh/order.hpp"
#include "host/bvh/prim_refs.hpp"
#include "host/bvh/split.hpp"

namespace wedge::bvh {
namespace {

constexpr uint32_t kLeafTriangles = 4;
constexpr int kWidth = 8;
// From this level on ranges are halved by count, which leaves at most an eighth for the next level:
// 16 + log8(2^32 / 4) + 1 < WEDGE_MAX_DEPTH.
constexpr uint32_t kBalancedLevel = 16;
// Of the root's area: where the two sides of a node have less in common, cutting triangles is not
// worth the search (Stich et al. 2009, section 4.5).
constexpr float kLeastOverlap = 1e-5f;
constexpr double kRefsPerTriangle = 1.5;
// Subtrees up to this size are one task.
constexpr uint32_t kTaskTriangles = 1 << 13;

/// Refs of one block.
struct Leaf {
    uint32_t first = 0, count = 0;
};

/// A subtree with indices of its own. Children that are pieces themselves are in `kids`. Blocks are
/// made when they have their place: they are most of the tree's memory.
struct Piece {
    std::vector<shared::BvhNode> nodes;
    std::vector<Leaf> leaves;
    std::array<std::unique_ptr<Piece>, kWidth> kids;
    uint32_t depth = 0;
};

struct Input {
    Splitter splitter;
    std::span<PrimRef> refs;
};

shared::BvhNode unused_node() {
    shared::BvhNode node{};
    for (int row = 0; row < 6; ++row)
        std::fill_n(node.bounds[row], kWidth, row % 2 == 0 ? INFINITY : -INFINITY);
    return node;
}

void set_child_bounds(shared::BvhNode& node, int slot, const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
        node.bounds[2 * axis][slot] = box.lower[axis];
        node.bounds[2 * axis + 1][slot] = box.upper[axis];
    }
}

shared::TriangleBlock make_block(const Input& input, const Leaf& range) {
    shared::TriangleBlock block{};
    std::fill_n(block.primitive, kLeafTriangles, WEDGE_NO_PRIMITIVE);
    const auto& [positions, triangles, scale, least_overlap] = input.splitter;
    uint32_t lane = 0;
    for (const PrimRef& ref : input.refs.subspan(range.first, range.count)) {
        const uint32_t primitive = ref.primitive();
        // Parts of one triangle can meet again.
        if (std::count(block.primitive, block.primitive + lane, primitive)) continue;
        const UVec3 triangle = triangles[primitive];
        block.primitive[lane] = primitive;
        for (int axis = 0; axis < 3; ++axis) {
            block.v0[axis][lane] = positions[triangle.x][axis];
            block.v1[axis][lane] = positions[triangle.y][axis];
            block.v2[axis][lane] = positions[triangle.z][axis];
        }
        ++lane;
    }
    return block;
}

struct Children {
    std::array<Range, kWidth> ranges;
    int count = 0;
};

/// Opens the range with the largest box (Dammertz et al. 2008), or when balancing that with the
/// most triangles, until there are 8 or all are leaves.
Children divide(const Input& input, const Range& range, uint32_t level) {
    Children children;
    children.ranges[children.count++] = range;
    const bool balance = level >= kBalancedLevel;
    while (children.count < kWidth) {
        int widest = -1;
        float widest_size = -1;
        for (int i = 0; i < children.count; ++i) {
            const Range& child = children.ranges[i];
            const float size =
                balance ? float(child.count) : half_area(child.bounds, input.splitter.scale);
            if (child.count <= kLeafTriangles || size <= widest_size) continue;
            widest = i;
            widest_size = size;
        }
        if (widest < 0) break;
        const Range opened = children.ranges[widest];
        const RangePair pair = balance ? split_by_count(input.refs, opened)
                                       : split_by_area(input.splitter, input.refs, opened);
        children.ranges[widest] = pair.left;
        children.ranges[children.count++] = pair.right;
    }
    return children;
}

/// Appends the subtree of `range`, depth first, and returns the index of its node.
int32_t append_subtree(const Input& input, const Range& range, uint32_t level, Piece& piece) {
    const int32_t index = int32_t(piece.nodes.size());
    piece.nodes.push_back(unused_node());
    piece.depth = std::max(piece.depth, level + 1);
    const Children children = divide(input, range, level);
    for (int i = 0; i < children.count; ++i) {
        const Range& child = children.ranges[i];
        set_child_bounds(piece.nodes[index], i, child.bounds);
        if (child.count <= kLeafTriangles) {
            piece.nodes[index].child[i] = ~int32_t(piece.leaves.size());
            piece.leaves.push_back({child.first, child.count});
        } else {
            // The vector may move during the call: index it afterwards.
            const int32_t below = append_subtree(input, child, level + 1, piece);
            piece.nodes[index].child[i] = below;
        }
    }
    return index;
}

/// As append_subtree, of a tree that is cut already.
int32_t append_tree(const Input& input, const BinaryTree& tree, uint32_t from, uint32_t level,
                    Piece& piece) {
    const int32_t index = int32_t(piece.nodes.size());
    piece.nodes.push_back(unused_node());
    piece.depth = std::max(piece.depth, level + 1);
    std::array<uint32_t, kWidth> children;
    const int count = tree.children(from, children);
    for (int i = 0; i < count; ++i) {
        const Range& child = tree.range(children[i]);
        set_child_bounds(piece.nodes[index], i, child.bounds);
        if (tree.is_leaf(children[i])) {
            piece.nodes[index].child[i] = ~int32_t(piece.leaves.size());
            piece.leaves.push_back({child.first, child.count});
        } else {
            const int32_t below = append_tree(input, tree, children[i], level + 1, piece);
            piece.nodes[index].child[i] = below;
        }
    }
    return index;
}

std::unique_ptr<Piece> build_piece(const Input& input, const Range& range, uint32_t level) {
    auto piece = std::make_unique<Piece>();
    if (range.count <= kTaskTriangles) {
        piece->nodes.reserve(range.count / 15 + 1);
        piece->leaves.reserve(range.count / 3 + 1);
        const BinaryTree tree(input.splitter, input.refs, range);
        if (level + tree.depth() <= kBalancedLevel)
            append_tree(input, tree, 0, level, *piece);
        else  // rare, and the only way whose depth has a bound
            append_subtree(input, range, level, *piece);
        return piece;
    }
    piece->depth = level + 1;
    piece->nodes.push_back(unused_node());
    const Children children = divide(input, range, level);
    for (int i = 0; i < children.count; ++i) {
        set_child_bounds(piece->nodes[0], i, children.ranges[i].bounds);
        if (children.ranges[i].count > kLeafTriangles) continue;
        piece->nodes[0].child[i] = ~int32_t(piece->leaves.size());
        piece->leaves.push_back({children.ranges[i].first, children.ranges[i].count});
    }
    parallel_ranges(children.count, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (children.ranges[i].count > kLeafTriangles)
                piece->kids[i] = build_piece(input, children.ranges[i], level + 1);
    });
    return piece;
}

struct PlacedPiece {
    const Piece* piece;
    std::size_t first_node, first_block;
};

/// Where pieces go, depth first.
struct Places {
    std::vector<PlacedPiece> pieces;
    std::size_t node_count = 0, block_count = 0;
    uint32_t depth = 0;
};

/// Gives every piece its place, and links pieces to the pieces above them.
void place_pieces(Piece& piece, Places& places) {
    const std::size_t first_node = places.node_count;
    places.pieces.push_back({&piece, first_node, places.block_count});
    places.depth = std::max(places.depth, piece.depth);
    places.node_count += piece.nodes.size();
    places.block_count += piece.leaves.size();
    for (int i = 0; i < kWidth; ++i) {
        if (!piece.kids[i]) continue;
        // Relative to this piece, like all its other children.
        piece.nodes[0].child[i] = int32_t(places.node_count - first_node);
        place_pieces(*piece.kids[i], places);
    }
}

void copy_piece(const Input& input, const PlacedPiece& from, Bvh& bvh) {
    for (std::size_t i = 0; i < from.piece->leaves.size(); ++i)
        bvh.blocks[from.first_block + i] = make_block(input, from.piece->leaves[i]);
    for (std::size_t i = 0; i < from.piece->nodes.size(); ++i) {
        shared::BvhNode node = from.piece->nodes[i];
        for (int slot = 0; slot < kWidth; ++slot) {
            if (node.bounds[0][slot] > node.bounds[1][slot]) continue;  // unused: stays 0
            node.child[slot] +=
                node.child[slot] >= 0 ? int32_t(from.first_node) : -int32_t(from.first_block);
        }
        bvh.nodes[from.first_node + i] = node;
    }
}

/// Copies all pieces and orders the children of their nodes: in those that are subtrees at once, in
/// the nodes above them afterwards.
void copy_pieces(const Input& input, const Places& places, Bvh& bvh) {
    bvh.nodes.resize(places.node_count);
    bvh.blocks.resize(places.block_count);
    RawVector<Expectation> expected(places.node_count);
    const auto order = [&](const PlacedPiece& placed) {
        order_nodes(bvh, placed.first_node, placed.piece->nodes.size(), input.splitter.scale,
                    {expected.data(), expected.size()});
    };
    const auto has_kids = [](const PlacedPiece& placed) {
        return std::any_of(placed.piece->kids.begin(), placed.piece->kids.end(),
                           [](const auto& kid) { return kid != nullptr; });
    };
    parallel_ranges(places.pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            copy_piece(input, places.pieces[i], bvh);
            if (!has_kids(places.pieces[i])) order(places.pieces[i]);
        }
    });
    for (std::size_t i = places.pieces.size(); i-- > 0;)
        if (has_kids(places.pieces[i])) order(places.pieces[i]);
}

Bounds to_bounds(const Box& box) {
    return {Vec3(box.lower[0], box.lower[1], box.lower[2]),
            Vec3(box.upper[0], box.upper[1], box.upper[2])};
}

/// Refs that a tree of high quality may have.
uint32_t spare_capacity(uint32_t triangles) {
    constexpr uint64_t kMost = 0x7fffffff;  // blocks are numbered by int
    return uint32_t(std::max<uint64_t>(
        triangles, std::min(uint64_t(kMost), uint64_t(double(triangles) * kRefsPerTriangle))));
}

float inverse_extent(const Bounds& bounds) {
    const Vec3 extent = bounds.extent();
    const float largest = glm::max(glm::max(extent.x, extent.y), extent.z);
    const float inverse = 1 / largest;
    return inverse > 0 && std::isfinite(inverse) ? inverse : 1.0f;
}

}  // namespace

Bvh build(std::span<const Vec3> positions, std::span<const UVec3> triangles, BvhQuality quality) {
    const auto start = std::chrono::steady_clock::now();
    PrimRefs prims = collect_prim_refs(positions, triangles);
    Bvh bvh;
    bvh.degenerate_count = prims.degenerate_count;
    bvh.non_finite_count = prims.non_finite_count;
    bvh.triangle_count = triangles.size();
    if (prims.refs.empty()) {
        bvh.nodes.push_back(unused_node());
        bvh.depth = 1;
        return bvh;
    }

    Range all = whole_range(prims.refs);
    bvh.bounds = to_bounds(all.bounds);
    Splitter splitter{positions, triangles, inverse_extent(bvh.bounds)};
    if (quality == BvhQuality::high) {
        splitter.least_overlap = kLeastOverlap * half_area(all.bounds, splitter.scale);
        all.capacity = spare_capacity(all.count);
        prims.refs.resize(all.capacity);
    }
    const Input input{splitter, prims.refs};
    const std::unique_ptr<Piece> root = build_piece(input, all, 0);

    Places places;
    place_pieces(*root, places);
    bvh.depth = places.depth;
    copy_pieces(input, places, bvh);
    bvh.build_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return bvh;
}

}  // namespace wedge::bvh
