// Files that a command reads and writes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace wedge::cli {

struct NamedFile {
    std::string what;  ///< option, or what the file is
    std::filesystem::path path;
};

/// Throws Error(usage) if one of `written` is one of those before it, or one of `read`, by whatever
/// name; Error(output) if one cannot be written later.
void check_written(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written);

}  // namespace wedge::cli
