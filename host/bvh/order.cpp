#include "host/bvh/order.hpp"

#include <algorithm>
#include <cmath>

#include "host/bvh/box.hpp"

namespace wedge::bvh {
namespace {

constexpr int kWidth = 8;

struct Child {
    float bounds[6];
    int32_t child;
    Expectation expected;
    float area;
};

Box child_box(const shared::BvhNode& node, int slot) {
    return {Float4{node.bounds[0][slot], node.bounds[2][slot], node.bounds[4][slot], 0},
            Float4{node.bounds[1][slot], node.bounds[3][slot], node.bounds[5][slot], 0}};
}

float triangles_area(const shared::TriangleBlock& b, float scale) {
    float sum = 0;
    for (int lane = 0; lane < 4; ++lane) {  // unused ones have no area
        float u[3], v[3];
        for (int axis = 0; axis < 3; ++axis) {
            u[axis] = (b.v1[axis][lane] - b.v0[axis][lane]) * scale;
            v[axis] = (b.v2[axis][lane] - b.v0[axis][lane]) * scale;
        }
        const float x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2],
                    z = u[0] * v[1] - u[1] * v[0];
        sum += 0.5f * std::sqrt(x * x + y * y + z * z);
    }
    return sum;
}

/// Random lines that meet a convex body of surface S meet a flat piece of area a in it with
/// probability 2 a / S (Cauchy, Crofton); several pieces are taken to be independent of each other.
Expectation expect_of_block(const shared::TriangleBlock& block, const Box& box, float scale) {
    const float surface_half = half_area(box, scale);
    const float area = triangles_area(block, scale);
    return {surface_half > 0 ? 1 - std::exp(-area / surface_half) : 1.0f, 1};
}

/// What the last child is worth trying for.
float worth(const Expectation& e) {
    return e.hit / e.visits;
}

}  // namespace

Expectation order_children(shared::BvhNode& node, const std::array<Expectation, 8>& children,
                           float scale) {
    std::array<Child, kWidth> sorted;
    int count = 0;
    Box all;
    for (int slot = 0; slot < kWidth; ++slot) {
        if (!is_used(node, slot)) continue;
        const Box box = child_box(node, slot);
        all.include(box);
        Child child{{}, node.child[slot], children[slot], half_area(box, scale)};
        for (int row = 0; row < 6; ++row) child.bounds[row] = node.bounds[row][slot];
        // By insertion: of equals, the order stays, and what is not a number does no harm.
        int place = count++;
        for (; place > 0 && worth(sorted[place - 1].expected) > worth(child.expected); --place)
            sorted[place] = sorted[place - 1];
        sorted[place] = child;
    }
    const float area = half_area(all, scale);
    Expectation expected{0, 1};
    float open = 1;  // probability that nothing was found so far
    for (int i = count; i-- > 0;) {
        const Child& child = sorted[i];
        const float enters = area > 0 ? child.area / area : 1.0f;
        expected.visits += open * enters * child.expected.visits;
        open *= 1 - enters * child.expected.hit;
    }
    expected.hit = 1 - open;

    for (int slot = 0; slot < kWidth; ++slot) {
        const bool used = slot < count;
        node.child[slot] = used ? sorted[slot].child : 0;
        for (int row = 0; row < 6; ++row)
            node.bounds[row][slot] = used           ? sorted[slot].bounds[row]
                                     : row % 2 == 0 ? INFINITY
                                                    : -INFINITY;
    }
    return expected;
}

void order_nodes(Bvh& tree, std::size_t first, std::size_t count, float scale,
                 std::span<Expectation> expected) {
    for (std::size_t i = first + count; i-- > first;) {
        shared::BvhNode& node = tree.nodes[i];
        std::array<Expectation, 8> children;
        for (int slot = 0; slot < kWidth; ++slot) {
            if (!is_used(node, slot)) continue;
            const int32_t child = node.child[slot];
            children[slot] =
                child >= 0 ? expected[child]
                           : expect_of_block(tree.blocks[~child], child_box(node, slot), scale);
        }
        expected[i] = order_children(node, children, scale);
    }
}

}  // namespace wedge::bvh
