// What filtering knows about its pixels, as layers of the image.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/render/signal_filter.hpp"
#include "wedge/image.hpp"
#include "wedge/math.hpp"
#include "wedge/shared/frame.h"

namespace wedge::rendering {

/// A channel's name and its values by pixel of the crop.
using NamedChannel = std::pair<std::string, std::vector<float>>;

/// Channels `width`, `guard`, `near`, `far`, `error`, `unfiltered` (docs/output.md). `film`: sums
/// before filtered light took its place; `errors`: mean square errors of R, G and B.
std::vector<NamedChannel> filter_layers(const FilteredLight& light,
                                        const std::vector<shared::FilmPixel>& film,
                                        std::span<const Vec3> errors);

}  // namespace wedge::rendering
