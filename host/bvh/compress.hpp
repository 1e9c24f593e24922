// The tree in quantised nodes of 80 bytes.
#pragma once

#include "host/bvh/bvh.hpp"

namespace wedge::bvh {

struct CompressedTree {
    RawVector<shared::CompressedNode> nodes;  ///< as many as the wide tree has
    RawVector<shared::TriangleBlock> blocks;  ///< the same, those of a node side by side
};

/// After Ylitie, Karras and Laine 2017, section 3: every stored box contains the one it stands for.
CompressedTree compress(const Bvh& tree);

}  // namespace wedge::bvh
