// What a sound scene file means.
#include <glm/gtc/matrix_transform.hpp>

#include "host/scene/lights.hpp"
#include "tests/scene/support.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

Vec3 moved(const std::string& transform, const Vec3& point) {
    const Scene scene = load_text(
        scene_text("", "\"instances\": [{\"mesh\": \"t\", \"transform\": " + transform + "}]"));
    return Vec3(scene.instances.at(0).transform * Vec4(point, 1));
}

bool near(const Vec3& a, const Vec3& b) {
    return glm::length(a - b) < 1e-5f;
}

}  // namespace

TEST_CASE("values_arrive_where_they_belong") {
    const Scene scene = load_text(R"({
        "name": "n",
        "camera": {"position": [1,2,3], "target": [4,5,6], "up": [0,0,1], "vertical_fov_deg": 90},
        "film": {"width": 30, "height": 20},
        "render": {"spp": 7, "bounces": 2, "exposure": -1.5},
        "background": [0.1, 0.2, 0.3],
        "materials": {"m": {"kd": 0.25, "ks": [0.1, 0.2, 0.3], "exponent": 9, "model": "phong",
                            "emission": [1, 2, 3]}},
        "meshes": {"t": {"obj": "t.obj"}},
        "instances": [{"mesh": "t", "material": "m"}, {"mesh": "t"}],
        "lights": [{"type": "point", "position": [1,1,1], "intensity": [4,5,6]},
                   {"type": "rect", "center": [0,9,0], "u": [2,0,0], "v": [0,0,3], "radiance": 8,
                    "profile": "gaussian", "sigma": 0.5}]})");
    CHECK(scene.name == "n");
    CHECK(scene.camera.position == Vec3(1, 2, 3));
    CHECK(scene.camera.target == Vec3(4, 5, 6));
    CHECK(scene.camera.up == Vec3(0, 0, 1));
    CHECK(scene.camera.vertical_fov_rad == doctest::Approx(1.5707963));
    CHECK(scene.film.width == 30);
    CHECK(scene.film.height == 20);
    CHECK(scene.defaults.samples_per_pixel == 7);
    CHECK(scene.defaults.bounces == 2);
    CHECK(scene.defaults.exposure == -1.5f);
    CHECK(scene.background == Vec3(0.1f, 0.2f, 0.3f));

    REQUIRE(scene.instances.size() == 2);
    CHECK(!scene.instances[1].material);
    const Material& m = scene.materials.at(scene.instances[0].material.value());
    CHECK(m.name == "m");
    CHECK(m.diffuse == Vec3(0.25f));
    CHECK(m.specular == Vec3(0.1f, 0.2f, 0.3f));
    CHECK(m.exponent == 9);
    CHECK(m.model == SpecularModel::phong);
    CHECK(m.emission == Vec3(1, 2, 3));

    REQUIRE(scene.point_lights.size() == 1);
    CHECK(scene.point_lights[0].intensity == Vec3(4, 5, 6));
    REQUIRE(scene.rect_lights.size() == 1);
    CHECK(scene.rect_lights[0].center == Vec3(0, 9, 0));
    CHECK(scene.rect_lights[0].edge_u == Vec3(2, 0, 0));
    CHECK(scene.rect_lights[0].edge_v == Vec3(0, 0, 3));
    CHECK(scene.rect_lights[0].radiance == Vec3(8));
    CHECK(scene.rect_lights[0].profile == LightProfile::gaussian);
    CHECK(scene.rect_lights[0].sigma == 0.5f);
}

TEST_CASE("without_instances_every_mesh_is_placed_once") {
    const Scene scene = load_text(scene_text(
        "", "", R"({"a": {"obj": "t.obj"}, "b": {"obj": "t.obj"}, "c": {"generate": "box"}})"));
    REQUIRE(scene.meshes.size() == 3);
    REQUIRE(scene.instances.size() == 3);
    for (uint32_t i = 0; i < 3; ++i) {
        CHECK(scene.instances[i].mesh == i);
        CHECK(scene.instances[i].transform == Mat4(1));
    }
}

TEST_CASE("transforms_scale_then_rotate_then_move") {
    // (1, 0, 0) doubled, turned a quarter about z to (0, 2, 0), moved by (5, 0, 0).
    CHECK(near(moved(R"({"translate": [5,0,0], "rotate_deg": 90, "axis": [0,0,3], "scale": 2})",
                     {1, 0, 0}),
               {5, 2, 0}));
    // y is the axis if none is given: x turns to -z.
    CHECK(near(moved(R"({"rotate_deg": 90})", {1, 0, 0}), {0, 0, -1}));
    // In a list the first comes first: moved to (6, 0, 0), then turned.
    CHECK(near(moved(R"([{"translate": [5,0,0]}, {"rotate_deg": 90, "axis": [0,0,1]}])", {1, 0, 0}),
               {0, 6, 0}));
}

TEST_CASE("matrices_are_row_major") {
    const Vec3 expected(1 + 2 * 2 + 4, 3 * 2 + 5, 7);  // rows applied to (1, 2, 0)
    const std::string numbers = "[1,2,0,4, 0,3,0,5, 0,0,6,7, 0,0,0,1]";
    CHECK(near(moved(numbers, {1, 2, 0}), expected));
    CHECK(near(moved("{\"matrix\": " + numbers + "}", {1, 2, 0}), expected));
    CHECK(near(moved("[[1,2,0,4], [0,3,0,5], [0,0,6,7], [0,0,0,1]]", {1, 2, 0}), expected));
    CHECK(near(moved("[" + numbers + ", {\"translate\": [1,0,0]}]", {1, 2, 0}),
               expected + Vec3(1, 0, 0)));
}

TEST_CASE("power_is_the_integral_of_the_profile") {
    RectLight light;
    light.edge_u = {2, 0, 0};
    light.edge_v = {0, 0, 3};
    CHECK(wedge::scene::power_per_radiance(light) == doctest::Approx(kPi * 6));

    light.profile = LightProfile::gaussian;
    for (const float sigma : {0.3f, 1.0f, 50.0f}) {
        light.sigma = sigma;
        // Midpoint rule over the rectangle.
        const int n = 1000;
        double sum = 0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const double x = ((i + 0.5) / n - 0.5) * 2, y = ((j + 0.5) / n - 0.5) * 3;
                sum += std::exp(-(x * x + y * y) / (2.0 * sigma * sigma));
            }
        CHECK(wedge::scene::power_per_radiance(light) ==
              doctest::Approx(double(kPi) * sum * 6 / (double(n) * n)).epsilon(1e-4));
    }

    const Scene scene = load_text(scene_text("", R"("lights": [{"type": "rect", "center": [0,0,0],
        "u": [2,0,0], "v": [0,0,3], "power": 12}])"));
    CHECK(scene.rect_lights.at(0).radiance.x == doctest::Approx(12 / (kPi * 6)));
}

TEST_CASE("materials_of_the_scene_change_those_of_meshes") {
    TempFolder folder;
    folder.write("t.mtl",
                 "newmtl floor\nKd 0.1 0.2 0.3\nKs 0.2 0.2 0.2\nNs 5\nillum 2\nnewmtl wall\nKd 0.6 "
                 "0.6 0.6\n");
    folder.write("t.obj", "mtllib t.mtl\nusemtl floor\n" + kTriangleObj + "usemtl wall\nf 3 2 1\n");
    LogCapture log;
    const Scene scene = load_scene(folder.write(
        "scene.json", scene_text("", R"("materials": {"floor": {"ks": 0.3, "exponent": 20},
                                                      "wal": {"kd": 0.5}})")));
    const Material& floor = scene.materials.at(scene.meshes[0].material_of.at(0));
    CHECK(floor.name == "floor");
    CHECK(floor.diffuse == Vec3(0.1f, 0.2f, 0.3f));  // what is not said stays
    CHECK(floor.specular == Vec3(0.3f));
    CHECK(floor.exponent == 20);
    CHECK(floor.model == SpecularModel::blinn_phong);
    CHECK(scene.materials.at(scene.meshes[0].material_of.at(1)).diffuse == Vec3(0.6f));
    CHECK(log.count("\"wal\" is used by no mesh or instance; did you mean \"wall\"?") == 1);
    CHECK(log.warnings.size() == 1);
}

TEST_CASE("generated_materials_can_be_changed") {
    const Scene plain = load_text(scene_text("", "", R"({"b": {"generate": "box"}})"));
    const std::string name = plain.materials.at(plain.meshes[0].material_of.at(0)).name;
    const Scene scene =
        load_text(scene_text("", "\"materials\": {\"" + name + "\": {\"kd\": [0.9, 0.1, 0.2]}}",
                             R"({"b": {"generate": "box"}})"));
    CHECK(scene.materials.at(scene.meshes[0].material_of.at(0)).diffuse == Vec3(0.9f, 0.1f, 0.2f));
}

TEST_CASE("materials_reflect_no_more_than_they_receive") {
    LogCapture log;
    const Scene scene = load_text(scene_text(
        "",
        R"("materials": {"bright": {"kd": [0.9, 0.5, 0.1], "ks": [0.6, 0.5, 0.1]}, "sum_1": {"kd": 0.9, "ks": 0.1}},
               "instances": [{"mesh": "t", "material": "bright"}, {"mesh": "t", "material": "sum_1"}])"));
    const Material& bright = scene.materials.at(scene.instances[0].material.value());
    CHECK(bright.diffuse.x == doctest::Approx(0.6));
    CHECK(bright.specular.x == doctest::Approx(0.4));
    CHECK(bright.diffuse.y == 0.5f);  // a channel that is in order stays
    CHECK(bright.specular.z == 0.1f);
    for (const Material& m : scene.materials)
        for (int c = 0; c < 3; ++c) CHECK(m.diffuse[c] + m.specular[c] <= 1 + 1e-6f);
    CHECK(log.count("1 material(s) reflect more than they receive") == 1);
    CHECK(log.warnings.size() == 1);
}

TEST_CASE("meshes_are_found_through_asset_paths_in_order") {
    TempFolder folder, first, second;
    first.write("models/u.obj", kTriangleObj);
    second.write("models/u.obj", kTriangleObj + "f 3 2 1\n");
    second.write("models/v.obj", kTriangleObj + "f 3 2 1\n");
    const auto file =
        folder.write("scene.json", scene_text("", "", R"({"u": {"obj": "models/u.obj"},
                                                                       "v": {"obj": "Models\\V.OBJ"}})"));
    const Scene scene = load_scene(file, {{first / "", second / ""}, {}});
    CHECK(scene.meshes.at(0).triangles.size() == 1);
    CHECK(scene.meshes.at(1).triangles.size() == 2);
}

TEST_CASE("bounds_hold_instances_and_lights") {
    const Scene scene = load_text(scene_text("", R"(
        "instances": [{"mesh": "t", "transform": {"scale": 2, "translate": [10, 0, 0]}}],
        "lights": [{"type": "rect", "center": [0, 8, 0], "u": [2, 0, 0], "v": [0, 0, 4], "radiance": 1},
                   {"type": "point", "position": [0, -3, 0], "intensity": 1}])"));
    const Bounds bounds = scene_bounds(scene);
    CHECK(bounds.lower == Vec3(-1, -3, -2));
    CHECK(bounds.upper == Vec3(12, 8, 2));
}

TEST_CASE("the_documented_example_loads") {
    const auto docs = std::filesystem::path(__FILE__).parent_path() / "../../docs/scene-format.md";
    std::ifstream stream(docs);
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    const std::string fence = "```json\n";
    const std::size_t start = text.find(fence) + fence.size();
    REQUIRE(start < text.size());

    TempFolder folder;
    folder.write("lobby/lobby.mtl", "newmtl floor\nKd 0.5 0.4 0.3\n");
    folder.write("lobby/lobby.obj", "mtllib lobby.mtl\nusemtl floor\n" + kTriangleObj);
    folder.write("vase.obj", kTriangleObj);
    LogCapture log;
    const Scene scene =
        load_scene(folder.write("lobby.json", text.substr(start, text.find("```", start) - start)));
    CHECK(scene.meshes.size() == 3);
    CHECK(scene.instances.size() == 4);
    CHECK(scene.rect_lights.size() == 2);
    CHECK(scene.point_lights.size() == 1);
    CHECK(log.count("\"picture\" is used by no mesh") == 1);  // lobby.mtl of this test has none
}
