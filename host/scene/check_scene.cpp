#include "host/scene/check_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "host/scene/materials.hpp"
#include "wedge/error.hpp"
#include "wedge/shared/radiance.h"

namespace wedge::scene {
namespace {

/// `scene "x": /lights/3/radiance: must be …`
class Place {
  public:
    Place(const Scene& scene, std::string path) : scene_(scene), path_(std::move(path)) {}

    void require(bool holds, const char* member, const std::string& what) const {
        if (!holds)
            throw Error(ErrorKind::bad_input,
                        fmt::format("scene \"{}\": {}/{}: {}", scene_.name, path_, member, what));
    }

    void require_between(const Vec3& value, float lower, float upper, const char* member) const {
        for (int i = 0; i < 3; ++i)
            if (!(value[i] >= lower && value[i] <= upper))
                require(false, member,
                        fmt::format("must be between {} and {}, got {}", lower, upper, value[i]));
    }

    /// Finite, not negative, and no more than a film can sum.
    void require_radiance(const Vec3& value, const char* member) const {
        require_intensity(value, member);
        for (int i = 0; i < 3; ++i)
            if (value[i] > WEDGE_LARGEST_RADIANCE)
                require(false, member,
                        fmt::format("must be at most {:g}, which a film can sum, got {}",
                                    WEDGE_LARGEST_RADIANCE, value[i]));
    }

    /// Finite and not negative.
    void require_intensity(const Vec3& value, const char* member) const {
        for (int i = 0; i < 3; ++i)
            if (!(value[i] >= 0) || !std::isfinite(value[i]))
                require(false, member,
                        fmt::format("must be finite and not negative, got {}", value[i]));
    }

    void require_finite(const Vec3& value, const char* member) const {
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(value[i]))
                require(false, member, fmt::format("must be finite, got {}", value[i]));
    }

  private:
    const Scene& scene_;
    std::string path_;
};

void check_camera(const Scene& scene) {
    const Camera& camera = scene.camera;
    const Place place(scene, "camera");
    place.require_finite(camera.position, "position");
    place.require_finite(camera.target, "target");
    place.require_finite(camera.up, "up");
    place.require(camera.position != camera.target, "target", "is where the camera is");
    const glm::dvec3 view = glm::dvec3(camera.target) - glm::dvec3(camera.position);
    place.require(glm::cross(view, glm::dvec3(camera.up)) != glm::dvec3(0), "up",
                  "must be neither zero nor parallel to the view");
    place.require(
        camera.vertical_fov_rad > 0 && camera.vertical_fov_rad < kPi, "vertical_fov_rad",
        fmt::format("must be between 0 and pi, both excluded, got {}", camera.vertical_fov_rad));
    Place(scene, "film")
        .require(scene.film.width > 0 && scene.film.height > 0, "width",
                 fmt::format("{} x {} is no size of a film", scene.film.width, scene.film.height));
    Place(scene, "").require_radiance(scene.background, "background");
}

void check_materials(const Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        const Place place(scene, fmt::format("materials/{}", i));
        place.require_between(m.diffuse, 0, 1, "diffuse");
        place.require_between(m.specular, 0, 1, "specular");
        place.require_between(Vec3(m.exponent), 0, kLargestExponent, "exponent");
        place.require_radiance(m.emission, "emission");
        for (int texture : {m.diffuse_texture, m.specular_texture, m.emission_texture,
                            m.normal_texture, m.bump_texture})
            place.require(texture < int(scene.textures.size()), "texture",
                          fmt::format("there is no texture {}", texture));
    }
}

void check_textures(const Scene& scene) {
    for (std::size_t i = 0; i < scene.textures.size(); ++i) {
        const TextureImage& image = scene.textures[i].image;
        const std::size_t bytes = image.format == TextureFormat::float32 ? 16 : 4;
        Place(scene, fmt::format("textures/{}", i))
            .require(image.width > 0 && image.height > 0 &&
                         image.texels.size() ==
                             std::size_t(image.width) * std::size_t(image.height) * bytes,
                     "image", "its data does not match its size");
    }
}

void check_meshes(const Scene& scene) {
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& mesh = scene.meshes[i];
        const Place place(scene, fmt::format("meshes/{}", i));
        const std::size_t vertices = mesh.positions.size();
        place.require(mesh.normals.empty() || mesh.normals.size() == vertices, "normals",
                      "must be as many as there are positions, or none");
        place.require(mesh.uvs.empty() || mesh.uvs.size() == vertices, "uvs",
                      "must be as many as there are positions, or none");
        place.require(mesh.material_of.empty() || mesh.material_of.size() == mesh.triangles.size(),
                      "material_of", "must be as many as there are triangles, or none");
        // Millions: no message is put together that nobody reads.
        for (const UVec3& t : mesh.triangles)
            if (std::max({t.x, t.y, t.z}) >= vertices)
                place.require(false, "triangles", "name a vertex that is not there");
        for (uint32_t material : mesh.material_of)
            if (material >= scene.materials.size())
                place.require(false, "material_of", "names a material that is not there");
    }
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const Place place(scene, fmt::format("instances/{}", i));
        place.require(instance.mesh < scene.meshes.size(), "mesh",
                      fmt::format("there is no mesh {}", instance.mesh));
        const bool has_material = instance.material ? *instance.material < scene.materials.size()
                                                    : !scene.materials.empty();
        place.require(has_material, "material", "names a material that is not there");
    }
}

void check_lights(const Scene& scene) {
    for (std::size_t i = 0; i < scene.rect_lights.size(); ++i) {
        const RectLight& light = scene.rect_lights[i];
        const Place place(scene, fmt::format("rect_lights/{}", i));
        place.require_finite(light.center, "center");
        place.require_finite(light.edge_u, "edge_u");
        place.require_finite(light.edge_v, "edge_v");
        place.require_radiance(light.radiance, "radiance");
        if (light.profile == LightProfile::gaussian)
            place.require(light.sigma > 0 && std::isfinite(light.sigma), "sigma",
                          fmt::format("must be positive and finite, got {}", light.sigma));
    }
    for (std::size_t i = 0; i < scene.point_lights.size(); ++i) {
        const Place place(scene, fmt::format("point_lights/{}", i));
        place.require_finite(scene.point_lights[i].position, "position");
        place.require_intensity(scene.point_lights[i].intensity, "intensity");
    }
}

}  // namespace

void check_scene(const Scene& scene) {
    check_camera(scene);
    check_materials(scene);
    check_textures(scene);
    check_meshes(scene);
    check_lights(scene);
}

}  // namespace wedge::scene
