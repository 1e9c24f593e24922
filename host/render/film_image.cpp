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

void write_pixel(const shared::FilmPixel& p, float* out) {
    const double n = p.direct.w, dropped = p.square.w;
    if (n + dropped <= 0) return;
    // Geometry comes from every sample; a pixel whose samples were all dropped is black.
    const double mean = n > 0 ? 1 / n : 0, seen = n + dropped;
    const double total[3] = {double(p.emission.x) + p.direct.x + p.indirect.x,
                             double(p.emission.y) + p.direct.y + p.indirect.y,
                             double(p.emission.z) + p.direct.z + p.indirect.z};
    const double hits = p.emission.w, per_hit = hits > 0 ? 1 / hits : 0;
    const double normal_length = std::hypot(p.normal.x, p.normal.y, p.normal.z);

    ChannelWriter writer{out};
    for (double sum : total) writer.value(sum * mean);
    writer.value(hits / seen);
    writer.rgb(p.direct, mean);
    writer.rgb(p.indirect, mean);
    writer.rgb(p.emission, mean);
    writer.rgb(p.albedo, 1 / seen);
    writer.rgb(p.normal, normal_length > 0 ? 1 / normal_length : 0);
    writer.rgb(p.position, per_hit);
    writer.value(p.albedo.w * per_hit);
    writer.value(variance_of_mean(total[0], p.square.x, n));
    writer.value(variance_of_mean(total[1], p.square.y, n));
    writer.value(variance_of_mean(total[2], p.square.z, n));
    writer.value(n);
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
    parallel_ranges(std::size_t(crop.height), 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (int x = 0; x < crop.width; ++x)
                write_pixel(pixels[y * crop.width + x], &image.at(crop.x + x, crop.y + int(y), 0));
    });
}

Image film_to_image(std::span<const shared::FilmPixel> pixels, const Film& film, const Rect& crop) {
    Image image = black_image(film);
    write_film(pixels, crop, image);
    return image;
}

void add_channel(Image& image, const std::string& name, std::span<const float> values,
                 const Rect& crop) {
    if (values.empty()) return;
    const std::size_t before = image.channels.size(), after = before + 1;
    std::vector<float> pixels(image.pixels.size() / before * after, 0.0f);
    for (std::size_t i = 0; i * before < image.pixels.size(); ++i)
        std::copy_n(&image.pixels[i * before], before, &pixels[i * after]);
    image.pixels = std::move(pixels);
    image.channels.push_back(name);
    for (int y = 0; y < crop.height; ++y)
        for (int x = 0; x < crop.width; ++x)
            image.at(crop.x + x, crop.y + y, int(before)) = values[std::size_t(y) * crop.width + x];
}

}  // namespace wedge::rendering
