// The order of a node's children, against all orders.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "host/bvh/order.hpp"
#include "meshes.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

struct Case {
    shared::BvhNode node{};
    std::array<bvh::Expectation, 8> children;
    int count = 0;
};

/// `count` boxes side by side along x, of random heights; child i is called i + 1.
Case random_case(std::mt19937& random, int count) {
    std::uniform_real_distribution<float> uniform(0.05f, 1.0f);
    Case result;
    result.count = count;
    for (int slot = 0; slot < 8; ++slot) {
        const bool used = slot < count;
        const float height = uniform(random);
        for (int row = 0; row < 6; ++row)
            result.node.bounds[row][slot] =
                used ? (row % 2 ? height : 0) : (row % 2 ? -INFINITY : INFINITY);
        if (!used) continue;
        result.node.bounds[0][slot] = float(slot);
        result.node.bounds[1][slot] = float(slot + 1);
        result.node.child[slot] = slot + 1;
        result.children[slot] = {uniform(random), 1 + 20 * uniform(random)};
    }
    return result;
}

double half_area(const shared::BvhNode& node, int slot) {
    const double x = node.bounds[1][slot] - node.bounds[0][slot],
                 y = node.bounds[3][slot] - node.bounds[2][slot],
                 z = node.bounds[5][slot] - node.bounds[4][slot];
    return x * y + y * z + z * x;
}

/// Expected visits below the node when children are tried from the back of `order`, summed over
/// which of them are entered and which of these block.
double visits_of(const Case& c, const std::vector<int>& order) {
    double width = c.count, height = 0, depth = 0;
    for (int slot = 0; slot < c.count; ++slot) {
        height = std::max(height, double(c.node.bounds[3][slot]));
        depth = std::max(depth, double(c.node.bounds[5][slot]));
    }
    const double area = width * height + height * depth + depth * width;
    double sum = 0;
    for (int entered = 0; entered < 1 << c.count; ++entered) {
        double chance = 1, visits = 0, reached = 1;
        for (int slot = 0; slot < c.count; ++slot) {
            const double enters = half_area(c.node, slot) / area;
            chance *= entered >> slot & 1 ? enters : 1 - enters;
        }
        for (int i = c.count; i-- > 0;) {
            if (!(entered >> order[i] & 1)) continue;
            visits += reached * c.children[order[i]].visits;
            reached *= 1 - c.children[order[i]].hit;
        }
        sum += chance * visits;
    }
    return sum;
}

}  // namespace

TEST_CASE("no_order_of_children_expects_fewer_visits") {
    std::mt19937 random(5);
    for (int i = 0; i < 40; ++i) {
        const Case before = random_case(random, 1 + i % 6);
        shared::BvhNode node = before.node;
        const bvh::Expectation expected = bvh::order_children(node, before.children, 1);

        std::vector<int> chosen(before.count), order(before.count);
        for (int slot = 0; slot < before.count; ++slot) {
            chosen[slot] = node.child[slot] - 1;
            for (int row = 0; row < 6; ++row)
                CHECK(node.bounds[row][slot] == before.node.bounds[row][chosen[slot]]);
        }
        for (int slot = before.count; slot < 8; ++slot) {
            CHECK(node.bounds[0][slot] == INFINITY);
            CHECK(node.bounds[1][slot] == -INFINITY);
        }
        const double least = visits_of(before, chosen);
        CHECK(expected.visits == doctest::Approx(1 + least).epsilon(1e-5));
        std::iota(order.begin(), order.end(), 0);
        do CHECK(least <= visits_of(before, order) * (1 + 1e-6));
        while (std::next_permutation(order.begin(), order.end()));
    }
}

TEST_CASE("a_triangle_blocks_the_share_of_rays_that_its_area_tells") {
    // Of the lines that enter a box with half the surface A, a flat piece of area a across it meets
    // a / A, which is small here, so that lines that meet two pieces do not matter.
    Triangles one;
    one.positions = {Vec3(0, 0, 0), Vec3(0.1f, 0, 0.02f), Vec3(1, 1, 1)};
    one.indices = {UVec3(0, 1, 2)};
    bvh::Bvh tree = bvh::build(one.positions, one.indices);
    std::vector<bvh::Expectation> expected(1);
    bvh::order_nodes(tree, 0, 1, 1, expected);
    const float area = 0.5f * glm::length(glm::cross(one.positions[1], one.positions[2]));
    CHECK(expected[0].hit == doctest::Approx(1 - std::exp(-area / 3)));
    CHECK(expected[0].visits == doctest::Approx(2));
}
