// How far one image is from another. docs/metrics.md has the formulas for users.
#pragma once

#include <cstdint>
#include <vector>

#include "host/image/plane.hpp"
#include "wedge/image.hpp"

namespace wedge::image {

/// Two images of one size as planes of linear R, G, B.
struct ImagePair {
    Planes test, reference;
    std::vector<uint8_t> counted;  ///< per pixel: 1 where all six values are finite
    std::size_t counted_pixels = 0;

    int width() const { return reference[0].width; }
    int height() const { return reference[0].height; }
};

/// Pixels that are not finite in either image are 0 in both and not counted. Throws
/// Error(bad_input) where sizes differ or R, G, B are missing.
ImagePair pair_images(const Image& test, const Image& reference);

/// Mean over the counted pixels; 0 if there are none.
double mean_of_counted(const ImagePair& pair, const Plane<float>& map);

/// Mean of (t - r)^2 over counted pixels and channels.
double mean_squared_error(const ImagePair& pair);

/// Mean of (t - r)^2 / (max(r, 0) + 0.01)^2, the MRSE of pbrt-v4. There r is never negative; the
/// maximum keeps a stray negative reference (a filter's lobe) from dividing by nearly nothing.
double relative_mean_squared_error(const ImagePair& pair);

/// Structural similarity (Wang et al. 2004), mean over counted pixels: 1 for equal images. Gaussian
/// window of 11 x 11, sigma 1.5 px, K1 = 0.01, K2 = 0.03, L = 1, on grey = srgb(x / (1 + x)) of the
/// luminance x. At the border the window is what lies inside the image, its weights scaled to 1.
double structural_similarity(const ImagePair& pair);

/// HDR-FLIP (Andersson et al. 2021): per pixel the largest LDR-FLIP over a range of exposures that
/// the reference decides, tone-mapped with the ACES fit. [0, 1], 0 for equal images.
Plane<float> flip_map(const ImagePair& pair);

}  // namespace wedge::image
