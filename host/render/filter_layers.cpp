#include "host/render/filter_layers.hpp"

#include <cmath>

namespace wedge::rendering {
namespace {

template <typename Value>
NamedChannel channel(const char* name, std::size_t count, Value value) {
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = float(value(i));
    return {name, std::move(values)};
}

float beauty(float emission, float direct, float indirect, const shared::FilmPixel& p) {
    const float emitted = p.position.w > 0 ? emission / p.position.w : 0;
    return p.direct.w > 0 ? emitted + (direct + indirect) / p.direct.w : emitted;
}

}  // namespace

std::vector<NamedChannel> filter_layers(const FilteredLight& light,
                                        const std::vector<shared::FilmPixel>& film,
                                        std::span<const Vec3> errors) {
    std::vector<NamedChannel> channels;
    const std::size_t n = light.guarded.size();
    if (n == 0) return channels;
    const auto add = [&](const char* name, auto value) {
        channels.push_back(channel(name, n, value));
    };
    const auto add_signal = [&](const SignalLayers& s, const char* width, const char* nearest,
                                const char* farthest) {
        if (s.width_px.empty()) return;
        add(width, [&](std::size_t i) { return s.width_px[i]; });
        add(nearest, [&](std::size_t i) { return s.nearest[i]; });
        add(farthest, [&](std::size_t i) { return s.farthest[i]; });
    };
    add_signal(light.direct, "width.direct", "near.direct", "far.direct");
    add_signal(light.indirect, "width.indirect", "near.indirect", "far.indirect");
    if (!light.direct.width_px.empty())
        add("guard.direct", [&](std::size_t i) { return light.guarded[i].direct.w; });
    if (!light.indirect.width_px.empty())
        add("guard.indirect", [&](std::size_t i) { return light.guarded[i].indirect.w; });
    add("error",
        [&](std::size_t i) { return std::sqrt((errors[i].x + errors[i].y + errors[i].z) / 3); });
    add("unfiltered.R", [&](std::size_t i) {
        return beauty(film[i].emission.x, film[i].direct.x, film[i].indirect.x, film[i]);
    });
    add("unfiltered.G", [&](std::size_t i) {
        return beauty(film[i].emission.y, film[i].direct.y, film[i].indirect.y, film[i]);
    });
    add("unfiltered.B", [&](std::size_t i) {
        return beauty(film[i].emission.z, film[i].direct.z, film[i].indirect.z, film[i]);
    });
    return channels;
}

}  // namespace wedge::rendering
