// Which devices there are and which one is taken.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/workbench.hpp"

namespace wedge::test {
namespace {

constexpr int kDevice = 4;

// The ICD loader finds its platforms in this folder; PoCL makes one device of each word.
const std::map<std::string, std::string> kNoPlatform{{"OCL_ICD_VENDORS", "/nonexistent-vendors"},
                                                     {"WEDGE_DEVICE", ""}};
const std::map<std::string, std::string> kTwoDevices{{"POCL_DEVICES", "pthread basic"},
                                                     {"WEDGE_DEVICE", ""}};

nlohmann::json devices_of(const Workbench& bench, const std::map<std::string, std::string>& env) {
    return nlohmann::json::parse(bench.wedge({"devices", "--json"}, {.environment = env}).out);
}

std::string device_used(const Workbench& bench, const std::string& selector,
                        std::map<std::string, std::string> env) {
    std::vector<std::string> arguments{"render", "room.json", "-o", "out.png", "--stats", "s.json"};
    if (!selector.empty()) arguments.insert(arguments.end(), {"--device", selector});
    const ProcessResult result = bench.wedge(arguments, {.environment = std::move(env)});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(bench.read("s.json")).at("device").at("name");
}

}  // namespace

TEST_CASE("no_platform_is_told_with_what_to_install") {
    const Workbench bench;
    write_room(bench);
    const auto files_before = bench.files();
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"devices"}, {"render", "room.json", "-o", "out.png"}}) {
        const ProcessResult result = bench.wedge(arguments, {.environment = kNoPlatform});
        CAPTURE(result.err);
        CHECK(result.exit_code == kDevice);
        CHECK(result.err_has("no OpenCL device"));
        CHECK(result.err_has("pocl-opencl-icd"));
        CHECK(result.out.empty());
    }
    CHECK(bench.files() == files_before);
    CHECK(bench.wedge({"devices", "--json"}, {.environment = kNoPlatform}).out == "[]\n");
}

TEST_CASE("info_needs_no_device") {
    const Workbench bench;
    write_room(bench);
    CHECK(bench.wedge({"info", "room.json"}, {.environment = kNoPlatform}).exit_code == 0);
}

TEST_CASE("device_list_holds_what_matters") {
    const Workbench bench;
    const auto devices = devices_of(bench, kTwoDevices);
    REQUIRE(devices.size() >= 2);
    const std::string table = bench.wedge({"devices"}, {.environment = kTwoDevices}).out;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        CHECK(devices[i].at("index") == i);
        CHECK(devices[i].at("compute_units") > 0);
        CHECK(devices[i].at("largest_buffer_bytes") > 0);
        CHECK(devices[i].at("largest_buffer_bytes") <= devices[i].at("memory_bytes"));
        for (const char* key : {"name", "type", "platform", "driver"}) {
            CAPTURE(key);
            CHECK(table.find(devices[i].at(key).get<std::string>()) != std::string::npos);
        }
    }
}

TEST_CASE("device_is_chosen_by_index_name_and_environment") {
    const Workbench bench;
    write_room(bench);
    const auto devices = devices_of(bench, kTwoDevices);
    REQUIRE(devices.size() >= 2);
    const std::string first = devices[0].at("name"), second = devices[1].at("name");
    REQUIRE(first != second);

    CHECK(device_used(bench, "0", kTwoDevices) == first);
    CHECK(device_used(bench, "1", kTwoDevices) == second);
    CHECK(device_used(bench, second.substr(0, 5), kTwoDevices) == second);
    auto environment = kTwoDevices;
    environment["WEDGE_DEVICE"] = "1";
    CHECK(device_used(bench, "", environment) == second);
    CHECK(device_used(bench, "0", environment) == first);
}

TEST_CASE("unknown_device_is_refused_with_the_list") {
    const Workbench bench;
    write_room(bench);
    const std::string name = devices_of(bench, {{"WEDGE_DEVICE", ""}})[0].at("name");
    for (const std::string selector : {"99", "abacus"}) {
        const ProcessResult result =
            bench.wedge({"render", "room.json", "-o", "out.png", "--device", selector});
        CAPTURE(result.err);
        CHECK(result.exit_code == kDevice);
        CHECK(result.err_has(selector));
        CHECK(result.err_has(name));
        CHECK(!bench.has("out.png"));
    }
}

}  // namespace wedge::test
