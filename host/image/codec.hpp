// Between pixels and the bytes of image files stands OpenImageIO, which brings some 250 shared
// libraries with it: 0.2 s of loading and relocating, before `main` if it were linked. So what uses
// it is a module, host/codec, that is loaded when the first image is read or written. Only types of
// this program pass between the two, and Errors.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "wedge/image.hpp"

namespace wedge::image {

/// Largest image taken, in pixels: 16384 x 16384. A few hostile bytes can claim any size.
inline constexpr std::size_t kMaxPixels = std::size_t(1) << 28;

/// An image file's pixels, still in the file's own channels and encoding. Row 0 at the top,
/// `channels.size()` interleaved values a pixel.
struct DecodedImage {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels;            ///< as the file names them
    bool stores_integers = false;                 ///< which image files encode with the sRGB curve
    bool holds_bytes = false;                     ///< `values` are unsigned char, not float
    std::map<std::string, std::string> metadata;  ///< attributes that begin with kMetadataPrefix
    std::unique_ptr<std::byte[]> values;

    std::size_t pixel_count() const { return std::size_t(width) * std::size_t(height); }
    const unsigned char* as_bytes() const {
        return reinterpret_cast<const unsigned char*>(values.get());
    }
    const float* as_floats() const { return reinterpret_cast<const float*>(values.get()); }
};

/// What the module offers; `wedge_codec` in it returns the address of one.
struct Codec {
    unsigned interface_number;
    DecodedImage (*decode)(const std::filesystem::path& file, bool keep_bytes);
    std::string (*encode_exr)(const Image& image, const std::filesystem::path& named);
    std::string (*encode_png)(int width, int height, const unsigned char* rgb,
                              const std::filesystem::path& named);
};

/// Higher by one after every change to what passes between the program and the module.
inline constexpr unsigned kCodecInterface = 1;
inline constexpr const char* kCodecEntry = "wedge_codec";

/// Throws Error(usage) if the module is not where it is looked for. Costs some look-ups of names,
/// where `codec` has to load: for asking before a long render.
void require_codec();

/// The module, loaded at the first call and kept. It is looked for as shared libraries are, so in
/// the run path (RPATH) of the program first. Throws Error(usage) that says where.
const Codec& codec();

/// Reads the first image of a file. With `keep_bytes`, files of 8 bits stay at 8 bits; everything
/// else becomes float, integers scaled to [0, 1]. Colour is not premultiplied by alpha, palettes
/// are expanded. Throws Error(bad_input).
inline DecodedImage decode(const std::filesystem::path& file, bool keep_bytes) {
    return codec().decode(file, keep_bytes);
}

/// The bytes of an EXR file: all channels, float32, with metadata. Encoding apart from writing lets
/// every reason the disk may have reach the user, and lets files appear whole. `named` is what
/// error messages call the file. Throws Error(output).
inline std::string encode_exr(const Image& image, const std::filesystem::path& named) {
    return codec().encode_exr(image, named);
}

/// The bytes of a PNG file of 8 bits a channel; `rgb` holds 3 * width * height sRGB codes.
inline std::string encode_png(int width, int height, const unsigned char* rgb,
                              const std::filesystem::path& named) {
    return codec().encode_png(width, height, rgb, named);
}

}  // namespace wedge::image
