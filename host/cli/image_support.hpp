// The program's only door to image files, so that a build without OpenImageIO differs in one place:
// there textures are left out and what writes images says that it cannot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/image/heat_map.hpp"
#include "wedge/image.hpp"
#include "wedge/scene.hpp"

namespace CLI {
class App;
}

namespace wedge::cli {

/// How a PNG is made from radiance.
struct Develop {
    float exposure = 0;         ///< stops
    std::string tone = "srgb";  ///< name of a tone curve
};

/// Throws Error(usage) if this build has no image support.
void require_image_support(const std::string& command);

/// Registers `compare`, or a stand-in that says what is missing.
void register_compare_if_supported(CLI::App& app);

/// Empty if this build has no image support.
TextureLoader texture_loader();

/// Throws Error(usage) for an unknown tone curve.
void check_tone(const std::string& name);

/// Throws Error(output) if `file` cannot be written later.
void check_output(const std::filesystem::path& file);

/// `.exr` or `.png`, by the extension. Throws Error(output).
void write_output(const std::filesystem::path& file, const Image& image, const Develop& develop);

/// A PNG. Throws Error(output).
void write_output(const std::filesystem::path& file, const image::HeatLayer& layer);

}  // namespace wedge::cli
