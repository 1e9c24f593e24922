// wedge devices: every OpenCL device, so that one can be chosen.
#include "wedge/device.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/commands.hpp"
#include "host/cli/text.hpp"
#include "wedge/error.hpp"

namespace wedge::cli {
namespace {

using Row = std::array<std::string, 8>;

void print_table(const std::vector<DeviceInfo>& devices) {
    std::vector<Row> rows{
        {"index", "name", "type", "platform", "driver", "units", "memory", "largest buffer"}};
    for (const DeviceInfo& d : devices)
        rows.push_back({std::to_string(d.index), d.name, name_of(d.type), d.platform, d.driver,
                        std::to_string(d.compute_units), text_of_bytes(d.memory_bytes),
                        text_of_bytes(d.largest_buffer_bytes)});

    std::array<std::size_t, std::tuple_size_v<Row>> widths{};
    for (const Row& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    for (const Row& row : rows) {
        std::string line;
        for (std::size_t i = 0; i < row.size(); ++i)
            line += fmt::format("{:<{}}", row[i], i + 1 < row.size() ? widths[i] + 2 : 0);
        fmt::print("{}\n", line);
    }
}

void print_json(const std::vector<DeviceInfo>& devices) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const DeviceInfo& d : devices)
        list.push_back({{"index", d.index},
                        {"name", d.name},
                        {"type", name_of(d.type)},
                        {"vendor", d.vendor},
                        {"version", d.version},
                        {"driver", d.driver},
                        {"platform", d.platform},
                        {"platform_version", d.platform_version},
                        {"compute_units", d.compute_units},
                        {"memory_bytes", d.memory_bytes},
                        {"largest_buffer_bytes", d.largest_buffer_bytes}});
    fmt::print("{}\n", list.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
}

void run(bool as_json) {
    const std::vector<DeviceInfo> devices = list_devices();
    if (as_json)
        print_json(devices);
    else if (!devices.empty())
        print_table(devices);
    std::fflush(stdout);
    if (devices.empty())
        throw Error(ErrorKind::device,
                    "no OpenCL device found. On Debian, `apt-get install pocl-opencl-icd` makes "
                    "the processor one; a GPU needs its vendor's OpenCL driver");
}

}  // namespace

void register_devices(CLI::App& app) {
    CLI::App* command = app.add_subcommand("devices", "List the OpenCL devices of this machine");
    auto as_json = std::make_shared<bool>(false);
    command->add_flag("--json", *as_json, "Print JSON");
    command->callback([as_json] { run(*as_json); });
}

}  // namespace wedge::cli
