#include "host/cli/written_files.hpp"

#include <fmt/format.h>

#include "host/cli/image_support.hpp"
#include "wedge/error.hpp"

namespace wedge::cli {
namespace {

namespace fs = std::filesystem;

/// What is no ordinary file (/dev/stdout) may be written to twice.
bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code ignored;
    if (fs::exists(a, ignored) && !fs::is_regular_file(a, ignored)) return false;
    if (fs::equivalent(a, b, ignored)) return true;
    std::error_code failed;
    const fs::path x = fs::weakly_canonical(fs::absolute(a), failed),
                   y = fs::weakly_canonical(fs::absolute(b), failed);
    return !failed && x == y;
}

}  // namespace

void check_written(const std::vector<NamedFile>& read, const std::vector<NamedFile>& written) {
    std::vector<NamedFile> known = read;
    for (const NamedFile& file : written) {
        for (const NamedFile& other : known)
            if (is_same_file(file.path, other.path))
                throw Error(ErrorKind::usage,
                            fmt::format("{} {}: would replace {}; give another name", file.what,
                                        file.path.string(), other.what));
        check_output(file.path);
        known.push_back({"the file of " + file.what, file.path});
    }
}

}  // namespace wedge::cli
