#include "host/device/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "host/device/discovery.hpp"
#include "host/device/status.hpp"
#include "host/device/zero_pages.hpp"
#include "wedge/error.hpp"

namespace wedge::device {
namespace {

// Smaller buffers have no room for a large page.
constexpr uint64_t kLargePagesFrom_bytes = uint64_t(2) << 20;

constexpr uint64_t kEmptyBufferBytes =
    16;  // OpenCL has no buffers of 0 bytes; one float4 suits all

// A group of rays that diverge gains nothing from its size; one item a group lets PoCL balance
// best.
constexpr uint32_t kLocalSizePocl = 1;
constexpr uint32_t kLocalSizeCpu = 16;
constexpr uint32_t kLocalSizeGpu = 64;  // a multiple of every warp and wavefront width in use

double mebibytes(uint64_t bytes) {
    return double(bytes) / (1024.0 * 1024.0);
}

std::string name_of(const cl::Kernel& kernel) {
    try {
        return trimmed(kernel.getInfo<CL_KERNEL_FUNCTION_NAME>());
    } catch (const cl::Error&) {
        return "(unknown)";
    }
}

}  // namespace

Device::Device(const std::string& selector) {
    const std::vector<FoundDevice> found = find_devices();
    std::vector<DeviceInfo> infos;
    for (const FoundDevice& one : found) infos.push_back(one.info);
    const std::size_t chosen = select_device(infos, selector);
    info_ = infos[chosen];
    device_ = found[chosen].handle;
    try {
        context_ = cl::Context(device_);
        queue_ = cl::CommandQueue(context_, device_, CL_QUEUE_PROFILING_ENABLE);
    } catch (const cl::Error& error) {
        throw_status(info_.name, "be opened", error.err());
    }
}

bool Device::is_pocl() const {
    return info_.platform == "Portable Computing Language";
}

cl::Buffer Device::create(uint64_t bytes, const std::string& what,
                          const std::function<cl::Buffer(uint64_t size)>& make) {
    if (bytes > info_.largest_buffer_bytes) {
        throw Error(
            ErrorKind::device,
            fmt::format("device {}: {} needs a buffer of {:.1f} MiB, the largest here is "
                        "{:.1f} MiB; render a smaller image or scene, or choose another "
                        "device with --device",
                        info_.name, what, mebibytes(bytes), mebibytes(info_.largest_buffer_bytes)));
    }
    const uint64_t size = std::max(bytes, kEmptyBufferBytes);
    try {
        cl::Buffer buffer = make(size);
        if (buffer()) allocated_bytes_ += size;
        return buffer;
    } catch (const cl::Error& error) {
        throw_status(info_.name,
                     fmt::format("allocate {:.1f} MiB for {} ({:.1f} MiB asked for before)",
                                 mebibytes(size), what, mebibytes(allocated_bytes_)),
                     error.err());
    }
}

cl::Buffer Device::allocate(uint64_t bytes, const std::string& what, cl_mem_flags flags) {
    return create(bytes, what, [&](uint64_t size) {
        cl::Buffer buffer(context_, flags, size);
        prefer_large_pages(buffer, size);
        return buffer;
    });
}

cl::Buffer Device::allocate_zeros(uint64_t bytes, const std::string& what) {
    if (info_.type == DeviceType::cpu && bytes >= kLargePagesFrom_bytes) {
        const cl::Buffer buffer =
            create(bytes, what, [&](uint64_t size) { return zero_pages(context_, size); });
        if (buffer()) return buffer;
    }
    cl::Buffer buffer = allocate(bytes, what);
    if (bytes > 0) fill_with_zeros(buffer, bytes, what);
    return buffer;
}

void Device::prefer_large_pages(const cl::Buffer& buffer, uint64_t bytes) {
    if (info_.type != DeviceType::cpu || bytes < kLargePagesFrom_bytes) return;
    try {
        void* memory =
            queue_.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0, bytes);
        ask_for_large_pages(memory, bytes);
        queue_.enqueueUnmapMemObject(buffer, memory);
    } catch (const cl::Error&) {
        // A device that cannot map: nothing is lost but time.
    }
}

void Device::fill_with_zeros(const cl::Buffer& buffer, uint64_t bytes, const std::string& what) {
    const cl_uchar zero = 0;
    const cl_int status =
        clEnqueueFillBuffer(queue_(), buffer(), &zero, sizeof(zero), 0, bytes, 0, nullptr, nullptr);
    if (status != CL_SUCCESS)
        throw_status(info_.name, fmt::format("fill {:.1f} MiB for {}", mebibytes(bytes), what),
                     status);
}

cl::Buffer Device::upload_bytes(const void* data, uint64_t bytes, const std::string& what,
                                cl_mem_flags flags) {
    cl::Buffer buffer = allocate(bytes, what, flags);
    if (bytes == 0) return buffer;
    try {
        queue_.enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes, data);
    } catch (const cl::Error& error) {
        throw_status(info_.name, fmt::format("upload {:.1f} MiB of {}", mebibytes(bytes), what),
                     error.err());
    }
    return buffer;
}

void Device::overwrite(const cl::Buffer& buffer, const void* data, uint64_t bytes) {
    if (bytes == 0) return;
    try {
        queue_.enqueueWriteBuffer(buffer, CL_TRUE, 0, bytes, data);
    } catch (const cl::Error& error) {
        throw_status(info_.name, fmt::format("write {:.1f} MiB", mebibytes(bytes)), error.err());
    }
}

void Device::download(const cl::Buffer& buffer, void* data, uint64_t bytes) {
    if (bytes == 0) return finish();
    try {
        queue_.enqueueReadBuffer(buffer, CL_TRUE, 0, bytes, data);
    } catch (const cl::Error& error) {
        throw_status(info_.name, fmt::format("read back {:.1f} MiB", mebibytes(bytes)),
                     error.err());
    }
}

cl::Event Device::launch(const cl::Kernel& kernel, uint64_t count, uint32_t local) {
    cl::Event event;
    uint64_t global = 0;
    try {
        if (count == 0) {  // an empty range is an error to OpenCL 1.2, and nothing to do for us
            queue_.enqueueMarkerWithWaitList(nullptr, &event);
            return event;
        }
        if (local == 0) {
            local = info_.type != DeviceType::cpu ? kLocalSizeGpu
                    : is_pocl()                   ? kLocalSizePocl
                                                  : kLocalSizeCpu;
            const auto largest = kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device_);
            local = uint32_t(std::clamp<std::size_t>(largest, 1, local));
        }
        global = (count + local - 1) / local * local;
        queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(global), cl::NDRange(local),
                                    nullptr, &event);
        return event;
    } catch (const cl::Error& error) {
        throw_status(info_.name,
                     fmt::format("launch kernel {} ({} work-items in groups of {})",
                                 name_of(kernel), global, local),
                     error.err());
    }
}

void Device::finish() {
    try {
        queue_.finish();
    } catch (const cl::Error& error) {
        throw_status(info_.name, "finish its work", error.err());
    }
}

double device_seconds(const cl::Event& event) {
    try {
        event.wait();
        const cl_ulong start_ns = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        const cl_ulong end_ns = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        return end_ns > start_ns ? double(end_ns - start_ns) * 1e-9 : 0.0;
    } catch (const cl::Error& error) {
        if (error.err() == CL_PROFILING_INFO_NOT_AVAILABLE) return 0.0;  // markers have none
        throw Error(ErrorKind::device, "a kernel failed: " + status_name(error.err()));
    }
}

}  // namespace wedge::device
