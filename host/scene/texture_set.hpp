// The textures of a scene: each file decoded once, each use of it one entry.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "wedge/scene.hpp"

namespace wedge::scene {

/// What the values of a texture stand for.
enum class TextureRole {
    reflectance,  ///< must lie in [0, 1]
    emission,     ///< must not be negative
    normal,       ///< directions
    height,
};

/// A texture as a material names it. Defaults are those of a bare file name.
struct TextureUse {
    std::string file;
    Vec2 scale{1, 1};
    Vec2 offset{0, 0};
    float gain = 1;
    float base = 0;
    bool clamp = false;
    bool is_color = true;  ///< 8-bit files hold sRGB
    TextureRole role = TextureRole::reflectance;
};

/// Collects textures into Scene::textures. What cannot be had is warned about, once a file, and
/// never stops a load.
class TextureSet {
  public:
    TextureSet(Scene& scene, const LoadOptions& options) : scene_(scene), options_(options) {}

    /// Index into Scene::textures, or -1 where the file is missing or unreadable. `named_in` is the
    /// file that names the texture: it is searched for beside it, then in the asset paths.
    int add(const TextureUse& use, const std::filesystem::path& named_in);

    /// Says what was left out because no loader was given.
    void report() const;

    /// Whether the image of a texture looks like unit normals in tangent space: most of its texels
    /// are about one long and point off the surface. False for -1.
    bool looks_like_normals(int texture) const;

  private:
    /// Fills `texture.image` from the file `texture.name`; false, after a warning, if it cannot.
    bool load_image(Texture& texture, const TextureUse& use);

    Scene& scene_;
    const LoadOptions& options_;
    std::map<std::string, int> uses_;  ///< by file and options; -1: could not be had
    std::map<std::pair<std::string, bool>, int> images_;  ///< by file and colour: who has the image
    std::size_t left_out_ = 0;
};

}  // namespace wedge::scene
