// A vector whose new elements are not set: large arrays are first touched by the threads that fill
// them, and once.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace wedge::bvh {

template <typename T>
struct RawAllocator : std::allocator<T> {
    template <typename U>
    struct rebind {
        using other = RawAllocator<U>;
    };
    template <typename U>
    void construct(U* at) {
        ::new (static_cast<void*>(at)) U;
    }
    template <typename U, typename... Args>
    void construct(U* at, Args&&... args) {
        ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
    }
};

/// resize() leaves new elements of plain types without a value.
template <typename T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace wedge::bvh
