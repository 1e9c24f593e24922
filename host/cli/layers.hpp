// Which layers an EXR file gets (docs/output.md says what each holds).
#pragma once

#include <string>
#include <vector>

#include "wedge/image.hpp"
#include "wedge/render.hpp"

namespace wedge::cli {

/// "direct, indirect, …", for help and messages.
std::string layer_names();

/// Names in any case, or `all` (also if the list is empty) or `none`. Returns the names as they are
/// spelled in files. Throws Error(usage) that lists the known ones.
std::vector<std::string> parse_layers(const std::vector<std::string>& names);

/// Throws Error(usage) if one of `layers`, where these are not all, is none that `method` has.
void check_layers(const std::vector<std::string>& layers, Method method);

/// Whether select_layers would give `image` itself.
bool holds_only(const Image& image, const std::vector<std::string>& layers);

/// R, G, B, A and the channels of `layers`, in the order of `image`.
Image select_layers(const Image& image, const std::vector<std::string>& layers);

}  // namespace wedge::cli
