// JSON scenes (docs/scene-format.md).
#pragma once

#include <filesystem>

#include "wedge/scene.hpp"

namespace wedge::scene {

/// Throws Error(bad_input) with the file and the JSON pointer, or line and column.
Scene load_scene_file(const std::filesystem::path& file, const LoadOptions& options);

}  // namespace wedge::scene
