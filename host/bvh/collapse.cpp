#include "host/bvh/collapse.hpp"

#include <algorithm>

namespace wedge::bvh {

BinaryTree::BinaryTree(const Splitter& splitter, std::span<PrimRef> refs, const Range& range) {
    nodes_.reserve(range.count);
    divide(splitter, refs, range);
}

uint32_t BinaryTree::divide(const Splitter& splitter, std::span<PrimRef> refs, const Range& range) {
    const uint32_t index = uint32_t(nodes_.size());
    nodes_.push_back({range});
    if (range.count > kLeafTriangles) {
        const RangePair pair = split_by_area(splitter, refs, range);
        // The vector may move during the calls: index it afterwards.
        const uint32_t left = divide(splitter, refs, pair.left);
        const uint32_t right = divide(splitter, refs, pair.right);
        nodes_[index].left = left;
        nodes_[index].right = right;
    }
    choose_cut(nodes_[index], splitter.scale);
    return index;
}

void BinaryTree::choose_cut(Node& node, float scale) const {
    // A visit to a node and a test of a block cost about the same; how many blocks there are is
    // settled, so their weight does not matter.
    const float area = half_area(node.range.bounds, scale);
    if (node.left == 0) {
        node.cost.fill(area);
        return;
    }
    const Node &left = nodes_[node.left], &right = nodes_[node.right];
    for (int slots = 2; slots <= kWidth; ++slots) {
        float best = std::numeric_limits<float>::infinity();
        node.from_left[slots - 1] = 1;  // even if areas are not finite
        for (int k = 1; k < slots; ++k) {
            const float cost = left.cost[k - 1] + right.cost[slots - k - 1];
            if (cost >= best) continue;
            best = cost;
            node.from_left[slots - 1] = uint8_t(k);
        }
        node.cost[slots - 1] = best;
    }
    node.cost[0] = area + node.cost[kWidth - 1];
    node.from_left[0] = 0;
    // As one child it may be cheaper than spread over several.
    for (int slots = 2; slots < kWidth; ++slots) {
        if (node.cost[slots - 1] <= node.cost[slots - 2]) continue;
        node.cost[slots - 1] = node.cost[slots - 2];
        node.from_left[slots - 1] = node.from_left[slots - 2];
    }
}

void BinaryTree::gather(uint32_t index, int slots, std::array<uint32_t, kWidth>& out,
                        int& count) const {
    const Node& node = nodes_[index];
    const int from_left = node.left == 0 ? 0 : node.from_left[slots - 1];
    if (from_left == 0) {
        out[count++] = index;
        return;
    }
    gather(node.left, from_left, out, count);
    gather(node.right, slots - from_left, out, count);
}

int BinaryTree::children(uint32_t index, std::array<uint32_t, kWidth>& out) const {
    int count = 0;
    if (is_leaf(index))
        out[count++] = index;
    else
        gather(index, kWidth, out, count);
    return count;
}

uint32_t BinaryTree::depth_below(uint32_t index) const {
    std::array<uint32_t, kWidth> below;
    const int count = children(index, below);
    uint32_t depth = 0;
    for (int i = 0; i < count; ++i)
        if (!is_leaf(below[i])) depth = std::max(depth, depth_below(below[i]));
    return depth + 1;
}

uint32_t BinaryTree::depth() const {
    return depth_below(0);
}

}  // namespace wedge::bvh
