// How Image::metadata is named in EXR files.
#pragma once

#include <string>
#include <string_view>

namespace wedge::image {

/// Keeps what Wedge says apart from the attributes of OpenEXR and of other programs.
inline constexpr std::string_view kMetadataPrefix = "wedge:";

/// Keys are attribute names, `wedge:seed`; a key without the prefix gets it.
inline std::string exr_attribute_name(const std::string& key) {
    return key.starts_with(kMetadataPrefix) ? key : std::string(kMetadataPrefix) + key;
}

}  // namespace wedge::image
