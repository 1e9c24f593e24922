// The order of a node's children: rays that ask only whether anything is in the way try the last
// child they enter first.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "host/bvh/bvh.hpp"

namespace wedge::bvh {

/// Of a ray that enters a box, without a thought for where it comes from.
struct Expectation {
    float hit = 0;     ///< probability that something in the box blocks it
    float visits = 1;  ///< nodes and blocks until that is found, or all is seen
};

/// Puts the children of `node` into the order that leads to the fewest visits, and returns what is
/// then expected of a ray that enters the node. `children`: of a ray that enters each child.
/// `scale` as for half_area.
Expectation order_children(shared::BvhNode& node, const std::array<Expectation, 8>& children,
                           float scale);

/// order_children for `count` nodes from the last to `first`. All nodes below must have been
/// ordered before, and `expected`, which has a place for every node of the tree, holds what came
/// out.
void order_nodes(Bvh& tree, std::size_t first, std::size_t count, float scale,
                 std::span<Expectation> expected);

}  // namespace wedge::bvh
