// Sums over samples to the named channels of an image.
#pragma once

#include <span>

#include "host/render/filter_layers.hpp"
#include "wedge/image.hpp"
#include "wedge/render.hpp"
#include "wedge/shared/frame.h"

namespace wedge::rendering {

/// `pixels` are the crop's, row by row; the image has the size of the film, 0 outside the crop.
/// Channels are described in docs/output.md.
Image black_image(const Film& film);
void write_film(std::span<const shared::FilmPixel> pixels, const Rect& crop, Image& image);

/// Both: pixels outside the crop are 0.
Image film_to_image(std::span<const shared::FilmPixel> pixels, const Film& film, const Rect& crop);

/// Appends channels; their values are the crop's, row by row.
void add_channels(Image& image, std::span<const NamedChannel> channels, const Rect& crop);

}  // namespace wedge::rendering
