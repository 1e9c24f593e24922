// The scene in device memory.
#pragma once

#include <CL/opencl.hpp>

#include "host/bvh/bvh.hpp"
#include "host/device/device.hpp"
#include "host/render/device_tree.hpp"
#include "host/render/flatten.hpp"

namespace wedge::rendering {

struct DeviceScene {
    DeviceTree tree;
    cl::Buffer vertices, triangles, materials, textures, texels, lights;
    cl_uint light_count = 0;
    cl::Buffer long_triangles;  ///< long_triangles.hpp, only where filters need them
    cl_uint long_triangle_count = 0;

    /// Sets WEDGE_SCENE_PARAMS (kernels/lib/scene.clh) from argument `first` on; returns the next
    /// index.
    cl_uint set_args(cl::Kernel& kernel, cl_uint first) const;
};

/// Throws Error(device) where something does not fit.
DeviceScene upload_scene(device::Device& device, const FlatScene& flat, const bvh::Bvh& bvh,
                         const std::vector<Texture>& textures, const BvhOptions& options = {});

/// Fills the list that `scene` has of them. Throws Error(device) where it does not fit.
void upload_long_triangles(device::Device& device, const FlatScene& flat, DeviceScene& scene);

}  // namespace wedge::rendering
