// What a render that goes well leaves behind.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/cli/workbench.hpp"
#include "wedge/image_io.hpp"

namespace wedge::test {
namespace {

nlohmann::json stats_of(const Workbench& bench) {
    return nlohmann::json::parse(bench.read("stats.json"));
}

// Renders room.json to out.exr and stats.json.
ProcessResult render_room(const Workbench& bench, std::vector<std::string> options = {},
                          ProcessSettings settings = {}) {
    std::vector<std::string> arguments{"render",  "room.json", "-o",
                                       "out.exr", "--stats",   "stats.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ProcessResult result = bench.wedge(arguments, std::move(settings));
    CAPTURE(result.err);
    REQUIRE(!result.timed_out);
    REQUIRE(bench.has("out.exr"));
    return result;
}

bool is_black(const Image& image, int x, int y) {
    const auto* first = &image.pixels[(std::size_t(y) * image.width + x) * image.channels.size()];
    return std::all_of(first, first + image.channels.size(), [](float v) { return v == 0; });
}

std::vector<std::string> sorted(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

TEST_CASE("default_outputs_are_exr_and_png_of_the_scenes_name") {
    const Workbench bench;
    write_room(bench);
    const ProcessResult result = bench.wedge({"render", "room.json"});
    CAPTURE(result.err);
    CHECK(result.exit_code == 0);
    CHECK(result.out == "room.exr\nroom.png\n");
    CHECK(bench.files() == std::set<std::string>{"room.obj", "room.json", "room.exr", "room.png"});
}

TEST_CASE("room_under_a_lamp_is_lit") {
    const Workbench bench;
    write_room(bench);
    render_room(bench);
    const Image image = read_image(bench.folder() / "out.exr");
    CHECK(image.width == 32);
    CHECK(image.height == 24);
    // The middle of the film sees the back wall; a rectangle of radiance 5 lights it.
    const float red = image.at(16, 12, image.channel("R"));
    CHECK(red > 0.05f);
    CHECK(red < 5);
}

TEST_CASE("model_renders_without_a_scene_file") {
    const Workbench bench;
    write_room(bench);
    const ProcessResult result =
        bench.wedge({"render", "room.obj", "--size", "32x24", "--spp", "1"});
    CAPTURE(result.err);
    CHECK(result.exit_code == 0);
    CHECK(result.err_has("camera"));
    CHECK(bench.has("room.png"));
}

TEST_CASE("filters_are_used_unless_something_else_is_asked_for") {
    const Workbench bench;
    write_room(bench);
    const auto method_of = [&](const std::vector<std::string>& more) {
        render_room(bench, more);
        return read_image(bench.folder() / "out.exr").metadata.at("wedge:method");
    };
    CHECK(method_of({}) == "aaf");
    CHECK(method_of({"--method", "mc"}) == "mc");
    CHECK(method_of({"--time", "0.01"}) == "aaf");
    CHECK(method_of({"--target-error", "0.1"}) == "aaf");
    CHECK(method_of({"--sample-offset", "8"}) == "mc");
    CHECK(method_of({"--resume", "room.state"}) == "mc");
}

TEST_CASE("crop_equals_the_full_render_inside_and_is_zero_outside") {
    const Workbench bench;
    write_room(bench);
    // Filters do not look over the edge of a crop, so this is for plain Monte Carlo.
    render_room(bench, {"--method", "mc"});
    const Image full = read_image(bench.folder() / "out.exr");
    render_room(bench, {"--method", "mc", "--crop", "5,7,11,9"});
    const Image crop = read_image(bench.folder() / "out.exr");

    REQUIRE(crop.width == full.width);
    REQUIRE(crop.height == full.height);
    REQUIRE(crop.channels == full.channels);
    std::size_t differing = 0, lit_outside = 0;
    for (int y = 0; y < full.height; ++y)
        for (int x = 0; x < full.width; ++x) {
            const bool inside = x >= 5 && x < 16 && y >= 7 && y < 16;
            if (!inside) lit_outside += is_black(crop, x, y) ? 0 : 1;
            for (std::size_t c = 0; inside && c < full.channels.size(); ++c)
                differing += full.at(x, y, int(c)) == crop.at(x, y, int(c)) ? 0 : 1;
        }
    CHECK(differing == 0);
    CHECK(lit_outside == 0);
}

TEST_CASE("aov_chooses_the_layers_of_the_exr") {
    const Workbench bench;
    write_room(bench);
    const auto layers = [&](const std::string& list) {
        render_room(bench, {"--aov", list});
        return sorted(read_image(bench.folder() / "out.exr").channels);
    };
    CHECK(layers("none") == sorted({"R", "G", "B", "A"}));
    CHECK(layers("n,Z") == sorted({"R", "G", "B", "A", "N.X", "N.Y", "N.Z", "Z"}));
    const auto all = layers("all");
    for (const char* name : {"direct.R", "indirect.G", "emission.B", "albedo.R", "N.X", "P.Z", "Z",
                             "variance.R", "spp"}) {
        CAPTURE(name);
        CHECK(std::count(all.begin(), all.end(), name) == 1);
    }
}

TEST_CASE("a_target_that_was_not_reached_is_told") {
    const Workbench bench;
    write_room(bench);
    const auto told = [&](const std::vector<std::string>& end) {
        std::vector<std::string> arguments = {"render", "room.json", "-o", "out.exr"};
        arguments.insert(arguments.end(), end.begin(), end.end());
        const ProcessResult result = bench.wedge(arguments);
        CHECK(result.exit_code == 0);
        return result.err_has("was not reached");
    };
    CHECK(told({"--target-error", "1e-12", "--mu", "0.5"}));
    CHECK(told({"--target-error", "1e-12", "--method", "mc", "--spp", "32"}));
    CHECK(told({"--target-error", "1e-12", "--target-metric", "rmse", "--mu", "0.5"}));
    CHECK_FALSE(told({"--target-error", "100", "--mu", "0.5"}));
    CHECK_FALSE(told({"--mu", "0.5"}));
}

TEST_CASE("time_limit_ends_the_render") {
    const Workbench bench;
    write_room(bench);
    render_room(bench);  // fills the program caches, so that compiling does not count below
    CHECK(render_room(bench, {"--method", "mc", "--time", "1"}, {.timeout_s = 60}).exit_code == 0);
    CHECK(stats_of(bench).at("render_s") >= 1.0);
    CHECK(stats_of(bench).at("render_s") < 3.0);
    // Filtering ends before that, but not by much.
    CHECK(render_room(bench, {"--time", "1"}, {.timeout_s = 60}).exit_code == 0);
    CHECK(stats_of(bench).at("render_s") >= 0.5);
    CHECK(stats_of(bench).at("render_s") < 3.0);
    CHECK(stats_of(bench).at("mu") > 1);
    // With both, whichever is first.
    CHECK(render_room(bench, {"--time", "100", "--spp", "8"}, {.timeout_s = 60}).exit_code == 0);
    CHECK(stats_of(bench).at("samples_per_pixel") == 8);
}

TEST_CASE("stats_hold_the_documented_keys") {
    const Workbench bench;
    write_room(bench);
    render_room(bench, {"--spp", "12"});
    const auto stats = stats_of(bench);
    for (const char* key : {"version",
                            "device",
                            "passes",
                            "rays",
                            "rays_per_s",
                            "samples",
                            "non_finite_samples",
                            "device_bytes",
                            "triangles",
                            "degenerate_triangles",
                            "non_finite_triangles",
                            "flatten_s",
                            "bvh_build_s",
                            "upload_s",
                            "compile_s",
                            "render_s",
                            "programs_compiled",
                            "programs_from_cache",
                            "interrupted",
                            "failure",
                            "scene",
                            "load_s",
                            "samples_per_pixel"}) {
        CAPTURE(key);
        CHECK(stats.contains(key));
    }
    CHECK(stats.at("samples") == 32 * 24 * 12);
    CHECK(stats.at("samples_per_pixel") == 12);
    CHECK(stats.at("rays") >= 32 * 24 * 12);  // at least the camera's
    CHECK(stats.at("interrupted") == false);
    CHECK(stats.at("scene") == "room.json");
}

TEST_CASE("warm_second_run_compiles_nothing") {
    const Workbench bench;
    write_room(bench);
    // PoCL has a cache of its own, so ours has to be forced there.
    const std::map<std::string, std::string> environment{
        {"WEDGE_CACHE", "force"}, {"WEDGE_CACHE_DIR", (bench.folder() / "cache").string()}};
    render_room(bench, {}, {.environment = environment});
    const auto cold = stats_of(bench);
    CHECK(cold.at("programs_compiled") > 0);
    const std::string image = bench.read("out.exr");
    render_room(bench, {}, {.environment = environment});
    const auto warm = stats_of(bench);
    CHECK(warm.at("programs_compiled") == 0);
    CHECK(warm.at("programs_from_cache") == cold.at("programs_compiled"));
}

/// What PoCL has compiled, and when; its notes on what is in use change with every run.
std::map<std::string, std::filesystem::file_time_type> compiled_below(
    const std::filesystem::path& folder) {
    std::map<std::string, std::filesystem::file_time_type> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::filesystem::path kind = entry.path().extension();
        if (kind == ".so" || kind == ".bc") files[entry.path()] = entry.last_write_time();
    }
    return files;
}

TEST_CASE("pocl_compiles_nothing_in_a_warm_second_run") {
    const Workbench bench;
    write_room(bench);
    const std::filesystem::path cache = bench.folder() / "pocl";
    std::filesystem::create_directory(cache);
    const std::map<std::string, std::string> environment{{"POCL_CACHE_DIR", cache.string()}};
    render_room(bench, {}, {.environment = environment});
    const auto cold = compiled_below(cache);
    if (cold.empty()) {
        MESSAGE("skipped: the device is not PoCL");
        return;
    }
    render_room(bench, {}, {.environment = environment});
    CHECK(compiled_below(cache) == cold);
}

TEST_CASE("a_scene_without_light_is_told") {
    const Workbench bench;
    write_room(bench);
    const std::string scene = bench.read("room.json");
    bench.write("room.json", scene.substr(0, scene.rfind("\"lights\"")) + "\"lights\": []}");
    CHECK(render_room(bench).err_has("no light"));
}

TEST_CASE("interrupt_saves_the_image_and_exits_130") {
    const Workbench bench;
    write_room(bench);
    ProcessSettings settings;
    settings.timeout_s = 120;
    settings.interrupt_when = [](const std::string& err) {
        return err.find(" %") != std::string::npos;
    };
    const ProcessResult result = render_room(bench, {"--spp", "10000000"}, settings);
    CAPTURE(result.err);
    CHECK(result.exit_code == 130);
    CHECK(result.err_has("stopped early, saved"));
    CHECK(result.err_has("samples per pixel"));
    CHECK(result.out == "out.exr\nstats.json\n");
    CHECK(stats_of(bench).at("interrupted") == true);
    CHECK(stats_of(bench).at("samples_per_pixel") < 10000000);
    const Image image = read_image(bench.folder() / "out.exr");
    CHECK(image.at(16, 12, image.channel("R")) > 0.05f);
}

TEST_CASE("quiet_says_nothing_on_stderr") {
    const Workbench bench;
    write_room(bench);
    const ProcessResult result = render_room(bench, {"--quiet"});
    CHECK(result.err.empty());
    CHECK(result.out == "out.exr\nstats.json\n");
}

TEST_CASE("replayed_pixel_writes_no_image") {
    const Workbench bench;
    write_room(bench);
    const auto files_before = bench.files();
    const ProcessResult result = bench.wedge({"render", "room.json", "--pixel", "16,12"});
    CAPTURE(result.err);
    CHECK(result.exit_code == 0);
    CHECK(!result.out.empty());
    CHECK(bench.files() == files_before);
}

TEST_CASE("assets_are_found_through_option_and_environment") {
    const Workbench bench;
    write_room(bench);
    const std::filesystem::path models = bench.folder() / "models";
    std::filesystem::create_directory(models);
    std::filesystem::rename(bench.folder() / "room.obj", models / "room.obj");
    CHECK(bench.wedge({"info", "room.json"}, {.environment = {{"WEDGE_ASSETS", ""}}}).exit_code ==
          3);
    CHECK(bench.wedge({"info", "room.json", "--asset-path", "models"}).exit_code == 0);
    CHECK(bench.wedge({"render", "room.json", "--asset-path", "models"}).exit_code == 0);
    const ProcessResult result = bench.wedge(
        {"info", "room.json"}, {.environment = {{"WEDGE_ASSETS", "/nowhere:" + models.string()}}});
    CHECK(result.exit_code == 0);
    CHECK(result.err_has("/nowhere"));
}

TEST_CASE("info_counts_the_room") {
    const Workbench bench;
    write_room(bench);
    const ProcessResult result = bench.wedge({"info", "room.json", "--json"});
    REQUIRE(result.exit_code == 0);
    const auto info = nlohmann::json::parse(result.out);
    CHECK(info.at("meshes") == 1);
    CHECK(info.at("placed_triangles") == 6);
    CHECK(info.at("instances") == 1);
    CHECK(info.at("rect_lights") == 1);
    CHECK(info.at("point_lights") == 0);
    CHECK(info.at("degenerate_triangles") == 0);
    CHECK(info.at("bounds").at("lower") == nlohmann::json{-1, 0, -1});
    CHECK(info.at("bounds").at("upper") == nlohmann::json{1, 2, 1});
    CHECK(bench.wedge({"info", "room.json"}).out_has("6 triangles"));
}

}  // namespace wedge::test
