#include "host/cli/scene_census.hpp"

namespace wedge::cli {
namespace {

bool is_finite(const Vec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

bool emits(const Material& material) {
    return material.emission != Vec3(0);
}

// In double precision, so that a small but real triangle far from the origin keeps its area.
bool has_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    const glm::dvec3 origin(a);
    return glm::cross(glm::dvec3(b) - origin, glm::dvec3(c) - origin) != glm::dvec3(0);
}

void count_materials(const Scene& scene, SceneCensus& census) {
    for (const Material& material : scene.materials) {
        switch (material.model) {
            case SpecularModel::none:
                ++census.lambert;
                break;
            case SpecularModel::phong:
                ++census.phong;
                break;
            case SpecularModel::blinn_phong:
                ++census.blinn_phong;
                break;
        }
        if (emits(material)) ++census.emitting;
    }
}

void count_triangles(const Scene& scene, const Instance& instance, SceneCensus& census) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const auto placed = [&](uint32_t vertex) {
        return Vec3(instance.transform * Vec4(mesh.positions[vertex], 1));
    };
    census.placed_triangles += mesh.triangles.size();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const UVec3& triangle = mesh.triangles[i];
        const Vec3 a = placed(triangle.x), b = placed(triangle.y), c = placed(triangle.z);
        if (!is_finite(a) || !is_finite(b) || !is_finite(c))
            ++census.non_finite_triangles;
        else if (!has_area(a, b, c))
            ++census.degenerate_triangles;
        else if (emits(scene.materials[instance.material.value_or(mesh.material_of[i])]))
            ++census.emitting_triangles;
    }
}

}  // namespace

SceneCensus take_census(const Scene& scene) {
    SceneCensus census;
    census.meshes = scene.meshes.size();
    for (const Mesh& mesh : scene.meshes) {
        census.mesh_triangles += mesh.triangles.size();
        census.vertices += mesh.positions.size();
    }
    census.instances = scene.instances.size();
    for (const Instance& instance : scene.instances) count_triangles(scene, instance, census);
    count_materials(scene, census);
    for (const RectLight& light : scene.rect_lights)
        if (light.profile == LightProfile::gaussian) ++census.gaussian_lights;
    for (const Texture& texture : scene.textures)
        census.texture_bytes += texture.image.texels.size();
    census.bounds = scene_bounds(scene);
    return census;
}

const char* format_name(TextureFormat format) {
    switch (format) {
        case TextureFormat::srgb8:
            return "8-bit sRGB";
        case TextureFormat::linear8:
            return "8-bit linear";
        case TextureFormat::float32:
            break;
    }
    return "float";
}

}  // namespace wedge::cli
