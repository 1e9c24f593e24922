#include "bench/peers/scene_export.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/peers/baked_images.hpp"
#include "bench/peers/ply_file.hpp"
#include "host/base/atomic_file.hpp"
#include "host/render/flatten.hpp"
#include "wedge/error.hpp"

namespace wedge::peers {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json to_json(const Vec3& v) {
    return ordered_json::array({v.x, v.y, v.z});
}

/// Triangles that can share a file.
struct Group {
    uint32_t material = 0;
    bool smooth = false;
    auto operator<=>(const Group&) const = default;
};

/// A mesh that grows by triangles of a flat scene; vertices are taken over once.
class GroupMesh {
  public:
    void add(const rendering::FlatScene& flat, const UVec3& corners, bool smooth) {
        UVec3 t;
        for (int c = 0; c < 3; ++c) t[c] = place_of(flat, corners[c], smooth);
        mesh_.triangles.push_back(t);
    }
    const PlyMesh& mesh() const { return mesh_; }

  private:
    uint32_t place_of(const rendering::FlatScene& flat, uint32_t vertex, bool smooth) {
        const auto [place, is_new] = places_.try_emplace(vertex, uint32_t(mesh_.positions.size()));
        if (is_new) {
            const shared::ShadingVertex& v = flat.vertices[vertex];
            mesh_.positions.push_back({v.px, v.py, v.pz});
            if (smooth) mesh_.normals.push_back({v.nx, v.ny, v.nz});
            mesh_.uvs.push_back({v.u, v.v});
        }
        return place->second;
    }

    PlyMesh mesh_;
    std::map<uint32_t, uint32_t> places_;
};

/// By material; those of rectangular lights, which come last, are left out.
std::map<Group, GroupMesh> group_triangles(const Scene& scene, const rendering::FlatScene& flat) {
    std::map<Group, GroupMesh> groups;
    const std::size_t count = flat.triangles.size() - 2 * scene.rect_lights.size();
    for (std::size_t i = 0; i < count; ++i) {
        const UVec3& t = flat.triangles[i];
        bool smooth = false, finite = true;
        for (int c = 0; c < 3; ++c) {
            const shared::ShadingVertex& v = flat.vertices[t[c]];
            smooth = smooth || v.nx != 0 || v.ny != 0 || v.nz != 0;
            finite = finite && std::isfinite(v.px + v.py + v.pz);
        }
        if (!finite) continue;  // as in Wedge's tree
        groups[{flat.shading[i].material, smooth}].add(flat, t, smooth);
    }
    return groups;
}

ordered_json export_meshes(const Scene& scene, const fs::path& folder) {
    ordered_json list = ordered_json::array();
    for (const auto& [group, made] : group_triangles(scene, rendering::flatten(scene))) {
        const std::string file = fmt::format("meshes/{}.ply", list.size());
        write_ply(folder / file, made.mesh());
        list.push_back({{"file", file},
                        {"material", group.material},
                        {"smooth", group.smooth},
                        {"triangles", made.mesh().triangles.size()}});
    }
    return list;
}

ordered_json export_materials(const Scene& scene, const fs::path& folder) {
    ordered_json list = ordered_json::array();
    BakedImages images(scene, folder);
    for (const Material& m : scene.materials) {
        const bool has_lobe = m.model != SpecularModel::none && m.specular != Vec3(0);
        ordered_json item{{"name", m.name},
                          {"model", !has_lobe                         ? "lambert"
                                    : m.model == SpecularModel::phong ? "phong"
                                                                      : "blinn_phong"},
                          {"kd", to_json(m.diffuse)},
                          {"ks", to_json(has_lobe ? m.specular : Vec3(0))},
                          {"exponent", has_lobe ? m.exponent : 0},
                          {"emission", to_json(m.emission)}};
        const auto add = [&](const char* name, int texture, const Vec3& constant, Range range) {
            if (texture >= 0 && constant != Vec3(0))
                item[name] = images.bake(texture, constant, range);
        };
        add("kd_image", m.diffuse_texture, m.diffuse, Range::reflectance);
        if (has_lobe) add("ks_image", m.specular_texture, m.specular, Range::reflectance);
        add("emission_image", m.emission_texture, m.emission, Range::radiance);
        list.push_back(std::move(item));
    }
    return list;
}

ordered_json export_rects(const Scene& scene, const fs::path& folder) {
    ordered_json list = ordered_json::array();
    for (const RectLight& rect : scene.rect_lights) {
        ordered_json item{{"center", to_json(rect.center)},
                          {"u", to_json(rect.edge_u)},
                          {"v", to_json(rect.edge_v)},
                          {"radiance", to_json(rect.radiance)}};
        if (rect.profile == LightProfile::gaussian) {
            item["image"] = fmt::format("textures/light{}.exr", list.size());
            bake_gaussian(rect, folder / item["image"].get<std::string>());
        }
        list.push_back(std::move(item));
    }
    return list;
}

}  // namespace

std::vector<std::string> simplify_for_peers(Scene& scene, bool lambert_only) {
    std::vector<std::string> taken;
    const auto tell = [&](const std::string& name, const char* what) {
        taken.push_back(fmt::format("{}: {} left out on both sides", name, what));
    };
    for (Material& m : scene.materials) {
        if (m.normal_texture >= 0 || m.bump_texture >= 0) tell(m.name, "its normal or bump map is");
        m.normal_texture = m.bump_texture = -1;
        if (!lambert_only || m.model == SpecularModel::none) continue;
        if (m.specular != Vec3(0)) tell(m.name, "its specular lobe is");
        m.model = SpecularModel::none;
        m.specular = Vec3(0);
        m.specular_texture = -1;
    }
    for (Mesh& mesh : scene.meshes) {
        if (!lambert_only || mesh.normals.empty()) continue;
        tell(mesh.name, "its interpolated normals are");
        mesh.normals.clear();
    }
    return taken;
}

void export_scene(const Scene& scene, const fs::path& folder) {
    for (const char* part : {"meshes", "textures"}) make_folder(folder / part);
    const Camera& camera = scene.camera;
    ordered_json object{{"format", "wedge-peers 1"},
                        {"name", scene.name},
                        {"film", {{"width", scene.film.width}, {"height", scene.film.height}}},
                        {"bounces", scene.defaults.bounces},
                        {"camera",
                         {{"position", to_json(camera.position)},
                          {"target", to_json(camera.target)},
                          {"up", to_json(camera.up)},
                          {"vertical_fov_rad", camera.vertical_fov_rad}}},
                        {"background", to_json(scene.background)}};
    const Bounds bounds = scene_bounds(scene);
    object["bounds"] = {{"lower", to_json(bounds.lower)}, {"upper", to_json(bounds.upper)}};
    object["materials"] = export_materials(scene, folder);
    object["meshes"] = export_meshes(scene, folder);
    object["rects"] = export_rects(scene, folder);
    object["points"] = ordered_json::array();
    for (const PointLight& point : scene.point_lights)
        object["points"].push_back(
            {{"position", to_json(point.position)}, {"intensity", to_json(point.intensity)}});
    write_file_atomically(
        folder / "scene.json",
        object.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace wedge::peers
