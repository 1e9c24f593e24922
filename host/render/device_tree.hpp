// The tree in device memory, in the layout that suits the device.
#pragma once

#include <CL/opencl.hpp>
#include <string>
#include <vector>

#include "host/bvh/bvh.hpp"
#include "host/device/device.hpp"

namespace wedge::rendering {

struct DeviceTree {
    std::vector<cl::Buffer> arrays;  ///< in the order of WEDGE_TREE_PARAMS (kernels/lib/tree.clh)
    /// For every program that traces rays through it, e.g. "WEDGE_BVH_LAYOUT=1". None where the
    /// layout is wide and nothing is cut.
    std::vector<std::string> defines;
    uint64_t bytes = 0;

    /// Sets WEDGE_TREE_PARAMS from argument `first` on; returns the next
    /// index.
    cl_uint set_args(cl::Kernel& kernel, cl_uint first) const;
};

/// `wide` for CPUs, `compressed` for others.
BvhLayout suitable_layout(const DeviceInfo& device);

/// Arrays larger than the device's largest buffer, or `options.largest_buffer_bytes`, are cut into
/// chunks. Throws Error(device) where something does not fit.
DeviceTree upload_tree(device::Device& device, const bvh::Bvh& tree,
                       const BvhOptions& options = {});

}  // namespace wedge::rendering
