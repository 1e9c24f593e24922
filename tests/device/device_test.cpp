#include <doctest/doctest.h>

#include <fstream>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "host/device/device.hpp"
#include "host/device/program.hpp"
#include "tests/device/helpers.hpp"

using namespace wedge;
using namespace wedge::device;
using namespace wedge::test;

static_assert(std::is_nothrow_destructible_v<Device>);
static_assert(!std::is_copy_constructible_v<Device> && std::is_move_constructible_v<Device>);

namespace {

cl::Kernel build_kernel(Device& device, const TemporaryFolder& tree, const std::string& source) {
    write_text(tree.path() / "kernels/test.cl", source);
    const ProgramRequest request{"kernels/test.cl", {}};
    return build_programs(device, {&request, 1}, tree.path().string())[0].kernel("test");
}

}  // namespace

TEST_CASE("buffer_beyond_the_largest_is_refused_with_both_sizes") {
    Device device;
    const uint64_t mebibyte = 1024 * 1024;
    const uint64_t largest = device.info().largest_buffer_bytes / mebibyte * mebibyte;
    const std::string message = error_of([&] { device.allocate(2 * largest, "the texels"); });
    CHECK_MESSAGE(contains(message, "the texels"), message);
    CHECK_MESSAGE(contains(message, device.info().name), message);
    CHECK_MESSAGE(contains(message, std::to_string(2 * largest / mebibyte) + ".0 MiB"), message);
    CHECK_MESSAGE(contains(message, std::to_string(largest / mebibyte) + "."), message);
    CHECK(device.allocated_bytes() == 0);
}

TEST_CASE("empty_buffers_can_be_had_filled_and_read") {
    Device device;
    const cl::Buffer buffer = device.upload(std::span<const float>(), "nothing");
    CHECK(buffer() != nullptr);
    device.download(buffer, nullptr, 0);
    CHECK(device.allocated_bytes() > 0);
}

TEST_CASE("zeros_are_zero_and_can_be_written") {
    Device device;
    const TemporaryFolder tree;
    cl::Kernel kernel = build_kernel(device, tree,
                                     "kernel void test(global uint* a, uint count) {\n"
                                     "    const uint i = get_global_id(0);\n"
                                     "    if (i < count && i % 5 == 0) a[i] += i + 1;\n"
                                     "}\n");
    // Small ones, and ones that have pages of their own, whole or not.
    for (const uint32_t count : {0u, 1u, 1000u, 1u << 19, (1u << 19) + 1, 3'000'001u}) {
        const cl::Buffer buffer = device.allocate_zeros(count * uint64_t(4), "zeros");
        std::vector<uint32_t> before(count, 1), after(count);
        device.download(buffer, before.data(), count * uint64_t(4));
        kernel.setArg(0, buffer);
        kernel.setArg(1, count);
        device.launch(kernel, count);
        device.download(buffer, after.data(), count * uint64_t(4));
        bool zero = true, written = true;
        for (uint32_t i = 0; i < count; ++i) {
            zero &= before[i] == 0;
            written &= after[i] == (i % 5 == 0 ? i + 1 : 0);
        }
        CHECK_MESSAGE(zero, count);
        CHECK_MESSAGE(written, count);
    }
}

TEST_CASE("zeros_leave_no_memory_behind") {
    const auto address_space_kb = [] {
        std::ifstream status("/proc/self/status");
        for (std::string line; std::getline(status, line);)
            if (line.starts_with("VmSize:")) return std::stol(line.substr(7));
        return 0l;
    };
    if (address_space_kb() == 0) {
        MESSAGE("skipped: zeros_leave_no_memory_behind: no /proc");
        return;
    }
    Device device;
    device.allocate_zeros(64 << 20, "zeros");
    device.finish();
    const long before = address_space_kb();
    for (int i = 0; i < 20; ++i) device.allocate_zeros(64 << 20, "zeros");
    device.finish();
    CHECK(address_space_kb() - before < 2 * 64 * 1024);
}

TEST_CASE("every_item_runs_once_whatever_count_and_local_size") {
    Device device;
    const TemporaryFolder tree;
    cl::Kernel kernel = build_kernel(device, tree,
                                     "kernel void test(global int* visits, uint count) {\n"
                                     "    const uint i = get_global_id(0);\n"
                                     "    if (i < count) visits[i] += 1;\n"
                                     "}\n");
    const std::size_t guarded = 1200;
    for (const uint32_t count : {1u, 2u, 63u, 64u, 65u, 1000u}) {
        for (const uint32_t local : {0u, 1u, 7u, 16u, 64u}) {
            std::vector<int> visits(guarded, 0);
            cl::Buffer buffer = device.allocate(guarded * 4, "visits");
            device.queue().enqueueWriteBuffer(buffer, CL_TRUE, 0, guarded * 4, visits.data());
            kernel.setArg(0, buffer);
            kernel.setArg(1, count);
            device.launch(kernel, count, local);
            device.download(buffer, visits.data(), guarded * 4);
            bool once = true;
            for (std::size_t i = 0; i < guarded; ++i) once &= visits[i] == (i < count ? 1 : 0);
            CHECK_MESSAGE(once, "count " << count << ", local size " << local);
        }
    }
}

TEST_CASE("launch_of_nothing_is_done_at_once") {
    Device device;
    const TemporaryFolder tree;
    const cl::Kernel kernel =
        build_kernel(device, tree, "kernel void test(global int* a) { *a = 1; }");
    CHECK(device_seconds(device.launch(kernel, 0)) >= 0.0);
}

TEST_CASE("event_time_is_positive_and_grows_with_the_work") {
    Device device;
    const TemporaryFolder tree;
    cl::Kernel kernel =
        build_kernel(device, tree,
                     "kernel void test(global uint* out, uint rounds) {\n"
                     "    uint x = get_global_id(0);\n"
                     "    for (uint i = 0; i < rounds; ++i) x = x * 747796405u + (x >> 3);\n"
                     "    out[get_global_id(0)] = x;\n"
                     "}\n");
    const cl::Buffer out = device.allocate(4 * 1024, "out");
    kernel.setArg(0, out);
    const auto seconds = [&](uint32_t rounds) {
        kernel.setArg(1, rounds);
        return device_seconds(device.launch(kernel, 1024, 64));
    };
    seconds(1);  // PoCL compiles at the first launch
    const double little = seconds(1000), much = seconds(1'000'000);
    CHECK(little > 0.0);
    CHECK(much > 5.0 * little);
}

TEST_CASE("launch_that_cannot_be_names_kernel_device_and_sizes") {
    Device device;
    const TemporaryFolder tree;
    const cl::Kernel kernel =
        build_kernel(device, tree, "kernel void test(global int* a) { *a = 1; }");
    const std::string unset = error_of([&] { device.launch(kernel, 100, 10); });
    CHECK_MESSAGE(contains(unset, "kernel test (100 work-items in groups of 10)"), unset);
    CHECK_MESSAGE(contains(unset, device.info().name), unset);
    CHECK_MESSAGE(contains(unset, "CL_INVALID_KERNEL_ARGS"), unset);
    const std::string huge = error_of([&] { device.launch(kernel, 1 << 30, 1 << 30); });
    CHECK_MESSAGE(contains(huge, "CL_INVALID_WORK_GROUP_SIZE"), huge);
}

TEST_CASE("device_that_was_moved_goes_on_working") {
    Device first;
    const std::vector<int> sent = {1, 2, 3};
    const cl::Buffer buffer = first.upload(std::span<const int>(sent), "numbers");
    Device second = std::move(first);
    std::vector<int> received(3);
    second.download(buffer, received.data(), 12);
    CHECK(received == sent);
    CHECK(second.allocated_bytes() == 16);
}
