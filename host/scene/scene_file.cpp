#include "host/scene/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "host/base/edit_distance.hpp"
#include "host/scene/asset_search.hpp"
#include "host/scene/json_reader.hpp"
#include "host/scene/lights.hpp"
#include "host/scene/materials.hpp"
#include "host/scene/obj_file.hpp"
#include "host/scene/settings.hpp"
#include "host/scene/transforms.hpp"
#include "scenes/generators/generators.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::scene {
namespace {

constexpr std::uintmax_t kLargestScene_bytes = 64u << 20;

struct Loading {
    const std::filesystem::path& file;
    const LoadOptions& options;
    Scene& scene;
    TextureSet& textures;
};

NormalsMode read_normals(const JsonView& view) {
    const std::string name = view.string();
    if (name == "auto") return NormalsMode::automatic;
    if (name == "face") return NormalsMode::face;
    if (name == "smooth") return NormalsMode::smooth;
    view.fail("unknown normals \"" + name + "\"" + suggestion(name, {"auto", "face", "smooth"}));
}

Mesh read_obj_mesh(const JsonView& view, const Loading& loading) {
    view.allow_only({"obj", "normals", "normal_maps"});
    const JsonView obj = view.require("obj");
    ObjOptions how;
    if (const auto normals = view.find("normals")) how.normals = read_normals(*normals);
    if (const auto maps = view.find("normal_maps")) how.normal_maps = maps->boolean();
    const auto found =
        find_file(obj.string(), search_order(loading.file, loading.options.asset_paths));
    if (!found)
        obj.fail("\"" + obj.string() +
                 "\" is not beside the scene nor in the asset paths; name the folder that holds it "
                 "with --asset-path or WEDGE_ASSETS");
    return load_obj(*found, how, loading.scene, loading.textures, loading.options);
}

Mesh read_generated_mesh(const JsonView& view, const Loading& loading) {
    std::string kind;
    std::map<std::string, double> parameters;
    for (const auto& [key, value] : view.members()) {
        if (key == "generate")
            kind = value.string();
        else
            parameters[key] = value.number();
    }
    try {
        return scenes::generate(kind, parameters, loading.scene.materials);
    } catch (const Error& error) {
        view.fail(error.what());
    }
}

void read_meshes(const JsonView& meshes, const Loading& loading) {
    for (const auto& [name, view] : meshes.members()) {
        const bool from_file = view.find("obj").has_value();
        if (from_file == view.find("generate").has_value())
            view.fail("needs either \"obj\" or \"generate\"");
        Mesh mesh = from_file ? read_obj_mesh(view, loading) : read_generated_mesh(view, loading);
        if (mesh.triangles.empty()) view.fail("empty mesh: it has no triangles");
        mesh.name = name;
        loading.scene.meshes.push_back(std::move(mesh));
    }
    if (loading.scene.meshes.empty()) meshes.fail("is empty; a scene needs a mesh");
}

/// The scene file's word on materials of that name in meshes; those of no mesh are materials of
/// their own, for instances to name. Returns the names of the latter.
std::set<std::string> apply_materials(const MaterialEdits& edits, const Loading& loading) {
    std::set<std::string> unclaimed;
    for (const auto& [name, edit] : edits) {
        bool claimed = false;
        for (Material& material : loading.scene.materials) {
            if (material.name != name) continue;
            apply(edit, material, loading.textures, loading.file);
            claimed = true;
        }
        if (claimed) continue;
        Material material;
        material.name = name;
        apply(edit, material, loading.textures, loading.file);
        loading.scene.materials.push_back(material);
        unclaimed.insert(name);
    }
    return unclaimed;
}

template <typename Named>
std::vector<std::string> names_of(const std::vector<Named>& items) {
    std::set<std::string> names;
    for (const Named& item : items) names.insert(item.name);
    return {names.begin(), names.end()};
}

/// Index of what `view` names among `items`.
template <typename Named>
uint32_t resolve(const JsonView& view, const std::vector<Named>& items, const char* what) {
    const std::string name = view.string();
    const auto found = std::find_if(items.begin(), items.end(),
                                    [&](const Named& item) { return item.name == name; });
    if (found == items.end())
        view.fail(
            fmt::format("unknown {} \"{}\"{}", what, name, suggestion(name, names_of(items))));
    return uint32_t(found - items.begin());
}

Instance read_instance(const JsonView& view, const Scene& scene) {
    view.allow_only({"mesh", "transform", "matrix", "material"});
    Instance instance;
    instance.mesh = resolve(view.require("mesh"), scene.meshes, "mesh");
    const auto transform = view.find("transform"), matrix = view.find("matrix");
    if (transform && matrix) matrix->fail("give either \"transform\" or \"matrix\"");
    if (transform) instance.transform = read_transform(*transform);
    if (matrix) instance.transform = read_transform(*matrix);
    if (const auto material = view.find("material"))
        instance.material = resolve(*material, scene.materials, "material");
    return instance;
}

void read_instances(const std::optional<JsonView>& instances, Scene& scene) {
    if (!instances) {
        for (uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
            scene.instances.push_back({mesh, Mat4(1), std::nullopt});
        return;
    }
    for (const JsonView& view : instances->elements())
        scene.instances.push_back(read_instance(view, scene));
    if (scene.instances.empty()) instances->fail("is empty; leave it out to place every mesh once");
}

/// A material of the scene file that nothing uses is most often a misspelt name of a mesh's.
void warn_of_unused(const std::set<std::string>& unclaimed, const Loading& loading) {
    std::set<std::string> used;
    for (const Instance& instance : loading.scene.instances)
        if (instance.material) used.insert(loading.scene.materials[*instance.material].name);
    std::vector<std::string> of_meshes;
    for (const std::string& name : names_of(loading.scene.materials))
        if (!unclaimed.count(name)) of_meshes.push_back(name);
    for (const std::string& name : unclaimed)
        if (!used.count(name))
            log_warning(fmt::format("{}: material \"{}\" is used by no mesh or instance{}",
                                    loading.file.string(), name, suggestion(name, of_meshes)));
}

}  // namespace

Scene load_scene_file(const std::filesystem::path& file, const LoadOptions& options) {
    const JsonDocument document(read_text(file, kLargestScene_bytes), file.string());
    const JsonView root = document.root();
    root.allow_only({"$schema", "name", "camera", "film", "render", "background", "materials",
                     "meshes", "instances", "lights"});

    // What is quick to check comes first: a slip in the camera must not wait for a million
    // triangles.
    Scene scene;
    scene.name = file.stem().string();
    if (const auto name = root.find("name")) scene.name = name->string();
    scene.camera = read_camera(root.require("camera"));
    if (const auto film = root.find("film")) scene.film = read_film(*film);
    if (const auto render = root.find("render")) scene.defaults = read_render_defaults(*render);
    if (const auto background = root.find("background")) scene.background = background->radiance();
    if (const auto lights = root.find("lights")) read_lights(*lights, scene);
    MaterialEdits edits;
    if (const auto materials = root.find("materials")) edits = read_materials(*materials);

    TextureSet textures(scene, options);
    const Loading loading{file, options, scene, textures};
    read_meshes(root.require("meshes"), loading);
    const std::set<std::string> unclaimed = apply_materials(edits, loading);
    read_instances(root.find("instances"), scene);

    warn_of_unused(unclaimed, loading);
    conserve_energy(scene.materials, file.string());
    textures.report();
    return scene;
}

}  // namespace wedge::scene
