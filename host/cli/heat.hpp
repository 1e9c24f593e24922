// Heat maps of a render's layers, for `--heat` (docs/output.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/cli/image_support.hpp"
#include "wedge/image.hpp"
#include "wedge/render.hpp"
#include "wedge/scene.hpp"

namespace wedge::cli {

/// "spp, Z, …", for help and messages.
std::string heat_layer_names();

/// Throws Error(usage) that lists the known names where one is not `all`, a layer, or what several
/// layers' names begin with (`width` for `width.direct` and `width.indirect`). Any case.
void check_heat_names(const std::vector<std::string>& names);

/// The layers that `names` ask for and that this render will have, each once. Throws Error(usage)
/// that lists those that it will have where a name stands for none of them.
std::vector<std::string> choose_heat_layers(const std::vector<std::string>& names,
                                            const Scene& scene, const RenderOptions& options);

/// `folder/image.LAYER.png` for the output `folder/image.exr`.
std::filesystem::path heat_file(const std::filesystem::path& output, const std::string& layer);

/// False for layers that a render which failed did not come to.
bool has_heat_layer(const Image& image, const std::string& layer);

/// Of a layer that `image` has. Throws Error(output).
void write_heat(const std::filesystem::path& file, const Image& image, const std::string& layer,
                const Develop& develop);

}  // namespace wedge::cli
