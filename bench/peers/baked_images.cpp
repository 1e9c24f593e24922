#include "bench/peers/baked_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "host/base/srgb.hpp"
#include "wedge/image_io.hpp"

namespace wedge::peers {
namespace {

/// Interpolated, a Gaussian errs by less than 1e-4 of its peak if a texel is this share of sigma.
constexpr double kTexelOfSigma = 1.0 / 40;
constexpr int kLeastSide = 64, kLargestSide = 2048;

Vec3 texel(const TextureImage& image, std::size_t index) {
    Vec3 value;
    for (int c = 0; c < 3; ++c) {
        if (image.format == TextureFormat::float32) {
            std::memcpy(&value[c], &image.texels[(4 * index + std::size_t(c)) * sizeof(float)],
                        sizeof(float));
            continue;
        }
        const float v = float(image.texels[4 * index + std::size_t(c)]) / 255.0f;
        value[c] = image.format == TextureFormat::srgb8 ? srgb_decode(v) : v;
    }
    return value;
}

}  // namespace

nlohmann::ordered_json BakedImages::bake(int texture, const Vec3& constant, Range range) {
    const Texture& t = scene_.textures[std::size_t(texture)];
    const std::string content =
        fmt::format("{} {} {} {} {}", texture, constant.x, constant.y, constant.z, int(range));
    const auto [known, is_new] =
        files_.try_emplace(content, fmt::format("textures/{}.exr", files_.size()));
    if (is_new) {
        Image image{t.image.width, t.image.height, {"R", "G", "B"}, {}, {}};
        const float limit = range == Range::reflectance ? 1.0f : INFINITY;
        for (std::size_t i = 0; i < std::size_t(t.image.width) * t.image.height; ++i) {
            const Vec3 value = texel(t.image, i) * t.value_gain + t.value_base;
            for (int c = 0; c < 3; ++c)
                image.pixels.push_back(constant[c] * std::min(std::max(value[c], 0.0f), limit));
        }
        write_exr(folder_ / known->second, image);
    }
    return {{"file", known->second},
            {"scale", {t.scale.x, t.scale.y}},
            {"offset", {t.offset.x, t.offset.y}},
            {"clamp", t.clamp}};
}

void bake_gaussian(const RectLight& rect, const std::filesystem::path& file) {
    const double length_u = glm::length(rect.edge_u), length_v = glm::length(rect.edge_v);
    const auto side = [&](double length) {
        return std::clamp(int(std::ceil(length / (rect.sigma * kTexelOfSigma))), kLeastSide,
                          kLargestSide);
    };
    Image image{side(length_u), side(length_v), {"R", "G", "B"}, {}, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double a = ((x + 0.5) / image.width - 0.5) * length_u / rect.sigma;
            const double b = ((y + 0.5) / image.height - 0.5) * length_v / rect.sigma;
            const auto profile = float(std::exp(-0.5 * (a * a + b * b)));
            for (int c = 0; c < 3; ++c) image.pixels.push_back(rect.radiance[c] * profile);
        }
    write_exr(file, image);
}

}  // namespace wedge::peers
