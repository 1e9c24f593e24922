// Frame after frame in one process: memory and handles stay what they were. WEDGE_TEST_FRAMES sets
// how many, by default 120.
#include <doctest/doctest.h>
#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

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
    const double memory = resident_bytes();
    const std::size_t handles = open_handles();
    for (int i = kWarm; i < frames; ++i) frame(i);
    const double growth = resident_bytes() / memory - 1;
    INFO(fmt::format("{:.1f} MiB after {} frames, {:.1f} MiB after {}", memory / 1048576, kWarm,
                     resident_bytes() / 1048576, frames));
    // Drivers' threads have heaps of their own, which differ by a few per cent however many frames
    // there are; 25 kB a frame would be as much.
    CHECK(growth < 0.03);
    CHECK(open_handles() == handles);
}

}  // namespace wedge::test
