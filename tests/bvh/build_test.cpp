// What the tree promises, whatever the triangles.
#include <doctest/doctest.h>

#include <cstring>

#ifdef WEDGE_HAVE_TBB
#include <tbb/global_control.h>
#endif

#include "host/bvh/bvh.hpp"
#include "host/bvh/prim_refs.hpp"
#include "meshes.hpp"
#include "wedge/error.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

bvh::Bvh build(const Triangles& t) {
    return bvh::build(t.positions, t.indices);
}

struct Census {
    std::vector<int> times_seen;  ///< by primitive
    uint64_t boxes_too_small = 0, wrong_vertices = 0, nodes_seen = 0;
    uint32_t depth = 0;
};

void visit(const bvh::Bvh& tree, const Triangles& triangles, int node_index, uint32_t level,
           std::vector<Bounds> around, Census& census) {
    const shared::BvhNode& node = tree.nodes[node_index];
    ++census.nodes_seen;
    census.depth = std::max(census.depth, level + 1);
    for (int slot = 0; slot < 8; ++slot) {
        Bounds box;
        for (int axis = 0; axis < 3; ++axis) {
            box.lower[axis] = node.bounds[2 * axis][slot];
            box.upper[axis] = node.bounds[2 * axis + 1][slot];
        }
        if (box.empty()) continue;
        around.push_back(box);
        if (node.child[slot] >= 0) {
            visit(tree, triangles, node.child[slot], level + 1, around, census);
        } else {
            const shared::TriangleBlock& block = tree.blocks[~node.child[slot]];
            for (int lane = 0; lane < 4; ++lane) {
                const uint32_t primitive = block.primitive[lane];
                if (primitive == WEDGE_NO_PRIMITIVE) continue;
                ++census.times_seen[primitive];
                const UVec3 t = triangles.indices[primitive];
                for (int corner = 0; corner < 3; ++corner) {
                    const Vec3 p = triangles.positions[t[corner]];
                    const auto& rows = corner == 0 ? block.v0 : corner == 1 ? block.v1 : block.v2;
                    for (int axis = 0; axis < 3; ++axis)
                        census.wrong_vertices += rows[axis][lane] != p[axis];
                    for (const Bounds& b : around)
                        census.boxes_too_small += glm::any(glm::lessThan(p, b.lower)) ||
                                                  glm::any(glm::greaterThan(p, b.upper));
                }
            }
        }
        around.pop_back();
    }
}

/// Every triangle in one leaf, inside all boxes above it; depth as stated and within the stack.
void check_tree(const Triangles& triangles) {
    const bvh::Bvh tree = build(triangles);
    Census census;
    census.times_seen.resize(triangles.indices.size());
    visit(tree, triangles, 0, 0, {}, census);
    for (const int times : census.times_seen) REQUIRE(times == 1);
    CHECK(census.boxes_too_small == 0);
    CHECK(census.wrong_vertices == 0);
    CHECK(census.nodes_seen == tree.nodes.size());
    CHECK(census.depth == tree.depth);
    CHECK(tree.depth <= WEDGE_MAX_DEPTH);
    CHECK(tree.degenerate_count == 0);
    CHECK(tree.non_finite_count == 0);
}

bool same_bytes(const bvh::Bvh& a, const bvh::Bvh& b) {
    const std::size_t node_bytes = a.nodes.size() * sizeof(shared::BvhNode);
    const std::size_t block_bytes = a.blocks.size() * sizeof(shared::TriangleBlock);
    return a.nodes.size() == b.nodes.size() && a.blocks.size() == b.blocks.size() &&
           std::memcmp(a.nodes.data(), b.nodes.data(), node_bytes) == 0 &&
           std::memcmp(a.blocks.data(), b.blocks.data(), block_bytes) == 0;
}

}  // namespace

TEST_CASE("every_triangle_is_in_one_leaf_and_in_all_boxes_above") {
    for (const int count : {1, 2, 4, 5, 8, 9, 33, 1000, 30000}) check_tree(make_soup(count, count));
    check_tree(make_sphere(60, 0.1f));
    check_tree(make_slivers(5000, 1));
    check_tree(transformed(make_soup(2000, 1), 1e-30f, Vec3(0)));
    check_tree(transformed(make_soup(2000, 1), 1e30f, Vec3(0)));
}

TEST_CASE("depth_is_bounded_for_triangles_that_defeat_the_heuristic") {
    SUBCASE("identical triangles") {
        Triangles same;
        for (int i = 0; i < 20000; ++i) same.add({0, 0, 0}, {1, 0, 0}, {0, 1, 1});
        check_tree(same);
    }
    SUBCASE("sizes that fall by a factor of two, one inside the other") {
        Triangles nested;
        for (int i = 0; i < 4000; ++i) {
            const float s = std::exp2(-float(i % 120));
            nested.add({0, 0, 0}, {s, 0, 0}, {0, s, s});
        }
        check_tree(nested);
    }
    SUBCASE("places that double") {
        Triangles row;
        for (int i = -60; i < 60; ++i) {
            const float x = std::exp2(float(i)), s = 0.1f * x;
            for (int k = 0; k < 40; ++k) row.add({x, 0, 0}, {x + s, 0, 0}, {x, s, 0.01f * k * s});
        }
        check_tree(row);
    }
}

/// Half-filled nodes cost memory and visits: cutting greedily leaves little more than four a node.
TEST_CASE("nodes_have_more_than_five_children_on_average") {
    for (const Triangles& triangles : {make_soup(30000, 1), make_sphere(150, 0.1f)}) {
        const bvh::Bvh tree = build(triangles);
        std::size_t children = 0;
        for (const shared::BvhNode& node : tree.nodes)
            for (int slot = 0; slot < 8; ++slot)
                children += node.bounds[0][slot] <= node.bounds[1][slot];
        CHECK(double(children) > 5.0 * double(tree.nodes.size()));
    }
}

TEST_CASE("an_empty_scene_has_a_root_without_children") {
    const bvh::Bvh tree = bvh::build({}, {});
    REQUIRE(tree.nodes.size() == 1);
    CHECK(tree.blocks.empty());
    CHECK(tree.bounds.empty());
    for (int slot = 0; slot < 8; ++slot)
        CHECK(tree.nodes[0].bounds[0][slot] > tree.nodes[0].bounds[1][slot]);
}

TEST_CASE("triangles_that_nothing_can_hit_are_dropped_and_counted") {
    Triangles mixed = make_soup(50, 1);
    mixed.add({1, 2, 3}, {1, 2, 3}, {4, 5, 6});   // two corners equal
    mixed.add({1, 2, 3}, {1, 2, 3}, {1, 2, 3});   // a point
    mixed.add({0, 0, 0}, {1, 2, 4}, {3, 6, 12});  // in one line
    mixed.add({1e5f, 0, 0}, {1e5f, 1, 0}, {1e5f, 3, 0});
    mixed.add({0, std::nanf(""), 0}, {1, 0, 0}, {0, 1, 0});
    mixed.add({0, 0, 0}, {INFINITY, 0, 0}, {0, 1, 0});
    mixed.add({0, 0, 0}, {1, 0, 0}, {0, 1, -INFINITY});
    const bvh::Bvh tree = build(mixed);
    CHECK(tree.degenerate_count == 4);
    CHECK(tree.non_finite_count == 3);
    uint32_t kept = 0;
    for (const shared::TriangleBlock& block : tree.blocks)
        for (const uint32_t primitive : block.primitive) {
            kept += primitive != WEDGE_NO_PRIMITIVE;
            CHECK((primitive == WEDGE_NO_PRIMITIVE || primitive < 50));
        }
    CHECK(kept == 50);
    for (int axis = 0; axis < 3; ++axis) CHECK(std::isfinite(tree.bounds.upper[axis]));
}

TEST_CASE("slivers_are_kept_and_scale_does_not_matter") {
    for (const float scale : {1e-12f, 1e-4f, 1.0f, 1e5f}) {
        CAPTURE(scale);
        const Vec3 v0(0), v1(scale, 0, 0);
        CHECK_FALSE(bvh::is_degenerate(v0, v1, Vec3(0.5f * scale, 1e-7f * scale, 0)));
        CHECK(bvh::is_degenerate(v0, v1, Vec3(0.5f * scale, 0, 0)));
    }
    // One unit in the last place off the line.
    const float up = std::nextafter(3.0f, 4.0f);
    CHECK_FALSE(bvh::is_degenerate({1, 1, 1}, {2, 2, 2}, {3, 3, up}));
}

TEST_CASE("an_index_out_of_range_is_an_error_that_names_the_triangle") {
    Triangles bad = make_soup(3, 1);
    bad.indices[2].y = 9;
    try {
        build(bad);
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::bad_input);
        CHECK(std::string(error.what()).find("triangle 2") != std::string::npos);
        CHECK(std::string(error.what()).find("9") != std::string::npos);
    }
}

#ifdef WEDGE_HAVE_TBB
TEST_CASE("the_number_of_threads_does_not_change_a_bit") {
    for (const Triangles& triangles : {make_soup(150000, 1), make_sphere(200, 0.1f)}) {
        const auto build_with = [&](std::size_t threads) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            return build(triangles);
        };
        const bvh::Bvh alone = build_with(1);
        CHECK(same_bytes(alone, build_with(2)));
        CHECK(same_bytes(alone, build_with(4)));
    }
}
#endif
