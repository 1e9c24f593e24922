// Floating-point images with named channels: what a render returns and what EXR files hold.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace wedge {

/// Row 0 at the top. Channels interleaved, float32. Names are those of the EXR file: `R`, `G`, `B`,
/// `A` first, then `layer.R`, `N.X`, `Z`, … (docs/output.md).
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels;
    std::vector<float> pixels;  ///< width * height * channels.size()
    std::map<std::string, std::string> metadata;

    float& at(int x, int y, int channel) {
        return pixels[(std::size_t(y) * width + x) * channels.size() + channel];
    }
    float at(int x, int y, int channel) const {
        return pixels[(std::size_t(y) * width + x) * channels.size() + channel];
    }
    /// Index of a channel, -1 where there is none.
    int channel(const std::string& name) const {
        for (std::size_t i = 0; i < channels.size(); ++i)
            if (channels[i] == name) return int(i);
        return -1;
    }
};

}  // namespace wedge
