#include "host/render/film_image.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/parallel.hpp"

namespace wedge::rendering {
namespace {

const std::vector<std::string> kChannels = {
    "R",          "G",          "B",          "A",                       // beauty and coverage
    "direct.R",   "direct.G",   "direct.B",                              // one scattering
    "indirect.R", "indirect.G", "indirect.B",                            // more than one
    "emission.R", "emission.G", "emission.B",                            // none
    "albedo.R",   "albedo.G",   "albedo.B",                              // first hit
    "N.X",        "N.Y",        "N.Z",        "P.X", "P.Y", "P.Z", "Z",  // first hit
    "variance.R", "variance.G", "variance.B",                            // of the pixel's mean
    "spp",
};

/// Unbiased estimate of the variance of a mean of n independent samples. Doubles, because the
/// difference of the two terms cancels.
float variance_of_mean(double sum, double sum_of_squares, double n) {
    if (n < 2) return 0;
    return float(std::max(0.0, (sum_of_squares - sum * sum / n) / (n * (n - 1))));
}

struct ChannelWriter {
    float* out;
    void value(double x) { *out++ = float(x); }
    void rgb(const shared::float4& sum, double scale) {
        value(sum.x * scale);
        value(sum.y * scale);
        value(sum.z * scale);
    }
};

double mean_of(double samples) {
    return samples > 0 ? 1 / samples : 0;
}

struct Beauty {
    double rgb[3];
};

Beauty beauty_of(const shared::FilmPixel& p) {
    const double mean = mean_of(p.direct.w), emission = mean_of(p.position.w);
    const auto total = [&](float emitted, float direct, float indirect) {
        return emission * emitted + mean * (double(direct) + indirect);
    };
    return {{total(p.emission.x, p.direct.x, p.indirect.x),
             total(p.emission.y, p.direct.y, p.indirect.y),
             total(p.emission.z, p.direct.z, p.indirect.z)}};
}

/// The first channels.
void write_pixel_light(const shared::FilmPixel& p, ChannelWriter& writer) {
    for (double value : beauty_of(p).rgb) writer.value(value);
    writer.value(p.emission.w / p.normal.w);
    writer.rgb(p.direct, mean_of(p.direct.w));
    writer.rgb(p.indirect, mean_of(p.direct.w));
    writer.rgb(p.emission, mean_of(p.position.w));
}

/// Geometry comes from every camera ray; a pixel whose samples were all dropped is black.
void write_pixel(const shared::FilmPixel& p, ChannelWriter writer) {
    const double n = p.direct.w, seen = p.normal.w, per_hit = mean_of(p.emission.w);
    const double normal_length = std::hypot(p.normal.x, p.normal.y, p.normal.z);
    const Beauty beauty = beauty_of(p);
    write_pixel_light(p, writer);
    writer.rgb(p.albedo, 1 / seen);
    writer.rgb(p.normal, normal_length > 0 ? 1 / normal_length : 0);
    writer.rgb(p.position, per_hit);
    writer.value(p.albedo.w * per_hit);
    writer.value(variance_of_mean(n * beauty.rgb[0], p.square.x, n));
    writer.value(variance_of_mean(n * beauty.rgb[1], p.square.y, n));
    writer.value(variance_of_mean(n * beauty.rgb[2], p.square.z, n));
    writer.value(n);
}

/// Of pixels that have been looked at.
template <typename Write>
void write_pixels(std::span<const shared::FilmPixel> pixels, const Rect& crop, Image& image,
                  Write write) {
    parallel_ranges(std::size_t(crop.height), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (int x = 0; x < crop.width; ++x) {
                const shared::FilmPixel& p = pixels[y * crop.width + x];
                ChannelWriter writer{&image.at(crop.x + x, crop.y + int(y), 0)};
                if (p.normal.w > 0) write(p, writer);
            }
    });
}

void append_channels(Image& image, std::span<const NamedChannel> channels) {
    const std::size_t before = image.channels.size(), after = before + channels.size();
    std::vector<float> pixels(image.pixels.size() / before * after, 0.0f);
    for (std::size_t i = 0; i * before < image.pixels.size(); ++i)
        std::copy_n(&image.pixels[i * before], before, &pixels[i * after]);
    image.pixels = std::move(pixels);
    for (const NamedChannel& channel : channels) image.channels.push_back(channel.first);
}

}  // namespace

Image black_image(const Film& film) {
    Image image;
    image.width = film.width;
    image.height = film.height;
    image.channels = kChannels;
    image.pixels.assign(std::size_t(film.width) * film.height * kChannels.size(), 0.0f);
    return image;
}

void write_film(std::span<const shared::FilmPixel> pixels, const Rect& crop, Image& image) {
    write_pixels(pixels, crop, image, write_pixel);
}

void write_light(std::span<const shared::FilmPixel> pixels, const Rect& crop, Image& image) {
    write_pixels(pixels, crop, image, write_pixel_light);
}

void add_channels(Image& image, std::span<const NamedChannel> channels, const Rect& crop) {
    if (channels.empty()) return;  // a large image is not copied for nothing
    const auto found = std::ranges::find(image.channels, channels[0].first);
    const auto before = std::size_t(found - image.channels.begin());
    if (found == image.channels.end()) append_channels(image, channels);
    const std::size_t stride = image.channels.size();
    for (std::size_t k = 0; k < channels.size(); ++k)
        for (int y = 0; y < crop.height; ++y)
            for (int x = 0; x < crop.width; ++x) {
                const auto pixel = std::size_t(crop.y + y) * image.width + crop.x + x;
                image.pixels[pixel * stride + before + k] =
                    channels[k].second[std::size_t(y) * crop.width + x];
            }
}

}  // namespace wedge::rendering
