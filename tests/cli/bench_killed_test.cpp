// Benches that are killed: nothing half under a final name, and the same command ends the same way.
#include <doctest/doctest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/cli/workbench.hpp"
#include "wedge/image_io.hpp"

namespace wedge::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> bench_into(const std::string& folder) {
    return {"bench",     "converge",   "room.json",       "--methods", "mc-sobol,aaf",
            "--budgets", "spp=4,8",    "--budgets",       "mu=1",      "--seeds",
            "2",         "--size",     "24x18",           "--bounces", "1",
            "-o",        folder,       "--reference-spp", "64",        "--reference-time",
            "0",         "--markdown", folder + ".md"};
}

/// What a killed process was writing stays behind under a name that begins with a dot.
std::vector<fs::path> finished_images(const fs::path& folder) {
    std::vector<fs::path> images;
    if (!fs::exists(folder)) return images;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".exr" &&
            !entry.path().filename().string().starts_with('.'))
            images.push_back(entry.path());
    return images;
}

void check_all_is_whole(const Workbench& bench) {
    for (const fs::path& image : finished_images(bench.folder() / "out"))
        CHECK_NOTHROW(read_image(image));
    if (bench.has("out/results.json"))
        CHECK(nlohmann::json::accept(bench.read("out/results.json")));
    if (bench.has("out/report.html"))
        CHECK(bench.read("out/report.html").find("</html>") != std::string::npos);
}

}  // namespace

TEST_CASE("a_bench_killed_at_ten_moments_ends_with_the_same_images") {
    const Workbench bench;
    write_room(bench);
    const ProcessResult whole = bench.wedge(bench_into("whole"));
    CAPTURE(whole.err);
    REQUIRE(whole.exit_code == 0);

    std::mt19937 random(5);
    int kills = 0;
    for (int i = 0; i < 10; ++i) {
        const double moment_s = whole.wall_s * double(random() % 1000) / 1000;
        kills += bench.wedge(bench_into("out"), {.timeout_s = moment_s}).signal != 0;
        check_all_is_whole(bench);
        if (bench.has("out.md")) {  // it was done: once more from the start
            fs::remove_all(bench.folder() / "out");
            fs::remove(bench.folder() / "out.md");
        }
    }
    CHECK(kills > 3);
    const ProcessResult last = bench.wedge(bench_into("out"));
    CAPTURE(last.err);
    REQUIRE(last.exit_code == 0);
    check_all_is_whole(bench);

    std::size_t runs = 0;
    for (const fs::path& image : finished_images(bench.folder() / "whole" / "images")) {
        ++runs;
        const fs::path twin = bench.folder() / "out" / "images" / image.filename();
        REQUIRE(fs::exists(twin));
        CHECK(read_image(twin).pixels == read_image(image).pixels);
    }
    CHECK(runs == 2 * (2 + 1));  // seeds, by budgets of both methods
}

}  // namespace wedge::test
