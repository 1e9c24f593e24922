#include "bench/converge/run_record.hpp"

#include <doctest/doctest.h>

#include <fstream>

#include "bench/converge/calibration.hpp"
#include "tests/bench/approx.hpp"
#include "tests/bench/temporary_folder.hpp"
#include "wedge/error.hpp"

using namespace wedge;
using namespace wedge::converge;
using test::TemporaryFolder;

TEST_CASE("a_line_cut_off_by_a_kill_is_dropped_and_the_next_stands_alone") {
    const TemporaryFolder folder;
    const auto file = folder / "runs.jsonl";
    CHECK(read_lines(file).empty());
    append_line(file, R"({"n": 1})");
    append_line(file, R"({"n": 2})");
    std::ofstream(file, std::ios::app) << R"({"n": 3, "cut)";
    CHECK(read_lines(file).size() == 2);
    append_line(file, R"({"n": 4})");
    const auto lines = read_lines(file);
    REQUIRE(lines.size() == 3);
    CHECK(lines[2]["n"] == 4);
}

TEST_CASE("records_survive_being_written_and_read") {
    RunRecord record;
    record.key = "k";
    record.scene = "room";
    record.method = "aaf";
    record.budget = {BudgetUnit::mu, 0.5};
    record.knob = 0.5;
    record.seed = 7;
    record.time_s = 1.25;
    record.passes = {{"probe", 0.5, 3}};
    record.rays = 1234567890123;
    record.settings = {{"sampler", "sobol"}};
    const RunRecord read = run_record_from(nlohmann::json::parse(to_json(record).dump()));
    CHECK(to_json(read) == to_json(record));
    CHECK(read.budget == record.budget);
    CHECK_THROWS_AS(run_record_from(nlohmann::json::object()), nlohmann::json::exception);
}

TEST_CASE("keys_differ_where_results_do") {
    DeviceInfo device;
    device.name = "a";
    const converge::Method& sobol = find_method("mc-sobol");
    const std::string key = run_key("scene", sobol, {BudgetUnit::spp, 4}, 0, device);
    CHECK(key == run_key("scene", sobol, {BudgetUnit::spp, 4}, 0, device));
    CHECK(key != run_key("other", sobol, {BudgetUnit::spp, 4}, 0, device));
    CHECK(key != run_key("scene", find_method("mc-hash"), {BudgetUnit::spp, 4}, 0, device));
    CHECK(key != run_key("scene", sobol, {BudgetUnit::spp, 8}, 0, device));
    CHECK(key != run_key("scene", sobol, {BudgetUnit::seconds, 4}, 0, device));
    CHECK(key != run_key("scene", sobol, {BudgetUnit::spp, 4}, 1, device));
    device.driver = "b";
    CHECK(key != run_key("scene", sobol, {BudgetUnit::spp, 4}, 0, device));
}

TEST_CASE("budgets_are_read_and_nonsense_is_refused") {
    Budgets budgets;
    parse_budgets("spp=1,2.5,30", budgets);
    CHECK(budgets.spp == std::vector<double>{1, 2.5, 30});
    parse_budgets("s=0.5", budgets);
    CHECK(budgets.seconds == std::vector<double>{0.5});
    for (const char* bad : {"spp", "spp=", "spp=a", "spp=1,2x", "days=1"}) {
        CAPTURE(bad);
        Config config;
        config.scenes = {"a.json"};
        CHECK_THROWS_AS((parse_budgets(bad, config.budgets), complete(config)), Error);
    }
}

TEST_CASE("film_keeps_its_shape_when_made_smaller") {
    const Film own{640, 480};
    CHECK(film_for("full", own).width == 640);
    CHECK(film_for("160", own).width == 160);
    CHECK(film_for("160", own).height == 120);
    CHECK(film_for("1000", own).width == 640);
    CHECK(film_for("32x64", own).height == 64);
    for (const char* bad : {"", "0", "x", "12x", "-3", "huge", "99999999999"}) {
        CAPTURE(bad);
        CHECK_THROWS_AS(film_for(bad, own), Error);
    }
}

TEST_CASE("configuration_files_say_which_key_is_wrong") {
    const TemporaryFolder folder;
    const auto file = folder / "config.json";
    std::ofstream(file) << R"({"scenes": ["a.json"], "budgets": {"spp": [8]},
                              "short": {"budgets": {"spp": [2]}, "seeds": 2}})";
    Config full, brief;
    read_config(file, false, full);
    read_config(file, true, brief);
    CHECK(full.scenes[0] == (folder / "a.json").string());
    CHECK(full.budgets.spp == std::vector<double>{8});
    CHECK(brief.budgets.spp == std::vector<double>{2});
    CHECK(brief.seeds == 2);
    std::ofstream(file) << R"({"scense": []})";
    CHECK_THROWS_WITH_AS(read_config(file, false, full), doctest::Contains("/scense"), Error);
    CHECK_THROWS_WITH_AS(read_config(file, true, full), doctest::Contains("scense"), Error);
}

TEST_CASE("calibration_finds_the_knob_that_takes_the_time") {
    // 0.1 s and 0.05 s a sample.
    const auto linear = calibrate(Knob::spp, [](double spp) { return 0.1 + 0.05 * spp; });
    CHECK(knob_for_seconds(linear, Knob::spp, 2.1) == test::close_to(40, 1e-6));
    CHECK(knob_for_seconds(linear, Knob::spp, 0.01) == 1);
    const auto power = calibrate(Knob::mu, [](double mu) { return 3 * std::pow(mu, 1.5); });
    CHECK(knob_for_seconds(power, Knob::mu, 24) == test::close_to(4, 1e-6));
    CHECK(knob_for_seconds(power, Knob::mu, 1e-9) == kLeastMu);
}
