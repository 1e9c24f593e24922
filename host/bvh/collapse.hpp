// Which inner nodes of a binary tree become nodes of the 8-wide one.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host/bvh/split.hpp"

namespace wedge::bvh {

/// A binary tree over one range of triangles, with the cheapest way to cut it into 8-wide nodes
/// (dynamic programming after Ylitie, Karras and Laine 2017, section 3.1).
class BinaryTree {
  public:
    static constexpr int kWidth = 8;
    static constexpr uint32_t kLeafTriangles = 4;

    /// Divides `range` by the surface-area heuristic down to leaves of at most four triangles.
    /// Reorders the refs of the range.
    BinaryTree(const Splitter& splitter, std::span<PrimRef> refs, const Range& range);

    /// Levels of 8-wide nodes.
    uint32_t depth() const;

    /// Children of the 8-wide node at binary node `index` (the root is 0): binary nodes again.
    /// Returns their number, 2 to 8.
    int children(uint32_t index, std::array<uint32_t, kWidth>& out) const;

    const Range& range(uint32_t index) const { return nodes_[index].range; }
    bool is_leaf(uint32_t index) const { return nodes_[index].left == 0; }

  private:
    struct Node {
        Range range;
        uint32_t left = 0, right = 0;  ///< 0: a leaf
        /// cost[i]: of the triangles below, as at most i + 1 children of some node above.
        std::array<float, kWidth> cost;
        /// Of i + 1 children, those that come from the left; 0: the node is one child itself.
        std::array<uint8_t, kWidth> from_left{};
    };

    uint32_t divide(const Splitter& splitter, std::span<PrimRef> refs, const Range& range);
    void choose_cut(Node& node, float scale) const;
    void gather(uint32_t index, int slots, std::array<uint32_t, kWidth>& out, int& count) const;
    uint32_t depth_below(uint32_t index) const;

    std::vector<Node> nodes_;
};

}  // namespace wedge::bvh
