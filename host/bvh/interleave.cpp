#include "host/bvh/interleave.hpp"

#include <cstring>

#include "host/base/parallel.hpp"

namespace wedge::bvh {
namespace {

constexpr int kSlots = 8;
constexpr uint64_t kNodeRows = sizeof(shared::BvhNode) / sizeof(shared::TreeRow);
constexpr uint64_t kBlockRows = sizeof(shared::TriangleBlock) / sizeof(shared::TreeRow);
constexpr std::size_t kGrain = 1024;

static_assert(kNodeRows * sizeof(shared::TreeRow) == sizeof(shared::BvhNode));
static_assert(kBlockRows * sizeof(shared::TreeRow) == sizeof(shared::TriangleBlock));
static_assert(kLargestFamily_rows == kNodeRows + kSlots * kBlockRows);

/// Unused slots hold 0, the root, which is nobody's child.
uint64_t family_rows(const shared::BvhNode& node) {
    uint64_t rows = kNodeRows;
    for (const int32_t child : node.child) rows += child < 0 ? kBlockRows : 0;
    return rows;
}

/// The first row of each node, and in the end how many there are.
RawVector<uint32_t> place_nodes(const Bvh& tree, uint64_t chunk_rows) {
    RawVector<uint32_t> first(tree.nodes.size() + 1);
    parallel_ranges(tree.nodes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) first[i] = uint32_t(family_rows(tree.nodes[i]));
    });
    uint64_t next = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const uint64_t rows = first[i];
        if (chunk_rows != 0 && next / chunk_rows != (next + rows - 1) / chunk_rows)
            next = (next / chunk_rows + 1) * chunk_rows;
        first[i] = uint32_t(next);
        next += rows;
    }
    first[tree.nodes.size()] = uint32_t(next);
    return first;
}

void copy_family(const Bvh& tree, std::size_t index, const RawVector<uint32_t>& first,
                 TreeRows& rows) {
    shared::BvhNode node = tree.nodes[index];
    uint32_t next = first[index] + uint32_t(kNodeRows);
    for (int32_t& child : node.child) {
        if (child > 0) child = int32_t(first[uint32_t(child)]);
        if (child >= 0) continue;
        std::memcpy(&rows[next], &tree.blocks[uint32_t(~child)], sizeof(shared::TriangleBlock));
        child = ~int32_t(next);
        next += uint32_t(kBlockRows);
    }
    std::memcpy(&rows[first[index]], &node, sizeof(node));
}

}  // namespace

uint64_t row_count(const Bvh& tree) {
    return tree.nodes.size() * kNodeRows + tree.blocks.size() * kBlockRows;
}

TreeRows interleave(const Bvh& tree, uint64_t chunk_rows) {
    const RawVector<uint32_t> first = place_nodes(tree, chunk_rows);
    TreeRows rows(first.back());
    parallel_ranges(tree.nodes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) copy_family(tree, i, first, rows);
    });
    return rows;
}

}  // namespace wedge::bvh
