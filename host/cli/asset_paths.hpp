// Where scene files look for models and textures that are not beside them.
#pragma once

#include <string>
#include <vector>

#include "wedge/scene.hpp"

namespace wedge::cli {

inline constexpr const char* kAssetPathHelp =
    "Folder searched for models and textures; repeatable. Then those in WEDGE_ASSETS";

/// Search order `folders`, then WEDGE_ASSETS (separated by colons); textures are read if this build
/// can read images. Throws Error(usage) if one of `folders` is not a folder; one of WEDGE_ASSETS
/// that is not gives a warning.
LoadOptions load_options(const std::vector<std::string>& folders);

}  // namespace wedge::cli
