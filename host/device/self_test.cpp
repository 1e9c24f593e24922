#include "host/device/self_test.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "host/device/binary_cache.hpp"
#include "host/device/program.hpp"
#include "host/device/status.hpp"
#include "wedge/error.hpp"
#include "wedge/shared/bvh.h"
#include "wedge/shared/filter.h"
#include "wedge/shared/frame.h"
#include "wedge/shared/replay.h"
#include "wedge/shared/scene.h"

namespace wedge::device {
namespace {

using shared::uint;

constexpr uint kItems =
    1000;  // not a multiple of any group size, so that rounding up is tested too
constexpr uint kWordsPerItem = 4;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct StructLayout {
    const char* name;
    uint bytes, field_offset;
};

constexpr StructLayout kLayouts[] = {
#define WEDGE_LAYOUT(type, field) \
    {#type, uint(sizeof(shared::type)), uint(offsetof(shared::type, field))},
#include "kernels/self_test_layout.clh"
#undef WEDGE_LAYOUT
};

uint expected_integer(uint i) {
    const uint state = i * 747796405u + 2891336453u;
    const uint word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    const uint pcg = (word >> 22) ^ word;
    const uint high = uint((std::uint64_t(pcg) * (i * 2654435761u)) >> 32);
    return std::rotl(pcg, int(i & 31)) + high + uint(std::countl_zero(pcg >> (i & 31)));
}

/// In double every step is exact, and the result has fewer than 24 bits.
uint expected_float(uint i) {
    const double x = i * 0.125;
    const float y = float(x * x - x + std::floor(x));
    const uint nan_bits = 1;
    return std::bit_cast<uint>(y) + (nan_bits << 31);
}

uint expected_mask(uint i) {
    uint mask = 0;
    for (uint lane = 0; lane < 8; ++lane) {
        const bool empty = lane == 3;
        if (!empty && lane + (i & 7) <= 7) mask |= 1u << lane;
    }
    return mask;
}

[[noreturn]] void fail(const Device& device, const std::string& what) {
    throw Error(
        ErrorKind::device,
        fmt::format("device {} computes wrong results: {}. Update its driver ({}), or choose "
                    "another device with --device",
                    device.info().name, what, device.info().driver));
}

void check_answers(Device& device, const Program& program) {
    const float infinities[2] = {kInfinity, -kInfinity};
    const uint64_t bytes = uint64_t(kItems) * kWordsPerItem * sizeof(uint);
    const cl::Buffer answers = device.allocate(bytes, "the self-test");
    const cl::Buffer limits = device.upload(std::span<const float>(infinities), "the self-test");
    cl::Kernel kernel = program.kernel("self_test_answers");
    kernel.setArg(0, answers);
    kernel.setArg(1, limits);
    kernel.setArg(2, kItems);
    device.launch(kernel, kItems);

    std::vector<uint> found(kItems * kWordsPerItem);
    device.download(answers, found.data(), bytes);
    for (uint i = 0; i < kItems; ++i) {
        const uint expected[] = {expected_integer(i), expected_float(i), expected_mask(i), i};
        const char* const names[] = {"integer arithmetic", "float arithmetic", "float8 comparison",
                                     "work-item indices"};
        for (uint word = 0; word < kWordsPerItem; ++word) {
            const uint got = found[i * kWordsPerItem + word];
            if (got == expected[word]) continue;
            fail(device, fmt::format("{}, item {}: {:#010x} instead of {:#010x}", names[word], i,
                                     got, expected[word]));
        }
    }
}

void check_layouts(Device& device, const Program& program) {
    constexpr std::size_t kWords = 2 * std::size(kLayouts);
    const cl::Buffer layout = device.allocate(kWords * sizeof(uint), "the self-test");
    const cl::Buffer base = device.allocate(1, "the self-test");
    cl::Kernel kernel = program.kernel("self_test_layout");
    kernel.setArg(0, layout);
    kernel.setArg(1, base);
    device.launch(kernel, 1);

    uint found[kWords] = {};
    device.download(layout, found, sizeof found);
    for (std::size_t i = 0; i < std::size(kLayouts); ++i) {
        const StructLayout& expected = kLayouts[i];
        const uint bytes = found[2 * i], offset = found[2 * i + 1];
        if (bytes == expected.bytes && offset == expected.field_offset) continue;
        fail(device,
             fmt::format("layout of {}: {} bytes with a field at {} instead of {} and {}",
                         expected.name, bytes, offset, expected.bytes, expected.field_offset));
    }
}

}  // namespace

bool self_test(Device& device, const std::string& kernel_dir) {
    const ProgramRequest request{"kernels/self_test.cl", {}};
    const std::string source = assemble_source(request.file, kernel_dir);
    const std::string name = cache_key(device, source, build_options(request)) + ".self_test";
    if (load_cached(name)) return false;

    const std::vector<Program> programs = build_programs(device, {&request, 1}, kernel_dir);
    try {
        check_answers(device, programs[0]);
        check_layouts(device, programs[0]);
    } catch (const cl::Error& error) {
        throw_status(device.info().name, "run the self-test", error.err());
    }
    store_cached(name, "passed\n");
    return true;
}

}  // namespace wedge::device
