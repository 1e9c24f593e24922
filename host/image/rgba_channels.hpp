// Which channels of a file are its colours.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace wedge::image {

/// Index of a channel, -1 where there is none.
int channel_index(const std::vector<std::string>& channels, const std::string& name);

/// Which channel of the file holds R, G, B and A (-1: no alpha). Grey fills R, G and B. Goes by the
/// names where there are such, else by position. Throws Error(bad_input) if neither helps.
std::array<int, 4> rgba_channels(const std::vector<std::string>& channels,
                                 const std::filesystem::path& file);

}  // namespace wedge::image
