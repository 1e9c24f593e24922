// A tree that follows moving vertices gives the answers of brute force on the moved triangles.
#include <doctest/doctest.h>

#include <cstring>

#include "brute_force.hpp"
#include "host/bvh/update.hpp"
#include "wedge/error.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

bvh::Bvh build(const Triangles& t) {
    return bvh::build(t.positions, t.indices);
}

bvh::UpdateResult update(bvh::Bvh& tree, const Triangles& t,
                         const bvh::UpdateOptions& options = {}) {
    return bvh::update_vertices(tree, t.positions, t.indices, options);
}

void check_rays(const bvh::Bvh& tree, const Triangles& triangles) {
    Random random(5);
    std::vector<PackedRay> rays;
    for (int i = 0; i < 8000; ++i)
        rays.push_back(make_ray(uniform_in_box(random, 1.5f), uniform_direction(random)));
    for (const BvhLayout layout : {BvhLayout::wide, BvhLayout::compressed, BvhLayout::binary}) {
        Tracer tracer(tree, {.portable = false, .bvh = {.layout = layout}});
        const Score score = score_closest(triangles, rays, tracer.closest(rays));
        CHECK(score.hits > 1000);
        CHECK(score.wrong == 0);
        CHECK(score_occluded(triangles, rays, tracer.occluded(rays)).wrong == 0);
    }
}

Triangles twisted(Triangles triangles, float angle) {
    for (Vec3& p : triangles.positions) {
        const float a = angle * p.y, c = std::cos(a), s = std::sin(a);
        p = Vec3(c * p.x - s * p.z, p.y, s * p.x + c * p.z);
    }
    return triangles;
}

}  // namespace

TEST_CASE("a_refitted_tree_agrees_with_brute_force") {
    const Triangles sphere = make_sphere(20, 0.1f);
    bvh::Bvh tree = build(sphere);
    for (const float angle : {0.1f, 0.3f}) {
        const Triangles moved = twisted(sphere, angle);
        CHECK_FALSE(update(tree, moved, {.rebuild_above = 10}).rebuilt);
        check_rays(tree, moved);
    }
}

TEST_CASE("vertices_that_did_not_move_leave_every_bit") {
    const Triangles soup = make_soup(5000, 1);
    const bvh::Bvh before = build(soup);
    bvh::Bvh after = before;
    const bvh::UpdateResult result = update(after, soup);
    CHECK_FALSE(result.rebuilt);
    CHECK(result.cost_ratio == 1);
    CHECK(std::memcmp(after.nodes.data(), before.nodes.data(),
                      before.nodes.size() * sizeof(before.nodes[0])) == 0);
    CHECK(std::memcmp(after.blocks.data(), before.blocks.data(),
                      before.blocks.size() * sizeof(before.blocks[0])) == 0);
}

TEST_CASE("a_tree_that_got_bad_is_built_anew") {
    const Triangles soup = make_soup(3000, 1);
    Triangles shuffled = soup;
    // Every triangle goes somewhere else.
    for (std::size_t i = 0; i < shuffled.indices.size(); ++i)
        shuffled.indices[i] = soup.indices[(i * 1237) % soup.indices.size()];
    bvh::Bvh tree = build(soup);
    const bvh::UpdateResult result = update(tree, shuffled);
    CHECK(result.rebuilt);
    CHECK(result.cost_ratio > 1.5);
    check_rays(tree, shuffled);
    CHECK(bvh::expected_visits(tree) == doctest::Approx(bvh::expected_visits(build(shuffled))));
}

TEST_CASE("rebuilding_can_be_asked_for") {
    const Triangles soup = make_soup(100, 1);
    bvh::Bvh tree = build(soup);
    CHECK(update(tree, soup, {.rebuild_above = 0}).rebuilt);
}

TEST_CASE("vertices_that_are_not_finite_drop_their_triangles_and_come_back") {
    const Triangles soup = make_soup(500, 2);
    Triangles broken = soup;
    broken.positions[7].y = std::nanf("");
    bvh::Bvh tree = build(soup);
    CHECK(update(tree, broken).rebuilt);
    CHECK(tree.non_finite_count == 1);
    CHECK(update(tree, soup).rebuilt);
    CHECK(tree.non_finite_count == 0);
    check_rays(tree, soup);
}

TEST_CASE("triangles_may_collapse_and_unfold") {
    const Triangles soup = make_soup(500, 3);
    Triangles flat = soup;
    for (const UVec3& t : flat.indices) flat.positions[t.z] = flat.positions[t.y];
    bvh::Bvh tree = build(soup);
    update(tree, flat, {.rebuild_above = 1e9});
    Tracer tracer(tree);
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        const PackedRay ray = make_ray(uniform_in_box(random, 1), uniform_direction(random));
        CHECK(tracer.closest({&ray, 1})[0].primitive == WEDGE_NO_PRIMITIVE);
    }
    // Built while all are degenerate, a tree holds none; unfolded, they must be found.
    bvh::Bvh none = build(flat);
    CHECK(none.blocks.empty());
    CHECK(update(none, soup).rebuilt);
    check_rays(none, soup);
}

TEST_CASE("updates_with_other_triangles_are_errors") {
    const Triangles soup = make_soup(10, 1);
    bvh::Bvh tree = build(soup);
    CHECK_THROWS_AS(update(tree, make_soup(11, 1)), const Error&);
    Triangles few = soup;
    few.positions.pop_back();
    CHECK_THROWS_AS(update(tree, few), const Error&);
}
