// What the device tests share: folders that vanish, environment for a block, and child processes.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wedge/error.hpp"

namespace wedge::test {

/// A fresh folder, removed with everything in it at the end of the block.
class TemporaryFolder {
  public:
    TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder();
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Sets an environment variable for the length of a block.
class ScopedVariable {
  public:
    ScopedVariable(std::string name, const std::string& value);
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;
    ~ScopedVariable();

  private:
    std::string name_;
    std::optional<std::string> before_;
};

void write_text(const std::filesystem::path& path, const std::string& text);
std::string read_text(const std::filesystem::path& path);

/// The message of the wedge::Error that `action` throws, "(no error)" if it throws none.
template <typename Action>
std::string error_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "(no error)";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

struct ChildResult {
    int exit_code;       ///< 128 + signal if it was killed
    std::string output;  ///< stdout and stderr
};

/// Variables to set, or to remove where there is no value.
using Environment = std::vector<std::pair<std::string, std::optional<std::string>>>;

/// A running copy of this test program that runs one test case (also a skipped one) with more
/// environment: OpenCL drivers read theirs once a process.
class Child {
  public:
    Child(const std::string& test_case, const Environment& environment);
    ChildResult wait();

  private:
    int pid_;
    TemporaryFolder folder_;
};

inline ChildResult run_child(const std::string& test_case, const Environment& environment) {
    return Child(test_case, environment).wait();
}

}  // namespace wedge::test
