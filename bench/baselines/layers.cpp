#include "bench/baselines/layers.hpp"

#include "wedge/error.hpp"

namespace wedge::baselines {
namespace {

/// Three channels and nothing, or a fourth.
std::vector<Float4> pack(const Image& image, const char* x, const char* y, const char* z,
                         const char* w = nullptr) {
    int from[4] = {-1, -1, -1, -1};
    const char* const names[4] = {x, y, z, w};
    for (int c = 0; c < 4; ++c) {
        if (!names[c]) continue;
        from[c] = image.channel(names[c]);
        if (from[c] < 0)
            throw Error(ErrorKind::internal,
                        std::string("filters need the layer ") + names[c] + ", which is not there");
    }
    std::vector<Float4> packed;
    const std::size_t stride = image.channels.size();
    packed.reserve(image.pixels.size() / stride);
    for (std::size_t i = 0; i < image.pixels.size(); i += stride) {
        const auto at = [&](int c) { return c < 0 ? 0.0f : image.pixels[i + std::size_t(c)]; };
        packed.push_back({at(from[0]), at(from[1]), at(from[2]), at(from[3])});
    }
    return packed;
}

}  // namespace

Layers layers_of(const Image& image, double pixel_angle) {
    Layers layers;
    layers.radiance = pack(image, "R", "G", "B");
    layers.emission = pack(image, "emission.R", "emission.G", "emission.B");
    layers.albedo = pack(image, "albedo.R", "albedo.G", "albedo.B");
    layers.variance = pack(image, "variance.R", "variance.G", "variance.B");
    layers.surface = pack(image, "N.X", "N.Y", "N.Z", "Z");
    layers.place = pack(image, "P.X", "P.Y", "P.Z", "Z");
    for (Float4& place : layers.place) place.w *= float(pixel_angle);
    return layers;
}

}  // namespace wedge::baselines
