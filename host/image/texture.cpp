// Image files to textures: RGBA, at 8 bits where the file has 8 bits, else linear float32.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "host/base/srgb.hpp"
#include "host/image/codec.hpp"
#include "host/image/rgba_channels.hpp"
#include "wedge/image_io.hpp"
#include "wedge/log.hpp"
#include "wedge/shared/radiance.h"

namespace wedge {
namespace {

using image::DecodedImage;

void fill_bytes(TextureImage& texture, const DecodedImage& decoded, std::array<int, 4> source) {
    const std::size_t stride = decoded.channels.size();
    texture.texels.resize(decoded.pixel_count() * 4);
    for (std::size_t i = 0; i < decoded.pixel_count(); ++i)
        for (std::size_t c = 0; c < 4; ++c)
            texture.texels[i * 4 + c] =
                source[c] < 0 ? 255 : decoded.as_bytes()[i * stride + std::size_t(source[c])];
}

/// Texels that had values which are not what is stored.
struct OddTexels {
    std::size_t non_finite = 0;  ///< such values become 0
    std::size_t too_large = 0;   ///< such values become the largest that a sample may have
};

OddTexels fill_floats(TextureImage& texture, const DecodedImage& decoded, std::array<int, 4> source,
                      bool decode_srgb) {
    const std::size_t stride = decoded.channels.size();
    texture.texels.resize(decoded.pixel_count() * 4 * sizeof(float));
    OddTexels odd;
    for (std::size_t i = 0; i < decoded.pixel_count(); ++i) {
        float texel[4] = {0, 0, 0, 1};
        bool finite = true, fits = true;
        for (std::size_t c = 0; c < 4; ++c) {
            if (source[c] < 0) continue;
            const float value = decoded.as_floats()[i * stride + std::size_t(source[c])];
            finite = finite && std::isfinite(value);
            fits = fits && !(std::abs(value) > WEDGE_LARGEST_RADIANCE);
            if (!std::isfinite(value))
                texel[c] = 0;
            else
                texel[c] = std::clamp(decode_srgb && c < 3 ? srgb_decode(value) : value,
                                      -WEDGE_LARGEST_RADIANCE, WEDGE_LARGEST_RADIANCE);
        }
        odd.non_finite += finite ? 0 : 1;
        odd.too_large += finite && !fits ? 1 : 0;
        std::memcpy(texture.texels.data() + i * sizeof(texel), texel, sizeof(texel));
    }
    return odd;
}

}  // namespace

TextureImage load_texture(const std::filesystem::path& file, bool is_colour) {
    const DecodedImage decoded = image::decode(file, true);
    const auto source = image::rgba_channels(decoded.channels, file);
    TextureImage texture;
    texture.width = decoded.width;
    texture.height = decoded.height;
    if (decoded.holds_bytes) {
        texture.format = is_colour ? TextureFormat::srgb8 : TextureFormat::linear8;
        fill_bytes(texture, decoded, source);
        return texture;
    }
    texture.format = TextureFormat::float32;
    const bool decode_srgb = is_colour && decoded.stores_integers;
    const OddTexels odd = fill_floats(texture, decoded, source, decode_srgb);
    if (odd.non_finite > 0)
        log_warning(fmt::format("{}: {} of {} texels have values that are not finite; 0 is used",
                                file.string(), odd.non_finite, decoded.pixel_count()));
    if (odd.too_large > 0)
        log_warning(fmt::format("{}: {} of {} texels have values above {:g}, which is used",
                                file.string(), odd.too_large, decoded.pixel_count(),
                                WEDGE_LARGEST_RADIANCE));
    return texture;
}

}  // namespace wedge
