// How Image::metadata is named in EXR files.
#pragma once

#include <string>
#include <string_view>

namespace wedge::image {

/// Keeps the keys of Wedge apart from those of OpenEXR and of other programs.
inline constexpr std::string_view kMetadataPrefix = "wedge:";

/// `seed` is stored as the attribute `wedge:seed`.
inline std::string exr_attribute_name(const std::string& key) {
    return std::string(kMetadataPrefix) + key;
}

}  // namespace wedge::image
