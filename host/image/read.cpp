// Files to images of named float32 channels.
#include <algorithm>
#include <string>

#include "host/base/parallel.hpp"
#include "host/base/srgb.hpp"
#include "host/image/codec.hpp"
#include "host/image/rgba_channels.hpp"
#include "wedge/image_io.hpp"

namespace wedge {
namespace {

/// Names as in EXR files: formats that call grey `I` or `Y` become R, G, B, so that images of all
/// formats can be compared.
void name_channels(Image& image, const image::DecodedImage& decoded,
                   const std::filesystem::path& file) {
    if (decoded.channels.size() > 4 || image::channel_index(decoded.channels, "R") >= 0) {
        image.channels = decoded.channels;
        image.pixels.assign(decoded.as_floats(),
                            decoded.as_floats() + decoded.pixel_count() * image.channels.size());
        return;
    }
    const auto source = image::rgba_channels(decoded.channels, file);
    image.channels = {"R", "G", "B"};
    if (source[3] >= 0) image.channels.push_back("A");
    image.pixels.reserve(decoded.pixel_count() * image.channels.size());
    for (std::size_t i = 0; i < decoded.pixel_count(); ++i)
        for (std::size_t c = 0; c < image.channels.size(); ++c)
            image.pixels.push_back(
                decoded.as_floats()[i * decoded.channels.size() + std::size_t(source[c])]);
}

void decode_srgb(Image& image) {
    const int alpha = image.channel("A");
    const std::size_t stride = image.channels.size();
    parallel_ranges(image.pixels.size() / stride, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            for (std::size_t c = 0; c < stride; ++c)
                if (int(c) != alpha) {
                    float& value = image.pixels[i * stride + c];
                    value = srgb_decode(value);
                }
    });
}

}  // namespace

Image read_image(const std::filesystem::path& file) {
    const image::DecodedImage decoded = image::decode(file, false);
    Image result;
    result.width = decoded.width;
    result.height = decoded.height;
    result.metadata = decoded.metadata;
    name_channels(result, decoded, file);
    if (decoded.stores_integers) decode_srgb(result);
    return result;
}

}  // namespace wedge
