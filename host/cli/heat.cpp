#include "host/cli/heat.hpp"

#include <fmt/format.h>
#include <strings.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/cli/layers.hpp"
#include "host/image/heat_map.hpp"
#include "host/render/plan.hpp"
#include "wedge/error.hpp"

namespace wedge::cli {
namespace {

namespace fs = std::filesystem;

/// What a scene and a method must have for a layer to be there.
enum class Needs { nothing, filtered_shadows, filtered_hemisphere, any_filter };

struct HeatSource {
    const char* layer;
    const char* unit;
    const char* present;  ///< channel that is above 0 where the layer has a value
    Needs needs;
    bool is_rgb = false;  ///< then shown is the mean of R, G and B
};

constexpr const char* kPicture = "unfiltered";  // of colour: not a heat map

constexpr HeatSource kSources[] = {
    {"spp", "samples", "spp", Needs::nothing},
    {"Z", "world units", "Z", Needs::nothing},
    {"variance", "radiance^2", "spp", Needs::nothing, true},
    {"width.direct", "px", "width.direct", Needs::filtered_shadows},
    {"near.direct", "world units", "far.direct", Needs::filtered_shadows},
    {"far.direct", "world units", "far.direct", Needs::filtered_shadows},
    {"guard.direct", "share", "width.direct", Needs::filtered_shadows},
    {"width.indirect", "px", "width.indirect", Needs::filtered_hemisphere},
    {"near.indirect", "world units", "far.indirect", Needs::filtered_hemisphere},
    {"far.indirect", "world units", "far.indirect", Needs::filtered_hemisphere},
    {"guard.indirect", "share", "width.indirect", Needs::filtered_hemisphere},
    {"error", "radiance", "spp", Needs::any_filter},
    {kPicture, "", "", Needs::any_filter, true},
};

bool same_name(const std::string& a, const std::string& b) {
    return strcasecmp(a.c_str(), b.c_str()) == 0;
}

/// Whether `name`, as typed, stands for `layer`, alone or with others.
bool stands_for(const std::string& name, const std::string& layer) {
    return same_name(name, "all") || same_name(name, layer) ||
           same_name(name, layer.substr(0, layer.find('.')));
}

bool has(const rendering::Plan& plan, Needs needs) {
    switch (needs) {
        case Needs::nothing:
            return true;
        case Needs::filtered_shadows:
            return plan.direct_signals > 0;
        case Needs::filtered_hemisphere:
            return plan.hemisphere;
        case Needs::any_filter:
            return plan.signals > 0;
    }
    return false;
}

[[noreturn]] void refuse_missing(const std::string& name, const std::vector<std::string>& there,
                                 Method method) {
    const char* reason = method == Method::mc
                             ? "--method mc has no such layer; use --method aaf"
                             : "nothing of that kind is filtered in this scene (wedge explain)";
    throw Error(ErrorKind::usage, fmt::format("--heat {}: {}; this render has {}", name, reason,
                                              fmt::join(there, ", ")));
}

const HeatSource& source_of(const std::string& layer) {
    return *std::find_if(std::begin(kSources), std::end(kSources),
                         [&](const HeatSource& source) { return layer == source.layer; });
}

std::vector<std::string> channels_of(const HeatSource& source) {
    const std::string name = source.layer;
    if (!source.is_rgb) return {name};
    return {name + ".R", name + ".G", name + ".B"};
}

image::HeatLayer heat_layer(const Image& image, const HeatSource& source) {
    const std::string name = source.layer;
    image::HeatLayer layer;
    layer.title = fmt::format("{}, {}", name, source.unit);
    layer.is_share = std::string(source.unit) == "share";
    layer.values = image::Plane<float>(image.width, image.height);

    std::vector<int> channels;
    for (const std::string& channel : channels_of(source))
        channels.push_back(image.channel(channel));
    const int present = image.channel(source.present);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            float sum = 0;
            for (const int channel : channels) sum += image.at(x, y, channel);
            const bool there = image.at(x, y, present) > 0;
            layer.values.row(y)[x] =
                there ? sum / float(channels.size()) : std::numeric_limits<float>::quiet_NaN();
        }
    return layer;
}

/// R, G, B of the layer under the names of the beauty.
Image picture_of(const Image& image, const HeatSource& source) {
    Image picture = select_layers(image, {source.layer});
    for (const std::string& channel : channels_of(source)) {
        const std::string colour = channel.substr(channel.find('.') + 1);
        std::swap(picture.channels[std::size_t(picture.channel(channel))],
                  picture.channels[std::size_t(picture.channel(colour))]);
    }
    return picture;
}

}  // namespace

std::string heat_layer_names() {
    std::string names;
    for (const HeatSource& source : kSources)
        names += (names.empty() ? "" : ", ") + std::string(source.layer);
    return names;
}

void check_heat_names(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        const bool known =
            std::any_of(std::begin(kSources), std::end(kSources),
                        [&](const HeatSource& source) { return stands_for(name, source.layer); });
        if (!known)
            throw Error(ErrorKind::usage, fmt::format("--heat {}: no such layer; known: all, {}",
                                                      name, heat_layer_names()));
    }
}

std::vector<std::string> choose_heat_layers(const std::vector<std::string>& names,
                                            const Scene& scene, const RenderOptions& options) {
    if (names.empty()) return {};
    const int bounces = options.bounces.value_or(scene.defaults.bounces);
    const rendering::Plan plan = rendering::make_plan(scene, options.method, bounces);
    std::vector<std::string> there;
    for (const HeatSource& source : kSources)
        if (has(plan, source.needs)) there.push_back(source.layer);

    std::vector<std::string> chosen;
    for (const std::string& layer : there)
        if (std::any_of(names.begin(), names.end(),
                        [&](const std::string& name) { return stands_for(name, layer); }))
            chosen.push_back(layer);
    for (const std::string& name : names)
        if (std::none_of(there.begin(), there.end(),
                         [&](const std::string& layer) { return stands_for(name, layer); }))
            refuse_missing(name, there, options.method);
    return chosen;
}

fs::path heat_file(const fs::path& output, const std::string& layer) {
    fs::path file = output;
    return file.replace_filename(output.stem().string() + "." + layer + ".png");
}

bool has_heat_layer(const Image& image, const std::string& layer) {
    for (const std::string& channel : channels_of(source_of(layer)))
        if (image.channel(channel) < 0) return false;
    return true;
}

void write_heat(const fs::path& file, const Image& image, const std::string& layer,
                const Develop& develop) {
    const HeatSource& source = source_of(layer);
    if (layer == kPicture)
        write_output(file, picture_of(image, source), develop);
    else
        write_output(file, heat_layer(image, source));
}

}  // namespace wedge::cli
