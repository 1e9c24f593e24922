// Lanes moved together, by the processor's instructions and without them.
#include <doctest/doctest.h>

#include <numeric>

#include "tracer.hpp"

using namespace wedge;
using namespace wedge::test;

TEST_CASE("the_values_at_every_set_of_lanes_are_packed_in_order") {
    constexpr uint32_t kSets = 256;
    device::Device& device = test_device();
    std::vector<cl_int> values(8), packed(8 * kSets);
    std::iota(values.begin(), values.end(), 100);
    for (const bool portable : {false, true}) {
        CAPTURE(portable);
        device::ProgramRequest request{"kernels/trace.cl", {}};
        if (portable) request.defines.push_back("WEDGE_PORTABLE_LANES=1");
        const auto programs = device::build_programs(device, {&request, 1}, kernel_dir());
        cl::Kernel kernel = programs[0].kernel("pack_sets_of_lanes");
        const cl::Buffer in = device.upload(std::span<const cl_int>(values), "values");
        const cl::Buffer out = device.allocate(packed.size() * sizeof(cl_int), "packed");
        kernel.setArg(0, in);
        kernel.setArg(1, out);
        kernel.setArg(2, cl_uint(kSets));
        device.launch(kernel, kSets);
        device.finish();
        device.download(out, packed.data(), packed.size() * sizeof(cl_int));
        for (uint32_t set = 0; set < kSets; ++set) {
            CAPTURE(set);
            int count = 0;
            for (int lane = 0; lane < 8; ++lane)
                if (set >> lane & 1) CHECK(packed[8 * set + count++] == 100 + lane);
        }
    }
}
