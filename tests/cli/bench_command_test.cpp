// What a report says of the command that made it.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/workbench.hpp"

namespace wedge::test {
namespace {

std::string told_command(const Workbench& bench, const std::vector<std::string>& arguments) {
    const ProcessResult result = bench.wedge(arguments);
    CAPTURE(result.err);
    REQUIRE(result.exit_code == 0);
    return nlohmann::json::parse(bench.read("out/results.json"))["command"];
}

}  // namespace

TEST_CASE("a_report_tells_the_command_that_repeats_it") {
    const Workbench bench;
    write_room(bench);
    bench.write("my room.json", room_scene());
    const std::vector<std::string> settings = {"--methods",
                                               "mc-sobol,mc-hash",
                                               "--budgets",
                                               "spp=4",
                                               "--budgets",
                                               "mu=1",
                                               "--seeds",
                                               "1",
                                               "--size",
                                               "12x9",
                                               "--reference-spp",
                                               "16",
                                               "--reference-time",
                                               "0",
                                               "--reference-limit",
                                               "16",
                                               "--any-build"};
    std::vector<std::string> typed = {"bench", "converge", "my room.json", "room.json"};
    typed.insert(typed.end(), settings.begin(), settings.end());
    for (const char* word : {"-o", "out", "--markdown", "out.md", "--title", "a b"})
        typed.push_back(word);
    const std::string told = told_command(bench, typed);
    // Options in the order of --help. Where results go is for whoever repeats it to say.
    std::string expected = "wedge bench converge 'my room.json' room.json";
    for (const std::string& word : settings) expected += " " + word;
    CHECK(told == expected);
}

}  // namespace wedge::test
