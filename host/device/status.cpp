#include "host/device/status.hpp"

#include <fmt/format.h>

#include "host/device/device.hpp"
#include "wedge/error.hpp"

namespace wedge::device {
namespace {

struct NamedStatus {
    cl_int status;
    const char* name;
};

#define WEDGE_STATUS(name) \
    { name, #name }
constexpr NamedStatus kStatuses[] = {
    WEDGE_STATUS(CL_SUCCESS),
    WEDGE_STATUS(CL_DEVICE_NOT_FOUND),
    WEDGE_STATUS(CL_DEVICE_NOT_AVAILABLE),
    WEDGE_STATUS(CL_COMPILER_NOT_AVAILABLE),
    WEDGE_STATUS(CL_MEM_OBJECT_ALLOCATION_FAILURE),
    WEDGE_STATUS(CL_OUT_OF_RESOURCES),
    WEDGE_STATUS(CL_OUT_OF_HOST_MEMORY),
    WEDGE_STATUS(CL_PROFILING_INFO_NOT_AVAILABLE),
    WEDGE_STATUS(CL_MEM_COPY_OVERLAP),
    WEDGE_STATUS(CL_IMAGE_FORMAT_MISMATCH),
    WEDGE_STATUS(CL_IMAGE_FORMAT_NOT_SUPPORTED),
    WEDGE_STATUS(CL_BUILD_PROGRAM_FAILURE),
    WEDGE_STATUS(CL_MAP_FAILURE),
    WEDGE_STATUS(CL_MISALIGNED_SUB_BUFFER_OFFSET),
    WEDGE_STATUS(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST),
    WEDGE_STATUS(CL_COMPILE_PROGRAM_FAILURE),
    WEDGE_STATUS(CL_LINKER_NOT_AVAILABLE),
    WEDGE_STATUS(CL_LINK_PROGRAM_FAILURE),
    WEDGE_STATUS(CL_DEVICE_PARTITION_FAILED),
    WEDGE_STATUS(CL_KERNEL_ARG_INFO_NOT_AVAILABLE),
    WEDGE_STATUS(CL_INVALID_VALUE),
    WEDGE_STATUS(CL_INVALID_DEVICE_TYPE),
    WEDGE_STATUS(CL_INVALID_PLATFORM),
    WEDGE_STATUS(CL_INVALID_DEVICE),
    WEDGE_STATUS(CL_INVALID_CONTEXT),
    WEDGE_STATUS(CL_INVALID_QUEUE_PROPERTIES),
    WEDGE_STATUS(CL_INVALID_COMMAND_QUEUE),
    WEDGE_STATUS(CL_INVALID_HOST_PTR),
    WEDGE_STATUS(CL_INVALID_MEM_OBJECT),
    WEDGE_STATUS(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR),
    WEDGE_STATUS(CL_INVALID_IMAGE_SIZE),
    WEDGE_STATUS(CL_INVALID_SAMPLER),
    WEDGE_STATUS(CL_INVALID_BINARY),
    WEDGE_STATUS(CL_INVALID_BUILD_OPTIONS),
    WEDGE_STATUS(CL_INVALID_PROGRAM),
    WEDGE_STATUS(CL_INVALID_PROGRAM_EXECUTABLE),
    WEDGE_STATUS(CL_INVALID_KERNEL_NAME),
    WEDGE_STATUS(CL_INVALID_KERNEL_DEFINITION),
    WEDGE_STATUS(CL_INVALID_KERNEL),
    WEDGE_STATUS(CL_INVALID_ARG_INDEX),
    WEDGE_STATUS(CL_INVALID_ARG_VALUE),
    WEDGE_STATUS(CL_INVALID_ARG_SIZE),
    WEDGE_STATUS(CL_INVALID_KERNEL_ARGS),
    WEDGE_STATUS(CL_INVALID_WORK_DIMENSION),
    WEDGE_STATUS(CL_INVALID_WORK_GROUP_SIZE),
    WEDGE_STATUS(CL_INVALID_WORK_ITEM_SIZE),
    WEDGE_STATUS(CL_INVALID_GLOBAL_OFFSET),
    WEDGE_STATUS(CL_INVALID_EVENT_WAIT_LIST),
    WEDGE_STATUS(CL_INVALID_EVENT),
    WEDGE_STATUS(CL_INVALID_OPERATION),
    WEDGE_STATUS(CL_INVALID_BUFFER_SIZE),
    WEDGE_STATUS(CL_INVALID_GLOBAL_WORK_SIZE),
    WEDGE_STATUS(CL_INVALID_PROPERTY),
    {-1001, "CL_PLATFORM_NOT_FOUND_KHR"},
};
#undef WEDGE_STATUS

const char* advice(cl_int status) {
    switch (status) {
        case CL_MEM_OBJECT_ALLOCATION_FAILURE:
        case CL_OUT_OF_HOST_MEMORY:
            return "; render a smaller image or scene, or choose another device with --device";
        case CL_OUT_OF_RESOURCES:
            return "; the device is out of memory or a kernel ran into a fault or the driver's "
                   "time "
                   "limit: try a smaller image, or another device with --device";
        case CL_DEVICE_NOT_AVAILABLE:
        case CL_COMPILER_NOT_AVAILABLE:
            return "; choose another device with --device";
        default:
            return "";
    }
}

}  // namespace

std::string status_name(cl_int status) {
    for (const NamedStatus& known : kStatuses) {
        if (known.status == status) return fmt::format("{} ({})", known.name, status);
    }
    return fmt::format("unknown OpenCL status ({})", status);
}

void throw_status(const std::string& device, const std::string& attempt, cl_int status) {
    throw Error(ErrorKind::device, fmt::format("device {}: cannot {}: {}{}", device, attempt,
                                               status_name(status), advice(status)));
}

std::string trimmed(const std::string& text) {
    const std::string padding(" \t\n\r\0", 5);
    const std::size_t first = text.find_first_not_of(padding);
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(padding) - first + 1);
}

}  // namespace wedge::device
