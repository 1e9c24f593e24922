// Closed meshes let no ray out.
#include <doctest/doctest.h>

#include "brute_force.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

/// Rays from a box of half side `reach` about the centre, which must lie inside, through random
/// points, edges and vertices; returns how many get out.
uint64_t count_leaks(const Triangles& mesh, const Vec3& centre, float reach, int count,
                     uint32_t seed) {
    Random random(seed);
    std::vector<PackedRay> rays;
    for (int i = 0; i < count; ++i) {
        const Vec3 origin = i % 8 == 0 ? centre : centre + uniform_in_box(random, reach);
        const UVec3 t = mesh.indices[random() % mesh.indices.size()];
        const Vec3 v0 = mesh.positions[t.x], v1 = mesh.positions[t.y];
        const int kind = random() % 4;
        const Vec3 target = kind == 0   ? v0
                            : kind == 1 ? 0.5f * v0 + 0.5f * v1
                                        : glm::mix(v0, v1, uniform(random, 0, 1));
        rays.push_back(make_ray(origin, target - origin));
    }
    Tracer tracer(mesh);
    uint64_t leaks = 0;
    for (const PackedHit& hit : tracer.closest(rays)) leaks += hit.primitive == WEDGE_NO_PRIMITIVE;
    for (const PackedHit& hit : tracer.occluded(rays)) leaks += hit.primitive == WEDGE_NO_PRIMITIVE;
    return leaks;
}

}  // namespace

TEST_CASE("no_ray_leaves_a_closed_mesh") {
    constexpr int kRays = 250000;
    CHECK(count_leaks(make_sphere(24, 0), Vec3(0), 0.5f, kRays, 1) == 0);
    CHECK(count_leaks(make_sphere(200, 0.05f), Vec3(0), 0.5f, kRays, 2) == 0);
    CHECK(count_leaks(make_cube(16), Vec3(0), 0.9f, kRays, 3) == 0);
    // The poles of this one are fans of needles.
    CHECK(count_leaks(make_sphere(400, 0), Vec3(0), 0.55f, kRays, 4) == 0);
}

TEST_CASE("no_ray_leaves_a_closed_mesh_at_any_scale") {
    constexpr int kRays = 100000;
    for (const float scale : {1e-4f, 1e5f}) {
        const Triangles sphere = transformed(make_sphere(40, 0.05f), scale, Vec3(0));
        CHECK(count_leaks(sphere, Vec3(0), 0.5f * scale, kRays, 5) == 0);
    }
    // Far away, vertices fall on a coarse grid of floats, but the mesh stays closed.
    const Vec3 far(1e5f, -1e5f, 1e5f);
    CHECK(count_leaks(transformed(make_sphere(20, 0.05f), 1, far), far, 0.5f, kRays, 6) == 0);
    CHECK(count_leaks(transformed(make_cube(8), 1, far), far, 0.5f, kRays, 7) == 0);
}

TEST_CASE("axis_parallel_rays_do_not_slip_between_faces") {
    // Every ray runs within the planes in which edges and vertices lie.
    const int n = 8;
    const Triangles cube = make_cube(n);
    std::vector<PackedRay> rays;
    for (int axis = 0; axis < 3; ++axis)
        for (int a = 0; a <= n; ++a)
            for (int b = 0; b <= n; ++b)
                for (const float sign : {-1.0f, 1.0f})
                    for (const float zero : {0.0f, -0.0f}) {
                        Vec3 origin(0), direction(zero);
                        origin[(axis + 1) % 3] = 2.0f * a / n - 1;
                        origin[(axis + 2) % 3] = 2.0f * b / n - 1;
                        direction[axis] = sign;
                        rays.push_back(make_ray(origin, direction));
                    }
    Tracer tracer(cube);
    uint64_t leaks = 0;
    for (const PackedHit& hit : tracer.closest(rays)) {
        leaks += hit.primitive == WEDGE_NO_PRIMITIVE;
        CHECK((hit.primitive == WEDGE_NO_PRIMITIVE || hit.t == doctest::Approx(1)));
    }
    CHECK(leaks == 0);
}
