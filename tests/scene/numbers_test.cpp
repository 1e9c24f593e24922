// Numbers in OBJ and MTL files that cannot be meant: told with their line, and never handed on.
#include <cmath>
#include <cstring>
#include <limits>

#include "host/scene/check_scene.hpp"
#include "host/scene/mtl_text.hpp"
#include "host/scene/words.hpp"
#include "tests/scene/support.hpp"
#include "wedge/shared/radiance.h"

using namespace wedge;
using namespace wedge::test;

namespace {

Scene load_with_mtl(const std::string& mtl, LogCapture&, const TextureLoader& loader = {}) {
    TempFolder folder;
    folder.write("map.png", "");
    folder.write("m.mtl", "newmtl a\n" + mtl);
    return load_scene(folder.write("m.obj", "mtllib m.mtl\nusemtl a\n" + kTriangleObj),
                      {{}, loader});
}

TextureImage float_image(const std::vector<float>& values) {
    TextureImage image{int(values.size()) / 4, 1, TextureFormat::float32, {}};
    image.texels.resize(values.size() * sizeof(float));
    std::memcpy(image.texels.data(), values.data(), image.texels.size());
    return image;
}

}  // namespace

TEST_CASE("words_are_numbers_or_nan") {
    CHECK(scene::number_in("1.5") == 1.5);
    CHECK(scene::number_in("+1e3") == 1000);
    CHECK(scene::number_in("1e-999") == 0);
    for (const char* word : {"", "abc", "1x", "nan", "-nan", "inf", "1e39", "1e999", "-1e999", "+"})
        CHECK(std::isnan(scene::number_in(word)));
}

TEST_CASE("bad_colours_of_mtl_are_told_with_their_line_and_count_as_0") {
    for (const std::string bad : {"nan", "-0.5", "inf", "-inf", "1e999", "red", "-1e999"}) {
        CAPTURE(bad);
        LogCapture log;
        const Scene scene =
            load_with_mtl("Kd 0.5 " + bad + " 0.25\nKs 0 0 0\nKe " + bad + " 1 1\nillum 2\n", log);
        const Material& m = scene.materials.at(0);
        CHECK(m.diffuse == Vec3(0.5f, 0, 0.25f));
        CHECK(m.emission == Vec3(0, 1, 1));
        CHECK(log.count("m.mtl:2: Kd") == 1);
        CHECK(log.count(":4: Ke") == 1);
        CHECK(log.warnings.size() == 1);
    }
}

TEST_CASE("emission_of_mtl_is_no_more_than_a_film_can_sum") {
    LogCapture log;
    const Scene scene = load_with_mtl("Kd 0 0 0\nKe 1e30 1 1e15\n", log);
    CHECK(scene.materials.at(0).emission == Vec3(WEDGE_LARGEST_RADIANCE, 1, 1e15f));
    CHECK(log.count("m.mtl:3: Ke 1e30 1 1e15: above 2^51, which is used") == 1);
}

TEST_CASE("exponents_of_mtl_stay_in_range") {
    const auto exponent = [](const std::string& ns, int warnings) {
        LogCapture log;
        const Scene scene = load_with_mtl("Kd 0 0 0\nKs 1 1 1\nillum 2\nNs " + ns + "\n", log);
        CHECK(log.count("m.mtl:5: Ns") == warnings);
        return scene.materials.at(0).exponent;
    };
    CHECK(exponent("0", 0) == 0);
    CHECK(exponent("1000000", 0) == 1e6f);
    CHECK(exponent("1e7", 1) == 1e6f);
    CHECK(exponent("-3", 1) == 0);
    CHECK(exponent("nan", 1) == 0);
    CHECK(exponent("1e999", 1) == 0);
}

TEST_CASE("texture_options_that_are_no_numbers_take_their_defaults") {
    LogCapture log;
    const Scene scene = load_with_mtl(
        "Kd 1 1 1\nmap_Kd -s nan 1 1 -mm inf 2 map.png\nmap_Ke -o 1e999 0 0 map.png\n"
        "bump -bm nan map.png\n",
        log, [](const auto&, bool) {
            return TextureImage{1, 1, TextureFormat::srgb8, {1, 2, 3, 4}};
        });
    REQUIRE(scene.textures.size() == 3);
    for (const Texture& t : scene.textures)
        for (float number :
             {t.scale.x, t.scale.y, t.offset.x, t.offset.y, t.value_gain, t.value_base})
            CHECK(std::isfinite(number));
    CHECK(log.count("m.mtl:3: map_Kd") == 1);
    CHECK(log.count(":4: map_Ke") == 1);
    CHECK(log.count(":5: bump") == 1);
}

TEST_CASE("sound_mtl_files_are_not_remarked_upon") {
    CHECK(scene::describe_bad_numbers(
              "newmtl a\nKd 0.1 .2 1\nKd spectral a.rfl 1\nKs 1e-3 0 0\nNs 1e6\nmap_Kd -s 1 1 1 "
              "-clamp on -bm 2 a b.png\nbump -imfchan r -s 2 wall.png\r\nillum 2\n") == "");
}

TEST_CASE("long_lists_of_bad_lines_are_cut") {
    std::string mtl;
    for (int i = 0; i < 10; ++i) mtl += "Kd -1 0 0\n";
    CHECK(contains(scene::describe_bad_numbers(mtl), "and 7 more lines"));
}

TEST_CASE("bad_vertices_normals_and_uvs_are_counted_with_the_first_line") {
    TempFolder folder;
    LogCapture log;
    const Scene scene = load_scene(folder.write(
        "m.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 1e999 0 0\nvn 0 inf 1\nvn 0 0 1\nvt nan 0\n"
        "f 1/1/1 2/1/2 3/1/2\nf 1 2 4\nf 1 2 5\n"));
    CHECK(log.count("m.obj:4: 2 vertices are not finite") == 1);
    CHECK(log.count("m.obj:6: 1 normals are no numbers") == 1);
    CHECK(log.count("m.obj:8: 1 texture coordinates are no numbers") == 1);
    const Mesh& mesh = scene.meshes.at(0);
    REQUIRE(mesh.triangles.size() == 3);
    for (const Vec2& uv : mesh.uvs) CHECK((std::isfinite(uv.x) && std::isfinite(uv.y)));
    for (const Vec3& n : mesh.normals) CHECK(std::isfinite(glm::length(n)));
}

TEST_CASE("normals_and_uvs_that_overflow_are_counted") {
    TempFolder folder;
    LogCapture log;
    load_scene(folder.write("m.obj", kTriangleObj +
                                         "vn 0 1e39 1\nvn 0 1e38 1e-60\nvt 1e-3 1E99\n"
                                         "vt 0." +
                                         std::string(60, '1') + "\nvt " + std::string(60, '1') +
                                         "\n"));
    CHECK(log.count("1 normals are no numbers") == 1);
    CHECK(log.count("2 texture coordinates are no numbers") == 1);
    CHECK(log.warnings.size() == 2);
}

TEST_CASE("a_vertex_line_without_numbers_spoils_no_other_vertex") {
    for (const std::string odd : {"v\n", "v \n", "v", "\tv\r\n", "v\t"}) {
        TempFolder folder;
        LogCapture log;
        const Scene scene =
            load_scene(folder.write("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n" + odd));
        for (const UVec3& t : scene.meshes.at(0).triangles)
            for (int i = 0; i < 3; ++i) CHECK(std::isfinite(scene.meshes[0].positions.at(t[i]).x));
        const Scene before =
            load_scene(folder.write("n.obj", odd + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n"));
        for (const UVec3& t : before.meshes.at(0).triangles)
            for (int i = 0; i < 3; ++i) CHECK(std::isfinite(before.meshes[0].positions.at(t[i]).x));
    }
}

TEST_CASE("old_line_ends_and_hostile_tags_are_read") {
    TempFolder folder;
    CHECK(load_scene(folder.write("mac.obj", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r"))
              .meshes[0]
              .triangles.size() == 1);
    CHECK_NOTHROW(load_scene(folder.write(
        "tag.obj", kTriangleObj + "t a 2000000000/2000000000/2000000000 1\nt b -1/-1/-1\n")));
}

TEST_CASE("texels_that_no_surface_reflects_are_counted") {
    const auto loader = [](const auto&, bool) {
        return float_image({-1, 0, 0, 1, 0.5f, 0.5f, 0.5f, 1, 2, 0, 0, 1});
    };
    LogCapture log;
    load_with_mtl("Kd 1 1 1\nmap_Kd map.png\n", log, loader);
    CHECK(log.count("1 texels are negative") == 1);
    CHECK(log.count("1 texels reflect more than they receive") == 1);
    LogCapture shining;
    load_with_mtl("Ke 1 1 1\nmap_Ke map.png\n", shining, loader);
    CHECK(shining.count("1 texels are negative") == 1);
    CHECK(shining.count("reflect more") == 0);
}

TEST_CASE("scenes_made_in_memory_are_checked") {
    Scene good;
    good.meshes = {Mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                        .triangles = {{0, 1, 2}},
                        .material_of = {0}}};
    good.instances = {{.mesh = 0}};
    good.materials = {Material{}};
    good.rect_lights = {RectLight{}};
    good.point_lights = {PointLight{}};
    CHECK_NOTHROW(scene::check_scene(good));

    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = INFINITY;
    const auto error = [&](const auto& spoil) {
        Scene bad = good;
        spoil(bad);
        return bad_input([&] { scene::check_scene(bad); });
    };
    CHECK(contains(error([](Scene& s) { s.camera.position.x = kNan; }), "camera/position"));
    CHECK(contains(error([](Scene& s) { s.camera.target = s.camera.position; }), "camera/target"));
    CHECK(contains(error([](Scene& s) { s.camera.vertical_fov_rad = 0; }), "vertical_fov_rad"));
    CHECK(contains(error([](Scene& s) { s.film.width = 0; }), "film/"));
    CHECK(contains(error([](Scene& s) { s.background.y = -1; }), "background"));
    CHECK(contains(error([](Scene& s) { s.materials[0].diffuse.x = 1.5f; }),
                   "/0/diffuse: must be between 0 and 1, got 1.5"));
    CHECK(contains(error([](Scene& s) { s.materials[0].exponent = kNan; }), "exponent"));
    CHECK(contains(error([](Scene& s) { s.materials[0].emission.z = kInf; }), "emission"));
    CHECK(contains(error([](Scene& s) { s.materials[0].bump_texture = 3; }), "no texture 3"));
    CHECK(contains(error([](Scene& s) { s.meshes[0].triangles[0].z = 3; }), "triangles"));
    CHECK(contains(error([](Scene& s) { s.meshes[0].material_of[0] = 7; }), "material"));
    CHECK(contains(error([](Scene& s) { s.meshes[0].uvs.resize(2); }), "uvs"));
    CHECK(contains(error([](Scene& s) { s.instances[0].mesh = 9; }), "no mesh 9"));
    CHECK(contains(error([](Scene& s) { s.rect_lights[0].radiance.x = kNan; }),
                   "rect_lights/0/radiance: must be finite and not negative, got nan"));
    CHECK(contains(error([](Scene& s) { s.rect_lights[0].radiance.x = 1e16f; }), "got 1e+16"));
    CHECK(contains(error([](Scene& s) { s.rect_lights[0].edge_u.x = kInf; }), "edge_u"));
    CHECK(contains(error([](Scene& s) {
                       s.rect_lights[0].profile = LightProfile::gaussian;
                       s.rect_lights[0].sigma = 0;
                   }),
                   "sigma"));
    CHECK(contains(error([](Scene& s) { s.point_lights[0].intensity.x = -1; }), "intensity"));
    CHECK(contains(error([](Scene& s) { s.textures.resize(1); }), "textures/0"));
}

TEST_CASE("bump_and_normal_maps_of_mtl_arrive") {
    // A bump map of bluish unit vectors is a normal map in the wrong place.
    const auto loader = [](const std::filesystem::path&, bool is_color) {
        CHECK(!is_color);
        return TextureImage{2, 1, TextureFormat::linear8, {140, 120, 254, 255, 64, 128, 236, 255}};
    };
    const auto grey = [](const std::filesystem::path&, bool) {
        return TextureImage{2, 1, TextureFormat::linear8, {140, 140, 140, 255, 64, 64, 64, 255}};
    };
    LogCapture log;
    for (const std::string key : {"bump", "map_Bump", "map_bump"}) {
        const Scene bumpy = load_with_mtl("Kd 1 1 1\n" + key + " -bm 0.5 map.png\n", log, grey);
        CHECK(bumpy.materials.at(0).bump_texture == 0);
        CHECK(bumpy.materials.at(0).normal_texture == -1);
        CHECK(bumpy.textures.at(0).value_gain == 0.5f);
        const Scene misplaced = load_with_mtl("Kd 1 1 1\n" + key + " map.png\n", log, loader);
        CHECK(misplaced.materials.at(0).bump_texture == -1);
        CHECK(misplaced.materials.at(0).normal_texture == 0);
    }
    const Scene mapped = load_with_mtl("Kd 1 1 1\nnorm -bm 2 map.png\n", log, loader);
    CHECK(mapped.materials.at(0).normal_texture == 0);
    CHECK(mapped.textures.at(0).value_gain == 2);
    const Scene missing = load_with_mtl("Kd 0.5 1 1\nbump none.png\n", log, grey);
    CHECK(missing.materials.at(0).bump_texture == -1);
    CHECK(log.count("none.png\" is not beside it nor in the asset paths; the surface stays") == 1);
}

TEST_CASE("scene_files_give_and_take_normal_maps") {
    TempFolder folder;
    folder.write("map.png", "");
    folder.write("m.mtl", "newmtl a\nKd 1 1 1\nbump map.png\n");
    folder.write("t.obj", "mtllib m.mtl\nusemtl a\n" + kTriangleObj);
    const LoadOptions options{{}, [](const auto&, bool) {
                                  return TextureImage{1, 1, TextureFormat::linear8, {9, 9, 9, 9}};
                              }};
    const auto load = [&](const std::string& others, const std::string& meshes = "") {
        return load_scene(folder.write("scene.json", scene_text("", others, meshes)), options)
            .materials.at(0);
    };
    CHECK(load("").bump_texture == 0);
    CHECK(load(R"("materials": {"a": {"bump_texture": null}})").bump_texture == -1);
    CHECK(load(R"("materials": {"a": {"normal_texture": "map.png"}})").normal_texture == 0);
    CHECK(load("", R"({"t": {"obj": "t.obj", "normal_maps": false}})").bump_texture == -1);
    const std::string steep =
        R"("materials": {"a": {"bump_texture": {"file": "map.png", "gain": -3}}})";
    CHECK(load(steep).bump_texture == 1);
}
