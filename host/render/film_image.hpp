// Sums over samples to the named channels of an image.
#pragma once

#include <span>

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

/// Appends a channel; `values` are the crop's, row by row. Empty: nothing is appended.
void add_channel(Image& image, const std::string& name, std::span<const float> values,
                 const Rect& crop);

}  // namespace wedge::rendering
