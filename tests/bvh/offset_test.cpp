// Rays that leave a surface start beside it: on the right side, and hardly farther than rounding.
#include <doctest/doctest.h>

#include "tracer.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

/// As kernels/trace.cl reads it.
struct OffsetQuery {
    shared::float4 v0, v1, v2;    // xyz
    shared::float4 barycentrics;  // x, y: of v1 and v2
    shared::float4 direction;     // xyz
};

std::vector<Vec3> offset_origins(std::span<const OffsetQuery> queries) {
    device::Device& device = test_device();
    const device::ProgramRequest request{"kernels/trace.cl", {}};
    const auto programs = device::build_programs(device, {&request, 1}, kernel_dir());
    cl::Kernel kernel = programs[0].kernel("offset_origins");
    const cl::Buffer in = device.upload(queries, "queries");
    const cl::Buffer out = device.allocate(queries.size() * sizeof(shared::float4), "origins");
    kernel.setArg(0, in);
    kernel.setArg(1, out);
    kernel.setArg(2, cl_uint(queries.size()));
    device.launch(kernel, queries.size());
    device.finish();
    std::vector<shared::float4> origins(queries.size());
    device.download(out, origins.data(), origins.size() * sizeof(shared::float4));
    std::vector<Vec3> result;
    for (const shared::float4& o : origins) result.push_back({o.x, o.y, o.z});
    return result;
}

shared::float4 pack(const Vec3& v) {
    return {v.x, v.y, v.z, 0};
}

}  // namespace

TEST_CASE("offset_origins_lie_on_the_side_of_the_direction_and_close") {
    using Double3 = glm::dvec3;
    Random random(11);
    for (const float scale : {1e-4f, 1.0f, 1e5f})
        for (const float away : {0.0f, 1.0f, 1e4f}) {
            CAPTURE(scale);
            CAPTURE(away);
            std::vector<OffsetQuery> queries;
            for (int i = 0; i < 20000; ++i) {
                const Vec3 centre = scale * away * uniform_direction(random);
                OffsetQuery q;
                q.v0 = pack(centre + uniform_in_box(random, scale));
                q.v1 = pack(centre + uniform_in_box(random, scale));
                q.v2 = pack(centre + uniform_in_box(random, scale));
                const float u = uniform(random, 0, 1), v = uniform(random, 0, 1 - u);
                q.barycentrics = {u, v, 0, 0};
                q.direction = pack(uniform_direction(random));
                queries.push_back(q);
            }
            const std::vector<Vec3> origins = offset_origins(queries);
            int wrong_side = 0, too_far = 0;
            for (std::size_t i = 0; i < queries.size(); ++i) {
                const OffsetQuery& q = queries[i];
                const Double3 v0(q.v0.x, q.v0.y, q.v0.z), v1(q.v1.x, q.v1.y, q.v1.z),
                    v2(q.v2.x, q.v2.y, q.v2.z), w(q.direction.x, q.direction.y, q.direction.z);
                const Double3 normal = glm::normalize(glm::cross(v1 - v0, v2 - v0));
                const double sine = glm::length(glm::cross(v1 - v0, v2 - v0)) /
                                    (glm::length(v1 - v0) * glm::length(v2 - v0));
                // Where the normal itself is all rounding, or the direction is in the plane, there
                // is no right side.
                if (sine < 0.01 || std::abs(glm::dot(normal, w)) < 1e-3) continue;
                const double height =
                    glm::dot(normal, Double3(origins[i]) - v0) * (glm::dot(normal, w) > 0 ? 1 : -1);
                const double size = std::max({glm::length(v0), glm::length(v1), glm::length(v2)});
                wrong_side += !(height > 0);
                too_far += !(height < 5e-6 * size);
            }
            CHECK(wrong_side == 0);
            CHECK(too_far == 0);
        }
}
