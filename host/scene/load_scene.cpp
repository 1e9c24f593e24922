#include <algorithm>
#include <cctype>

#include "host/scene/default_view.hpp"
#include "host/scene/materials.hpp"
#include "host/scene/obj_file.hpp"
#include "host/scene/scene_file.hpp"
#include "host/scene/texture_set.hpp"
#include "wedge/error.hpp"
#include "wedge/scene.hpp"

namespace wedge {
namespace {

Scene load_model(const std::filesystem::path& file, const LoadOptions& options) {
    Scene scene;
    scene.name = file.stem().string();
    scene::TextureSet textures(scene, options);
    scene.meshes.push_back(scene::load_obj(file, scene::ObjOptions{}, scene, textures, options));
    scene.instances.push_back({});
    scene::conserve_energy(scene.materials, file.string());
    textures.report();
    scene::add_default_view(scene);
    return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, const LoadOptions& options) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    if (extension == ".obj") return load_model(file, options);
    if (extension == ".json") return scene::load_scene_file(file, options);
    throw Error(ErrorKind::bad_input,
                file.string() + ": a scene is a .json or an .obj file, not \"" + extension + "\"");
}

Bounds scene_bounds(const Scene& scene) {
    Bounds bounds;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (const UVec3& triangle : mesh.triangles)
            for (int corner = 0; corner < 3; ++corner) {
                const Vec3 p(instance.transform * Vec4(mesh.positions[triangle[corner]], 1));
                // A vertex that is not finite takes its triangles out of the scene, not the rest.
                if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
                    bounds.include(p);
            }
    }
    for (const RectLight& light : scene.rect_lights)
        for (const float u : {-0.5f, 0.5f})
            for (const float v : {-0.5f, 0.5f})
                bounds.include(light.center + u * light.edge_u + v * light.edge_v);
    for (const PointLight& light : scene.point_lights) bounds.include(light.position);
    return bounds;
}

}  // namespace wedge
