#include "host/scene/texture_set.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <exception>
#include <utility>

#include "host/scene/asset_search.hpp"
#include "wedge/log.hpp"

namespace wedge::scene {
namespace {

const char* instead(const TextureUse& use) {
    const bool bends = use.role == TextureRole::normal || use.role == TextureRole::height;
    return bends ? "the surface stays smooth" : "the material's constant colour is used instead";
}

std::string key_of(const TextureUse& use, const std::filesystem::path& folder) {
    return fmt::format("{}\n{}\n{} {} {} {} {} {} {} {}", folder.string(), use.file, use.scale.x,
                       use.scale.y, use.offset.x, use.offset.y, use.gain, use.base, use.clamp,
                       use.is_color);
}

/// Why an image must not be handed on; empty if it is sound.
std::string flaw(const TextureImage& image) {
    if (image.width <= 0 || image.height <= 0) return "it has no pixels";
    const std::size_t texel_bytes = image.format == TextureFormat::float32 ? 16 : 4;
    const std::size_t expected = std::size_t(image.width) * std::size_t(image.height) * texel_bytes;
    return image.texels.size() == expected ? "" : "its data does not match its size";
}

std::array<float, 3> texel(const TextureImage& image, std::size_t i) {
    std::array<float, 3> rgb{};
    if (image.format == TextureFormat::float32) {
        std::memcpy(rgb.data(), image.texels.data() + 16 * i, sizeof(rgb));
    } else {
        for (std::size_t c = 0; c < 3; ++c) rgb[c] = float(image.texels[4 * i + c]) / 255;
    }
    return rgb;
}

std::size_t texel_count(const TextureImage& image) {
    return std::size_t(image.width) * std::size_t(image.height);
}

/// Only floating-point images can hold what no surface reflects or sends out.
void warn_of_odd_texels(const Texture& texture, TextureRole role) {
    if (texture.image.format != TextureFormat::float32) return;
    if (role != TextureRole::reflectance && role != TextureRole::emission) return;
    std::size_t negative = 0, above_one = 0;
    for (std::size_t i = 0; i < texel_count(texture.image); ++i) {
        const auto rgb = texel(texture.image, i);
        negative += rgb[0] < 0 || rgb[1] < 0 || rgb[2] < 0;
        above_one += rgb[0] > 1 || rgb[1] > 1 || rgb[2] > 1;
    }
    if (negative)
        log_warning(
            fmt::format("texture {}: {} texels are negative; 0 is used", texture.name, negative));
    if (above_one && role == TextureRole::reflectance)
        log_warning(
            fmt::format("texture {}: {} texels reflect more than they receive (above 1); 1 is used",
                        texture.name, above_one));
}

}  // namespace

int TextureSet::add(const TextureUse& use, const std::filesystem::path& named_in) {
    const std::string key = key_of(use, named_in.parent_path());
    const auto [known, is_new] = uses_.emplace(key, -1);
    if (!is_new) return known->second;

    if (!options_.load_texture) {
        ++left_out_;
        return -1;
    }
    const auto file = find_file(use.file, search_order(named_in, options_.asset_paths));
    if (!file) {
        log_warning(fmt::format("{}: texture \"{}\" is not beside it nor in the asset paths; {}",
                                named_in.string(), use.file, instead(use)));
        return -1;
    }

    Texture texture;
    texture.name = file->string();
    if (!load_image(texture, use)) return -1;
    texture.scale = use.scale;
    texture.offset = use.offset;
    texture.value_gain = use.gain;
    texture.value_base = use.base;
    texture.clamp = use.clamp;
    scene_.textures.push_back(std::move(texture));
    return known->second = int(scene_.textures.size()) - 1;
}

bool TextureSet::load_image(Texture& texture, const TextureUse& use) {
    const auto [known, is_new] = images_.emplace(std::pair(texture.name, use.is_color), -1);
    if (!is_new && known->second < 0) return false;
    if (!is_new) {
        texture.image = scene_.textures[std::size_t(known->second)].image;
        return true;
    }
    std::string problem;
    try {
        texture.image = options_.load_texture(texture.name, use.is_color);
        problem = flaw(texture.image);
    } catch (const std::exception& error) {
        problem = error.what();
    }
    if (!problem.empty()) {
        log_warning(
            fmt::format("texture {} cannot be used ({}); {}", texture.name, problem, instead(use)));
        return false;
    }
    warn_of_odd_texels(texture, use.role);
    known->second = int(scene_.textures.size());  // where `add` is about to put it
    return true;
}

void TextureSet::report() const {
    if (left_out_)
        log_warning(fmt::format("{} textures left out, this build reads no images; {}", left_out_,
                                instead(TextureUse{})));
}

bool TextureSet::looks_like_normals(int texture) const {
    if (texture < 0) return false;
    // Heights are grey and colours have no reason to be of length 1; a few texels tell.
    constexpr std::size_t kLooks = 4096;
    constexpr float kLengthError = 0.15f, kLeastZ = 0.3f;
    const TextureImage& image = scene_.textures[std::size_t(texture)].image;
    const std::size_t count = texel_count(image), step = count / kLooks + 1;
    std::size_t seen = 0, alike = 0;
    for (std::size_t i = 0; i < count; i += step, ++seen) {
        const auto rgb = texel(image, i);
        const Vec3 n = 2.0f * Vec3(rgb[0], rgb[1], rgb[2]) - 1.0f;
        const bool grey = rgb[0] == rgb[1] && rgb[1] == rgb[2];
        alike += !grey && n.z > kLeastZ && std::abs(glm::length(n) - 1) < kLengthError;
    }
    return 10 * alike > 9 * seen;
}

}  // namespace wedge::scene
