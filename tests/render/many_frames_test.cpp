// Frame after frame in one process: memory and handles stay what they were. WEDGE_TEST_FRAMES sets
// how many, by default 120.
#include <doctest/doctest.h>
#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "test_scenes.hpp"

namespace wedge::test {
namespace {

/// Resident, bytes, without what the allocator only keeps for later; 0 where /proc does not tell.
double resident_bytes() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmRSS:")) return 1024 * std::stod(line.substr(6));
    return 0;
}

#ifdef __GLIBC__
/// What the allocator has handed out and not got back, bytes, over all threads' heaps and mappings.
double allocated_bytes() {
    char* text = nullptr;
    std::size_t length = 0;
    std::FILE* stream = open_memstream(&text, &length);
    malloc_info(0, stream);
    std::fclose(stream);
    std::string info(text, length);
    std::free(text);
    // Totals over all heaps follow the last heap's own.
    info.erase(0, info.rfind("</heap>"));
    const auto total = [&](const std::string& name) {
        const std::size_t at = info.find("\"" + name + "\"");
        return std::stod(info.substr(info.find("size=\"", at) + 6));
    };
    return total("current") - total("fast") - total("rest") + total("mmap");
}
#else
double allocated_bytes() {
    return resident_bytes();
}
#endif

std::size_t open_handles() {
    const std::filesystem::directory_iterator entries("/proc/self/fd");
    return std::size_t(std::distance(begin(entries), end(entries)));
}

}  // namespace

TEST_CASE("frames_leave_memory_and_handles_as_they_were") {
    if (resident_bytes() == 0) {
        MESSAGE("skipped: frames_leave_memory_and_handles_as_they_were: no /proc");
        return;
    }
    Scene scene = make_room(20);
    scene.film = {8, 8};
    const auto frame = [&](int i) {
        RenderOptions options = quick(4, 1, Sampler::sobol, uint32_t(i));
        options.method = i % 2 == 0 ? Method::mc : Method::aaf;
        if (options.method == Method::aaf) options.samples_per_pixel = 12;
        render(scene, options);
    };
    // The first frames fill caches: of programs, of kernels, of the allocator.
    constexpr int kWarm = 10;
    const char* asked = std::getenv("WEDGE_TEST_FRAMES");
    const int frames = asked ? std::atoi(asked) : 120;
    for (int i = 0; i < kWarm; ++i) frame(i);
    const double allocated = allocated_bytes();
    const double memory = resident_bytes();
    const std::size_t handles = open_handles();
    for (int i = kWarm; i < frames; ++i) frame(i);
    const double kept = allocated_bytes() - allocated;
    const double growth = resident_bytes() - memory;
    INFO(fmt::format(
        "after {} frames and after {}: {:.2f} and {:.2f} MiB allocated, {:.1f} and {:.1f} resident",
        kWarm, frames, allocated / 1048576, (allocated + kept) / 1048576, memory / 1048576,
        (memory + growth) / 1048576));
    // What is handed out repeats to a few tenths of a per cent. Which pages stay resident also
    // depends on which thread's heap an allocation fell into, several per cent from run to run
    // however many frames there are, so that limit only sees mappings beside the allocator's.
    CHECK(kept <= 0.01 * allocated);
    CHECK(growth <= 0.15 * memory);
    CHECK(open_handles() == handles);
}

}  // namespace wedge::test
