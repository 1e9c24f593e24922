#include "host/scene/texture_set.hpp"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "host/scene/asset_search.hpp"
#include "wedge/log.hpp"

namespace wedge::scene {
namespace {

constexpr const char* kInstead = "the material's constant colour is used instead";

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
                                named_in.string(), use.file, kInstead));
        return -1;
    }

    Texture texture;
    texture.name = file->string();
    if (!load_image(texture, use.is_color)) return -1;
    texture.scale = use.scale;
    texture.offset = use.offset;
    texture.value_gain = use.gain;
    texture.value_base = use.base;
    texture.clamp = use.clamp;
    scene_.textures.push_back(std::move(texture));
    return known->second = int(scene_.textures.size()) - 1;
}

bool TextureSet::load_image(Texture& texture, bool is_color) {
    const auto [known, is_new] = images_.emplace(std::pair(texture.name, is_color), -1);
    if (!is_new && known->second < 0) return false;
    if (!is_new) {
        texture.image = scene_.textures[std::size_t(known->second)].image;
        return true;
    }
    std::string problem;
    try {
        texture.image = options_.load_texture(texture.name, is_color);
        problem = flaw(texture.image);
    } catch (const std::exception& error) {
        problem = error.what();
    }
    if (!problem.empty()) {
        log_warning(
            fmt::format("texture {} cannot be used ({}); {}", texture.name, problem, kInstead));
        return false;
    }
    known->second = int(scene_.textures.size());  // where `add` is about to put it
    return true;
}

void TextureSet::report() const {
    if (left_out_)
        log_warning(fmt::format("{} textures left out, this build reads no images; {}", left_out_,
                                kInstead));
}

}  // namespace wedge::scene
