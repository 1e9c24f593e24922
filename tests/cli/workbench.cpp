#include "tests/cli/workbench.hpp"

#include <stdlib.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace wedge::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRoomObj = R"(v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v -1 2 -1
v 1 2 -1
v 1 2 1
v -1 2 1
f 1 4 3 2
f 1 2 6 5
f 5 6 7 8
)";

constexpr const char* kRoomScene = R"({
  "camera": {"position": [0, 1, 4], "target": [0, 1, 0], "vertical_fov_deg": 40},
  "film": {"width": 32, "height": 24},
  "render": {"spp": 4, "bounces": 1},
  "background": [0, 0, 0],
  "materials": {"grey": {"kd": [0.5, 0.5, 0.5]}},
  "meshes": {"room": {"obj": "room.obj"}},
  "instances": [{"mesh": "room", "material": "grey"}],
  "lights": [{"type": "rect", "center": [0, 1.9, 0], "u": [1, 0, 0], "v": [0, 0, 1],
              "radiance": [5, 5, 5]}]
}
)";

}  // namespace

Workbench::Workbench() {
    std::string pattern = (fs::temp_directory_path() / "wedge-test-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("mkdtemp failed: " + pattern);
    folder_ = pattern;
}

Workbench::~Workbench() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
}

void Workbench::write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
}

std::string Workbench::read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return text.str();
}

bool Workbench::has(const std::string& name) const {
    return fs::exists(folder_ / name);
}

std::set<std::string> Workbench::files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_))
        names.insert(entry.path().filename().string());
    return names;
}

ProcessResult Workbench::wedge(const std::vector<std::string>& arguments,
                               ProcessSettings settings) const {
    std::vector<std::string> command{WEDGE_PROGRAM};
    command.insert(command.end(), arguments.begin(), arguments.end());
    settings.folder = folder_;
    return run_process(command, settings);
}

std::string room_scene(const std::string& pattern, const std::string& replacement) {
    std::string text = kRoomScene;
    const auto at = text.find(pattern);
    if (at == std::string::npos) throw std::logic_error("not in room.json: " + pattern);
    return text.replace(at, pattern.size(), replacement);
}

void write_room(const Workbench& bench) {
    bench.write("room.obj", kRoomObj);
    bench.write("room.json", room_scene());
}

}  // namespace wedge::test
