#include "bench/converge/run_record.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "host/base/sha256.hpp"
#include "wedge/error.hpp"

namespace wedge::converge {
namespace {

using nlohmann::json;

BudgetUnit unit_named(const std::string& name) {
    for (BudgetUnit unit : {BudgetUnit::spp, BudgetUnit::mu})
        if (name == name_of(unit)) return unit;
    return BudgetUnit::seconds;
}

}  // namespace

json to_json(const RunRecord& r) {
    json passes = json::array();
    for (const PassStats& pass : r.passes)
        passes.push_back(
            {{"name", pass.name}, {"device_s", pass.device_s}, {"launches", pass.launches}});
    return {{"key", r.key},
            {"scene", r.scene},
            {"scene_digest", r.scene_digest},
            {"method", r.method},
            {"unit", name_of(r.budget.unit)},
            {"budget", r.budget.value},
            {"knob", r.knob},
            {"seed", r.seed},
            {"width", r.width},
            {"height", r.height},
            {"image", r.image},
            {"time_s", r.time_s},
            {"flatten_s", r.flatten_s},
            {"bvh_build_s", r.bvh_build_s},
            {"upload_s", r.upload_s},
            {"compile_s", r.compile_s},
            {"render_s", r.render_s},
            {"passes", passes},
            {"rays", r.rays},
            {"samples", r.samples},
            {"non_finite_samples", r.non_finite_samples},
            {"predicted_rmse", r.predicted_rmse},
            {"device", r.device},
            {"driver", r.driver},
            {"platform", r.platform},
            {"version", r.version},
            {"program", r.program},
            {"commit", r.commit},
            {"settings", r.settings},
            {"command", r.command}};
}

RunRecord run_record_from(const json& o) {
    RunRecord r;
    const auto get = [&](const char* key, auto& value) { o.at(key).get_to(value); };
    get("key", r.key);
    get("scene", r.scene);
    get("scene_digest", r.scene_digest);
    get("method", r.method);
    r.budget = {unit_named(o.at("unit").get<std::string>()), o.at("budget").get<double>()};
    get("knob", r.knob);
    get("seed", r.seed);
    get("width", r.width);
    get("height", r.height);
    get("image", r.image);
    get("time_s", r.time_s);
    get("flatten_s", r.flatten_s);
    get("bvh_build_s", r.bvh_build_s);
    get("upload_s", r.upload_s);
    get("compile_s", r.compile_s);
    get("render_s", r.render_s);
    for (const json& pass : o.at("passes"))
        r.passes.push_back({pass.at("name").get<std::string>(), pass.at("device_s").get<double>(),
                            pass.at("launches").get<uint64_t>()});
    get("rays", r.rays);
    get("samples", r.samples);
    get("non_finite_samples", r.non_finite_samples);
    get("predicted_rmse", r.predicted_rmse);
    get("device", r.device);
    get("driver", r.driver);
    get("platform", r.platform);
    get("version", r.version);
    get("program", r.program);
    get("commit", r.commit);
    r.settings = o.at("settings");
    get("command", r.command);
    return r;
}

void append_line(const std::filesystem::path& file, const std::string& line) {
    const auto fail = [&](const char* what) {
        throw Error(ErrorKind::output,
                    fmt::format("{}: {}: {}", file.string(), what, std::strerror(errno)));
    };
    const int handle = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (handle < 0) fail("cannot open");
    const std::string text = line + "\n";
    const ssize_t written = ::write(handle, text.data(), text.size());
    const bool whole = written == ssize_t(text.size()) && ::fsync(handle) == 0;
    ::close(handle);
    if (!whole) fail("cannot append");
}

std::vector<json> read_lines(const std::filesystem::path& file) {
    std::vector<json> objects;
    std::ifstream in(file, std::ios::binary);
    if (!in) return objects;
    std::stringstream all;
    all << in.rdbuf();
    const std::string text = all.str();
    std::size_t begin = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != text.npos; begin = end + 1) {
        json object = json::parse(text.substr(begin, end - begin), nullptr, false);
        if (!object.is_discarded()) objects.push_back(std::move(object));
    }
    // What follows the last newline was being written when the program was killed; the next line
    // must not be glued to it.
    if (begin < text.size()) {
        std::error_code ignored;
        std::filesystem::resize_file(file, begin, ignored);
    }
    return objects;
}

std::string run_key(const std::string& scene_digest, const Method& method, const Budget& budget,
                    uint32_t seed, const DeviceInfo& device) {
    const std::string text =
        fmt::format("{}|{}|{}|{}|{:.9g}|{}|{}|{}|{}", scene_digest, method.name,
                    settings_json(method).dump(), name_of(budget.unit), budget.value, seed,
                    device.name, device.driver, device.platform_version);
    return to_hex(sha256(text)).substr(0, 16);
}

}  // namespace wedge::converge
