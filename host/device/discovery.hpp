// Which OpenCL devices there are, and which one a selector means.
#pragma once

#include <CL/opencl.hpp>
#include <span>
#include <string>
#include <vector>

#include "wedge/device.hpp"

namespace wedge::device {

struct FoundDevice {
    DeviceInfo info;
    cl::Device handle;
};

/// Every device of every platform, in the platforms' order. A platform that fails is left out with
/// a warning. Makes the first OpenCL call of the process, after setting up the environment for
/// PoCL.
std::vector<FoundDevice> find_devices();

/// The place in `devices` of the one that `selector` means (see Device), `selector` empty:
/// WEDGE_DEVICE, then the first GPU, then the first. Throws Error(device) that lists what there is,
/// or says how to get a device if there is none.
std::size_t select_device(std::span<const DeviceInfo> devices, const std::string& selector);

}  // namespace wedge::device
