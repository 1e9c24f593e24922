// Scenes for other renderers, and whether their images agree with ours.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "bench/peers/baked_images.hpp"
#include "bench/peers/peer_process.hpp"
#include "bench/peers/scene_export.hpp"
#include "tests/bench/synthetic.hpp"
#include "tests/bench/temporary_folder.hpp"
#include "wedge/error.hpp"
#include "wedge/image_io.hpp"

using namespace wedge;
using test::Synthetic;
using test::TemporaryFolder;

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostTriangles = 200'000;  // tests take seconds

std::string read_text(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

bool succeeds(const std::string& command) {
    return std::system((command + " > /dev/null 2>&1").c_str()) == 0;
}

LoadOptions with_models() {
    const char* given = std::getenv("WEDGE_SHARED_DIR");
    const fs::path shared = given ? fs::path(given) : fs::path(WEDGE_SOURCE_DIR) / "../shared";
    return {{shared / "scenes"}, load_texture};
}

std::size_t triangle_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        count += scene.meshes[instance.mesh].triangles.size();
    return count;
}

std::size_t number_after(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    REQUIRE(at != std::string::npos);
    return std::size_t(std::stoul(text.substr(at + words.size())));
}

/// Header against content: sizes, and that indices name vertices. Returns the triangles.
std::size_t check_ply(const fs::path& file, bool smooth) {
    const std::string text = read_text(file);
    const std::string end = "end_header\n";
    const std::size_t body = text.find(end) + end.size();
    const std::size_t vertices = number_after(text, "element vertex ");
    const std::size_t faces = number_after(text, "element face ");
    const std::size_t vertex_bytes = (smooth ? 8 : 5) * sizeof(float), face_bytes = 13;
    REQUIRE(text.size() == body + vertices * vertex_bytes + faces * face_bytes);
    bool sound = true;
    for (std::size_t f = 0; f < faces; ++f) {
        const char* face = text.data() + body + vertices * vertex_bytes + f * face_bytes;
        int32_t corners[3];
        std::memcpy(corners, face + 1, sizeof(corners));
        sound = sound && face[0] == 3;
        for (int32_t c : corners) sound = sound && c >= 0 && std::size_t(c) < vertices;
    }
    CHECK(sound);
    return faces;
}

void check_export(const fs::path& folder, const Scene& scene) {
    const json object = json::parse(read_text(folder / "scene.json"));
    CHECK(object["materials"].size() == scene.materials.size());
    CHECK(object["rects"].size() == scene.rect_lights.size());
    std::size_t triangles = 0;
    for (const json& mesh : object["meshes"]) {
        CHECK(mesh["material"].get<std::size_t>() < scene.materials.size());
        triangles += check_ply(folder / mesh["file"].get<std::string>(), mesh["smooth"]);
    }
    CHECK(triangles == triangle_count(scene));
    for (const json& material : object["materials"])
        for (const char* image : {"kd_image", "ks_image", "emission_image"})
            if (material.contains(image))
                CHECK(fs::exists(folder / material[image]["file"].get<std::string>()));
}

/// A floor with a shining square over it; the material has a lobe.
Scene small_scene() {
    Scene scene;
    scene.name = "small <&>";
    scene.film = {16, 12};
    scene.camera = {{0, 1, 3}, {0, 0, 0}, {0, 1, 0}, 0.8f};
    scene.materials = {{.name = "floor",
                        .diffuse = Vec3(0.4f),
                        .specular = Vec3(0.3f),
                        .exponent = 20,
                        .model = SpecularModel::blinn_phong}};
    scene.meshes = {{.name = "floor",
                     .positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}},
                     .triangles = {{0, 1, 2}, {0, 2, 3}},
                     .material_of = {0, 0}}};
    scene.instances = {{.mesh = 0}};
    scene.rect_lights = {{{0, 2, 0}, {1, 0, 0}, {0, 0, 1}, Vec3(5), LightProfile::gaussian, 0.25f}};
    return scene;
}

/// For renderers without lobes: the floor has four texels of different colours, and there is a sky.
Scene lambert_scene() {
    Scene scene = small_scene();
    peers::simplify_for_peers(scene, true);
    scene.background = {0.2f, 0.1f, 0.4f};
    scene.materials[0].diffuse = Vec3(0.9f);
    scene.defaults.bounces = 1;
    // A wall beside it makes bounces count.
    Mesh& mesh = scene.meshes[0];
    mesh.positions.insert(mesh.positions.end(), {{-1, 2, 1}, {-1, 2, -1}});
    mesh.triangles.insert(mesh.triangles.end(), {{0, 3, 5}, {0, 5, 4}});
    mesh.material_of.assign(4, 0);
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 1}, {1, 1}};
    const std::vector<uint8_t> texels = {255, 0, 0,   255, 0,   255, 0,   255,
                                         0,   0, 255, 255, 255, 255, 255, 255};
    scene.textures = {{.name = "t", .image = {2, 2, TextureFormat::linear8, texels}}};
    scene.materials[0].diffuse_texture = 0;
    return scene;
}

/// Mean of a quarter of the image.
double mean_of_quarter(const Image& image, int right, int below, int channel) {
    const int w = image.width / 2, h = image.height / 2;
    double sum = 0;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            sum += double(image.at(right * w + x, below * h + y, channel)) / (w * h);
    return sum;
}

/// Its picture of the Lambert scene is ours: right way up, in the same colours, of the same light.
void check_peer_renders_as_we_do(const char* script, const char* method) {
    const Scene scene = lambert_scene();
    const TemporaryFolder folder;
    peers::export_scene(scene, folder.path());
    peers::Peer peer("python3", script, method, folder.path());
    const auto theirs = peer.render(1024, 1, 4);
    CHECK(theirs.samples == 1024 * 16 * 12);
    CHECK(theirs.render_s > 0);
    CHECK(theirs.image.channel("variance.B") == 5);
    RenderOptions options;
    options.method = wedge::Method::mc;
    options.samples_per_pixel = 1024;
    const Image ours = render(scene, options).image;
    for (int quarter = 0; quarter < 4; ++quarter)
        for (int c = 0; c < 3; ++c) {
            CAPTURE(quarter);
            CAPTURE(c);
            CHECK(
                mean_of_quarter(theirs.image, quarter % 2, quarter / 2, c) ==
                doctest::Approx(mean_of_quarter(ours, quarter % 2, quarter / 2, c)).epsilon(0.02));
        }
    // Other samples and other seeds are other images.
    const Image few = peer.render(1, 1).image, more = peer.render(16, 1).image,
                other = peer.render(16, 2).image;
    CHECK(few.pixels != more.pixels);
    CHECK(other.pixels != more.pixels);
}

}  // namespace

TEST_CASE("every_scene_is_exported_whole") {
    const bool has_python = succeeds("python3 -c 'import xml.etree.ElementTree'");
    if (!has_python) MESSAGE("XML is not checked: there is no python3");
    const std::string to_xml =
        "python3 '" + (peers::peers_folder() / "mitsuba_xml.py").string() + "' ";
    std::size_t exported = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(WEDGE_SOURCE_DIR) / "scenes")) {
        if (entry.path().extension() != ".json") continue;
        CAPTURE(entry.path().string());
        Scene scene;
        try {
            scene = load_scene(entry.path(), with_models());
        } catch (const Error& error) {
            MESSAGE(entry.path().filename().string() << " is skipped: " << error.what());
            continue;
        }
        if (triangle_count(scene) > kMostTriangles) {
            MESSAGE(entry.path().filename().string() << " is skipped: it is large");
            continue;
        }
        peers::simplify_for_peers(scene);
        const TemporaryFolder folder;
        peers::export_scene(scene, folder.path());
        check_export(folder.path(), scene);
        ++exported;
        if (!has_python) continue;
        CHECK(succeeds(to_xml + folder.path().string()));
        CHECK(succeeds("python3 -c \"import xml.etree.ElementTree as t; t.parse('" +
                       (folder / "mitsuba.xml").string() + "')\""));
    }
    CHECK(exported >= 3);  // those without models
}

TEST_CASE("exported_gaussian_light_has_the_power_of_the_formula") {
    const Scene scene = small_scene();
    const RectLight& rect = scene.rect_lights[0];
    const TemporaryFolder folder;
    peers::bake_gaussian(rect, folder / "light.exr");
    const Image image = read_image(folder / "light.exr");
    double mean = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            mean += double(image.at(x, y, 0)) / (double(image.width) * image.height);
    // Integral of exp(-x^2 / (2 sigma^2)) over [-1/2, 1/2], in each direction.
    const double sigma = double(rect.sigma);
    const double along = sigma * std::sqrt(2 * M_PI) * std::erf(0.5 / (sigma * std::sqrt(2.0)));
    CHECK(mean == doctest::Approx(double(rect.radiance.x) * along * along).epsilon(1e-4));
}

TEST_CASE("exported_textures_are_linear_and_hold_their_constants") {
    Scene scene = small_scene();
    // sRGB 188 is 0.5029 linear (IEC 61966-2-1).
    scene.textures = {{.name = "t", .image = {1, 1, TextureFormat::srgb8, {188, 0, 255, 255}}}};
    scene.textures[0].scale = {2, 3};
    scene.materials[0].diffuse_texture = 0;
    const TemporaryFolder folder;
    peers::export_scene(scene, folder.path());
    const json object = json::parse(read_text(folder / "scene.json"));
    const json& exported = object["materials"][0]["kd_image"];
    CHECK(exported["scale"] == json::array({2, 3}));
    const Image image = read_image(folder / exported["file"].get<std::string>());
    CHECK(image.at(0, 0, 0) == doctest::Approx(0.4 * 0.50289).epsilon(1e-4));
    CHECK(image.at(0, 0, 1) == 0);
    CHECK(image.at(0, 0, 2) == doctest::Approx(0.4));
}

TEST_CASE("normal_maps_are_taken_away_by_name") {
    Scene scene = small_scene();
    scene.materials[0].bump_texture = 0;
    const auto taken = peers::simplify_for_peers(scene);
    REQUIRE(taken.size() == 1);
    CHECK(taken[0].find("floor") != std::string::npos);
    CHECK(scene.materials[0].bump_texture == -1);
    CHECK(peers::simplify_for_peers(scene).empty());
}

TEST_CASE("lobes_and_smooth_normals_are_taken_away_by_name_for_those_without") {
    Scene scene = small_scene();
    scene.meshes[0].normals.assign(4, Vec3(0, 1, 0));
    CHECK(peers::simplify_for_peers(scene).empty());
    CHECK(scene.materials[0].model == SpecularModel::blinn_phong);
    const auto taken = peers::simplify_for_peers(scene, true);
    REQUIRE(taken.size() == 2);
    CHECK(taken[0] == "floor: its specular lobe is left out on both sides");
    CHECK(taken[1] == "floor: its interpolated normals are left out on both sides");
    CHECK(scene.materials[0].model == SpecularModel::none);
    CHECK(scene.materials[0].diffuse == Vec3(0.4f));
    CHECK(scene.meshes[0].normals.empty());
}

TEST_CASE("exporters_for_cycles_and_luxcore_write_what_the_scene_says") {
    if (!succeeds("python3 -c 'import json, struct'")) {
        MESSAGE(
            "exporters_for_cycles_and_luxcore_write_what_the_scene_says is skipped: there is no "
            "python3");
        return;
    }
    const TemporaryFolder lambert, glossy;
    peers::export_scene(lambert_scene(), lambert.path());
    Scene scene = small_scene();
    scene.meshes[0].normals.assign(4, Vec3(0, 1, 0));
    peers::export_scene(scene, glossy.path());
    CHECK(succeeds("python3 '" WEDGE_SOURCE_DIR "/tests/bench/exporters_check.py' '" +
                   peers::peers_folder().string() + "' '" + lambert.path().string() + "' '" +
                   glossy.path().string() + "'"));
}

TEST_CASE("agreement_sees_a_bias_and_none_in_noise") {
    const double variance = 1e-2;
    Synthetic ours(64, 64, 1), same(64, 64, 2), other(64, 64, 3);
    const converge::Reference reference = ours.reference(variance);
    const converge::PeerReference agreeing{nullptr, "a", same.image(variance), 1};
    const converge::PeerReference biased{nullptr, "b", other.image(variance, 0.1), 1};
    const auto a = converge::agreement_of(reference, agreeing, {});
    const auto b = converge::agreement_of(reference, biased, {});
    CHECK(a.test.p > 1e-3);
    CHECK(a.test.mean_square_z == doctest::Approx(1).epsilon(0.3));
    CHECK(a.rmse == doctest::Approx(a.rmse_of_noise).epsilon(0.05));
    CHECK(b.test.p < 1e-6);
    CHECK(b.ratio_of_means[0] < 0.95);
}

TEST_CASE("a_peer_that_fails_says_why") {
    const TemporaryFolder folder;
    peers::export_scene(small_scene(), folder.path());
    std::string message;
    try {
        peers::Peer("/no/such/python", "mitsuba_peer.py", "mitsuba", folder.path());
    } catch (const Error& error) {
        message = error.what();
    }
    CHECK(message.find("/no/such/python") != std::string::npos);
}

TEST_CASE("mitsuba_renders_an_exported_scene") {
    if (!succeeds("python3 -c 'import mitsuba, numpy; mitsuba.set_variant(\"llvm_ad_rgb\")'")) {
        MESSAGE("mitsuba_renders_an_exported_scene is skipped: python3 has no mitsuba");
        return;
    }
    const TemporaryFolder folder;
    peers::export_scene(small_scene(), folder.path());
    peers::Peer peer("python3", "mitsuba_peer.py", "mitsuba", folder.path());
    CHECK(peer.version().starts_with("Mitsuba 3"));
    const auto rendered = peer.render(16, 1, 4);
    CHECK(rendered.samples == 16 * 16 * 12);
    CHECK(rendered.render_s > 0);
    CHECK(rendered.image.width == 16);
    CHECK(rendered.image.channel("variance.B") == 5);
    // The floor under the light, and the sky, which is black.
    CHECK(rendered.image.at(8, 7, 0) > 0.05f);
    CHECK(rendered.image.at(8, 0, 0) == 0);
}

TEST_CASE("cycles_renders_an_exported_scene_as_we_do") {
    if (!succeeds("python3 -c 'import bpy, numpy'")) {
        MESSAGE("cycles_renders_an_exported_scene_as_we_do is skipped: python3 has no bpy");
        return;
    }
    check_peer_renders_as_we_do("cycles_peer.py", "cycles");
}

TEST_CASE("luxcore_renders_an_exported_scene_as_we_do") {
    if (!succeeds("python3 -c 'import pyluxcore, numpy'")) {
        MESSAGE("luxcore_renders_an_exported_scene_as_we_do is skipped: python3 has no pyluxcore");
        return;
    }
    check_peer_renders_as_we_do("luxcore_peer.py", "luxcore");
}
