// What the module does; host/image/codec.hpp has the words.
#pragma once

#include "host/image/codec.hpp"

namespace wedge::codec {

image::DecodedImage decode(const std::filesystem::path& file, bool keep_bytes);
std::string encode_exr(const Image& image, const std::filesystem::path& named);
std::string encode_png(int width, int height, const unsigned char* rgb,
                       const std::filesystem::path& named);

}  // namespace wedge::codec
