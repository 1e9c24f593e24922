// How PoCL, which makes an OpenCL device of the CPU, is to run kernels.
#pragma once

namespace wedge::device {

/// Sets POCL_WORK_GROUP_METHOD and POCL_AFFINITY (docs/cli.md) where the user has not. PoCL reads
/// them once, so this must come before the first OpenCL call; from the second time on it does
/// nothing.
void prepare_pocl();

}  // namespace wedge::device
