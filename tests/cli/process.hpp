// Runs the real program as a person would: arguments in; exit code, stdout and stderr out.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace wedge::test {

struct ProcessSettings {
    std::filesystem::path folder = ".";              ///< it runs in
    std::map<std::string, std::string> environment;  ///< added to, or replacing, this process's
    double timeout_s = 300;                          ///< then it is killed
    /// Given what it has written to stderr so far; once it returns true the program gets a SIGINT.
    std::function<bool(const std::string&)> interrupt_when;
    std::function<bool()>
        kill_when;  ///< asked again and again; once true, the program gets SIGKILL
    std::optional<std::size_t> largest_file_bytes;  ///< a write beyond fails, as on a full disk
};

struct ProcessResult {
    int exit_code = -1;  ///< -1 if a signal ended it
    int signal = 0;
    std::string out, err;
    double wall_s = 0;
    bool timed_out = false;

    bool err_has(const std::string& text) const { return err.find(text) != std::string::npos; }
    bool out_has(const std::string& text) const { return out.find(text) != std::string::npos; }
};

ProcessResult run_process(const std::vector<std::string>& command,
                          const ProcessSettings& settings = {});

}  // namespace wedge::test
