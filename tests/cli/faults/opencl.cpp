// Stands between the program and OpenCL (LD_PRELOAD) and lets one function fail from its n-th call
// on, as a device does that has gone: WEDGE_TEST_FAULT="clCreateBuffer 5 -4" is function, call,
// status. With WEDGE_TEST_SIGNAL=1 Ctrl-C comes at the first of them, too.
// WEDGE_TEST_LARGEST_BUFFER is the size in bytes of the largest buffer that devices claim to have.
// So failures are tested on the program as it is, without a door for them in it.
#include <CL/cl.h>
#include <dlfcn.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Fault {
    char function[64] = "";
    int call = 0;
    cl_int status = CL_SUCCESS;

    Fault() {
        if (const char* text = std::getenv("WEDGE_TEST_FAULT"))
            if (std::sscanf(text, "%63s %d %d", function, &call, &status) != 3) std::abort();
    }
};

/// The status that this call of `function` has to end with, CL_SUCCESS for most.
cl_int injected(const char* function) {
    static const Fault fault;
    static std::atomic<int> calls{0};
    if (std::strcmp(function, fault.function) != 0) return CL_SUCCESS;
    const int call = ++calls;
    if (call == fault.call && std::getenv("WEDGE_TEST_SIGNAL")) std::raise(SIGINT);
    return call >= fault.call ? fault.status : CL_SUCCESS;
}

template <typename Function>
Function* next(Function*, const char* name) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

// The names and arguments are OpenCL's.
#define WEDGE_FAULTY(name, parameters, ...)                                             \
    extern "C" CL_API_ENTRY cl_int CL_API_CALL name parameters {                        \
        if (const cl_int status = injected(#name); status != CL_SUCCESS) return status; \
        return next(&name, #name)(__VA_ARGS__);                                         \
    }

WEDGE_FAULTY(clEnqueueNDRangeKernel,
             (cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
              const size_t* global, const size_t* local, cl_uint event_count,
              const cl_event* events, cl_event* event),
             queue, kernel, dimensions, offset, global, local, event_count, events, event)

WEDGE_FAULTY(clEnqueueFillBuffer,
             (cl_command_queue queue, cl_mem buffer, const void* pattern, size_t pattern_bytes,
              size_t offset, size_t bytes, cl_uint event_count, const cl_event* events,
              cl_event* event),
             queue, buffer, pattern, pattern_bytes, offset, bytes, event_count, events, event)

WEDGE_FAULTY(clWaitForEvents, (cl_uint count, const cl_event* events), count, events)

WEDGE_FAULTY(clEnqueueReadBuffer,
             (cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset, size_t bytes,
              void* to, cl_uint event_count, const cl_event* events, cl_event* event),
             queue, buffer, blocking, offset, bytes, to, event_count, events, event)

extern "C" CL_API_ENTRY cl_mem CL_API_CALL clCreateBuffer(cl_context context, cl_mem_flags flags,
                                                          size_t bytes, void* host,
                                                          cl_int* status) {
    if (const cl_int refused = injected("clCreateBuffer"); refused != CL_SUCCESS) {
        if (status) *status = refused;
        return nullptr;
    }
    return next(&clCreateBuffer, "clCreateBuffer")(context, flags, bytes, host, status);
}

// Builds all the same: drivers keep no log of what they were never asked to build.
extern "C" CL_API_ENTRY cl_int CL_API_CALL
clBuildProgram(cl_program program, cl_uint device_count, const cl_device_id* devices,
               const char* options, void(CL_CALLBACK* notify)(cl_program, void*), void* data) {
    const cl_int status = next(&clBuildProgram, "clBuildProgram")(program, device_count, devices,
                                                                  options, notify, data);
    const cl_int refused = injected("clBuildProgram");
    return refused != CL_SUCCESS ? refused : status;
}

extern "C" CL_API_ENTRY cl_int CL_API_CALL clGetDeviceInfo(cl_device_id device, cl_device_info what,
                                                           size_t room, void* value, size_t* size) {
    const cl_int status =
        next(&clGetDeviceInfo, "clGetDeviceInfo")(device, what, room, value, size);
    const char* largest = std::getenv("WEDGE_TEST_LARGEST_BUFFER");
    if (largest && what == CL_DEVICE_MAX_MEM_ALLOC_SIZE && value) {
        const cl_ulong bytes = std::strtoull(largest, nullptr, 10);
        std::memcpy(value, &bytes, sizeof bytes);
    }
    return status;
}
