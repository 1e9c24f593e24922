// A scene as plain data: what the files say, checked, in world units, before any device knows of
// it.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wedge/math.hpp"

namespace wedge {

/// Pinhole camera. `position` != `target`; `up` not parallel to the view. Right-handed, y up by
/// habit.
struct Camera {
    Vec3 position{0, 0, 5};
    Vec3 target{0, 0, 0};
    Vec3 up{0, 1, 0};
    float vertical_fov_rad = 0.8f;  ///< full vertical angle, (0, pi)
};

/// How the texels of a texture are stored.
enum class TextureFormat {
    srgb8,    ///< 4 bytes a texel, RGB with the sRGB curve, A linear
    linear8,  ///< 4 bytes a texel, linear
    float32,  ///< 4 floats a texel, linear
};

/// Decoded image, row 0 at the top, RGBA interleaved.
struct TextureImage {
    int width = 0;   ///< px
    int height = 0;  ///< px
    TextureFormat format = TextureFormat::srgb8;
    std::vector<unsigned char> texels;  ///< width * height * (4 or 16) bytes
};

/// An image laid over a surface. v = 0 is the bottom row (OBJ convention).
struct Texture {
    std::string name;  ///< path as resolved; for messages
    TextureImage image;
    Vec2 scale{1, 1};  ///< uv' = uv * scale + offset  (MTL -s, -o)
    Vec2 offset{0, 0};
    float value_gain = 1;  ///< value' = value * gain + base  (MTL -mm base gain)
    float value_base = 0;
    bool clamp = false;  ///< MTL -clamp on; else the image repeats
};

enum class SpecularModel { none, phong, blinn_phong };

/// Lambert plus an optional cosine-power lobe, normalised so that it reflects at most `specular`.
struct Material {
    std::string name;
    Vec3 diffuse{0.5f};   ///< kd, [0, 1]
    Vec3 specular{0.0f};  ///< ks, [0, 1]; kd + ks <= 1 per channel
    float exponent = 0;   ///< m >= 0
    SpecularModel model = SpecularModel::none;
    Vec3 emission{0.0f};       ///< radiance leaving the front side (W / m^2 / sr, by channel)
    int diffuse_texture = -1;  ///< indices into Scene::textures, multiply the constants; -1: none
    int specular_texture = -1;
    int emission_texture = -1;
    /// Both bend the shading normal and move nothing; where both are set, the bump map counts.
    /// RGB in tangent space, n = 2 rgb - 1: +x along u, +y along v, z off the surface; the
    /// texture's value_gain multiplies x and y, its value_base is not used.
    int normal_texture = -1;
    /// Heights by luminance: value 1 (after gain and base) is as high as a texel is wide.
    int bump_texture = -1;
};

/// Triangles of one vertex set. Counter-clockwise seen from the front.
struct Mesh {
    std::string name;
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;          ///< per vertex, unit; empty: the face's own normal is used
    std::vector<Vec2> uvs;              ///< per vertex; empty: (0, 0)
    std::vector<UVec3> triangles;       ///< vertex indices
    std::vector<uint32_t> material_of;  ///< per triangle, index into Scene::materials
};

/// A mesh placed in the world. Meshes are shared by reference; the renderer flattens them.
struct Instance {
    uint32_t mesh = 0;
    Mat4 transform{1.0f};                ///< object to world, affine, invertible
    std::optional<uint32_t> material{};  ///< replaces the mesh's own materials
};

enum class LightProfile { uniform, gaussian };

/// Rectangle that emits from its front side, the side cross(edge_u, edge_v) points to.
struct RectLight {
    Vec3 center{0};
    Vec3 edge_u{1, 0, 0};  ///< full side vectors, perpendicular, non-zero
    Vec3 edge_v{0, 0, 1};
    Vec3 radiance{1};  ///< at the centre
    LightProfile profile = LightProfile::uniform;
    float sigma =
        0;  ///< gaussian: standard deviation in world units; radiance * exp(-r^2 / (2 sigma^2))
};

/// Isotropic point light.
struct PointLight {
    Vec3 position{0};
    Vec3 intensity{1};  ///< W / sr, by channel
};

struct Film {
    int width = 640;   ///< px, > 0
    int height = 480;  ///< px, > 0
};

/// What scene files and commands may ask for.
inline constexpr int kLargestSide_px = 65536;
/// 4 GiB of RGBA in single precision.
inline constexpr long long kMostPixels = 1ll << 28;

/// What the scene file asks for; command-line options override it.
struct RenderDefaults {
    int samples_per_pixel = 64;
    int bounces = 3;     ///< indirect bounces; 0 is direct light only
    float exposure = 0;  ///< stops, for the PNG
};

struct Scene {
    std::string name;
    Camera camera;
    Film film;
    RenderDefaults defaults;
    Vec3 background{0};  ///< radiance of everything that is missed
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<RectLight> rect_lights;
    std::vector<PointLight> point_lights;
};

/// Reads one image file into memory. `is_colour` images of 8 bits are taken as sRGB. Throws
/// Error(bad_input). Kept as a callback so that reading scenes needs no image library.
using TextureLoader = std::function<TextureImage(const std::filesystem::path&, bool is_colour)>;

struct LoadOptions {
    /// Folders searched, in order, for files not found beside the scene.
    std::vector<std::filesystem::path> asset_paths;
    TextureLoader load_texture;  ///< empty: textures are left out, with a warning
};

/// Loads a JSON scene (docs/scene-format.md), or an OBJ file for which a camera and a light are
/// made up (and said in the log). Throws Error(bad_input) that names file and place.
Scene load_scene(const std::filesystem::path& file, const LoadOptions& options = {});

/// Takes all lights and colours away and puts a sky of radiance 1 in their place: rendered without
/// bounces, a pixel is the cosine-weighted share of the hemisphere that nothing hides.
void make_ambient_occlusion(Scene& scene);

/// Box of all instances in world space, lights included.
Bounds scene_bounds(const Scene& scene);

}  // namespace wedge
