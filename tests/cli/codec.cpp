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

TEST_CASE("first_samples_come_before_the_image_module_and_a_bad_one_is_told_at_once") {
    const Workbench bench;
    write_room(bench);
    ProcessSettings settings;
    settings.environment = {{"LD_LIBRARY_PATH", WEDGE_FOREIGN_CODEC_DIR}};
    settings.timeout_s = 60;
    const ProcessResult result = bench.wedge({"render", "room.json", "--spp", "10000000", "-o",
                                              "a.exr", "--resume", "a.state", "--checkpoint", "0"},
                                             settings);
    CHECK(result.exit_code == 2);
    CHECK(result.err_has("libwedge_codec.so is of another version of Wedge"));
    CHECK(bench.has("a.state"));
}

TEST_CASE("missing_image_module_is_told_before_the_render") {
    const Workbench bench;
    write_room(bench);
    fs::copy_file(WEDGE_PROGRAM, bench.folder() / "wedge");
    const std::string alone = (bench.folder() / "wedge").string();
    const ProcessSettings settings{.folder = bench.folder()};

    const ProcessResult render =
        run_process({alone, "render", "room.json", "--spp", "100000", "-o", "out.png"}, settings);
    CHECK(render.exit_code == 2);
    CHECK(render.err_has("no image file can be read or written: libwedge_codec.so: "));
    CHECK(render.err_has("install Wedge anew"));
    CHECK(!bench.has("out.png"));
    CHECK(run_process({alone, "explain", "room.json"}, settings).exit_code == 0);
    CHECK(run_process({alone, "render", "room.json", "--pixel", "3,3"}, settings).exit_code == 0);
}

}  // namespace wedge::test
