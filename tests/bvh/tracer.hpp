// A set of triangles on the device, ready for rays.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/bvh/bvh.hpp"
#include "host/device/device.hpp"
#include "host/device/program.hpp"
#include "host/render/device_tree.hpp"
#include "meshes.hpp"

namespace wedge::test {

/// As kernels/trace.cl reads and writes them.
struct PackedRay {
    float ox, oy, oz, t_max;
    float dx, dy, dz;
    uint32_t source;
};
struct PackedHit {
    float t, u, v;
    uint32_t primitive;
    bool operator==(const PackedHit&) const = default;
};

PackedRay make_ray(const Vec3& origin, const Vec3& direction, float t_max = INFINITY,
                   uint32_t source = WEDGE_NO_PRIMITIVE);

/// $WEDGE_KERNEL_DIR, for trying kernels without building the program anew, or empty.
std::string kernel_dir();

/// The device all tests of this program share.
device::Device& test_device();

struct TracerOptions {
    bool portable = false;  ///< without the builtins of the processor
    BvhOptions bvh;
};

class Tracer {
  public:
    explicit Tracer(const Triangles& triangles, const TracerOptions& options = {});
    explicit Tracer(bvh::Bvh tree, const TracerOptions& options = {});
    std::vector<PackedHit> closest(std::span<const PackedRay> rays) { return run(closest_, rays); }
    std::vector<PackedHit> occluded(std::span<const PackedRay> rays) {
        return run(occluded_, rays);
    }
    const bvh::Bvh& tree() const { return tree_; }
    const rendering::DeviceTree& on_device() const { return device_tree_; }

  private:
    std::vector<PackedHit> run(cl::Kernel& kernel, std::span<const PackedRay> rays);

    bvh::Bvh tree_;
    rendering::DeviceTree device_tree_;
    cl::Kernel closest_, occluded_;
};

}  // namespace wedge::test
