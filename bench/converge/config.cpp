#include "bench/converge/config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "wedge/error.hpp"

namespace wedge::converge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ErrorKind::usage, message);
}

std::vector<double> sorted_ladder(std::vector<double> values, const std::string& what) {
    if (values.empty()) refuse(what + ": at least one budget is needed");
    for (double value : values)
        if (!(value > 0) || !std::isfinite(value))
            refuse(fmt::format("{}: budgets must be positive, got {}", what, value));
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

std::optional<int> parse_side(const std::string& text) {
    if (text.empty() || text.size() > 5 || text.find_first_not_of("0123456789") != text.npos)
        return {};
    const int side = std::stoi(text);
    if (side < 1 || side > kLargestSide_px) return {};
    return side;
}

void apply(const json& object, const fs::path& base, Config& config) {
    for (const auto& [key, value] : object.items()) {
        if (key == "scenes") {
            config.scenes.clear();
            for (const json& scene : value)
                config.scenes.push_back((base / scene.get<std::string>()).lexically_normal());
        } else if (key == "methods") {
            config.methods = value.get<std::vector<std::string>>();
        } else if (key == "budgets") {
            for (const auto& [unit, list] : value.items()) {
                if (unit == "spp")
                    config.budgets.spp = list.get<std::vector<double>>();
                else if (unit == "mu")
                    config.budgets.mu = list.get<std::vector<double>>();
                else if (unit == "s")
                    config.budgets.seconds = list.get<std::vector<double>>();
                else
                    throw Error(ErrorKind::bad_input,
                                "/budgets/" + unit + ": unknown unit; known: spp, mu, s");
            }
        } else if (key == "seeds") {
            config.seeds = value.get<int>();
        } else if (key == "size") {
            config.size = value.get<std::string>();
        } else if (key == "bounces") {
            config.bounces = value.get<int>();
        } else if (key == "reference_spp") {
            config.reference_spp = value.get<int>();
        } else if (key == "reference_sampler") {
            config.reference_sampler = parse_sampler(value.get<std::string>(), key);
        } else if (key == "reference_time") {
            config.reference_time_s = value.get<double>();
        } else if (key == "reference_limit") {
            config.reference_limit = value.get<int>();
        } else if (key == "title") {
            config.title = value.get<std::string>();
        } else if (key != "short" && key != "comment") {
            throw Error(
                ErrorKind::bad_input,
                "/" + key +
                    ": unknown key; known: scenes, methods, budgets, seeds, size, bounces, "
                    "reference_spp, reference_sampler, reference_time, reference_limit, title, "
                    "short, comment");
        }
    }
}

}  // namespace

const char* name_of(BudgetUnit unit) {
    return unit == BudgetUnit::spp ? "spp" : unit == BudgetUnit::mu ? "mu" : "s";
}

void parse_budgets(const std::string& text, Budgets& budgets) {
    const std::size_t equals = text.find('=');
    const std::string unit = text.substr(0, equals);
    std::vector<double>* ladder = unit == "spp"  ? &budgets.spp
                                  : unit == "mu" ? &budgets.mu
                                  : unit == "s"  ? &budgets.seconds
                                                 : nullptr;
    if (equals == text.npos || !ladder)
        refuse("--budgets " + text + ": must be spp=, mu= or s= and numbers, as in spp=4,16,64");
    ladder->clear();
    std::istringstream list(text.substr(equals + 1));
    for (std::string word; std::getline(list, word, ',');) {
        std::size_t used = 0;
        double value = 0;
        try {
            value = std::stod(word, &used);
        } catch (const std::exception&) {
            used = 0;
        }
        if (used == 0 || used != word.size())
            refuse(fmt::format("--budgets {}: '{}' is not a number", text, word));
        ladder->push_back(value);
    }
}

void apply_config(const json& object, const fs::path& folder, bool short_form, Config& config) {
    apply(object, folder, config);
    if (!short_form) return;
    if (!object.contains("short"))
        throw Error(ErrorKind::bad_input, "/short: is missing, but --short asks for it");
    apply(object["short"], folder, config);
}

void read_config(const fs::path& file, bool short_form, Config& config) {
    std::ifstream in(file);
    if (!in) throw Error(ErrorKind::bad_input, file.string() + ": cannot be read");
    try {
        const json object = json::parse(in, nullptr, true, true);
        apply_config(object, file.parent_path(), short_form, config);
    } catch (const json::exception& error) {
        throw Error(ErrorKind::bad_input, fmt::format("{}: {}", file.string(), error.what()));
    } catch (const Error& error) {
        throw Error(error.kind(), fmt::format("{}: {}", file.string(), error.what()));
    }
}

std::vector<Budget> ladder(const Config& config, const Method& method) {
    const bool timed = !config.budgets.seconds.empty();
    const BudgetUnit unit = timed                      ? BudgetUnit::seconds
                            : method.knob == Knob::spp ? BudgetUnit::spp
                                                       : BudgetUnit::mu;
    const std::vector<double>& values = timed                      ? config.budgets.seconds
                                        : method.knob == Knob::spp ? config.budgets.spp
                                                                   : config.budgets.mu;
    std::vector<Budget> rungs;
    for (double value : values) rungs.push_back({unit, value});
    return rungs;
}

Film film_for(const std::string& size, const Film& own) {
    if (size == "full") return own;
    if (const std::size_t x = size.find('x'); x != size.npos) {
        const auto width = parse_side(size.substr(0, x)), height = parse_side(size.substr(x + 1));
        if (width && height) return {*width, *height};
    } else if (const auto side = parse_side(size)) {
        const int larger = std::max(own.width, own.height);
        if (larger <= *side) return own;
        const double scale = double(*side) / larger;
        return {std::max(1, int(std::lround(own.width * scale))),
                std::max(1, int(std::lround(own.height * scale)))};
    }
    refuse("--size " + size + ": must be WIDTHxHEIGHT, the larger side, or full; in px");
}

void complete(Config& config) {
    if (config.scenes.empty()) refuse("no scene: name scene files, or a --config that does");
    if (config.methods.empty()) refuse("--methods: at least one is needed");
    bool any_own = false;
    for (const std::string& name : config.methods)
        any_own = !find_method(name).external_source || any_own;
    if (!any_own) refuse("--methods: at least one that this program runs is needed");
    config.budgets.spp = sorted_ladder(config.budgets.spp, "--budgets spp");
    config.budgets.mu = sorted_ladder(config.budgets.mu, "--budgets mu");
    if (!config.budgets.seconds.empty())
        config.budgets.seconds = sorted_ladder(config.budgets.seconds, "--budgets s");
    if (config.seeds < 1 || config.seeds > 1000)
        refuse(fmt::format("--seeds: must be 1 to 1000, got {}", config.seeds));
    if (config.reference_spp < 0)
        refuse(fmt::format("--reference-spp: must be positive, got {}", config.reference_spp));
    if (config.reference_spp == 0)
        config.reference_spp = int(std::ceil(kReferenceFactor * config.budgets.spp.back()));
    if (!(config.reference_time_s >= 0))
        refuse(fmt::format("--reference-time: must be 0 or more seconds, got {}",
                           config.reference_time_s));
    if (config.reference_limit < 1)
        refuse(fmt::format("--reference-limit: must be positive, got {}", config.reference_limit));
    film_for(config.size, {});
    if (config.folder.empty())
        config.folder = config.scenes.size() == 1
                            ? "converge-" + fs::path(config.scenes[0]).stem().string()
                            : std::string("converge");
    if (config.references.empty()) config.references = config.folder / "references";
    if (config.title.empty()) config.title = "Error against time";
}

}  // namespace wedge::converge
