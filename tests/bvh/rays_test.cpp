// Rays and scenes out of the ordinary.
#include <doctest/doctest.h>

#include "tracer.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr uint32_t kNone = WEDGE_NO_PRIMITIVE;

Triangles one_triangle() {
    Triangles triangles;
    triangles.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    return triangles;
}

}  // namespace

TEST_CASE("hit_gives_distance_and_barycentrics") {
    Tracer tracer(one_triangle());
    // Towards (0.25, 0.5, 0) from both sides, with directions of other lengths than 1.
    const PackedRay rays[] = {make_ray({0.25f, 0.5f, 2}, {0, 0, -1}),
                              make_ray({0.25f, 0.5f, -2}, {0, 0, 4}),
                              make_ray({1.25f, 1.5f, 1}, {-10, -10, -10})};
    const auto hits = tracer.closest(rays);
    const float expected_t[] = {2, 0.5f, 0.1f};
    for (int i = 0; i < 3; ++i) {
        CHECK(hits[i].primitive == 0);
        CHECK(hits[i].t == doctest::Approx(expected_t[i]));
        CHECK(hits[i].u == doctest::Approx(0.25));
        CHECK(hits[i].v == doctest::Approx(0.5));
    }
}

TEST_CASE("hits_lie_strictly_between_zero_and_t_max") {
    Tracer tracer(one_triangle());
    const Vec3 at(0.25f, 0.25f, 1), down(0, 0, -1);
    const PackedRay rays[] = {make_ray(at, down, 1.0001f), make_ray(at, down, 1.0f),
                              make_ray(at, down, 0.9999f), make_ray({0.25f, 0.25f, 0}, down),
                              make_ray(at, -down),         make_ray(at, down, 0.0f),
                              make_ray(at, down, -1.0f)};
    const auto closest = tracer.closest(rays);
    const auto occluded = tracer.occluded(rays);
    for (int i = 0; i < 7; ++i) {
        CAPTURE(i);
        CHECK((closest[i].primitive == 0) == (i == 0));
        CHECK((occluded[i].primitive == 0) == (i == 0));
    }
    CHECK(closest[2].t == 0.9999f);
}

TEST_CASE("the_source_of_a_ray_is_never_hit") {
    // Two coincident triangles: leaving one, the other is still there.
    Triangles twice = one_triangle();
    twice.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    Tracer tracer(twice);
    const Vec3 at(0.25f, 0.25f, 1), down(0, 0, -1);
    const PackedRay rays[] = {make_ray(at, down, INFINITY, 0), make_ray(at, down, INFINITY, 1)};
    const auto hits = tracer.closest(rays);
    CHECK(hits[0].primitive == 1);
    CHECK(hits[1].primitive == 0);
    CHECK(tracer.occluded(rays)[0].primitive != kNone);

    Tracer alone(one_triangle());
    CHECK(alone.closest(rays)[0].primitive == kNone);
    CHECK(alone.occluded(rays)[0].primitive == kNone);
    CHECK(alone.closest(rays)[1].primitive == 0);
}

TEST_CASE("rays_that_are_not_finite_hit_nothing") {
    Tracer tracer(make_sphere(10, 0));
    const float nan = std::nanf(""), inf = INFINITY;
    std::vector<PackedRay> rays;
    for (const float bad : {nan, -nan, inf, -inf})
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 origin(0), direction(0.3f, 0.4f, 0.5f);
            origin[axis] = bad;
            rays.push_back(make_ray(origin, direction));
            origin = Vec3(0);
            direction[axis] = bad;
            rays.push_back(make_ray(origin, direction));
        }
    rays.push_back(make_ray(Vec3(0), Vec3(0)));
    rays.push_back(make_ray(Vec3(0), Vec3(0, 0, 1), nan));
    rays.push_back(make_ray(Vec3(0), Vec3(0, 0, 1), -inf));
    const std::size_t bad_count = rays.size();
    rays.push_back(make_ray(Vec3(0), Vec3(0.3f, 0.4f, 0.5f)));

    const auto closest = tracer.closest(rays);
    const auto occluded = tracer.occluded(rays);
    for (std::size_t i = 0; i < bad_count; ++i) {
        CAPTURE(i);
        CHECK(closest[i].primitive == kNone);
        CHECK(occluded[i].primitive == kNone);
    }
    CHECK(closest.back().primitive != kNone);
}

TEST_CASE("an_empty_scene_is_never_hit") {
    Tracer tracer(Triangles{});
    const PackedRay rays[] = {make_ray(Vec3(0), Vec3(0, 0, 1)), make_ray(Vec3(1), Vec3(1, 2, 3))};
    for (const PackedHit& hit : tracer.closest(rays)) CHECK(hit.primitive == kNone);
    for (const PackedHit& hit : tracer.occluded(rays)) CHECK(hit.primitive == kNone);
}

TEST_CASE("length_of_the_direction_only_scales_t") {
    Tracer tracer(make_sphere(10, 0.1f));
    for (const float length : {1e-12f, 1e-6f, 1.0f, 1e6f, 1e12f}) {
        const PackedRay ray = make_ray({0.1f, 0.2f, 0.1f}, Vec3(0.3f, 0, 0.5f) * length);
        const PackedRay unit = make_ray({0.1f, 0.2f, 0.1f}, Vec3(0.3f, 0, 0.5f));
        const PackedHit hit = tracer.closest({&ray, 1})[0];
        const PackedHit expected = tracer.closest({&unit, 1})[0];
        CHECK(hit.primitive == expected.primitive);
        CHECK(hit.t * length == doctest::Approx(expected.t));
    }
}

TEST_CASE("the_portable_lane_mask_gives_the_same_hits") {
    const Triangles soup = make_soup(2000, 9);
    Tracer fast(soup), portable(soup, {.portable = true, .bvh = {}});
    Random random(3);
    std::vector<PackedRay> rays;
    for (int i = 0; i < 100000; ++i)
        rays.push_back(make_ray(uniform_in_box(random, 1.5f), uniform_direction(random)));
    CHECK(fast.closest(rays) == portable.closest(rays));
    CHECK(fast.occluded(rays) == portable.occluded(rays));
}
