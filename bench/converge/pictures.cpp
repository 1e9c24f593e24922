#include "bench/converge/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/converge/html.hpp"
#include "host/base/srgb.hpp"
#include "host/image/codec.hpp"

namespace wedge::converge {
namespace {

using Colour = std::array<double, 3>;  // sRGB codes, 0 to 255

/// Straight between equally spaced stops; `share` in [0, 1].
template <std::size_t kCount>
Colour between(const std::array<Colour, kCount>& stops, double share) {
    const double at = std::clamp(std::isfinite(share) ? share : 1.0, 0.0, 1.0) * (kCount - 1);
    const auto i = std::min(std::size_t(at), kCount - 2);
    Colour colour;
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] = stops[i][c] + (at - double(i)) * (stops[i + 1][c] - stops[i][c]);
    return colour;
}

// Lightness rises evenly in the first, falls evenly to both sides in the second.
constexpr std::array<Colour, 6> kHeat = {
    {{6, 6, 16}, {62, 18, 92}, {150, 32, 96}, {222, 76, 56}, {250, 156, 40}, {252, 248, 190}}};
constexpr std::array<Colour, 5> kSigned = {
    {{18, 62, 140}, {104, 160, 214}, {246, 246, 244}, {232, 140, 104}, {150, 20, 32}}};

template <typename Map>
Picture mapped(const std::vector<double>& values, int width, int height, const Map& map) {
    Picture picture{width, height, {}};
    picture.rgb.reserve(values.size() * 3);
    for (double value : values)
        for (double code : map(value)) picture.rgb.push_back((unsigned char)(code + 0.5));
    return picture;
}

}  // namespace

Picture developed(const Image& image, float exposure) {
    Picture picture{image.width, image.height, {}};
    const float gain = std::exp2(exposure);
    const int rgb[3] = {image.channel("R"), image.channel("G"), image.channel("B")};
    const std::size_t stride = image.channels.size();
    for (std::size_t i = 0; i < image.pixels.size(); i += stride)
        for (int c : rgb)
            picture.rgb.push_back(
                (unsigned char)(srgb_encode(image.pixels[i + std::size_t(c)] * gain) * 255 + 0.5f));
    return picture;
}

Picture heat_map(const std::vector<double>& values, int width, int height, double full) {
    return mapped(values, width, height, [&](double v) { return between(kHeat, v / full); });
}

Picture signed_map(const std::vector<double>& values, int width, int height, double full) {
    return mapped(values, width, height,
                  [&](double v) { return between(kSigned, 0.5 + 0.5 * v / full); });
}

Picture crop_of(const Picture& picture, const Rect& rect) {
    Picture out{rect.width, rect.height, {}};
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
        const auto* row = &picture.rgb[(std::size_t(y) * picture.width + rect.x) * 3];
        out.rgb.insert(out.rgb.end(), row, row + std::size_t(rect.width) * 3);
    }
    return out;
}

Picture shrunk(const Picture& picture, int largest) {
    const int factor = (std::max(picture.width, picture.height) + largest - 1) / largest;
    if (factor <= 1) return picture;
    Picture out{picture.width / factor, picture.height / factor, {}};
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x)
            for (int c = 0; c < 3; ++c) {
                double sum = 0;
                for (int j = 0; j < factor; ++j)
                    for (int i = 0; i < factor; ++i)
                        sum += picture.rgb[(std::size_t(y * factor + j) * picture.width +
                                            x * factor + i) *
                                               3 +
                                           c];
                out.rgb.push_back((unsigned char)(sum / (factor * factor) + 0.5));
            }
    return out;
}

std::string base64(const std::string& bytes) {
    static constexpr char kDigits[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        unsigned group = 0;
        for (std::size_t j = 0; j < 3; ++j)
            group = group << 8 | (j < count ? (unsigned char)bytes[i + j] : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            text += j <= count ? kDigits[group >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

std::string png_of(const Picture& picture) {
    return image::encode_png(picture.width, picture.height, picture.rgb.data(),
                             "picture of the report");
}

std::string img_html(const Picture& picture, const std::string& alt, bool pixelated) {
    return fmt::format(
        "<img{} width=\"{}\" height=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\"/>",
        pixelated ? " class=\"pixels\"" : "", picture.width, picture.height, escaped(alt),
        base64(png_of(picture)));
}

}  // namespace wedge::converge
