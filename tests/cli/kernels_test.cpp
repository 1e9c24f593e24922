// Kernels from a source tree, and what is said if they do not build.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "tests/cli/workbench.hpp"

namespace wedge::test {
namespace {

namespace fs = std::filesystem;

/// A source tree with the kernels of this one.
void copy_kernels(const Workbench& bench) {
    const fs::path source = WEDGE_SOURCE_DIR;
    fs::create_directories(bench.folder() / "tree/include/wedge");
    fs::copy(source / "kernels", bench.folder() / "tree/kernels", fs::copy_options::recursive);
    fs::copy(source / "include/wedge/shared", bench.folder() / "tree/include/wedge/shared",
             fs::copy_options::recursive);
}

ProcessResult render_from_tree(const Workbench& bench) {
    return bench.wedge({"render", "room.json", "--kernel-dir", "tree", "-o", "out.exr"});
}

TEST_CASE("kernels_can_come_from_a_source_tree") {
    const Workbench bench;
    write_room(bench);
    copy_kernels(bench);
    CHECK(render_from_tree(bench).exit_code == 0);
}

TEST_CASE("a_kernel_that_does_not_build_gives_the_log_and_exit_code_4") {
    const Workbench bench;
    write_room(bench);
    copy_kernels(bench);
    std::ofstream(bench.folder() / "tree/kernels/path.cl", std::ios::app) << "\nno such thing;\n";
    const ProcessResult result = render_from_tree(bench);
    CAPTURE(result.err);
    CHECK(result.exit_code == 4);
    CHECK(result.err_has("kernels/path.cl"));
    CHECK(result.err_has("unknown type name"));
    CHECK(!bench.has("out.exr"));
}

TEST_CASE("structures_that_changed_since_the_program_was_built_are_noticed") {
    const Workbench bench;
    write_room(bench);
    copy_kernels(bench);
    const std::string name = "tree/include/wedge/shared/frame.h";
    std::string text = bench.read(name);
    const std::string member = "uint seed;";
    REQUIRE(text.find(member) != std::string::npos);
    bench.write(name, text.replace(text.find(member), member.size(), "uint stray, seed;"));
    for (const bool replay : {false, true}) {
        std::vector<std::string> arguments = {"render", "room.json", "--kernel-dir", "tree"};
        for (const char* word : {replay ? "--pixel" : "-o", replay ? "3,4" : "out.exr"})
            arguments.push_back(word);
        const ProcessResult result = bench.wedge(arguments);
        CAPTURE(result.err);
        CHECK(result.exit_code == 4);
        CHECK(result.err_has("layout of FrameParams"));
    }
}

}  // namespace
}  // namespace wedge::test
