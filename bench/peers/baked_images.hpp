// Textures for other renderers: linear float images that need no further constant, gain or curve.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "wedge/scene.hpp"

namespace wedge::peers {

enum class Range { reflectance, radiance };

/// Writes each combination of texture and constant once, as `folder`/textures/N.exr.
class BakedImages {
  public:
    BakedImages(const Scene& scene, std::filesystem::path folder)
        : scene_(scene), folder_(std::move(folder)) {}

    /// {"file", "scale", "offset", "clamp"}: uv' = uv * scale + offset, v = 0 the bottom row.
    /// Texels are constant * (value * gain + base), the bracket kept in [0, 1] for reflectances and
    /// above 0 for radiance. Wedge limits what it has interpolated, so that the two differ beside
    /// texels that are outside. Throws Error(output).
    nlohmann::ordered_json bake(int texture, const Vec3& constant, Range range);

  private:
    const Scene& scene_;
    std::filesystem::path folder_;
    std::map<std::string, std::string> files_;  ///< by what is in them
};

/// Radiance of a light with a Gaussian profile over its rectangle, symmetric in both directions.
void bake_gaussian(const RectLight& rect, const std::filesystem::path& file);

}  // namespace wedge::peers
