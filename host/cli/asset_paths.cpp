#include "host/cli/asset_paths.hpp"

#include <cstdlib>
#include <sstream>

#include "host/cli/image_support.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::cli {
namespace {

namespace fs = std::filesystem;

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

void append_environment(std::vector<fs::path>& paths) {
    const char* variable = std::getenv("WEDGE_ASSETS");
    std::istringstream list(variable ? variable : "");
    for (std::string folder; std::getline(list, folder, ':');) {
        if (folder.empty()) continue;
        if (is_folder(folder))
            paths.emplace_back(folder);
        else
            log_warning("WEDGE_ASSETS: " + folder + " is not a folder; it is left out");
    }
}

}  // namespace

LoadOptions load_options(const std::vector<std::string>& folders) {
    LoadOptions options;
    for (const std::string& folder : folders) {
        if (!is_folder(folder))
            throw Error(ErrorKind::usage, "--asset-path " + folder + ": not a folder");
        options.asset_paths.emplace_back(folder);
    }
    append_environment(options.asset_paths);
    options.load_texture = texture_loader();
    return options;
}

}  // namespace wedge::cli
