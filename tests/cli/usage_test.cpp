// Calls that are wrong in themselves: exit code 2, and a message that says what was expected.
#include <doctest/doctest.h>

#include "tests/cli/workbench.hpp"

namespace wedge::test {
namespace {

constexpr int kUsage = 2;

struct WrongCall {
    std::vector<std::string> arguments;
    std::string message;  ///< part of what it must say
};

const std::vector<WrongCall> kWrongOptions{
    {{"--spp", "0"}, "--spp: must be at least 1, got 0"},
    {{"--spp", "-4"}, "--spp: must be at least 1, got -4"},
    {{"--spp", "many"}, "--spp"},
    {{"--spp", "99999999999"}, "--spp"},
    {{"--spp"}, "--spp"},
    {{"--bounces", "-1"}, "--bounces: must be at least 0"},
    {{"--seed", "-1"}, "--seed"},
    {{"--time", "0"}, "--time: must be a positive"},
    {{"--time", "nan"}, "--time: must be a positive"},
    {{"--exposure", "inf"}, "--exposure"},
    {{"--size", "64"}, "expected WIDTHxHEIGHT in pixels, got '64'"},
    {{"--size", "64x"}, "expected WIDTHxHEIGHT"},
    {{"--size", "64x48x3"}, "expected WIDTHxHEIGHT"},
    {{"--size", "0x48"}, "each side must be 1 to 65536 px"},
    {{"--size", "64x70000"}, "each side must be 1 to 65536 px"},
    {{"--crop", "1,2,3"}, "expected X,Y,WIDTH,HEIGHT"},
    {{"--crop", "-1,0,4,4"}, "--crop"},
    {{"--crop", "0,0,0,4"}, "--crop"},
    {{"--crop", "30,0,4,4"}, "reaches outside the film of 32x24 px"},
    {{"--crop", "2147483647,0,2147483647,1"}, "reaches outside the film"},
    {{"--resume", "--checkpoint", "--pixel", "32,0"}, "outside the film of 32x24 px"},
    {{"--pixel", "3"}, "expected X,Y"},
    {{"--sampler", "lottery"}, "known: sobol, stratified, lattice, hash"},
    {{"--tone", "sepia"}, "srgb"},
    {{"--aov", "N,nonsense"}, "nonsense: no such layer; known: "},
    {{"--sample-offset", "3"}, "must be a multiple of 4"},
    {{"-o", "image.tiff"}, "known: .exr, .png"},
    {{"-o", "image"}, "known: .exr, .png"},
    {{"--asset-path", "nowhere"}, "nowhere: not a folder"},
    {{"--no-such-option"}, "--no-such-option: no such option of wedge render"},
    {{"--exposre=1"}, "did you mean \"--exposure\"?"},
    {{"--seed", "18446744073709551616"}, "--seed: must be a whole number from 0 to"},
    {{"--seed", "1e3"}, "--seed: must be"},
    {{"second.json"}, "second.json"},
    {{"--size", "20000x20000"}, "20000x20000 are more than 268435456 pixels"},
    {{"-o", "a.exr", "-o", "./a.exr"}, "would replace the file of --output"},
    {{"-o", "a.exr", "--stats", "a.exr"}, "--stats a.exr: would replace the file of --output"},
    {{"-o", "a.exr", "--resume", "a.exr"}, "--resume a.exr: would replace the file of --output"},
    {{"--stats", "room.json"}, "--stats room.json: would replace the scene"},
    {{"--method", "mc", "--mu", "2"}, "--mu: has no meaning without filters"},
    {{"--method", "mc", "--filter", "none"}, "--filter: has no meaning without filters"},
    {{"--sample-offset", "4", "--uniform"}, "--uniform: has no meaning without filters"},
    {{"--method", "aaf", "--pixel", "3,4"}, "--pixel: replays path tracing alone"},
    {{"--method", "mc", "--aov", "N,width"}, "--aov width: --method mc has no such layer"},
    {{"--checkpoint", "3"}, "--checkpoint: says how often --resume saves"},
    {{"--target-metric", "rmse"}, "--target-metric: says what --target-error is"},
    {{"--integrator", "ao", "--bounces", "2"}, "--bounces: ambient occlusion has none"},
};

}  // namespace

TEST_CASE("wrong_render_options_are_refused_and_nothing_is_written") {
    const Workbench bench;
    write_room(bench);
    const auto files_before = bench.files();
    for (const WrongCall& call : kWrongOptions) {
        std::vector<std::string> arguments{"render", "room.json"};
        arguments.insert(arguments.end(), call.arguments.begin(), call.arguments.end());
        const ProcessResult result = bench.wedge(arguments);
        CAPTURE(call.message);
        CAPTURE(result.err);
        CHECK(result.exit_code == kUsage);
        CHECK(result.err_has("wedge: "));
        CHECK(result.err_has(call.message));
        CHECK(result.out.empty());
        CHECK(bench.files() == files_before);
    }
}

TEST_CASE("wrong_commands_are_refused") {
    const Workbench bench;
    CHECK(bench.wedge({}).exit_code == kUsage);
    CHECK(bench.wedge({"paint"}).exit_code == kUsage);
    CHECK(bench.wedge({"render"}).exit_code == kUsage);
    CHECK(bench.wedge({"info"}).exit_code == kUsage);
    CHECK(bench.wedge({"compare", "one.exr"}).exit_code == kUsage);
    CHECK(bench.wedge({"render"}).err_has("see wedge render --help"));
    CHECK(bench.wedge({"rendr", "a.json"})
              .err_has("rendr: no such command of wedge; did you mean \"render\"?"));
    CHECK(bench.wedge({"bench", "trac"}).err_has("did you mean \"trace\"?"));
}

TEST_CASE("every_command_has_help") {
    const Workbench bench;
    for (const std::string command : {"render", "devices", "info", "compare", "bench"}) {
        CAPTURE(command);
        const ProcessResult result = bench.wedge({command, "--help"});
        CHECK(result.exit_code == 0);
        CHECK(result.out_has("Usage: wedge " + command));
        CHECK(result.err.empty());
        CHECK(bench.wedge({"--help"}).out_has(command));
    }
}

TEST_CASE("every_option_of_the_manual_is_in_the_help") {
    const Workbench bench;
    const std::string help = bench.wedge({"render", "--help"}).out;
    for (const std::string option :
         {"--output",     "--spp",  "--bounces",       "--size",       "--seed",
          "--crop",       "--time", "--device",        "--sampler",    "--aov",
          "--exposure",   "--tone", "--stats",         "--asset-path", "--kernel-dir",
          "--local-size", "--tile", "--sample-offset", "--pixel",      "--quiet"}) {
        CAPTURE(option);
        CHECK(help.find(option + " ") != std::string::npos);
    }
}

}  // namespace wedge::test
