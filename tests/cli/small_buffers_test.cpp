// Scenes near the size of the largest buffer that a device gives.
#include <doctest/doctest.h>

#include <string>

#include "tests/cli/workbench.hpp"
#include "wedge/image_io.hpp"

namespace wedge::test {
namespace {

constexpr int kCells = 100;  // 10 201 vertices of 32 bytes and 20 000 triangles of 20 bytes

/// A gently waved floor in place of the room.
void write_floor(const Workbench& bench) {
    std::string obj;
    for (int j = 0; j <= kCells; ++j)
        for (int i = 0; i <= kCells; ++i)
            obj += "v " + std::to_string(i * 0.02 - 1) + " " + std::to_string((i * j) % 7 * 0.01) +
                   " " + std::to_string(j * 0.02 - 1) + "\n";
    const auto vertex = [](int i, int j) { return " " + std::to_string(j * (kCells + 1) + i + 1); };
    for (int j = 0; j < kCells; ++j)
        for (int i = 0; i < kCells; ++i)
            obj += "f" + vertex(i, j) + vertex(i, j + 1) + vertex(i + 1, j + 1) + vertex(i + 1, j) +
                   "\n";
    write_room(bench);
    bench.write("room.obj", obj);
}

ProcessSettings largest_buffer(const std::string& bytes) {
    ProcessSettings settings;
    settings.environment = {{"LD_PRELOAD", WEDGE_OPENCL_FAULTS},
                            {"ASAN_OPTIONS", "verify_asan_link_order=0"},
                            {"WEDGE_TEST_LARGEST_BUFFER", bytes}};
    return settings;
}

}  // namespace

TEST_CASE("a_tree_beyond_the_largest_buffer_renders_the_same_bits") {
    const Workbench bench;
    write_floor(bench);
    REQUIRE(bench.wedge({"render", "room.json", "-o", "whole.exr"}).exit_code == 0);
    // The tree takes a megabyte; vertices and triangles just fit.
    const ProcessResult cut =
        bench.wedge({"render", "room.json", "-o", "cut.exr"}, largest_buffer("420000"));
    CAPTURE(cut.err);
    REQUIRE(cut.exit_code == 0);
    CHECK(read_image(bench.folder() / "cut.exr").pixels ==
          read_image(bench.folder() / "whole.exr").pixels);
}

TEST_CASE("triangles_beyond_the_largest_buffer_are_refused_with_both_sizes") {
    const Workbench bench;
    write_floor(bench);
    const ProcessResult result =
        bench.wedge({"render", "room.json", "-o", "a.exr"}, largest_buffer("360000"));
    CAPTURE(result.err);
    CHECK(result.exit_code == 4);
    CHECK(result.err_has("triangles"));
    CHECK(result.err_has(" needs a buffer of 0.4 MiB, the largest here is 0.3 MiB"));
    CHECK(!bench.has("a.exr"));
}

}  // namespace wedge::test
