#include "tracer.hpp"

#include <cstdlib>
#include <map>

namespace wedge::test {
namespace {

const device::Program& trace_program(const std::vector<std::string>& defines) {
    static std::map<std::vector<std::string>, device::Program> programs;
    const auto found = programs.find(defines);
    if (found != programs.end()) return found->second;
    const device::ProgramRequest request{"kernels/trace.cl", defines};
    return programs[defines] =
               device::build_programs(test_device(), {&request, 1}, kernel_dir()).front();
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

Tracer::Tracer(const Triangles& triangles, const TracerOptions& options)
    : Tracer(bvh::build(triangles.positions, triangles.indices, options.bvh.quality), options) {}

Tracer::Tracer(bvh::Bvh tree, const TracerOptions& options)
    : tree_(std::move(tree)),
      device_tree_(rendering::upload_tree(test_device(), tree_, options.bvh)) {
    std::vector<std::string> defines = device_tree_.defines;
    if (options.portable) defines.push_back("WEDGE_PORTABLE_LANES=1");
    closest_ = trace_program(defines).kernel("trace_closest_rays");
    occluded_ = trace_program(defines).kernel("trace_occluded_rays");
}

std::vector<PackedHit> Tracer::run(cl::Kernel& kernel, std::span<const PackedRay> rays) {
    device::Device& device = test_device();
    const cl::Buffer packed = device.upload(rays, "rays");
    const cl::Buffer found = device.allocate(rays.size() * sizeof(PackedHit), "hits");
    cl_uint arg = device_tree_.set_args(kernel, 0);
    kernel.setArg(arg++, packed);
    kernel.setArg(arg++, found);
    kernel.setArg(arg++, cl_uint(rays.size()));
    device.launch(kernel, rays.size());
    device.finish();
    std::vector<PackedHit> hits(rays.size());
    device.download(found, hits.data(), hits.size() * sizeof(PackedHit));
    return hits;
}

}  // namespace wedge::test
