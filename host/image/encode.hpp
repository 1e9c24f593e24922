// Pixels to the bytes of an image file, in memory.
#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <string>

namespace wedge::image {

/// Bytes of a file of `format` ("openexr", "png") that holds `pixels`, laid out as `spec` says.
/// Encoding apart from writing lets every reason the disk may have reach the user, and lets files
/// appear whole. `named` is what error messages call the file. Throws Error(output).
std::string encode(const std::string& format, const OIIO::ImageSpec& spec, const void* pixels,
                   const std::filesystem::path& named);

}  // namespace wedge::image
