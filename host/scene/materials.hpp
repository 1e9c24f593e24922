// Materials as files describe them, and what is done so that they stay physical.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/scene/json_reader.hpp"
#include "host/scene/texture_set.hpp"
#include "wedge/scene.hpp"

namespace wedge::scene {

inline constexpr float kLargestExponent = 1e6f;
/// Of a specular lobe for which nobody gave one.
inline constexpr float kDefaultExponent = 20;

/// A texture entry of a material: a file, or `null`, which takes a texture away.
struct TextureEdit {
    std::optional<TextureUse> use;
};

/// What a scene file says of a material: only what is set changes.
struct MaterialEdit {
    std::optional<Vec3> diffuse, specular, emission;
    std::optional<float> exponent;
    std::optional<SpecularModel> model;
    std::optional<TextureEdit> diffuse_texture, specular_texture, emission_texture;
    std::optional<TextureEdit> normal_texture, bump_texture;
};
using MaterialEdits = std::map<std::string, MaterialEdit>;

/// Reads `/materials`. Throws Error(bad_input).
MaterialEdits read_materials(const JsonView& materials);

/// Applies an edit; `scene_file` is where its textures are named.
void apply(const MaterialEdit& edit, Material& material, TextureSet& textures,
           const std::filesystem::path& scene_file);

/// Scales diffuse and specular down together wherever they sum to more than 1 in a channel, and
/// warns once, with the number of materials and the names of the first.
void conserve_energy(std::vector<Material>& materials, const std::string& file);

/// `"a", "b", "c" and 4 more`.
std::string listed(const std::vector<std::string>& names);

}  // namespace wedge::scene
