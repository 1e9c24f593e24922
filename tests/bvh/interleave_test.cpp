// The rows that kernels read hold the same tree: each node with its blocks behind it, nothing
// twice.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "host/bvh/interleave.hpp"
#include "meshes.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr uint32_t kNodeRows = 7, kBlockRows = 5;

template <typename T>
T read(const bvh::TreeRows& rows, uint32_t first) {
    REQUIRE(first * sizeof(rows[0]) + sizeof(T) <= rows.size() * sizeof(rows[0]));
    T item;
    std::memcpy(&item, &rows[first], sizeof(item));
    return item;
}

template <typename T>
bool same_bits(const T& a, const T& b) {
    return std::memcmp(&a, &b, sizeof(T)) == 0;
}

/// Follows both trees from the root; `taken`: rows that are part of something.
struct Walk {
    const bvh::Bvh& tree;
    const bvh::TreeRows& rows;
    uint64_t chunk_rows;
    std::vector<bool> taken;

    void take(uint32_t first, uint32_t count) {
        for (uint32_t row = first; row < first + count; ++row) {
            CHECK(!taken[row]);
            taken[row] = true;
        }
    }

    void visit(uint32_t index, uint32_t first) {
        const shared::BvhNode& expected = tree.nodes[index];
        const auto node = read<shared::BvhNode>(rows, first);
        CHECK(same_bits(node.bounds, expected.bounds));
        take(first, kNodeRows);
        uint32_t next = first + kNodeRows;
        for (int slot = 0; slot < 8; ++slot) {
            if (!bvh::is_used(expected, slot)) continue;
            REQUIRE((node.child[slot] < 0) == (expected.child[slot] < 0));
            if (node.child[slot] >= 0) {
                visit(uint32_t(expected.child[slot]), uint32_t(node.child[slot]));
                continue;
            }
            CHECK(uint32_t(~node.child[slot]) == next);
            take(next, kBlockRows);
            CHECK(same_bits(read<shared::TriangleBlock>(rows, next),
                            tree.blocks[uint32_t(~expected.child[slot])]));
            next += kBlockRows;
        }
        if (chunk_rows) CHECK(first / chunk_rows == (next - 1) / chunk_rows);
    }
};

void check_rows(const Triangles& shape, uint64_t chunk_rows) {
    const bvh::Bvh tree = bvh::build(shape.positions, shape.indices);
    const bvh::TreeRows rows = bvh::interleave(tree, chunk_rows);
    Walk walk{tree, rows, chunk_rows, std::vector<bool>(rows.size())};
    walk.visit(0, 0);
    const auto taken = uint64_t(std::count(walk.taken.begin(), walk.taken.end(), true));
    CHECK(taken == bvh::row_count(tree));
    if (chunk_rows == 0) CHECK(rows.size() == taken);
}

}  // namespace

TEST_CASE("rows_hold_the_tree_each_node_with_its_blocks") {
    check_rows(make_soup(3000, 1), 0);
    check_rows(make_sphere(20, 0.1f), 0);
    check_rows(make_soup(3, 2), 0);
    check_rows(Triangles{}, 0);
}

TEST_CASE("a_node_and_its_blocks_lie_in_one_chunk") {
    check_rows(make_soup(3000, 1), 64);
    check_rows(make_sphere(20, 0.1f), 128);
}
