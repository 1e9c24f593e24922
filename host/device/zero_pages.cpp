#include "host/device/zero_pages.hpp"

#include <cstddef>
#include <memory>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace wedge::device {

#ifdef __linux__

namespace {

struct Pages {
    explicit Pages(std::size_t size)
        : bytes(size),
          memory(mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)) {}
    ~Pages() {
        if (exist()) munmap(memory, bytes);
    }
    Pages(const Pages&) = delete;
    Pages& operator=(const Pages&) = delete;

    bool exist() const { return memory != MAP_FAILED; }

    std::size_t bytes;
    void* memory;
};

void CL_CALLBACK release(cl_mem, void* pages) {
    delete static_cast<Pages*>(pages);
}

}  // namespace

cl::Buffer zero_pages(const cl::Context& context, uint64_t bytes) {
    auto pages = std::make_unique<Pages>(std::size_t(bytes));
    if (!pages->exist()) return {};
    ask_for_large_pages(pages->memory, bytes);
    // After the pages, so that it goes before them if the callback is refused.
    cl::Buffer buffer(context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, pages->bytes,
                      pages->memory);
    buffer.setDestructorCallback(release, pages.get());
    pages.release();
    return buffer;
}

void ask_for_large_pages(void* memory, uint64_t bytes) {
    constexpr std::uintptr_t kPage = 4096;
    const auto first = (reinterpret_cast<std::uintptr_t>(memory) + kPage - 1) / kPage * kPage;
    const auto last = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kPage * kPage;
    if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

#else

cl::Buffer zero_pages(const cl::Context&, uint64_t) {
    return {};
}

void ask_for_large_pages(void*, uint64_t) {}

#endif

}  // namespace wedge::device
