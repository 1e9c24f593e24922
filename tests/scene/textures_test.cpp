// Textures: found, decoded once, and never a reason to stop.
#include "tests/scene/support.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

/// A loader that gives one texel and counts; files named "broken…" throw.
struct FakeLoader {
    std::vector<std::string> loaded;
    std::vector<bool> as_color;

    TextureLoader callback() {
        return [this](const std::filesystem::path& file, bool is_color) {
            loaded.push_back(file.filename().string());
            as_color.push_back(is_color);
            if (file.filename().string().starts_with("broken"))
                throw Error(ErrorKind::bad_input, "no image");
            return TextureImage{1, 1, TextureFormat::srgb8, {1, 2, 3, 4}};
        };
    }
};

struct Loaded {
    Scene scene;
    FakeLoader loader;
    LogCapture log;
};

/// A triangle with one MTL material "a" of these lines; there are "Wall.PNG", "maps/floor.png" and
/// "broken.png".
void load_mtl(const std::string& mtl, Loaded& result) {
    TempFolder folder;
    for (const char* name : {"Wall.PNG", "maps/floor.png", "broken.png"}) folder.write(name, "");
    folder.write("m.mtl", "newmtl a\n" + mtl);
    const auto file = folder.write("m.obj", "mtllib m.mtl\nusemtl a\n" + kTriangleObj);
    result.scene = load_scene(file, {{}, result.loader.callback()});
}

}  // namespace

TEST_CASE("texture_names_ignore_case_and_take_windows_separators") {
    for (const char* name :
         {"wall.png", "WALL.PNG", "MAPS\\Floor.png", "D:\\textures\\wall.png", "maps/floor.png"}) {
        Loaded l;
        load_mtl("Kd 1 1 1\nmap_Kd " + std::string(name) + "\n", l);
        CHECK(l.scene.materials.at(0).diffuse_texture == 0);
        CHECK(l.scene.textures.size() == 1);
        CHECK(l.log.warnings.empty());
    }
}

TEST_CASE("texture_options_of_mtl_arrive") {
    Loaded l;
    load_mtl("Kd 1 1 1\nmap_Kd -s 2 3 1 -o 0.5 0.25 0 -mm 0.1 0.4 -clamp on wall.png\n", l);
    REQUIRE(l.scene.textures.size() == 1);
    const Texture& texture = l.scene.textures[0];
    CHECK(texture.scale == Vec2(2, 3));
    CHECK(texture.offset == Vec2(0.5f, 0.25f));
    CHECK(texture.value_base == 0.1f);
    CHECK(texture.value_gain == 0.4f);
    CHECK(texture.clamp);
    CHECK(l.loader.as_color.at(0));
}

TEST_CASE("a_file_is_decoded_once_and_an_entry_made_per_use") {
    Loaded l;
    load_mtl(
        "Kd 1 1 1\nKe 1 1 1\nmap_Kd wall.png\nmap_Ke -s 2 2 2 wall.png\nnewmtl b\nKd 1 1 1\nmap_Kd "
        "wall.png\n",
        l);
    CHECK(l.loader.loaded.size() == 1);
    CHECK(l.scene.textures.size() == 2);
    CHECK(l.scene.materials.at(0).diffuse_texture == l.scene.materials.at(1).diffuse_texture);
    CHECK(l.scene.materials.at(0).emission_texture != l.scene.materials.at(0).diffuse_texture);
    CHECK(l.scene.textures[1].image.texels == l.scene.textures[0].image.texels);
}

TEST_CASE("missing_and_broken_textures_warn_once_and_leave_the_constant") {
    for (const char* name : {"none.png", "broken.png"}) {
        Loaded l;
        load_mtl("Kd 0.2 0.3 0.4\nmap_Kd " + std::string(name) + "\nnewmtl b\nKd 0 0 0\nmap_Kd " +
                     name + "\n",
                 l);
        CHECK(l.scene.materials.at(0).diffuse_texture == -1);
        CHECK(l.scene.materials.at(0).diffuse == Vec3(0.2f, 0.3f, 0.4f));
        CHECK(l.scene.materials.at(1).diffuse == Vec3(0.5f));  // black beside a map means nothing
        CHECK(l.scene.textures.empty());
        CHECK(l.log.count(name) == 1);
        CHECK(l.log.warnings.size() == 1);
    }
}

TEST_CASE("black_beside_a_map_is_white") {
    Loaded l;
    load_mtl("Kd 0 0 0\nmap_Kd wall.png\nKe 0 0 0\nmap_Ke wall.png\n", l);
    CHECK(l.scene.materials.at(0).diffuse == Vec3(1));
    CHECK(l.scene.materials.at(0).emission == Vec3(1));
}

TEST_CASE("a_map_without_a_colour_is_taken_as_it_is") {
    for (const char* mtl : {"map_Kd wall.png\n", "  map_Kd\twall.png\nKs 0 0 0\n"}) {
        Loaded l;
        load_mtl(mtl, l);
        CHECK(l.scene.materials.at(0).diffuse == Vec3(1));
    }
    for (const char* mtl :
         {"Kd 0.3 0.3 0.3\nmap_Kd wall.png\n", "map_Kd wall.png\nKd 0.3 0.3 0.3"}) {
        Loaded l;
        load_mtl(mtl, l);
        CHECK(l.scene.materials.at(0).diffuse == Vec3(0.3f));
    }
}

TEST_CASE("without_a_loader_textures_are_left_out_with_one_warning") {
    TempFolder folder;
    folder.write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd wall.png\nmap_Ke b.png\n");
    LogCapture log;
    const Scene scene =
        load_scene(folder.write("m.obj", "mtllib m.mtl\nusemtl a\n" + kTriangleObj));
    CHECK(scene.textures.empty());
    CHECK(log.count("2 textures left out") == 1);
    CHECK(log.warnings.size() == 1);
}

TEST_CASE("images_of_the_wrong_size_are_refused") {
    TempFolder folder;
    folder.write("wall.png", "");
    LogCapture log;
    const LoadOptions options{{}, [](const std::filesystem::path&, bool) {
                                  return TextureImage{2, 2, TextureFormat::srgb8, {1, 2, 3, 4}};
                              }};
    folder.write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd wall.png\n");
    const Scene scene =
        load_scene(folder.write("m.obj", "mtllib m.mtl\nusemtl a\n" + kTriangleObj), options);
    CHECK(scene.textures.empty());
    CHECK(log.count("does not match its size") == 1);
}

TEST_CASE("textures_of_scene_files_arrive") {
    TempFolder folder;
    folder.write("t.obj", kTriangleObj);
    folder.write("wall.png", "");
    FakeLoader loader;
    const Scene scene = load_scene(folder.write("scene.json", scene_text("", R"("materials": {
            "a": {"kd_texture": {"file": "wall.png", "scale": [2, 3], "offset": [4, 5], "gain": 0.5,
                                 "base": 0.25, "clamp": true, "color": false}},
            "b": {"ks_texture": "wall.png", "ks": 0.5, "kd": 0.2},
            "c": {"kd": 0.2, "kd_texture": null}},
            "instances": [{"mesh": "t", "material": "a"}, {"mesh": "t", "material": "b"},
                          {"mesh": "t", "material": "c"}])")),
                                   {{}, loader.callback()});
    const auto material = [&](int i) {
        return scene.materials.at(scene.instances.at(i).material.value());
    };
    const Texture& texture = scene.textures.at(material(0).diffuse_texture);
    CHECK(material(0).diffuse == Vec3(1));
    CHECK(texture.scale == Vec2(2, 3));
    CHECK(texture.offset == Vec2(4, 5));
    CHECK(texture.value_gain == 0.5f);
    CHECK(texture.value_base == 0.25f);
    CHECK(texture.clamp);
    CHECK(!loader.as_color.at(0));
    CHECK(material(1).specular_texture >= 0);
    CHECK(material(1).model == SpecularModel::blinn_phong);
    CHECK(material(1).exponent == 20);
    CHECK(material(2).diffuse_texture == -1);
}
