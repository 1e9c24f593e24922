// One opened OpenCL device: context, queue, and the checks around them.
#pragma once

#include <CL/opencl.hpp>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "wedge/device.hpp"

namespace wedge::device {

/// Owns the context and an in-order queue with profiling. Movable, not copyable.
class Device {
  public:
    /// `selector`: index as listed, part of a name (any case), `cpu`, `gpu`, or empty: then
    /// WEDGE_DEVICE, then the first GPU, then the first device. Throws Error(device) that lists
    /// what there is.
    explicit Device(const std::string& selector = "");
    Device(Device&&) = default;
    Device& operator=(Device&&) = default;

    const DeviceInfo& info() const { return info_; }
    const cl::Context& context() const { return context_; }
    const cl::Device& handle() const { return device_; }
    const cl::CommandQueue& queue() const { return queue_; }

    /// True for PoCL, which caches programs itself and wants small work-groups.
    bool is_pocl() const;

    /// Device memory; `what` names it in errors. Throws Error(device) with the sizes if it is
    /// larger than the device's largest buffer or cannot be had. A request of 0 bytes gives a small
    /// buffer.
    cl::Buffer allocate(uint64_t bytes, const std::string& what,
                        cl_mem_flags flags = CL_MEM_READ_WRITE);

    /// The same, all bits 0. Where the device's memory is the host's, pages are there only once
    /// they are touched.
    cl::Buffer allocate_zeros(uint64_t bytes, const std::string& what);

    /// Allocates and fills; kernels may only read it, unless `flags` say otherwise.
    template <typename T>
    cl::Buffer upload(std::span<const T> items, const std::string& what) {
        return upload_bytes(items.data(), items.size_bytes(), what);
    }
    cl::Buffer upload_bytes(const void* data, uint64_t bytes, const std::string& what,
                            cl_mem_flags flags = CL_MEM_READ_ONLY);

    /// Blocking write of `bytes` to the start of `buffer`.
    void overwrite(const cl::Buffer& buffer, const void* data, uint64_t bytes);
    /// Blocking read of `bytes` from the start of `buffer`.
    void download(const cl::Buffer& buffer, void* data, uint64_t bytes);

    /// Enqueues `kernel` over `count` work-items (rounded up to whole groups: kernels check their
    /// index). `local` 0: what suits the device. Returns the profiling event. Throws Error(device)
    /// that names kernel, device, sizes.
    cl::Event launch(const cl::Kernel& kernel, uint64_t count, uint32_t local = 0);

    /// Waits until all is done. Throws Error(device).
    void finish();

    /// All that was ever asked for, released or not.
    uint64_t allocated_bytes() const { return allocated_bytes_; }

  private:
    cl::Buffer create(uint64_t bytes, const std::string& what,
                      const std::function<cl::Buffer(uint64_t size)>& make);

    void fill_with_zeros(const cl::Buffer& buffer, uint64_t bytes, const std::string& what);

    /// Where the device's memory is the host's: rays jump about in it, and large pages take less
    /// time to be found and to be had.
    void prefer_large_pages(const cl::Buffer& buffer, uint64_t bytes);

    DeviceInfo info_;
    cl::Device device_;
    cl::Context context_;
    cl::CommandQueue queue_;
    uint64_t allocated_bytes_ = 0;
};

/// Seconds the event's command ran on the device. Waits for it.
double device_seconds(const cl::Event& event);

/// Text for an OpenCL status, e.g. "CL_OUT_OF_RESOURCES (-5)".
std::string status_name(cl_int status);

}  // namespace wedge::device
