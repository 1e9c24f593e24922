#include "host/device/pocl.hpp"

#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#endif

#include <cstdlib>
#include <mutex>

namespace wedge::device {
namespace {

/// False, too, where it is not known.
bool may_use_all_processors() {
#ifdef __linux__
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    return ::sched_getaffinity(0, sizeof(allowed), &allowed) == 0 &&
           CPU_COUNT(&allowed) == ::sysconf(_SC_NPROCESSORS_CONF);
#else
    return false;
#endif
}

void set_variables() {
    // The default way to run a work-group loses a factor of two on kernels whose items diverge, as
    // rays do.
    ::setenv("POCL_WORK_GROUP_METHOD", "loops", /*overwrite=*/0);
    // Threads that sleep between kernels may wake on one processor and share it for milliseconds.
    // PoCL ties its n-th thread to processor n, whether the process may use that one or not.
    if (may_use_all_processors() && !std::getenv("POCL_MAX_PTHREAD_COUNT"))
        ::setenv("POCL_AFFINITY", "1", /*overwrite=*/0);
}

}  // namespace

void prepare_pocl() {
    static std::once_flag once;
    std::call_once(once, set_variables);
}

}  // namespace wedge::device
