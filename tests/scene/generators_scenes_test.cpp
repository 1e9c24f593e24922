// The scene files that come with the project load, and say what they mean to say.
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "wedge/log.hpp"
#include "wedge/scene.hpp"

using namespace wedge;
namespace fs = std::filesystem;

namespace {

const fs::path kRoot = fs::path(__FILE__).parent_path().parent_path().parent_path();

/// Folder of the models that are not part of the project; empty where there is none.
fs::path models() {
    const char* given = std::getenv("WEDGE_SHARED_DIR");
    const fs::path folder = (given ? fs::path(given) : kRoot.parent_path() / "shared") / "scenes";
    return fs::is_directory(folder) ? folder : fs::path();
}

Scene load(const std::string& name, const fs::path& assets = {}) {
    LoadOptions options;
    if (!assets.empty()) options.asset_paths.push_back(assets);
    return load_scene(kRoot / "scenes" / (name + ".json"), options);
}

std::size_t instanced_triangle_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        count += scene.meshes[instance.mesh].triangles.size();
    return count;
}

bool emits(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        for (const uint32_t material : mesh.material_of)
            if (scene.materials[material].emission != Vec3(0)) return true;
    return !scene.rect_lights.empty() || !scene.point_lights.empty();
}

void check_is_lit_and_in_view(const Scene& scene) {
    CHECK(emits(scene));
    CHECK(instanced_triangle_count(scene) > 0);
    const Bounds bounds = scene_bounds(scene);
    const Vec3 target = scene.camera.target;
    CHECK(glm::all(glm::greaterThanEqual(target, bounds.lower - 0.01f * bounds.extent())));
    CHECK(glm::all(glm::lessThanEqual(target, bounds.upper + 0.01f * bounds.extent())));
}

}  // namespace

TEST_CASE("scenes_of_generated_geometry_load_without_assets") {
    for (const auto* name : {"demo", "cornell", "grids", "spheres", "tentacles", "room"}) {
        CAPTURE(name);
        const Scene scene = load(name);
        CHECK(scene.name == name);
        check_is_lit_and_in_view(scene);
    }
}

TEST_CASE("scenes_of_known_models_have_their_published_size") {
    const fs::path assets = models();
    if (assets.empty()) {
        MESSAGE("skipped: scenes_of_known_models_have_their_published_size (no models here)");
        return;
    }
    // Triangles of the model, and of what the scene file adds.
    const std::pair<const char*, std::size_t> expected[] = {
        {"sponza", 66450},       {"sibenik", 75284},  {"bunny", 144046 + 2},
        {"buddha", 100000 + 2},  {"car", 300603 + 2}, {"cornell-original", 36},
        {"cornell-glossy", 1112}};
    for (const auto& [name, triangles] : expected) {
        CAPTURE(name);
        const Scene scene = load(name, assets);
        CHECK(instanced_triangle_count(scene) == triangles);
        check_is_lit_and_in_view(scene);
    }
}

TEST_CASE("the_light_of_the_cornell_box_fills_the_hole_in_its_ceiling") {
    const Scene scene = load("cornell");
    REQUIRE(scene.rect_lights.size() == 1);
    const RectLight& light = scene.rect_lights[0];
    CHECK(glm::cross(light.edge_u, light.edge_v).y < 0);
    const Mesh& box = scene.meshes[0];
    for (const float u : {-0.5f, 0.5f})
        for (const float v : {-0.5f, 0.5f}) {
            const Vec3 corner = light.center + u * light.edge_u + v * light.edge_v;
            CAPTURE(corner.x);
            CAPTURE(corner.z);
            CHECK(std::find(box.positions.begin(), box.positions.end(), corner) !=
                  box.positions.end());
        }
}
