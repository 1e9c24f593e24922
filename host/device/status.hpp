// What an OpenCL failure becomes: a wedge::Error that says which device, doing what, and why.
#pragma once

#include <CL/opencl.hpp>
#include <string>

namespace wedge::device {

/// Throws Error(device): `device NAME: cannot ATTEMPT: STATUS`, with advice where there is some.
[[noreturn]] void throw_status(const std::string& device, const std::string& attempt,
                               cl_int status);

/// Text with the zeros and blanks that drivers leave at its ends removed.
std::string trimmed(const std::string& text);

}  // namespace wedge::device
