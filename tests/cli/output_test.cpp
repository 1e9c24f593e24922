// Results that cannot be written: exit code 5, said before the render starts where that can be
// known, and never half a file under the final name.
#include <doctest/doctest.h>

#include "tests/cli/workbench.hpp"

namespace wedge::test {
namespace {

constexpr int kOutput = 5;
// Room for what PoCL writes when it compiles a kernel, but not for an EXR of a film this large.
constexpr std::size_t kSmallDisk_bytes = 4 << 20;
const std::string kLargeFilm = "1280x960";

}  // namespace

TEST_CASE("unwritable_outputs_are_refused_before_the_render") {
    const Workbench bench;
    write_room(bench);
    std::filesystem::create_directory(bench.folder() / "folder.png");
    const auto files_before = bench.files();
    // /proc takes no new files, not even from root.
    for (const std::string file :
         {"absent/out.png", "room.obj/out.png", "/proc/out.png", "folder.png"}) {
        CAPTURE(file);
        // So many samples that a render that starts would not end in time.
        ProcessSettings settings;
        settings.timeout_s = 30;
        const ProcessResult result =
            bench.wedge({"render", "room.json", "--spp", "10000000", "-o", file}, settings);
        CAPTURE(result.err);
        CHECK(!result.timed_out);
        CHECK(result.exit_code == kOutput);
        CHECK(result.err_has(file));
        CHECK(result.out.empty());
        CHECK(bench.files() == files_before);
    }
}

TEST_CASE("unwritable_stats_file_is_refused_before_the_render") {
    const Workbench bench;
    write_room(bench);
    const ProcessResult result =
        bench.wedge({"render", "room.json", "--spp", "10000000", "--stats", "absent/s.json"},
                    {.timeout_s = 30});
    CHECK(result.exit_code == kOutput);
    CHECK(result.err_has("absent/s.json"));
}

TEST_CASE("benches_that_cannot_write_say_so") {
    const Workbench bench;
    write_room(bench);
    for (const std::string folder : {"/proc/out", "room.json"}) {
        const ProcessResult result =
            bench.wedge({"bench", "converge", "room.json", "--size", "8", "-o", folder});
        CAPTURE(result.err);
        CHECK(result.exit_code == kOutput);
        CHECK(result.err_has(folder));
    }
    // Said before hours of measuring.
    const ProcessResult result =
        bench.wedge({"bench", "converge", "room.json", "--size", "8", "--markdown", "absent/t.md"});
    CHECK(result.exit_code == kOutput);
    CHECK(result.err_has("absent/t.md"));
    CHECK_FALSE(bench.has("converge-room"));
}

TEST_CASE("full_disk_is_told_and_leaves_no_file") {
    const Workbench bench;
    write_room(bench);
    // Fills the program caches, so that the second run writes nothing large but the image.
    REQUIRE(bench.wedge({"render", "room.json", "-o", "small.exr"}).exit_code == 0);
    const auto files_before = bench.files();

    ProcessSettings settings;
    settings.largest_file_bytes = kSmallDisk_bytes;
    const ProcessResult result = bench.wedge(
        {"render", "room.json", "--size", kLargeFilm, "--spp", "1", "-o", "out.exr"}, settings);
    CAPTURE(result.err);
    CHECK(result.exit_code == kOutput);
    CHECK(result.err_has("out.exr"));
    CHECK(result.out.empty());
    CHECK(bench.files() == files_before);
}

TEST_CASE("an_older_image_survives_a_full_disk") {
    const Workbench bench;
    write_room(bench);
    REQUIRE(bench.wedge({"render", "room.json", "-o", "out.exr"}).exit_code == 0);
    const std::string before = bench.read("out.exr");
    ProcessSettings settings;
    settings.largest_file_bytes = kSmallDisk_bytes;
    const ProcessResult result = bench.wedge(
        {"render", "room.json", "--size", kLargeFilm, "--spp", "1", "-o", "out.exr"}, settings);
    CHECK(result.exit_code == kOutput);
    CHECK(bench.read("out.exr") == before);
}

TEST_CASE("one_output_that_fails_does_not_take_the_others") {
    const Workbench bench;
    write_room(bench);
    REQUIRE(bench.wedge({"render", "room.json", "-o", "small.exr"}).exit_code == 0);
    ProcessSettings settings;
    settings.largest_file_bytes = kSmallDisk_bytes;
    const ProcessResult result = bench.wedge({"render", "room.json", "--size", kLargeFilm, "--spp",
                                              "1", "-o", "out.exr", "-o", "out.png"},
                                             settings);
    CHECK(result.exit_code == kOutput);
    CHECK(!bench.has("out.exr"));
    CHECK(bench.has("out.png"));
    CHECK(result.out == "out.png\n");
}

}  // namespace wedge::test
