// Images to and from files, and the distance between two images. Needs OpenImageIO.
#pragma once

#include <filesystem>
#include <string>

#include "wedge/image.hpp"
#include "wedge/scene.hpp"

namespace wedge {

/// Tone curves for PNG. `srgb`: clip at 1. `filmic`: ACES-like shoulder (Narkowicz 2015).
/// `reinhard`: x / (1 + x).
enum class ToneCurve { srgb, filmic, reinhard };
ToneCurve parse_tone_curve(const std::string& name);  ///< throws Error(usage) that lists the names

/// Writes `file` (EXR: every channel, float32, with metadata) through a temporary file and a
/// rename, so that a truncated file never stands under the final name. Throws Error(output).
void write_exr(const std::filesystem::path& file, const Image& image);

/// Tone-maps R, G, B to 8 bits with the sRGB curve. `exposure` in stops. Throws Error(output).
void write_png(const std::filesystem::path& file, const Image& image, float exposure = 0,
               ToneCurve curve = ToneCurve::srgb);

/// Throws Error(output) at once if `file` could not be written later: checked before a long render.
void check_writable(const std::filesystem::path& file);

/// Any format OpenImageIO reads, as float32 (8-bit files are decoded from sRGB). Throws
/// Error(bad_input).
Image read_image(const std::filesystem::path& file);

/// A TextureLoader (see scene.hpp).
TextureImage load_texture(const std::filesystem::path& file, bool is_colour);

/// Formulas in host/image/metrics.hpp and docs/metrics.md. Over R, G, B.
struct ImageDifference {
    double mse = 0;
    double rmse = 0;
    double rel_mse = 0;  ///< mean (t - r)^2 / (r + 0.01)^2, pbrt-v4's MRSE
    double ssim = 0;
    double flip = 0;
    std::size_t non_finite = 0;  ///< pixels left out because a channel is not finite
};

/// Throws Error(bad_input) where sizes differ or R, G, B are missing.
ImageDifference compare_images(const Image& test, const Image& reference);

/// |t - r| * gain, as an image of R, G, B.
Image difference_image(const Image& test, const Image& reference, float gain);

}  // namespace wedge
