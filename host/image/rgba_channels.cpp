#include "host/image/rgba_channels.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wedge/error.hpp"

namespace wedge::image {

int channel_index(const std::vector<std::string>& channels, const std::string& name) {
    const auto found = std::find(channels.begin(), channels.end(), name);
    return found == channels.end() ? -1 : int(found - channels.begin());
}

std::array<int, 4> rgba_channels(const std::vector<std::string>& channels,
                                 const std::filesystem::path& file) {
    const auto find = [&](const char* name) { return channel_index(channels, name); };
    const int alpha = find("A");
    if (find("R") >= 0 && find("G") >= 0 && find("B") >= 0)
        return {find("R"), find("G"), find("B"), alpha};
    if (find("Y") >= 0) return {find("Y"), find("Y"), find("Y"), alpha};
    switch (channels.size()) {
        case 1:
            return {0, 0, 0, -1};
        case 2:
            return {0, 0, 0, 1};
        case 3:
            return {0, 1, 2, -1};
        case 4:
            return {0, 1, 2, 3};
        default:
            break;
    }
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{}: cannot read the image: none of its {} channels are called R, G, B or Y",
                    file.string(), channels.size()));
}

}  // namespace wedge::image
