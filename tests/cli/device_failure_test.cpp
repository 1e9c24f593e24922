// Devices that fail, at the call where OpenCL says so: a named error, and what was rendered is
// kept.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/cli/workbench.hpp"
#include "wedge/image_io.hpp"

namespace wedge::test {
namespace {

constexpr int kDeviceError = 4;

/// OpenCL function `call` fails from its n-th call on (tests/cli/faults/opencl.cpp).
ProcessSettings failing(const std::string& function, int call, int status) {
    ProcessSettings settings;
    settings.environment = {
        {"LD_PRELOAD", WEDGE_OPENCL_FAULTS},
        {"ASAN_OPTIONS", "verify_asan_link_order=0"},
        {"WEDGE_TEST_FAULT", function + " " + std::to_string(call) + " " + std::to_string(status)}};
    return settings;
}

std::vector<std::string> render_with(const std::vector<std::string>& more) {
    std::vector<std::string> command{"render", "room.json", "-o", "a.exr", "--tile", "200"};
    command.insert(command.end(), more.begin(), more.end());
    return command;
}

/// Samples that the image says it has; all its values must be finite, and some light there.
double samples_of(const Workbench& bench) {
    const Image image = read_image(bench.folder() / "a.exr");
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size())
        sum += image.pixels[i + std::size_t(image.channel("G"))];
    CHECK(std::isfinite(sum));
    CHECK(sum > 0);
    return std::stod(image.metadata.at("wedge:samples"));
}

}  // namespace

TEST_CASE("refused_allocation_ends_with_a_named_error_wherever_it_is") {
    const Workbench bench;
    write_room(bench);
    int refused = 0;
    for (int call = 1; call < 100; call += 7) {
        CAPTURE(call);
        const ProcessResult result =
            bench.wedge(render_with({"--method", "aaf"}), failing("clCreateBuffer", call, -4));
        if (result.exit_code == 0) break;  // so many there are not
        ++refused;
        CAPTURE(result.err);
        CHECK(result.exit_code == kDeviceError);
        CHECK(result.err_has(" cannot allocate "));
        CHECK(result.err_has("CL_MEM_OBJECT_ALLOCATION_FAILURE"));
        CHECK(!bench.has("a.exr"));
    }
    CHECK(refused > 3);
}

TEST_CASE("buffers_that_cannot_be_cleared_end_with_a_named_error") {
    const Workbench bench;
    write_room(bench);
    for (int call : {1, 4, 8}) {
        CAPTURE(call);
        const ProcessResult result =
            bench.wedge(render_with({"--method", "aaf"}), failing("clEnqueueFillBuffer", call, -5));
        CAPTURE(result.err);
        CHECK(result.exit_code == kDeviceError);
        CHECK(result.err_has(" cannot fill "));
        CHECK(result.err_has("CL_OUT_OF_RESOURCES"));
        CHECK(!bench.has("a.exr"));
    }
}

TEST_CASE("refused_kernel_build_names_kernel_and_status") {
    const Workbench bench;
    write_room(bench);
    const ProcessResult result = bench.wedge(render_with({}), failing("clBuildProgram", 1, -11));
    CAPTURE(result.err);
    CHECK(result.exit_code == kDeviceError);
    CHECK(result.err_has("cannot build kernels/"));
    CHECK(result.err_has("CL_BUILD_PROGRAM_FAILURE"));
    CHECK(bench.files() == std::set<std::string>{"room.json", "room.obj"});
}

TEST_CASE("ctrl_c_that_makes_a_kernel_build_fail_is_no_fault_of_the_device") {
    const Workbench bench;
    write_room(bench);
    ProcessSettings settings = failing("clBuildProgram", 1, -11);
    settings.environment["WEDGE_TEST_SIGNAL"] = "1";
    const ProcessResult result = bench.wedge(render_with({}), settings);
    CAPTURE(result.err);
    CHECK(result.exit_code == 130);
    CHECK(result.err_has("stopped before the first sample; no image was written"));
    CHECK(!bench.has("a.exr"));
}

TEST_CASE("samples_from_before_a_refused_launch_or_a_lost_event_are_saved") {
    constexpr double kAll = 32 * 24 * 64;
    for (const char* function : {"clEnqueueNDRangeKernel", "clWaitForEvents"})
        for (const std::string method : {"mc", "aaf"}) {
            int saved = 0, before_the_first = 0;
            for (int call = 1; call < 200; call += 5) {
                CAPTURE(function);
                CAPTURE(method);
                CAPTURE(call);
                const Workbench bench;
                write_room(bench);
                std::vector<std::string> options = {"--spp", "64", "--method", method};
                if (method == "aaf") options.push_back("--uniform");
                const ProcessResult result =
                    bench.wedge(render_with(options), failing(function, call, -5));
                if (result.exit_code == 0) break;  // so many there are not
                CAPTURE(result.err);
                CHECK(result.exit_code == kDeviceError);
                CHECK(result.err_has("CL_OUT_OF_RESOURCES"));
                const bool has_image = bench.has("a.exr");
                CHECK(has_image == result.err_has("the image holds the samples from before this"));
                (has_image ? saved : before_the_first) += 1;
                if (!has_image) continue;
                CHECK(samples_of(bench) > 0);
                CHECK(samples_of(bench) <= kAll);
            }
            CHECK(saved > 0);
            CHECK(before_the_first > 0);
        }
}

TEST_CASE("render_whose_device_is_lost_goes_on_from_its_state") {
    const Workbench bench;
    write_room(bench);
    const std::vector<std::string> render =
        render_with({"--spp", "64", "--resume", "a.state", "--checkpoint", "0"});
    REQUIRE(bench.wedge(render).exit_code == 0);
    const std::vector<float> whole = read_image(bench.folder() / "a.exr").pixels;

    const ProcessResult lost = bench.wedge(render, failing("clEnqueueNDRangeKernel", 8, -36));
    CAPTURE(lost.err);
    CHECK(lost.exit_code == kDeviceError);
    CHECK(lost.err_has("--resume a.state goes on from here"));
    const ProcessResult resumed = bench.wedge(render);
    CHECK(resumed.exit_code == 0);
    CHECK(resumed.err_has("a.state: goes on after"));
    CHECK(read_image(bench.folder() / "a.exr").pixels == whole);
}

TEST_CASE("device_that_gives_nothing_back_is_told_and_writes_nothing") {
    const Workbench bench;
    write_room(bench);
    const ProcessResult result =
        bench.wedge(render_with({}), failing("clEnqueueReadBuffer", 1, -36));
    CAPTURE(result.err);
    CHECK(result.exit_code == kDeviceError);
    CHECK(result.err_has("cannot read back"));
    CHECK(!bench.has("a.exr"));
}

}  // namespace wedge::test
