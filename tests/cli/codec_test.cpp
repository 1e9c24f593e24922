// The module that reads and writes image files: loaded late, and told of where it is missing.
#include <doctest/doctest.h>

#include <filesystem>

#include "tests/cli/workbench.hpp"

namespace wedge::test {
namespace {

namespace fs = std::filesystem;

/// What the dynamic loader (of glibc) says it has loaded.
std::string loaded_files(const Workbench& bench) {
    for (const std::string& name : bench.files())
        if (name.starts_with("loaded.")) return bench.read(name);
    return "";
}

ProcessSettings watching_the_loader() {
    ProcessSettings settings;
    settings.environment = {{"LD_DEBUG", "files"}, {"LD_DEBUG_OUTPUT", "loaded"}};
    return settings;
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("image_library_is_loaded_for_images_only") {
    const Workbench without, with;
    write_room(without);
    write_room(with);
    REQUIRE(
        without.wedge({"render", "room.json", "--pixel", "3,3"}, watching_the_loader()).exit_code ==
        0);
    CHECK(has(loaded_files(without), "libOpenCL"));
    CHECK(!has(loaded_files(without), "libOpenImageIO"));
    REQUIRE(with.wedge({"render", "room.json", "-o", "a.png"}, watching_the_loader()).exit_code ==
            0);
    CHECK(has(loaded_files(with), "libOpenImageIO"));
}

TEST_CASE("missing_image_module_is_told_before_the_render") {
    const Workbench bench;
    write_room(bench);
    fs::copy_file(WEDGE_PROGRAM, bench.folder() / "wedge");
    const std::string alone = (bench.folder() / "wedge").string();
    const ProcessSettings settings{.folder = bench.folder()};

    const ProcessResult render =
        run_process({alone, "render", "room.json", "--spp", "10000000", "-o", "out.png"}, settings);
    CHECK(render.exit_code == 2);
    CHECK(render.err_has("no image file can be read or written: libwedge_codec-"));
    CHECK(render.err_has("install Wedge anew"));
    CHECK(!bench.has("out.png"));
    CHECK(run_process({alone, "explain", "room.json"}, settings).exit_code == 0);
    CHECK(run_process({alone, "render", "room.json", "--pixel", "3,3"}, settings).exit_code == 0);
}

TEST_CASE("image_module_of_another_version_is_refused_and_no_sample_lost") {
    const Workbench bench;
    write_room(bench);
    ProcessSettings settings;
    settings.environment = {{"LD_LIBRARY_PATH", WEDGE_FOREIGN_CODEC_DIR}};
    const std::vector<std::string> render{"render", "room.json", "-o",
                                          "a.exr",  "--resume",  "a.state"};
    const ProcessResult refused = bench.wedge(render, settings);
    CHECK(refused.exit_code == 2);
    CHECK(refused.err_has(" is of another version of Wedge (interface "));
    REQUIRE(bench.has("a.state"));  // the module was first asked for after the last sample
    const ProcessResult resumed = bench.wedge(render);
    CHECK(resumed.exit_code == 0);
    CHECK(resumed.err_has("a.state: goes on after"));
    CHECK(bench.has("a.exr"));
}

}  // namespace wedge::test
