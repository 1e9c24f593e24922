// Kernel files to one flat text.
#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "host/device/embedded_sources.hpp"
#include "host/device/program.hpp"
#include "wedge/error.hpp"

namespace wedge::device {
namespace {

/// Reads from a source tree if there is one, else from the program itself.
std::optional<std::string> read_source(const std::string& path, const std::string& kernel_dir) {
    if (kernel_dir.empty()) {
        for (std::size_t i = 0; i < kEmbeddedSourceCount; ++i) {
            const EmbeddedSource& source = kEmbeddedSources[i];
            if (path == source.path) return std::string(source.text, source.size);
        }
        return std::nullopt;
    }
    std::ifstream file(kernel_dir + "/" + path, std::ios::binary);
    if (!file) return std::nullopt;
    std::ostringstream text;
    text << file.rdbuf();
    return std::move(text).str();
}

/// Where an include name lies, from the root of the source tree.
std::string path_of_include(std::string_view name) {
    if (name.starts_with("wedge/")) return fmt::format("include/{}", name);
    if (name.starts_with("kernels/")) return std::string(name);
    return fmt::format("kernels/{}", name);
}

/// The NAME of a line `#include "NAME"`. Includes in angle brackets are for C++ alone.
std::optional<std::string_view> included_name(std::string_view line) {
    const auto skip_blanks = [&line] {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    };
    skip_blanks();
    if (!line.starts_with('#')) return std::nullopt;
    line.remove_prefix(1);
    skip_blanks();
    if (!line.starts_with("include")) return std::nullopt;
    line.remove_prefix(7);
    skip_blanks();
    if (!line.starts_with('"')) return std::nullopt;
    line.remove_prefix(1);
    const std::size_t end = line.find('"');
    if (end == std::string_view::npos) return std::nullopt;
    return line.substr(0, end);
}

class Assembler {
  public:
    explicit Assembler(std::string kernel_dir) : kernel_dir_(std::move(kernel_dir)) {}

    void append(const std::string& path, const std::string& included_from, int included_at) {
        // Once each, whatever the guards say: an include under an #if that is false would hide the
        // file from all who follow, so shared files are included unconditionally.
        if (!seen_.insert(path).second) return;
        const std::optional<std::string> source = read_source(path, kernel_dir_);
        if (!source) fail_missing(path, included_from, included_at);
        append_lines(path, *source);
    }

    std::string take() { return std::move(text_); }

  private:
    void append_lines(const std::string& path, const std::string& source) {
        text_ += fmt::format("#line 1 \"{}\"\n", path);
        std::istringstream lines(source);
        std::string line;
        for (int number = 1; std::getline(lines, line); ++number) {
            if (line.ends_with('\r')) line.pop_back();
            if (const auto name = included_name(line)) {
                append(path_of_include(*name), path, number);
                text_ += fmt::format("#line {} \"{}\"\n", number + 1, path);
            } else {
                text_ += line + '\n';
            }
        }
    }

    [[noreturn]] void fail_missing(const std::string& path, const std::string& included_from,
                                   int included_at) const {
        const bool embedded = kernel_dir_.empty();
        const std::string where =
            included_from.empty() ? "" : fmt::format("{}:{}: ", included_from, included_at);
        throw Error(embedded ? ErrorKind::internal : ErrorKind::bad_input,
                    fmt::format("{}there is no kernel source {} {}", where, path,
                                embedded ? "in this program" : "under " + kernel_dir_));
    }

    std::string kernel_dir_, text_;
    std::set<std::string> seen_;
};

}  // namespace

std::string assemble_source(const std::string& file, const std::string& kernel_dir) {
    Assembler assembler(kernel_dir);
    assembler.append(file, "", 0);
    return assembler.take();
}

}  // namespace wedge::device
