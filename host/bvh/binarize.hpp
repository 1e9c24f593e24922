// The tree in nodes of two children.
#pragma once

#include "host/bvh/bvh.hpp"

namespace wedge::bvh {

/// Every wide node becomes a binary tree over its children. The blocks stay what they are.
RawVector<shared::BinaryNode> binarize(const Bvh& tree);

}  // namespace wedge::bvh
