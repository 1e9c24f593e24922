// Files that cannot be rendered as they are: each gives one message that names the file and the
// place, exit code 3, and leaves nothing behind.
#include <doctest/doctest.h>

#include "tests/cli/workbench.hpp"

namespace wedge::test {
namespace {

constexpr int kBadInput = 3;

// Renders `scene` and expects it to be refused with a message that has all of `parts`.
void check_refused(const Workbench& bench, const std::string& scene,
                   const std::vector<std::string>& parts) {
    const auto files_before = bench.files();
    const ProcessResult result = bench.wedge({"render", scene, "-o", "out.exr", "-o", "out.png"});
    CAPTURE(result.err);
    CHECK(result.exit_code == kBadInput);
    CHECK(result.out.empty());
    CHECK(result.err_has("wedge: "));
    for (const std::string& part : parts) {
        CAPTURE(part);
        CHECK(result.err_has(part));
    }
    CHECK(bench.files() == files_before);
}

void check_scene_refused(const std::string& pattern, const std::string& replacement,
                         const std::vector<std::string>& parts) {
    const Workbench bench;
    write_room(bench);
    bench.write("bad.json", room_scene(pattern, replacement));
    std::vector<std::string> all = parts;
    all.push_back("bad.json");
    check_refused(bench, "bad.json", all);
}

// Renders room.json with a kd_texture; the image must be there in spite of it.
void check_texture_warning(const std::string& texture) {
    const Workbench bench;
    write_room(bench);
    bench.write("broken.png", "this is not an image");
    bench.write("room.json",
                room_scene(R"("kd": [0.5, 0.5, 0.5])",
                           R"("kd": [0.5, 0.5, 0.5], "kd_texture": ")" + texture + "\""));
    const ProcessResult result = bench.wedge({"render", "room.json", "-o", "out.png"});
    CAPTURE(result.err);
    CHECK(result.exit_code == 0);
    CHECK(result.err_has("wedge: warning: "));
    CHECK(result.err_has(texture));
    CHECK(bench.has("out.png"));
}

}  // namespace

TEST_CASE("missing_scene_file_is_named") {
    const Workbench bench;
    check_refused(bench, "absent.json", {"absent.json"});
    check_refused(bench, "absent.obj", {"absent.obj"});
}

TEST_CASE("folder_as_scene_is_refused") {
    const Workbench bench;
    std::filesystem::create_directory(bench.folder() / "folder.json");
    check_refused(bench, "folder.json", {"folder.json"});
}

TEST_CASE("json_syntax_error_gives_line_and_column") {
    // In line 3 a comma too many, its last character.
    const Workbench bench;
    write_room(bench);
    bench.write("bad.json", room_scene(R"("height": 24},)", R"("height": 24},,)"));
    const std::string line = R"(  "film": {"width": 32, "height": 24},,)";
    check_refused(bench, "bad.json", {"bad.json:3:" + std::to_string(line.size())});
}

TEST_CASE("wrong_type_gives_json_pointer") {
    check_scene_refused(R"("width": 32)", R"("width": "wide")", {"/film/width"});
    check_scene_refused(R"("center": [0, 1.9, 0])", R"("center": [0, 1.9])", {"/lights/0/center"});
}

TEST_CASE("unknown_key_suggests_the_nearest") {
    check_scene_refused(R"("vertical_fov_deg")", R"("vertical_fov_dge")",
                        {"/camera", "vertical_fov_dge", "vertical_fov_deg"});
}

TEST_CASE("unknown_mesh_is_refused") {
    check_scene_refused(R"({"mesh": "room")", R"({"mesh": "rooom")", {"/instances/0", "rooom"});
}

TEST_CASE("zero_size_film_is_refused") {
    check_scene_refused(R"("width": 32)", R"("width": 0)", {"/film/width", "0"});
}

TEST_CASE("zero_area_light_is_refused") {
    check_scene_refused(R"("u": [1, 0, 0])", R"("u": [0, 0, 0])", {"/lights/0"});
}

TEST_CASE("obj_index_out_of_range_is_refused") {
    const Workbench bench;
    write_room(bench);
    bench.write("room.obj", bench.read("room.obj") + "f 1 2 99\n");
    check_refused(bench, "room.json", {"room.obj"});
    check_refused(bench, "room.obj", {"room.obj"});
}

TEST_CASE("mesh_without_faces_is_refused") {
    const Workbench bench;
    write_room(bench);
    bench.write("room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    check_refused(bench, "room.json", {"room.obj"});
}

TEST_CASE("missing_texture_renders_on_with_a_warning") {
    check_texture_warning("absent.png");
}

TEST_CASE("broken_texture_renders_on_with_a_warning") {
    check_texture_warning("broken.png");
}

// A default view brings its own lamp, so that there is something on the film.
TEST_CASE("model_without_area_is_warned_of") {
    const Workbench bench;
    bench.write("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    bench.write("corner.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\n");
    const auto warns = [&](const char* model) {
        const ProcessResult result =
            bench.wedge({"render", model, "--size", "8x8", "--spp", "4", "-o", "out.exr"});
        CHECK(result.exit_code == 0);
        return result.err_has("no triangle of the scene's meshes can be rendered");
    };
    CHECK(warns("line.obj"));
    CHECK(!warns("corner.obj"));
}

TEST_CASE("non_finite_vertices_render_on_and_are_counted") {
    const Workbench bench;
    write_room(bench);
    bench.write("room.obj", bench.read("room.obj") + "v nan 0 0\nf 1 2 9\n");
    const ProcessResult result =
        bench.wedge({"render", "room.json", "-o", "out.png", "--stats", "stats.json"});
    CAPTURE(result.err);
    CHECK(result.exit_code == 0);
    CHECK(bench.has("out.png"));
    const ProcessResult info = bench.wedge({"info", "room.json"});
    CHECK(info.out_has("1 non-finite"));
}

}  // namespace wedge::test
