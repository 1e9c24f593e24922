// Kernels from source text or cache to something that can be launched.
#pragma once

#include <CL/opencl.hpp>
#include <span>
#include <string>
#include <vector>

#include "host/device/device.hpp"

namespace wedge::device {

/// One kernel file and the coarse feature switches it is compiled with.
struct ProgramRequest {
    std::string file;                  ///< "kernels/path.cl"
    std::vector<std::string> defines;  ///< "WEDGE_SPECULAR=1"
};

struct Program {
    cl::Program program;
    bool from_cache = false;
    /// Throws Error(device) if there is no such kernel.
    cl::Kernel kernel(const char* name) const;
};

/// `kernels/x.cl` with every `#include "…"` replaced by the file it names (each file once), so that
/// the driver sees one flat text. Files come from the program itself or, if `kernel_dir` is given,
/// from that source tree. Include names are from include/ ("wedge/shared/bvh.h") or from kernels/
/// ("lib/trace.clh"; "kernels/lib/trace.clh" is the same). An include stands outside every `#if`.
/// `#line` directives keep file names and lines in build logs true. Throws Error(internal /
/// bad_input).
std::string assemble_source(const std::string& file, const std::string& kernel_dir = "");

/// What the compiler is called with: OpenCL C 1.2 and the request's defines.
std::string build_options(const ProgramRequest& request);

/// Builds all, in parallel, each from the binary cache if it is there. Throws Error(device) with
/// the device's name and the build log. Cache: $WEDGE_CACHE_DIR, else $XDG_CACHE_HOME/wedge, else
/// ~/.cache/wedge; off if WEDGE_CACHE=0 and on PoCL, which has its own (there `from_cache` says
/// whether PoCL's was warm cannot be known and is false). Any fault of the cache falls back to the
/// source silently.
std::vector<Program> build_programs(Device& device, std::span<const ProgramRequest> requests,
                                    const std::string& kernel_dir = "");

}  // namespace wedge::device
