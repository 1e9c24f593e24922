#include "tracer.hpp"

#include <cstdlib>

namespace wedge::test {
namespace {

const device::Program& trace_program(bool portable) {
    static std::vector<device::Program> programs = [] {
        const std::vector<device::ProgramRequest> requests = {
            {"kernels/trace.cl", {}}, {"kernels/trace.cl", {"WEDGE_PORTABLE_LANES=1"}}};
        return device::build_programs(test_device(), requests, kernel_dir());
    }();
    return programs[portable ? 1 : 0];
}

}  // namespace

std::string kernel_dir() {
    const char* folder = std::getenv("WEDGE_KERNEL_DIR");
    return folder ? folder : "";
}

PackedRay make_ray(const Vec3& origin, const Vec3& direction, float t_max, uint32_t source) {
    return {origin.x, origin.y, origin.z, t_max, direction.x, direction.y, direction.z, source};
}

device::Device& test_device() {
    static device::Device instance;
    return instance;
}

Tracer::Tracer(const Triangles& triangles, bool portable)
    : tree_(bvh::build(triangles.positions, triangles.indices)),
      nodes_(test_device().upload(std::span<const shared::BvhNode>(tree_.nodes), "nodes")),
      blocks_(test_device().upload(std::span<const shared::TriangleBlock>(tree_.blocks), "blocks")),
      closest_(trace_program(portable).kernel("trace_closest_rays")),
      occluded_(trace_program(portable).kernel("trace_occluded_rays")) {}

std::vector<PackedHit> Tracer::run(cl::Kernel& kernel, std::span<const PackedRay> rays) {
    device::Device& device = test_device();
    const cl::Buffer packed = device.upload(rays, "rays");
    const cl::Buffer found = device.allocate(rays.size() * sizeof(PackedHit), "hits");
    kernel.setArg(0, nodes_);
    kernel.setArg(1, blocks_);
    kernel.setArg(2, packed);
    kernel.setArg(3, found);
    kernel.setArg(4, cl_uint(rays.size()));
    device.launch(kernel, rays.size());
    device.finish();
    std::vector<PackedHit> hits(rays.size());
    device.download(found, hits.data(), hits.size() * sizeof(PackedHit));
    return hits;
}

}  // namespace wedge::test
