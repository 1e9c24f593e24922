#include "host/cli/layers.hpp"

#include <strings.h>

#include <algorithm>
#include <array>

#include "wedge/error.hpp"

namespace wedge::cli {
namespace {

constexpr std::array kLayers{"direct", "indirect", "emission", "albedo", "N",
                             "P",      "Z",        "variance", "spp",    "width",
                             "guard",  "near",     "far",      "error",  "unfiltered"};

/// Those that only filtered renders have.
constexpr std::array kFilteredLayers{"width", "guard", "near", "far", "error", "unfiltered"};

bool same_name(const std::string& a, const char* b) {
    return strcasecmp(a.c_str(), b) == 0;
}

std::string spelled(const std::string& name) {
    for (const char* layer : kLayers)
        if (same_name(name, layer)) return layer;
    throw Error(ErrorKind::usage,
                "--aov " + name + ": no such layer; known: all, none, " + layer_names());
}

// `albedo.R` is in the layer `albedo`, `Z` in the layer `Z`.
std::string layer_of(const std::string& channel) {
    return channel.substr(0, channel.find('.'));
}

bool is_beauty(const std::string& channel) {
    return channel == "R" || channel == "G" || channel == "B" || channel == "A";
}

}  // namespace

std::string layer_names() {
    std::string names;
    for (const char* layer : kLayers) {
        if (!names.empty()) names += ", ";
        names += layer;
    }
    return names;
}

std::vector<std::string> parse_layers(const std::vector<std::string>& names) {
    std::vector<std::string> layers;
    for (const std::string& name : names)
        if (!same_name(name, "all") && !same_name(name, "none")) layers.push_back(spelled(name));
    const bool all = names.empty() || std::any_of(names.begin(), names.end(), [](const auto& name) {
                         return same_name(name, "all");
                     });
    if (all) layers.assign(kLayers.begin(), kLayers.end());
    return layers;
}

void check_layers(const std::vector<std::string>& layers, Method method) {
    if (method == Method::aaf || layers.size() == kLayers.size()) return;
    for (const std::string& layer : layers)
        if (std::find(kFilteredLayers.begin(), kFilteredLayers.end(), layer) !=
            kFilteredLayers.end())
            throw Error(ErrorKind::usage,
                        "--aov " + layer +
                            ": --method mc has no such layer; use --method aaf, or --aov all");
}

bool holds_only(const Image& image, const std::vector<std::string>& layers) {
    return std::all_of(image.channels.begin(), image.channels.end(), [&](const auto& channel) {
        return is_beauty(channel) ||
               std::count(layers.begin(), layers.end(), layer_of(channel)) > 0;
    });
}

Image select_layers(const Image& image, const std::vector<std::string>& layers) {
    Image selected;
    selected.width = image.width;
    selected.height = image.height;
    selected.metadata = image.metadata;
    std::vector<std::size_t> sources;
    for (std::size_t i = 0; i < image.channels.size(); ++i) {
        const std::string& channel = image.channels[i];
        const bool wanted =
            is_beauty(channel) || std::count(layers.begin(), layers.end(), layer_of(channel)) > 0;
        if (!wanted) continue;
        sources.push_back(i);
        selected.channels.push_back(channel);
    }

    const std::size_t pixel_count = std::size_t(image.width) * image.height;
    selected.pixels.reserve(pixel_count * sources.size());
    for (std::size_t pixel = 0; pixel < pixel_count; ++pixel)
        for (const std::size_t source : sources)
            selected.pixels.push_back(image.pixels[pixel * image.channels.size() + source]);
    return selected;
}

}  // namespace wedge::cli
