#include "host/device/discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <optional>

#include "host/device/device.hpp"
#include "host/device/pocl.hpp"
#include "host/device/status.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge {
namespace device {
namespace {

constexpr cl_int kPlatformNotFound = -1001;  // CL_PLATFORM_NOT_FOUND_KHR, from cl_khr_icd

DeviceType type_of(cl_device_type type) {
    if (type & CL_DEVICE_TYPE_GPU) return DeviceType::gpu;
    if (type & CL_DEVICE_TYPE_CPU) return DeviceType::cpu;
    return DeviceType::accelerator;
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device) {
    DeviceInfo info;
    info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
    info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
    info.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
    info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
    info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
    info.platform_version = trimmed(platform.getInfo<CL_PLATFORM_VERSION>());
    info.type = type_of(device.getInfo<CL_DEVICE_TYPE>());
    info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.largest_buffer_bytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    return info;
}

void append_devices(const cl::Platform& platform, std::vector<FoundDevice>& found) {
    std::vector<cl::Device> handles;
    platform.getDevices(CL_DEVICE_TYPE_ALL, &handles);
    for (const cl::Device& handle : handles) {
        found.push_back({describe(platform, handle), handle});
        found.back().info.index = int(found.size()) - 1;
    }
}

std::string lower_case(std::string text) {
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::optional<std::size_t> first_of_type(std::span<const DeviceInfo> devices, DeviceType type) {
    const auto it = std::ranges::find(devices, type, &DeviceInfo::type);
    if (it == devices.end()) return std::nullopt;
    return std::size_t(it - devices.begin());
}

std::optional<std::size_t> find_selected(std::span<const DeviceInfo> devices,
                                         const std::string& selector) {
    const std::string wanted = lower_case(selector);
    if (wanted == "gpu") return first_of_type(devices, DeviceType::gpu);
    if (wanted == "cpu") return first_of_type(devices, DeviceType::cpu);

    std::size_t index = 0;
    const char* end = wanted.data() + wanted.size();
    if (const auto [stop, status] = std::from_chars(wanted.data(), end, index); stop == end) {
        if (status == std::errc() && index < devices.size()) return index;
        return std::nullopt;
    }
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (lower_case(devices[i].name).find(wanted) != std::string::npos) return i;
    }
    return std::nullopt;
}

}  // namespace

std::vector<FoundDevice> find_devices() {
    prepare_pocl();
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error& error) {
        if (error.err() != kPlatformNotFound) {
            log_warning("cannot list the OpenCL platforms: " + status_name(error.err()));
        }
        return {};
    }

    std::vector<FoundDevice> found;
    for (const cl::Platform& platform : platforms) {
        const std::size_t before = found.size();
        try {
            append_devices(platform, found);
        } catch (const cl::Error& error) {
            found.resize(before);
            if (error.err() == CL_DEVICE_NOT_FOUND) continue;
            log_warning("an OpenCL platform is left out, its devices cannot be listed: " +
                        status_name(error.err()));
        }
    }
    return found;
}

std::size_t select_device(std::span<const DeviceInfo> devices, const std::string& selector) {
    if (devices.empty()) {
        throw Error(ErrorKind::device,
                    "no OpenCL device found; on Debian: apt-get install pocl-opencl-icd");
    }
    std::string wanted = selector;
    std::string origin = "--device";
    if (const char* variable = std::getenv("WEDGE_DEVICE"); wanted.empty() && variable) {
        wanted = variable;
        origin = "WEDGE_DEVICE";
    }
    if (wanted.empty()) return first_of_type(devices, DeviceType::gpu).value_or(0);
    if (const auto index = find_selected(devices, wanted)) return *index;

    std::string message = fmt::format(
        "{}: no OpenCL device is \"{}\"; give an index, part of a name, cpu or gpu. There are:",
        origin, wanted);
    for (const DeviceInfo& info : devices) {
        message += fmt::format("\n  {}: {} ({})", info.index, info.name, info.platform);
    }
    throw Error(ErrorKind::device, message);
}

}  // namespace device

const char* name_of(DeviceType type) {
    switch (type) {
        case DeviceType::cpu:
            return "cpu";
        case DeviceType::gpu:
            return "gpu";
        case DeviceType::accelerator:
            break;
    }
    return "accelerator";
}

std::vector<DeviceInfo> list_devices() {
    std::vector<DeviceInfo> infos;
    for (device::FoundDevice& found : device::find_devices())
        infos.push_back(std::move(found.info));
    return infos;
}

}  // namespace wedge
