// The OpenCL devices of this machine, for choosing one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace wedge {

enum class DeviceType { cpu, gpu, accelerator };
const char* name_of(DeviceType type);

struct DeviceInfo {
    int index = 0;  ///< as listed; what `--device N` takes
    std::string name, vendor, version, driver, platform, platform_version;
    DeviceType type = DeviceType::cpu;
    uint32_t compute_units = 0;
    uint64_t memory_bytes = 0;
    uint64_t largest_buffer_bytes = 0;
};

/// Every device of every platform, in the order the platforms give them. Empty if there is none.
std::vector<DeviceInfo> list_devices();

}  // namespace wedge
