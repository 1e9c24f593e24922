// What is measured: a tracer is given rays and says how long it took.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/rays.hpp"
#include "host/bvh/bvh.hpp"
#include "host/device/device.hpp"

namespace wedge::bench {

class Tracer {
  public:
    virtual ~Tracer() = default;
    virtual void load(const RaySet& set) = 0;   ///< not timed
    virtual double trace() = 0;                 ///< seconds for the set loaded
    virtual std::vector<PackedHit> hits() = 0;  ///< of the last trace
    double build_s = 0;                         ///< of the acceleration structure
};

/// The kernels on `device`, which must outlive the tracer. `local_size` 0: what suits the device.
std::unique_ptr<Tracer> make_kernel_tracer(device::Device& device, const bvh::Bvh& tree,
                                           uint32_t local_size);

/// Embree's rtcIntersect1 and rtcOccluded1 on all cores; null in a build without Embree.
std::unique_ptr<Tracer> make_embree_tracer(const rendering::FlatScene& flat);

}  // namespace wedge::bench
