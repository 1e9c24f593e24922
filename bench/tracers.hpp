// What is measured: a tracer is given rays and says how long it took.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/rays.hpp"
#include "host/device/device.hpp"
#include "host/render/device_tree.hpp"

namespace wedge::bench {

class Tracer {
  public:
    virtual ~Tracer() = default;
    virtual void load(const RaySet& set) = 0;   ///< not timed
    virtual double trace() = 0;                 ///< seconds for the set loaded
    virtual std::vector<PackedHit> hits() = 0;  ///< of the last trace
};

/// The kernels on `device`, which like the tree must outlive the tracer. `local_size` 0: what suits
/// the device.
std::unique_ptr<Tracer> make_kernel_tracer(device::Device& device,
                                           const rendering::DeviceTree& tree, uint32_t local_size);

/// Embree's structure over a scene.
class EmbreeScene {
  public:
    virtual ~EmbreeScene() = default;
    /// rtcIntersect1 and rtcOccluded1 on all cores. The scene must outlive the tracer.
    virtual std::unique_ptr<Tracer> make_tracer() = 0;
    double build_s = 0;
    uint64_t bytes = 0;  ///< of the structure, as Embree counts them, without its copy of the mesh
};

/// Null in a build without Embree.
std::unique_ptr<EmbreeScene> build_embree_scene(const rendering::FlatScene& flat,
                                                BvhQuality quality);

}  // namespace wedge::bench
