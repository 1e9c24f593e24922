// Renders that are killed and gone on with: to the same bits, and never with half a file to show.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "tests/cli/workbench.hpp"
#include "wedge/image_io.hpp"

namespace wedge::test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kRender{"render", "room.json", "--spp",  "1500",
                                       "--tile", "200",       "--seed", "5"};

std::vector<std::string> render_with(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = kRender;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::vector<float> pixels_of(const Workbench& bench, const std::string& file) {
    return read_image(bench.folder() / file).pixels;
}

/// Files under their final names; what a killed process leaves of a file under work begins with a
/// dot.
void check_outputs_are_whole(const Workbench& bench) {
    for (const std::string file : {"out.exr", "out.png"})
        if (bench.has(file)) CHECK_NOTHROW(read_image(bench.folder() / file));
}

}  // namespace

TEST_CASE("a_render_killed_at_ten_moments_ends_in_the_same_bits") {
    const Workbench bench;
    write_room(bench);
    REQUIRE(bench.wedge(render_with({"-o", "whole.exr", "--method", "mc"})).exit_code == 0);

    const std::vector<std::string> resumed = render_with(
        {"-o", "out.exr", "-o", "out.png", "--resume", "room.state", "--checkpoint", "0"});
    std::mt19937 random(11);
    int kills = 0, went_on = 0;
    for (int i = 0; i < 10; ++i) {
        // Some time after its state was first saved by this process, or never if it is quicker.
        const fs::path state = bench.folder() / "room.state";
        std::error_code ignored;
        const fs::file_time_type before = fs::last_write_time(state, ignored);
        int patience = int(random() % 12);
        const ProcessResult result =
            bench.wedge(resumed, {.kill_when = [&] {
                            std::error_code none;
                            return fs::exists(state) &&
                                   fs::last_write_time(state, none) != before && patience-- <= 0;
                        }});
        check_outputs_are_whole(bench);
        kills += result.signal != 0;
        went_on += result.err_has("room.state: goes on after");
        if (result.signal == 0) break;
    }
    CHECK(kills > 0);
    const ProcessResult last = bench.wedge(resumed);
    went_on += last.err_has("room.state: goes on after");
    CAPTURE(last.err);
    CHECK(last.exit_code == 0);
    CHECK(went_on > 0);
    CHECK(pixels_of(bench, "out.exr") == pixels_of(bench, "whole.exr"));
    CHECK(!bench.has("room.state"));  // done: nothing to go on from
}

TEST_CASE("an_interrupted_render_can_be_gone_on_with") {
    const Workbench bench;
    write_room(bench);
    REQUIRE(bench.wedge(render_with({"-o", "whole.exr", "--method", "mc"})).exit_code == 0);
    const std::vector<std::string> resumed =
        render_with({"-o", "out.exr", "--resume", "room.state", "--checkpoint", "0"});
    ProcessSettings settings;
    settings.interrupt_when = [&](const std::string&) { return bench.has("room.state"); };
    const ProcessResult first = bench.wedge(resumed, settings);
    REQUIRE(first.exit_code == 130);
    CHECK(first.err_has("--resume room.state goes on from here"));
    CHECK(bench.has("room.state"));
    const ProcessResult second = bench.wedge(resumed);
    CHECK(second.exit_code == 0);
    CHECK(second.err_has("goes on after"));
    CHECK(pixels_of(bench, "out.exr") == pixels_of(bench, "whole.exr"));
}

TEST_CASE("states_that_are_damaged_or_of_other_renders_are_refused") {
    const Workbench bench;
    write_room(bench);
    ProcessSettings settings;
    settings.interrupt_when = [&](const std::string&) { return bench.has("room.state"); };
    const std::vector<std::string> state{"--resume", "room.state", "--checkpoint",
                                         "0",        "-o",         "out.exr"};
    REQUIRE(bench.wedge(render_with(state), settings).exit_code == 130);
    const std::string good = bench.read("room.state");

    std::vector<std::string> other = render_with(state);
    other[7] = "6";  // the seed
    const ProcessResult of_other = bench.wedge(other);
    CHECK(of_other.exit_code == 3);
    CHECK(
        of_other.err_has("room.state: is the state of another render; not the same: "
                         "seed, sampler or first sample; remove it"));
    CHECK(bench.wedge(render_with({"--resume", "room.state", "--crop", "0,0,8,8"}))
              .err_has("not the same: crop; remove it"));

    std::string bad = good;
    bad[bad.size() / 2] ^= 1;
    bench.write("room.state", bad);
    CHECK(bench.wedge(render_with(state)).err_has("room.state: is damaged"));
    bench.write("room.state", good.substr(0, good.size() / 2));
    CHECK(bench.wedge(render_with(state)).err_has("room.state: is damaged"));
    bench.write("room.state", "wedge state 1\n" + good.substr(14));
    CHECK(bench.wedge(render_with(state)).err_has("the state of a render by another version"));
    bench.write("room.state", "");
    CHECK(bench.wedge(render_with(state)).err_has("room.state: is no state of a render"));
    bench.write("room.state", good);
    CHECK(bench.wedge(render_with(state)).exit_code == 0);

    CHECK(bench.wedge(render_with({"--method", "aaf", "--resume", "a.state"})).exit_code == 2);
    CHECK(bench.wedge(render_with({"--resume", "no/such/a.state"})).exit_code == 5);
}

}  // namespace wedge::test
