// Every answer of the kernels against every triangle in double precision: a million rays and more.
#include <doctest/doctest.h>

#include <functional>
#include <string>

#include "brute_force.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr int kRays = 60000;

using MakeRay = std::function<PackedRay(Random&, const Triangles&)>;

Vec3 random_surface_point(Random& random, const Triangles& triangles) {
    const UVec3 t = triangles.indices[random() % triangles.indices.size()];
    float b1 = uniform(random, 0, 1), b2 = uniform(random, 0, 1);
    if (b1 + b2 > 1) b1 = 1 - b1, b2 = 1 - b2;
    return (1 - b1 - b2) * triangles.positions[t.x] + b1 * triangles.positions[t.y] +
           b2 * triangles.positions[t.z];
}

/// A ray within the box [-1.5, 1.5]^3; some have an end.
PackedRay random_ray(Random& random, const Triangles&) {
    const Vec3 origin = uniform_in_box(random, 1.5f);
    const Vec3 direction = uniform_direction(random) * std::exp2(uniform(random, -4, 4));
    const bool ends = random() % 4 == 0;
    return make_ray(origin, direction, ends ? uniform(random, 0, 1) : INFINITY);
}

/// A ray towards the surface.
PackedRay aimed_ray(Random& random, const Triangles& triangles) {
    const Vec3 origin = uniform_in_box(random, 1.5f);
    return make_ray(origin, random_surface_point(random, triangles) - origin);
}

/// A ray almost in the plane of a triangle, passing through or near it.
PackedRay grazing_ray(Random& random, const Triangles& triangles) {
    const UVec3 t = triangles.indices[random() % triangles.indices.size()];
    const Vec3 v0 = triangles.positions[t.x], v1 = triangles.positions[t.y];
    const Vec3 normal = glm::cross(v1 - v0, triangles.positions[t.z] - v0);
    const Vec3 along = uniform(random, -1, 1) * (v1 - v0) +
                       uniform(random, -1, 1) * (triangles.positions[t.z] - v0);
    const float tilt = std::pow(10.0f, uniform(random, -6, -1)) * glm::length(along) /
                       std::max(glm::length(normal), 1e-12f);
    const Vec3 target = random_surface_point(random, triangles);
    const Vec3 direction = along + tilt * normal;
    return make_ray(target - uniform(random, 0, 2) * direction, direction);
}

/// A ray along an axis, its zero components of either sign, many on the planes of vertices.
PackedRay axis_ray(Random& random, const Triangles& triangles) {
    Vec3 origin = uniform_in_box(random, 1.5f);
    for (int axis = 0; axis < 3; ++axis)
        if (random() % 3 == 0)
            origin[axis] = triangles.positions[random() % triangles.positions.size()][axis];
    Vec3 direction(random() % 2 ? 0.0f : -0.0f);
    direction[random() % 3] = random() % 2 ? 1.0f : -1.0f;
    // Some with one zero only.
    if (random() % 3 == 0) direction[random() % 3] = uniform(random, -1, 1);
    return make_ray(origin, direction);
}

/// A ray through a vertex or a point of an edge.
PackedRay edge_ray(Random& random, const Triangles& triangles) {
    const UVec3 t = triangles.indices[random() % triangles.indices.size()];
    const float share = random() % 2 ? 0.0f : uniform(random, 0, 1);
    const Vec3 target = glm::mix(triangles.positions[t.x], triangles.positions[t.y], share);
    const Vec3 origin = uniform_in_box(random, 1.5f);
    return make_ray(origin, target - origin);
}

/// A ray that starts on a triangle, names it as its source, and leaves at any angle.
PackedRay leaving_ray(Random& random, const Triangles& triangles) {
    const uint32_t primitive = random() % uint32_t(triangles.indices.size());
    const UVec3 t = triangles.indices[primitive];
    const Vec3 centre =
        (triangles.positions[t.x] + triangles.positions[t.y] + triangles.positions[t.z]) / 3.0f;
    return make_ray(centre, uniform_direction(random), INFINITY, primitive);
}

/// Traces `kRays` rays made for `shape`, after both are scaled and moved. At most `unsure_share` of
/// them may have more than one right answer: else the test would say little.
void check_agreement(const std::string& name, const Triangles& shape, const MakeRay& make_ray_for,
                     float scale = 1, const Vec3& shift = Vec3(0), double unsure_share = 1) {
    const Triangles placed = transformed(shape, scale, shift);
    Random random(7);
    std::vector<PackedRay> rays;
    for (int i = 0; i < kRays; ++i) {
        PackedRay ray = make_ray_for(random, shape);
        ray.ox = ray.ox * scale + shift.x;
        ray.oy = ray.oy * scale + shift.y;
        ray.oz = ray.oz * scale + shift.z;
        ray.t_max *= scale;
        rays.push_back(ray);
    }
    Tracer tracer(placed);
    const Score closest = score_closest(placed, rays, tracer.closest(rays));
    const Score occluded = score_occluded(placed, rays, tracer.occluded(rays));
    INFO(name << ", scale " << scale << ": " << closest.hits << " hits, " << closest.unsure
              << " rays with more than one right answer, first wrong: closest "
              << closest.first_wrong << ", occluded " << occluded.first_wrong);
    CHECK(closest.hits > 0);
    CHECK(closest.wrong == 0);
    CHECK(occluded.wrong == 0);
    CHECK(closest.unsure <= unsure_share * kRays);
}

}  // namespace

TEST_CASE("random_rays_agree_with_brute_force") {
    const Vec3 here(0);
    check_agreement("soup", make_soup(600, 1), random_ray, 1, here, 0.001);
    check_agreement("sphere", make_sphere(16, 0.1f), aimed_ray, 1, here, 0.001);
    check_agreement("terrain", make_terrain(20, 0.1f), aimed_ray, 1, here, 0.001);
}

TEST_CASE("grazing_rays_agree_with_brute_force") {
    check_agreement("soup", make_soup(400, 2), grazing_ray);
    check_agreement("terrain", make_terrain(16, 0.02f), grazing_ray);
    check_agreement("cube", make_cube(7), grazing_ray);
}

TEST_CASE("axis_parallel_rays_agree_with_brute_force") {
    check_agreement("cube", make_cube(8), axis_ray);
    check_agreement("soup", make_soup(500, 3), axis_ray);
}

TEST_CASE("rays_through_edges_and_vertices_agree_with_brute_force") {
    check_agreement("sphere", make_sphere(14, 0), edge_ray);
    check_agreement("cube", make_cube(8), edge_ray);
}

TEST_CASE("rays_at_slivers_agree_with_brute_force") {
    check_agreement("slivers", make_slivers(500, 4), aimed_ray);
}

TEST_CASE("rays_that_leave_a_triangle_agree_with_brute_force") {
    check_agreement("sphere", make_sphere(14, 0.1f), leaving_ray);
    check_agreement("cube", make_cube(8), leaving_ray);
}

TEST_CASE("answers_do_not_depend_on_scale_or_place") {
    const Triangles sphere = make_sphere(12, 0.1f), soup = make_soup(300, 5);
    for (const float scale : {1e-4f, 1e-2f, 1e2f, 1e5f}) {
        check_agreement("soup", soup, random_ray, scale, Vec3(0), 0.001);
        check_agreement("cube", make_cube(6), axis_ray, scale);
    }
    check_agreement("far sphere", sphere, aimed_ray, 1, Vec3(1e5f, -1e5f, 1e5f));
    check_agreement("far big sphere", sphere, aimed_ray, 1e4f, Vec3(1e5f, 3e5f, -2e5f));
    check_agreement("far tiny cube", make_cube(6), axis_ray, 0.5f, Vec3(1e5f, 0, 0));
}
