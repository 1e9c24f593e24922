// Every layout of the nodes, cut into chunks or not, gives the answers of brute force, and the same
// distances as the wide one.
#include <doctest/doctest.h>

#include "brute_force.hpp"
#include "wedge/error.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr int kRays = 6000;

constexpr BvhLayout kLayouts[] = {BvhLayout::wide, BvhLayout::compressed, BvhLayout::binary};

Vec3 random_vertex(Random& random, const Triangles& triangles) {
    return triangles.positions[random() % triangles.positions.size()];
}

/// Rays of all kinds: random, through vertices, along axes through vertices, leaving triangles.
std::vector<PackedRay> make_rays(const Triangles& triangles, float scale, const Vec3& shift) {
    Random random(11);
    std::vector<PackedRay> rays;
    for (int i = 0; i < kRays; ++i) {
        const Vec3 origin = scale * uniform_in_box(random, 1.5f) + shift;
        const Vec3 target = random_vertex(random, triangles);
        Vec3 axis(0);
        axis[random() % 3] = random() % 2 ? 1.0f : -1.0f;
        const float end = random() % 3 ? INFINITY : scale * uniform(random, 0, 2);
        const auto source = uint32_t(random() % triangles.indices.size());
        const int kind = i % 4;
        rays.push_back(kind == 0   ? make_ray(origin, uniform_direction(random), end)
                       : kind == 1 ? make_ray(origin, target - origin)
                       : kind == 2 ? make_ray(target - 3 * scale * axis, axis)
                                   : make_ray(target, uniform_direction(random), end, source));
    }
    return rays;
}

void check_layout(const Triangles& shape, const BvhOptions& options, float scale = 1,
                  const Vec3& shift = Vec3(0)) {
    const Triangles placed = transformed(shape, scale, shift);
    const std::vector<PackedRay> rays = make_rays(placed, scale, shift);
    Tracer tracer(placed, {.portable = false, .bvh = options});
    CAPTURE(int(options.layout));
    CAPTURE(options.largest_buffer_bytes);
    CAPTURE(scale);
    const std::vector<PackedHit> closest = tracer.closest(rays), any = tracer.occluded(rays);
    const Score score = score_closest(placed, rays, closest);
    CHECK(score.hits > 100);
    CHECK(score.wrong == 0);
    CHECK(score_occluded(placed, rays, any).wrong == 0);

    Tracer wide(placed, {.portable = false, .bvh = {.layout = BvhLayout::wide}});
    const std::vector<PackedHit> expected = wide.closest(rays);
    std::size_t other = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) other += closest[i].t != expected[i].t;
    CHECK(other == 0);
}

}  // namespace

TEST_CASE("every_layout_agrees_with_brute_force") {
    for (const BvhLayout layout : kLayouts) {
        const BvhOptions options{.layout = layout};
        check_layout(make_soup(700, 1), options);
        check_layout(make_cube(7), options);
        check_layout(make_slivers(300, 4), options);
    }
}

TEST_CASE("every_layout_agrees_at_any_scale_and_place") {
    for (const BvhLayout layout : kLayouts) {
        const BvhOptions options{.layout = layout};
        check_layout(make_soup(400, 2), options, 1e-4f);
        check_layout(make_soup(400, 2), options, 1e5f);
        check_layout(make_sphere(10, 0.1f), options, 1, Vec3(1e5f, -1e5f, 1e5f));
        check_layout(make_cube(6), options, 1e-6f, Vec3(1, 1, -1));
    }
}

TEST_CASE("every_layout_takes_trees_of_no_and_of_one_triangle") {
    Triangles one;
    one.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    const PackedRay rays[] = {make_ray({0.25f, 0.5f, 2}, {0, 0, -1}),
                              make_ray({0.75f, 0.5f, 2}, {0, 0, -1})};
    for (const BvhLayout layout : kLayouts) {
        Tracer empty(Triangles{}, {.portable = false, .bvh = {.layout = layout}});
        CHECK(empty.closest(rays)[0].primitive == WEDGE_NO_PRIMITIVE);
        CHECK(empty.occluded(rays)[0].primitive == WEDGE_NO_PRIMITIVE);
        Tracer tracer(one, {.portable = false, .bvh = {.layout = layout}});
        CHECK(tracer.closest(rays)[0].primitive == 0);
        CHECK(tracer.closest(rays)[0].t == doctest::Approx(2));
        CHECK(tracer.closest(rays)[1].primitive == WEDGE_NO_PRIMITIVE);
        CHECK(tracer.occluded(rays)[0].primitive == 0);
    }
}

TEST_CASE("trees_larger_than_a_buffer_are_cut_into_chunks") {
    const Triangles soup = make_soup(900, 3);
    for (const BvhLayout layout : kLayouts) {
        // Some 80 nodes and 300 blocks: eight chunks of at most 64 blocks and fewer of nodes, or
        // sixteen of 256 rows.
        const BvhOptions options{.layout = layout, .largest_buffer_bytes = 64 * 160};
        Tracer tracer(soup, {.portable = false, .bvh = options});
        CHECK(tracer.on_device().arrays.size() == 2 * WEDGE_TREE_CHUNKS);
        CHECK(tracer.on_device().defines.size() >= 2);
        check_layout(soup, options);
    }
}

TEST_CASE("a_tree_that_chunks_cannot_hold_is_an_error_that_says_so") {
    try {
        Tracer tracer(make_soup(900, 3),
                      {.portable = false, .bvh = {.largest_buffer_bytes = 4 * 160}});
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::device);
        CHECK(std::string(error.what()).find("do not fit") != std::string::npos);
    }
}
