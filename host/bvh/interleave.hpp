// The wide tree in one array, each node with its blocks behind it: what a ray needs next lies near
// what it has.
#pragma once

#include <cstdint>

#include "host/bvh/bvh.hpp"

namespace wedge::bvh {

/// Nodes of 7 rows and blocks of 5. A node's children are >= 0: the node's first row; < 0: ~ the
/// block's first row. Row 0 is the root's first.
using TreeRows = RawVector<shared::TreeRow>;

/// How many rows `interleave` makes at least: with chunks there may be unused ones between.
uint64_t row_count(const Bvh& tree);

/// Nodes in the order of `tree`, each followed by the blocks that are its children. Where
/// `chunk_rows` is not 0, it is a power of two of at least kLargestFamily_rows, and a node and its
/// blocks never lie on both sides of a multiple of it.
TreeRows interleave(const Bvh& tree, uint64_t chunk_rows = 0);

/// Rows of a node with eight blocks.
constexpr uint64_t kLargestFamily_rows = 7 + 8 * 5;

}  // namespace wedge::bvh
