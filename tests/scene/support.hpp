// What the tests of the scene part share: files that go away, messages that are kept.
#pragma once

#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "wedge/error.hpp"
#include "wedge/log.hpp"
#include "wedge/scene.hpp"

namespace wedge::test {

/// A folder of its own, removed at the end of the test.
class TempFolder {
  public:
    TempFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "wedge_scene_XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~TempFolder() { std::filesystem::remove_all(path_); }
    TempFolder(const TempFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
        return path_ / name;
    }

  private:
    std::filesystem::path path_;
};

/// Messages of tests that do not look at them would only hide those of doctest.
inline void ignore_messages() {
    set_log_sink([](LogLevel, const std::string&) {});
}
inline const bool kQuiet = (ignore_messages(), true);

/// Keeps what is logged while it lives.
class LogCapture {
  public:
    LogCapture() {
        set_log_sink([this](LogLevel level, const std::string& message) {
            (level == LogLevel::warning ? warnings : infos).push_back(message);
        });
    }
    ~LogCapture() { ignore_messages(); }

    /// How many warnings contain `part`.
    int count(const std::string& part) const {
        int n = 0;
        for (const std::string& warning : warnings) n += warning.find(part) != std::string::npos;
        return n;
    }

    std::vector<std::string> warnings, infos;
};

/// The message of the Error(bad_input) that `action` throws; empty, after a failed check, if none.
inline std::string bad_input(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::bad_input);
        return error.what();
    }
    FAIL_CHECK("no error was thrown");
    return "";
}

inline bool contains(const std::string& text, const std::string& part) {
    const bool found = text.find(part) != std::string::npos;
    if (!found) MESSAGE("\"" << part << "\" is not in: " << text);
    return found;
}

/// One triangle in the plane z = 0.
inline const std::string kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A scene of one triangle with further members, each of which replaces the usual one.
inline std::string scene_text(const std::string& camera = "", const std::string& others = "",
                              const std::string& meshes = "") {
    return "{\"camera\": " +
           (camera.empty() ? "{\"position\": [0, 0, 5], \"target\": [0, 0, 0]}" : camera) +
           ", \"meshes\": " + (meshes.empty() ? "{\"t\": {\"obj\": \"t.obj\"}}" : meshes) +
           (others.empty() ? "" : ", " + others) + "}";
}

/// Loads such a scene from a folder of its own.
inline Scene load_text(const std::string& text, const LoadOptions& options = {}) {
    TempFolder folder;
    folder.write("t.obj", kTriangleObj);
    return load_scene(folder.write("scene.json", text), options);
}

/// The shared models: WEDGE_SHARED_DIR, else the folder `shared` beside the repository.
inline std::filesystem::path shared_model(const std::string& name) {
    const char* given = std::getenv("WEDGE_SHARED_DIR");
    const std::filesystem::path root =
        given ? std::filesystem::path(given)
              : std::filesystem::path(__FILE__).parent_path() / "../../../shared";
    return root / "scenes" / name;
}

}  // namespace wedge::test
