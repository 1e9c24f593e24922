/* The few types that structures shared by C++ and OpenCL C are made of: scalars and float4 only,
   because nothing else is laid out alike by every compiler. */
#ifndef WEDGE_SHARED_PORTABLE_H
#define WEDGE_SHARED_PORTABLE_H

#ifdef __OPENCL_VERSION__
#define WEDGE_SHARED_BEGIN
#define WEDGE_SHARED_END
#define WEDGE_ASSERT_SIZE(type, bytes)
#else
#include <cstdint>
#define WEDGE_SHARED_BEGIN namespace wedge::shared {
#define WEDGE_SHARED_END }
#define WEDGE_ASSERT_SIZE(type, bytes) \
    static_assert(sizeof(type) == (bytes), #type " changed its size")
namespace wedge::shared {
struct alignas(16) float4 {
    float x, y, z, w;
};
using uint = std::uint32_t;
}  // namespace wedge::shared
#endif

#endif
