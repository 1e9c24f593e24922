#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "host/device/device.hpp"
#include "host/device/discovery.hpp"
#include "host/device/status.hpp"
#include "tests/device/helpers.hpp"

using namespace wedge;
using namespace wedge::device;
using namespace wedge::test;

namespace {

DeviceInfo made_up(int index, const std::string& name, DeviceType type) {
    DeviceInfo info;
    info.index = index;
    info.name = name;
    info.type = type;
    info.platform = "Made Up";
    return info;
}

const std::vector<DeviceInfo> kDevices = {made_up(0, "pthread-Xeon", DeviceType::cpu),
                                          made_up(1, "Radeon 7900", DeviceType::gpu),
                                          made_up(2, "GeForce RTX 4090", DeviceType::gpu),
                                          made_up(3, "Alveo U50", DeviceType::accelerator)};

}  // namespace

TEST_CASE("selector_is_an_index_a_part_of_a_name_or_a_type") {
    const ScopedVariable none("WEDGE_DEVICE", "");
    CHECK(select_device(kDevices, "0") == 0);
    CHECK(select_device(kDevices, "3") == 3);
    CHECK(select_device(kDevices, "rtx") == 2);
    CHECK(select_device(kDevices, "XEON") == 0);
    CHECK(select_device(kDevices, "e") == 0);  // the first of several
    CHECK(select_device(kDevices, "cpu") == 0);
    CHECK(select_device(kDevices, "GPU") == 1);
}

TEST_CASE("empty_selector_is_the_environment_then_the_first_gpu_then_the_first") {
    {
        const ScopedVariable variable("WEDGE_DEVICE", "alveo");
        CHECK(select_device(kDevices, "") == 3);
        CHECK(select_device(kDevices, "cpu") == 0);
    }
    const ScopedVariable none("WEDGE_DEVICE", "");
    CHECK(select_device(kDevices, "") == 1);
    CHECK(select_device(std::vector<DeviceInfo>{kDevices[3], kDevices[0]}, "") == 0);
}

TEST_CASE("selector_that_fits_nothing_is_an_error_that_lists_the_devices") {
    const ScopedVariable none("WEDGE_DEVICE", "");
    // 90 is part of a name, but a number is an index.
    for (const char* selector : {"4", "90", "99999999999999999999999", "-1", "voodoo"}) {
        const std::string message = error_of([&] { select_device(kDevices, selector); });
        CHECK_MESSAGE(contains(message, selector), message);
        CHECK_MESSAGE(contains(message, "--device"), message);
        for (const DeviceInfo& info : kDevices) CHECK(contains(message, info.name));
    }
    const ScopedVariable variable("WEDGE_DEVICE", "voodoo");
    CHECK(contains(error_of([] { select_device(kDevices, ""); }), "WEDGE_DEVICE"));
}

TEST_CASE("no_device_at_all_is_an_error_that_says_what_to_install") {
    const std::string message = error_of([] { select_device({}, "gpu"); });
    CHECK_MESSAGE(contains(message, "pocl-opencl-icd"), message);
}

TEST_CASE("status_has_a_name_and_a_number") {
    CHECK(status_name(-5) == "CL_OUT_OF_RESOURCES (-5)");
    CHECK(status_name(0) == "CL_SUCCESS (0)");
    CHECK(status_name(-1001) == "CL_PLATFORM_NOT_FOUND_KHR (-1001)");
    CHECK(contains(status_name(-9999), "-9999"));
}

TEST_CASE("driver_strings_lose_zeros_and_blanks_at_their_ends") {
    CHECK(trimmed(std::string("  Intel(R) Xeon \0\0", 17)) == "Intel(R) Xeon");
    CHECK(trimmed(" \n") == "");
}

// The cases below are run by others, in processes with another environment.

TEST_CASE("child_opens_a_device_where_there_is_none" * doctest::skip()) {
    CHECK(list_devices().empty());
    CHECK(contains(error_of([] { Device device; }), "pocl-opencl-icd"));
}

TEST_CASE("child_computes_on_two_devices" * doctest::skip()) {
    const std::vector<DeviceInfo> infos = list_devices();
    REQUIRE(infos.size() == 2);
    for (int index = 0; index < 2; ++index) {
        CHECK(infos[index].index == index);
        Device device(std::to_string(index));
        CHECK(device.info().name == infos[index].name);
        const std::vector<int> sent = {index, 7, 42};
        const cl::Buffer buffer = device.upload(std::span<const int>(sent), "numbers");
        std::vector<int> received(3);
        device.download(buffer, received.data(), 12);
        CHECK(received == sent);
    }
    for (const char* part : {"basic", "pthread"}) {
        CHECK(contains(Device(part).info().name, part));
    }
}

TEST_CASE("without_a_platform_the_list_is_empty_and_opening_is_a_clear_error") {
    const TemporaryFolder empty;
    const ChildResult result =
        run_child("child_opens_a_device_where_there_is_none",
                  {{"OCL_ICD_VENDORS", empty.path().string() + "/"}, {"OCL_ICD_FILENAMES", ""}});
    CHECK_MESSAGE(result.exit_code == 0, result.output);
    CHECK(contains(result.output, "1 passed"));
}

TEST_CASE("two_devices_are_told_apart_and_both_compute") {
    const std::vector<DeviceInfo> infos = list_devices();
    if (infos.empty() || infos[0].platform != "Portable Computing Language") {
        MESSAGE("skipped: two_devices_are_told_apart_and_both_compute (the first is not PoCL)");
        return;
    }
    const ChildResult result =
        run_child("child_computes_on_two_devices", {{"POCL_DEVICES", "pthread basic"}});
    CHECK_MESSAGE(result.exit_code == 0, result.output);
    CHECK(contains(result.output, "1 passed"));
}
