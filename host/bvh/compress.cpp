#include "host/bvh/compress.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/base/parallel.hpp"

namespace wedge::bvh {
namespace {

constexpr int kSlots = 8;
constexpr int kExponentBias = 127;
constexpr int kUnused = -1;

/// Which child of the wide node comes into each slot; kUnused: none.
using Order = std::array<int8_t, kSlots>;

Vec3 lower_of(const shared::BvhNode& node, int child) {
    return {node.bounds[0][child], node.bounds[2][child], node.bounds[4][child]};
}
Vec3 upper_of(const shared::BvhNode& node, int child) {
    return {node.bounds[1][child], node.bounds[3][child], node.bounds[5][child]};
}

/// Children go where they lie: the pair of child and slot that agree best first (Ylitie et al.
/// solve the assignment; taking the best pair each time comes close).
Order order_children(const shared::BvhNode& node) {
    Bounds all;
    for (int c = 0; c < kSlots; ++c)
        if (is_used(node, c))
            all.lower = glm::min(all.lower, lower_of(node, c)),
            all.upper = glm::max(all.upper, upper_of(node, c));
    std::array<std::array<float, kSlots>, kSlots> gain;  // [child][slot]
    for (int c = 0; c < kSlots; ++c) {
        if (!is_used(node, c)) continue;
        const Vec3 from_middle =
            0.5f * (lower_of(node, c) - all.lower) - 0.5f * (all.upper - upper_of(node, c));
        for (int slot = 0; slot < kSlots; ++slot)
            gain[c][slot] = (slot & 1 ? from_middle.x : -from_middle.x) +
                            (slot & 2 ? from_middle.y : -from_middle.y) +
                            (slot & 4 ? from_middle.z : -from_middle.z);
    }
    Order order;
    order.fill(kUnused);
    std::array<bool, kSlots> placed{};
    for (;;) {
        int child = kUnused, slot = kUnused;
        for (int c = 0; c < kSlots; ++c) {
            if (placed[c] || !is_used(node, c)) continue;
            for (int s = 0; s < kSlots; ++s)
                if (order[s] == kUnused && (child < 0 || gain[c][s] > gain[child][slot]))
                    child = c, slot = s;
        }
        if (child < 0) return order;
        order[slot] = int8_t(child);
        placed[child] = true;
    }
}

float step_of(int biased_exponent) {
    return std::ldexp(1.0f, biased_exponent - kExponentBias);
}

/// As the kernels compute it: the product is exact, the sum rounded once.
float plane_at(float origin, float step, int byte) {
    return origin + step * float(byte);
}

/// The byte of the highest plane not above `lower`, at least 0.
int byte_below(float origin, float step, float lower) {
    int byte = int(std::clamp(std::floor((lower - origin) / step), 0.0f, 255.0f));
    while (byte > 0 && plane_at(origin, step, byte) > lower) --byte;
    return byte;
}

/// The byte of the lowest plane not below `upper`; 256 if there is none.
int byte_above(float origin, float step, float upper) {
    int byte = int(std::clamp(std::ceil((upper - origin) / step), 0.0f, 255.0f));
    while (byte < 256 && plane_at(origin, step, byte) < upper) ++byte;
    return byte;
}

/// The smallest step, a power of two, with which 255 steps reach from `lower` to `upper`.
int exponent_for(float lower, float upper) {
    int exponent = 0;
    std::frexp((upper - lower) / 255, &exponent);  // the extent is finite: FLT_MAX / 2 at most
    int biased = std::clamp(exponent + kExponentBias - 1, 1, 254);
    while (biased < 254 && byte_above(lower, step_of(biased), upper) > 255) ++biased;
    return biased;
}

void set_byte(shared::CompressedNode& node, int row, int slot, int byte) {
    node.planes[row][slot / 4] |= uint32_t(byte) << (8 * (slot % 4));
}

shared::CompressedNode compress_node(const shared::BvhNode& wide, const Order& order) {
    shared::CompressedNode node{};
    for (int axis = 0; axis < 3; ++axis) {
        float lower = INFINITY, upper = -INFINITY;
        for (int c = 0; c < kSlots; ++c) {
            if (!is_used(wide, c)) continue;
            lower = std::min(lower, wide.bounds[2 * axis][c]);
            upper = std::max(upper, wide.bounds[2 * axis + 1][c]);
        }
        if (!(lower <= upper)) lower = upper = 0;  // an empty tree
        const int exponent = exponent_for(lower, upper);
        const float step = step_of(exponent);
        node.origin[axis] = lower;
        node.steps |= uint32_t(exponent) << (8 * axis);
        for (int slot = 0; slot < kSlots; ++slot) {
            if (order[slot] == kUnused) continue;
            const int c = order[slot];
            set_byte(node, 2 * axis, slot, byte_below(lower, step, wide.bounds[2 * axis][c]));
            set_byte(node, 2 * axis + 1, slot,
                     byte_above(lower, step, wide.bounds[2 * axis + 1][c]));
        }
    }
    for (int slot = 0; slot < kSlots; ++slot) {
        if (order[slot] == kUnused) continue;
        if (wide.child[order[slot]] >= 0)
            node.steps |= 1u << (24 + slot);
        else
            node.leaves |= 1u << slot;
    }
    return node;
}

/// Where the wide tree's nodes and blocks went.
struct Moves {
    std::vector<uint32_t> nodes;   ///< by new index: the old
    std::vector<uint32_t> blocks;  ///< likewise
};

/// Gives each node's children neighbouring places, a level below the other, and tells the nodes
/// where these begin.
Moves place_children(const Bvh& tree, const std::vector<Order>& orders, CompressedTree& out) {
    Moves moves;
    moves.nodes.reserve(tree.nodes.size());
    moves.blocks.reserve(tree.blocks.size());
    moves.nodes.push_back(0);
    for (std::size_t i = 0; i < moves.nodes.size(); ++i) {
        const uint32_t from = moves.nodes[i];
        out.nodes[i].first_node = uint32_t(moves.nodes.size());
        out.nodes[i].first_block = uint32_t(moves.blocks.size());
        for (const int8_t c : orders[from]) {
            if (c == kUnused) continue;
            const int32_t child = tree.nodes[from].child[c];
            child >= 0 ? moves.nodes.push_back(uint32_t(child))
                       : moves.blocks.push_back(uint32_t(~child));
        }
    }
    return moves;
}

}  // namespace

CompressedTree compress(const Bvh& tree) {
    constexpr std::size_t kGrain = 1024;
    std::vector<Order> orders(tree.nodes.size());
    parallel_ranges(tree.nodes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) orders[i] = order_children(tree.nodes[i]);
    });
    CompressedTree out;
    out.nodes.resize(tree.nodes.size());
    out.blocks.resize(tree.blocks.size());
    const Moves moves = place_children(tree, orders, out);
    parallel_ranges(out.nodes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const uint32_t from = moves.nodes[i];
            shared::CompressedNode node = compress_node(tree.nodes[from], orders[from]);
            node.first_node = out.nodes[i].first_node;
            node.first_block = out.nodes[i].first_block;
            out.nodes[i] = node;
        }
    });
    parallel_ranges(out.blocks.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) out.blocks[i] = tree.blocks[moves.blocks[i]];
    });
    return out;
}

}  // namespace wedge::bvh
