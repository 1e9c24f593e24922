// A look at the header of an OpenEXR file before the library takes its word for it.
#pragma once

#include <filesystem>
#include <string>

namespace wedge::codec {

/// What is wrong with the attributes of an OpenEXR file: the library sets aside whatever size an
/// attribute claims, gigabytes too, before it looks for the bytes. Empty for sound files and for
/// all other formats.
std::string flaw_of_exr_header(const std::filesystem::path& file);

}  // namespace wedge::codec
