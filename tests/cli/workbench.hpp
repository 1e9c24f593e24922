// A folder of its own for each test, with a small room to render in it.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/cli/process.hpp"

namespace wedge::test {

/// A temporary folder, removed at the end, in which the program is run.
class Workbench {
  public:
    Workbench();
    ~Workbench();
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;

    const std::filesystem::path& folder() const { return folder_; }
    void write(const std::string& name, const std::string& text) const;
    std::string read(const std::string& name) const;
    bool has(const std::string& name) const;
    std::set<std::string> files() const;  ///< names in the folder

    /// Runs `wedge ARGUMENTS` here.
    ProcessResult wedge(const std::vector<std::string>& arguments,
                        ProcessSettings settings = {}) const;

  private:
    std::filesystem::path folder_;
};

/// room.obj: floor, back wall and ceiling, 2 x 2 x 2 around (0, 1, 0), open to +z. room.json looks
/// into it: 32x24 px, 4 samples per pixel, one bounce, a rectangular light below the ceiling.
void write_room(const Workbench& bench);

/// The text of room.json, with `pattern` (which must occur) replaced.
std::string room_scene(const std::string& pattern = "", const std::string& replacement = "");

}  // namespace wedge::test
