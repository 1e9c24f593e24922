// Sums over samples to the named channels of an image.
#pragma once

#include <span>

#include "host/render/filter_layers.hpp"
#include "wedge/image.hpp"
#include "wedge/render.hpp"
#include "wedge/shared/frame.h"

namespace wedge::rendering {

/// The size of the film, all 0, with the channels of docs/output.md that every image has.
Image black_image(const Film& film);

/// `pixels` are the crop's, row by row.
void write_film(std::span<const shared::FilmPixel> pixels, const Rect& crop, Image& image);

/// The same, of light alone: what filters change.
void write_light(std::span<const shared::FilmPixel> pixels, const Rect& crop, Image& image);

/// Fills channels, which are appended, all 0, where there are none of these names; values are the
/// crop's, row by row. Always of the same names.
void add_channels(Image& image, std::span<const NamedChannel> channels, const Rect& crop);

}  // namespace wedge::rendering
