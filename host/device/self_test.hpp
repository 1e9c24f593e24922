// Does the device compute what it should? Drivers and their compilers have bugs; a wrong image is
// worse than an error.
#pragma once

#include <string>

#include "host/device/device.hpp"

namespace wedge::device {

/// Runs kernels of `kernel_dir` (empty: the program's own) with known answers: integers, floats
/// with infinities and NaN, eight-wide comparison, indices, layout of the shared structures. Throws
/// Error(device) that says what is wrong. A success is remembered in the cache folder for this
/// device, driver and text of the test (also on PoCL; not with WEDGE_CACHE=0), so that this costs a
/// file's read after the first time. Returns true if the kernels ran, false if the success was
/// remembered.
bool self_test(Device& device, const std::string& kernel_dir);

}  // namespace wedge::device
