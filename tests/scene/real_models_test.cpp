// Models that others made, where they are at hand.
#include <cmath>
#include <cstdio>

#include "tests/scene/support.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

struct Expected {
    const char* file;
    std::size_t triangles;  ///< as published with the model
    bool interior;
};

const Expected kModels[] = {
    {"cornell_box/CornellBox-Original.obj", 36, true},
    {"cornell_box/CornellBox-Water.obj", 7088, true},
    {"dabrovic_sponza/sponza.obj", 66450, true},
    {"sibenik/sibenik.obj", 75284, true},
    {"holodeck/holodeck.obj", 4015, true},
    {"stanford_bunny/bunny.obj", 144046, false},
    {"happy_buddha_100k/buddha.obj", 100000, false},
    {"sports_car/sportsCar.obj", 300603, false},
    {"teapot/teapot.obj", 15704, false},
};

void check_indices(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) {
        REQUIRE(mesh.material_of.size() == mesh.triangles.size());
        CHECK((mesh.normals.empty() || mesh.normals.size() == mesh.positions.size()));
        CHECK((mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size()));
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            wrong += mesh.material_of[i] >= scene.materials.size();
            for (int c = 0; c < 3; ++c) wrong += mesh.triangles[i][c] >= mesh.positions.size();
        }
        CHECK(wrong == 0);
    }
}

}  // namespace

TEST_CASE("real_models_have_their_triangles_and_are_seen_from_the_right_side") {
    for (const Expected& expected : kModels) {
        const auto file = shared_model(expected.file);
        if (!std::filesystem::exists(file)) {
            std::printf("skipped: %s is not at hand\n", expected.file);
            continue;
        }
        CAPTURE(expected.file);
        LogCapture log;
        const Scene scene = load_scene(file);
        CHECK(scene.meshes.at(0).triangles.size() == expected.triangles);
        check_indices(scene);
        const bool interior = log.infos.at(0).find("interior") != std::string::npos;
        CHECK(interior == expected.interior);
    }
}

TEST_CASE("textures_of_sponza_are_all_found") {
    const auto file = shared_model("dabrovic_sponza/sponza.obj");
    if (!std::filesystem::exists(file)) {
        std::printf("skipped: dabrovic_sponza/sponza.obj is not at hand\n");
        return;
    }
    LogCapture log;
    const Scene scene =
        load_scene(file, {{}, [](const std::filesystem::path&, bool) {
                              return TextureImage{1, 1, TextureFormat::srgb8, {1, 2, 3, 4}};
                          }});
    CHECK(log.count("texture") == 0);
    CHECK(scene.textures.size() == 12 + 11);  // distinct names after map_Kd and after bump
}
