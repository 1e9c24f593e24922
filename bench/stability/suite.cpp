#include "bench/stability/suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "wedge/error.hpp"

namespace wedge::stability {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr Measure kMeasures[] = {Measure::rmse,   Measure::rel_rmse, Measure::dssim,
                                 Measure::energy, Measure::constant, Measure::noise};

Measure measure_named(const std::string& name) {
    for (Measure measure : kMeasures)
        if (name == name_of(measure)) return measure;
    throw Error(
        ErrorKind::bad_input,
        "unknown measure \"" + name + "\"; known: rmse, rel_rmse, dssim, energy, constant, noise");
}

Region region_from(const json& list) {
    if (list.size() != 4)
        throw Error(ErrorKind::bad_input,
                    "a region is [x, y, width, height], as shares of the film");
    return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>(),
            list[3].get<double>()};
}

Rule rule_from(const json& object) {
    Rule rule;
    rule.measure = measure_named(object.at("measure").get<std::string>());
    object.at("at_most").get_to(rule.at_most);
    rule.value = object.value("value", 0.0);
    if (rule.measure == Measure::constant && !(rule.value > 0))
        throw Error(ErrorKind::bad_input, "the measure constant needs a positive value");
    for (const json& region : object.value("regions", json::array()))
        rule.regions.push_back(region_from(region));
    return rule;
}

Recipe recipe_from(const json& object, const fs::path& folder) {
    Recipe recipe;
    object.at("id").get_to(recipe.id);
    recipe.scene = (folder / object.at("scene").get<std::string>()).lexically_normal();
    object.at("why").get_to(recipe.why);
    recipe.rule = rule_from(object.at("rule"));
    return recipe;
}

std::vector<Absent> absent_from(const json& list) {
    std::vector<Absent> absent;
    for (const json& object : list)
        absent.push_back({object.at("id").get<std::string>(), object.at("name").get<std::string>(),
                          object.at("reason").get<std::string>()});
    return absent;
}

}  // namespace

const char* name_of(Measure measure) {
    switch (measure) {
        case Measure::rmse:
            return "rmse";
        case Measure::rel_rmse:
            return "rel_rmse";
        case Measure::dssim:
            return "dssim";
        case Measure::energy:
            return "energy";
        case Measure::constant:
            return "constant";
        case Measure::noise:
            return "noise";
    }
    return "unknown";
}

Suite read_suite(const fs::path& file, bool short_form, converge::Config& config) {
    std::ifstream in(file);
    if (!in)
        throw Error(ErrorKind::bad_input,
                    file.string() + ": cannot be read; --suite FILE says where the table is");
    Suite suite;
    std::string place = "/measure";
    try {
        const json object = json::parse(in, nullptr, true, true);
        converge::apply_config(object.at("measure"), file.parent_path(), short_form, config);
        place = "/recipes";
        for (const json& recipe : object.at("recipes")) {
            place = fmt::format("/recipes/{}", suite.recipes.size());
            suite.recipes.push_back(recipe_from(recipe, file.parent_path()));
        }
        place = "/waiting";
        suite.waiting = absent_from(object.value("waiting", json::array()));
        place = "/elsewhere";
        suite.elsewhere = absent_from(object.value("elsewhere", json::array()));
    } catch (const json::exception& error) {
        throw Error(ErrorKind::bad_input,
                    fmt::format("{}: {}: {}", file.string(), place, error.what()));
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}: {}", file.string(), place, error.what()));
    }
    return suite;
}

void keep_only(const std::vector<std::string>& names, Suite& suite) {
    if (names.empty()) return;
    const auto is = [](const Recipe& recipe, const std::string& name) {
        return recipe.id == name || recipe.scene_name() == name;
    };
    for (const std::string& name : names)
        if (std::none_of(suite.recipes.begin(), suite.recipes.end(),
                         [&](const Recipe& recipe) { return is(recipe, name); }))
            throw Error(ErrorKind::usage, name + ": no recipe of the suite has this id or scene");
    std::erase_if(suite.recipes, [&](const Recipe& recipe) {
        return std::none_of(names.begin(), names.end(),
                            [&](const std::string& name) { return is(recipe, name); });
    });
}

}  // namespace wedge::stability
