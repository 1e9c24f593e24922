// Trees of high quality, where triangles are cut between nodes: no answer changes.
#include <doctest/doctest.h>

#include <bit>
#include <cstring>

#ifdef WEDGE_HAVE_TBB
#include <tbb/global_control.h>
#endif

#include "brute_force.hpp"
#include "host/bvh/spatial.hpp"
#include "host/bvh/update.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr BvhOptions kHigh{.layout = BvhLayout::wide, .quality = BvhQuality::high};

/// Long thin triangles, all along a diagonal: their boxes are large, and most of them empty.
Triangles make_straws(int count) {
    Random random(4);
    Triangles straws;
    for (int i = 0; i < count; ++i) {
        const Vec3 middle = uniform_in_box(random, 1);
        const Vec3 along = Vec3(0.5f) + uniform_in_box(random, 0.05f);
        const Vec3 across = 0.02f * uniform_direction(random);
        straws.add(middle - along, middle + along, middle + across);
    }
    return straws;
}

uint64_t count_parts(const bvh::Bvh& tree) {
    uint64_t parts = 0;
    for (const shared::TriangleBlock& block : tree.blocks)
        for (const uint32_t primitive : block.primitive) parts += primitive != WEDGE_NO_PRIMITIVE;
    return parts;
}

void check_rays(const Triangles& triangles, float scale = 1, const Vec3& shift = Vec3(0)) {
    const Triangles placed = transformed(triangles, scale, shift);
    Random random(5);
    std::vector<PackedRay> rays;
    for (int i = 0; i < 8000; ++i) {
        const Vec3 origin = scale * uniform_in_box(random, 1.5f) + shift;
        const Vec3 target = placed.positions[random() % placed.positions.size()];
        const Vec3 direction = i % 2 ? target - origin : uniform_direction(random);
        rays.push_back(make_ray(origin, direction));
    }
    Tracer tracer(placed, {.portable = false, .bvh = kHigh});
    const Score score = score_closest(placed, rays, tracer.closest(rays));
    CHECK(score.hits > 100);
    CHECK(score.wrong == 0);
    CHECK(score_occluded(placed, rays, tracer.occluded(rays)).wrong == 0);
}

}  // namespace

TEST_CASE("cut_triangles_agree_with_brute_force") {
    check_rays(make_straws(600));
    check_rays(make_slivers(300, 1));
    check_rays(make_cube(7));
    check_rays(make_soup(700, 1));
    check_rays(make_straws(600), 1e-4f);
    check_rays(make_straws(600), 1e5f);
    check_rays(make_straws(600), 1, Vec3(1e5f, -1e5f, 1e5f));
}

TEST_CASE("no_ray_slips_between_the_parts_of_a_cut_triangle") {
    // A floor of long narrow strips along the diagonal, each with a large empty box.
    Triangles floor;
    const auto corner = [](int strip, float along) {
        const float across = 0.1f * float(strip);
        return Vec3(along + across, 0.03f * along, along - across);
    };
    for (int i = -60; i < 60; ++i) {
        floor.add(corner(i, -8), corner(i + 1, -8), corner(i + 1, 8));
        floor.add(corner(i, -8), corner(i + 1, 8), corner(i, 8));
    }
    const bvh::Bvh tree = bvh::build(floor.positions, floor.indices, BvhQuality::high);
    CHECK(count_parts(tree) > 300);
    Random random(3);
    std::vector<PackedRay> rays;
    for (int i = 0; i < 200000; ++i) {
        const Vec3 origin = uniform_in_box(random, 1) + Vec3(0, 2, 0);
        // A third straight to an edge.
        const Vec3 target = i % 3 == 0 ? corner(int(random() % 41) - 20, uniform(random, -2, 2))
                                       : origin + Vec3(uniform(random, -1, 1), -1, 0.3f);
        rays.push_back(make_ray(origin, target - origin));
    }
    Tracer tracer(tree);
    uint64_t misses = 0;
    for (const PackedHit& hit : tracer.closest(rays)) misses += hit.primitive == WEDGE_NO_PRIMITIVE;
    for (const PackedHit& hit : tracer.occluded(rays))
        misses += hit.primitive == WEDGE_NO_PRIMITIVE;
    CHECK(misses == 0);
}

TEST_CASE("cutting_makes_better_trees_of_at_most_half_as_many_parts_more") {
    const Triangles straws = make_straws(4000);
    const bvh::Bvh medium = bvh::build(straws.positions, straws.indices);
    const bvh::Bvh high = bvh::build(straws.positions, straws.indices, BvhQuality::high);
    CHECK(count_parts(medium) == 4000);
    CHECK(count_parts(high) > 4400);
    CHECK(count_parts(high) <= 6000);
    CHECK(bvh::expected_visits(high) < 0.97 * bvh::expected_visits(medium));
    CHECK(high.depth <= WEDGE_MAX_DEPTH);
}

TEST_CASE("parts_of_a_triangle_cover_it") {
    Random random(8);
    const Triangles soup = make_soup(300, 6);
    const bvh::Splitter splitter{soup.positions, soup.indices};
    uint64_t outside = 0;
    for (uint32_t i = 0; i < soup.indices.size(); ++i) {
        const UVec3 t = soup.indices[i];
        const Vec3 v[3] = {soup.positions[t.x], soup.positions[t.y], soup.positions[t.z]};
        bvh::Box box;
        for (const Vec3& p : v) box.include(bvh::Float4{p.x, p.y, p.z, 0});
        bvh::PrimRef ref{box.lower, box.upper};
        ref.lower[3] = std::bit_cast<float>(i);
        for (int axis = 0; axis < 3; ++axis) {
            const float share = uniform(random, 0.05f, 0.95f);
            const float position = glm::mix(float(box.lower[axis]), float(box.upper[axis]), share);
            const bvh::CutRef cut = bvh::cut_ref(splitter, ref, axis, position);
            CHECK(cut.left.primitive() == i);
            CHECK(cut.right.primitive() == i);
            for (int k = 0; k < 200; ++k) {
                double a = uniform(random, 0, 1), b = uniform(random, 0, 1);
                if (a + b > 1) a = 1 - a, b = 1 - b;
                const glm::dvec3 p =
                    glm::dvec3(v[0]) * (1 - a - b) + glm::dvec3(v[1]) * a + glm::dvec3(v[2]) * b;
                const bvh::PrimRef& part = p[axis] <= position ? cut.left : cut.right;
                for (int d = 0; d < 3; ++d) outside += p[d] < part.lower[d] || p[d] > part.upper[d];
            }
        }
    }
    CHECK(outside == 0);
}

#ifdef WEDGE_HAVE_TBB
TEST_CASE("the_number_of_threads_does_not_change_a_bit_of_a_tree_of_high_quality") {
    const Triangles straws = make_straws(60000);
    const auto build_with = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return bvh::build(straws.positions, straws.indices, BvhQuality::high);
    };
    const bvh::Bvh alone = build_with(1), four = build_with(4);
    REQUIRE(alone.nodes.size() == four.nodes.size());
    REQUIRE(alone.blocks.size() == four.blocks.size());
    CHECK(std::memcmp(alone.nodes.data(), four.nodes.data(),
                      alone.nodes.size() * sizeof(alone.nodes[0])) == 0);
    CHECK(std::memcmp(alone.blocks.data(), four.blocks.data(),
                      alone.blocks.size() * sizeof(alone.blocks[0])) == 0);
}
#endif
