// Memory of the host that is zero and costs nothing until it is touched.
#pragma once

#include <CL/opencl.hpp>
#include <cstdint>

namespace wedge::device {

/// A buffer of `bytes` zeros in pages that the operating system hands out when they are touched
/// first, large ones if it has some; they go when the buffer does. For devices whose memory is the
/// host's. Empty where there are no such pages. Throws cl::Error if the driver refuses.
cl::Buffer zero_pages(const cl::Context& context, uint64_t bytes);

/// Pages of 2 MiB in place of 4 KiB for memory that has not been touched yet. A hint, which may be
/// ignored.
void ask_for_large_pages(void* memory, uint64_t bytes);

}  // namespace wedge::device
