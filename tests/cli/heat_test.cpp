// `wedge render --heat`: which layers, which files, and what is refused before anything is traced.
#include <doctest/doctest.h>

#include "tests/cli/workbench.hpp"
#include "wedge/image_io.hpp"

namespace wedge::test {
namespace {

ProcessResult render_heat(const Workbench& bench, const std::string& list,
                          std::vector<std::string> options = {}) {
    std::vector<std::string> arguments{"render", "room.json", "-o", "out.exr", "--heat", list};
    arguments.insert(arguments.end(), options.begin(), options.end());
    ProcessResult result = bench.wedge(arguments);
    CAPTURE(result.err);
    REQUIRE(!result.timed_out);
    return result;
}

}  // namespace

TEST_CASE("heat_all_writes_every_layer_of_a_filtered_render") {
    const Workbench bench;
    write_room(bench);
    const ProcessResult result =
        render_heat(bench, "all", {"--method", "aaf", "--aov", "none", "--crop", "3,2,17,13"});
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    std::set<std::string> expected{"room.obj", "room.json", "out.exr"};
    for (const char* layer : {"spp", "Z", "variance", "error", "unfiltered", "width.direct",
                              "near.direct", "far.direct", "guard.direct", "width.indirect",
                              "near.indirect", "far.indirect", "guard.indirect"}) {
        const std::string file = std::string("out.") + layer + ".png";
        CAPTURE(file);
        CHECK(result.out_has(file + "\n"));
        expected.insert(file);
    }
    CHECK(bench.files() == expected);
    // The film of 32 x 24 px is enlarged by whole factors and has a legend below; the picture
    // without the filter is a picture.
    const Image heat = read_image(bench.folder() / "out.width.direct.png");
    CHECK(heat.width >= 6 * 32);
    CHECK(heat.height > 6 * 24);
    CHECK(read_image(bench.folder() / "out.unfiltered.png").width == 32);
}

TEST_CASE("heat_layers_are_known_by_name_in_any_case_and_by_group") {
    const Workbench bench;
    write_room(bench);
    CHECK(render_heat(bench, "z,SPP,spp", {"--method", "mc"}).exit_code == 0);
    CHECK(bench.files() ==
          std::set<std::string>{"room.obj", "room.json", "out.exr", "out.Z.png", "out.spp.png"});
    CHECK(render_heat(bench, "Width", {"--method", "aaf"}).exit_code == 0);
    CHECK(bench.has("out.width.direct.png"));
    CHECK(bench.has("out.width.indirect.png"));
    CHECK_FALSE(bench.has("out.guard.direct.png"));
}

TEST_CASE("heat_layers_that_are_not_there_are_refused_before_rendering") {
    const Workbench bench;
    write_room(bench);
    const auto refused = [&](const ProcessResult& result, const std::string& text) {
        CAPTURE(result.err);
        CHECK(result.exit_code == 2);
        CHECK(result.err_has(text));
        CHECK_FALSE(bench.has("out.exr"));
    };
    refused(render_heat(bench, "hue"), "--heat hue: no such layer; known: all, spp, Z,");
    const ProcessResult mc = render_heat(bench, "spp,width.direct", {"--method", "mc"});
    refused(mc, "--heat width.direct: --method mc has no such layer; use --method aaf");
    refused(mc, "this render has spp, Z, variance");
    // Without bounces and background no hemisphere is filtered.
    refused(render_heat(bench, "guard.indirect", {"--method", "aaf", "--bounces", "0"}),
            "this render has spp, Z, variance, width.direct,");
    refused(render_heat(bench, "spp", {"-o", "out.spp.png"}), "would replace the file of --output");
}

}  // namespace wedge::test
