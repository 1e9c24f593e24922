#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "host/device/program.hpp"
#include "tests/device/helpers.hpp"

using namespace wedge;
using namespace wedge::device;
using namespace wedge::test;

TEST_CASE("syntax_error_gives_device_file_line_and_log") {
    Device device;
    const TemporaryFolder tree;
    write_text(tree.path() / "kernels/lib/broken.clh", "\n\nfloat f(float x) { return y; }\n");
    write_text(
        tree.path() / "kernels/test.cl",
        "#include \"lib/broken.clh\"\nkernel void test(global float* o) { *o = f(1.0f); }\n");
    const ProgramRequest request{"kernels/test.cl", {"WEDGE_TEST=1"}};
    const std::string message = error_of([&] {
        build_programs(device, {&request, 1}, tree.path().string());
    });
    CHECK_MESSAGE(contains(message, device.info().name), message);
    CHECK_MESSAGE(contains(message, "kernels/test.cl"), message);
    CHECK_MESSAGE(contains(message, "-DWEDGE_TEST=1"), message);
    CHECK_MESSAGE(contains(message, "kernels/lib/broken.clh:3"), message);
    CHECK_MESSAGE(contains(message, "'y'"), message);
}

TEST_CASE("programs_come_in_the_order_asked_for_with_their_defines") {
    Device device;
    const TemporaryFolder tree;
    write_text(tree.path() / "kernels/test.cl",
               "kernel void test(global int* o) { *o = WEDGE_TEST_VALUE; }\n");
    std::vector<ProgramRequest> requests;
    for (int i = 0; i < 6; ++i) {
        requests.push_back({"kernels/test.cl", {"WEDGE_TEST_VALUE=" + std::to_string(100 + i)}});
    }
    const std::vector<Program> programs = build_programs(device, requests, tree.path().string());
    REQUIRE(programs.size() == 6);
    const cl::Buffer out = device.allocate(4, "out");
    for (int i = 0; i < 6; ++i) {
        cl::Kernel kernel = programs[i].kernel("test");
        kernel.setArg(0, out);
        device.launch(kernel, 1);
        int value = 0;
        device.download(out, &value, 4);
        CHECK(value == 100 + i);
    }
}

TEST_CASE("one_broken_program_of_many_is_the_error") {
    Device device;
    const TemporaryFolder tree;
    write_text(tree.path() / "kernels/good.cl", "kernel void test(global int* o) { *o = 1; }\n");
    write_text(tree.path() / "kernels/bad.cl", "kernel void test(global int* o) { *o = ; }\n");
    const std::vector<ProgramRequest> requests = {
        {"kernels/good.cl", {}}, {"kernels/bad.cl", {}}, {"kernels/good.cl", {"A=1"}}};
    CHECK(contains(error_of([&] { build_programs(device, requests, tree.path().string()); }),
                   "kernels/bad.cl:1"));
}

TEST_CASE("kernel_that_is_not_there_is_an_error_that_names_it") {
    Device device;
    const ProgramRequest request{"kernels/self_test.cl", {}};
    const std::vector<Program> programs = build_programs(device, {&request, 1});
    CHECK(contains(error_of([&] { programs[0].kernel("gone"); }), "gone"));
}
