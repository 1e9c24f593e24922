// The bytes of an image file to pixels, still in the file's own channels and encoding.
#pragma once

#include <OpenImageIO/imageio.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>

namespace wedge::image {

/// Row 0 at the top, `spec.nchannels` interleaved values a pixel, of type `type`.
struct DecodedImage {
    OIIO::ImageSpec spec;  ///< spec.format is how the file stores them
    OIIO::TypeDesc type;   ///< how they are held here: UINT8 or FLOAT
    std::unique_ptr<std::byte[]> values;

    std::size_t pixel_count() const { return std::size_t(spec.width) * std::size_t(spec.height); }
    const unsigned char* as_bytes() const {
        return reinterpret_cast<const unsigned char*>(values.get());
    }
    const float* as_floats() const { return reinterpret_cast<const float*>(values.get()); }
};

/// Largest image taken, in pixels: 16384 x 16384. A few hostile bytes can claim any size.
inline constexpr std::size_t kMaxPixels = std::size_t(1) << 28;

/// Reads the first image of a file. With `keep_bytes`, files of 8 bits stay at 8 bits (UINT8);
/// everything else becomes FLOAT, integers scaled to [0, 1]. Colour is not premultiplied by alpha,
/// palettes are expanded. Throws Error(bad_input).
DecodedImage decode(const std::filesystem::path& file, bool keep_bytes);

/// True if the file stores integers, which image files encode with the sRGB curve.
bool is_integer(const OIIO::ImageSpec& spec);

/// Which channel of the file holds R, G, B and A (-1: no alpha). Grey fills R, G and B. Goes by the
/// names where there are such, else by position. Throws Error(bad_input) if neither helps.
std::array<int, 4> rgba_channels(const OIIO::ImageSpec& spec, const std::filesystem::path& file);

}  // namespace wedge::image
