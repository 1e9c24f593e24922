// What is to be measured: scenes, methods, budgets.
#pragma once

#include <atomic>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/converge/methods.hpp"
#include "wedge/scene.hpp"

namespace wedge::converge {

enum class BudgetUnit { spp, mu, seconds };
const char* name_of(BudgetUnit unit);  ///< "spp", "mu", "s"

struct Budget {
    BudgetUnit unit = BudgetUnit::spp;
    double value = 0;
    bool operator==(const Budget&) const = default;
};

/// Ladders, each rising. Seconds, if given, are for all methods; else each takes that of its knob.
struct Budgets {
    std::vector<double> spp{4, 8, 16, 32, 64};
    std::vector<double> mu{0.25, 0.5, 1, 2};
    std::vector<double> seconds;
};

/// Settings that hold for all scenes alike; there are none for a single scene.
struct Config {
    std::vector<std::string> scenes;  ///< files
    std::vector<std::string> methods{"mc-sobol", "mc-hash", "aaf"};
    Budgets budgets;
    int seeds = 3;
    /// "WxH"; "full": the scene's own; "N": the scene's, made smaller so that no side is above N.
    std::string size = "192";
    std::optional<int> bounces;  ///< else the scene's
    int reference_spp = 0;       ///< 0: kReferenceFactor times the largest spp of the ladder
    Sampler reference_sampler = Sampler::lattice;  ///< no method's
    /// A reference is given more samples until it is kReferenceMargin times better than the best
    /// run, while it has taken less than this and is below `reference_limit`; 0: never.
    double reference_time_s = 0;
    int reference_limit = 65536;   ///< samples per pixel
    std::filesystem::path folder;  ///< of everything that is written; empty: named after the scene
    std::filesystem::path references;  ///< empty: `folder`/references
    std::string device, kernel_dir;
    bool estimate_errors = false;  ///< by the renders themselves, to compare with the true ones
    /// Time is processor time over the device's compute units: for machines that others use too.
    /// For CPUs only.
    bool cpu_clock = false;
    std::string python = "python3";  ///< that runs other renderers
    bool any_build = false;          ///< take finished runs of other builds of the program too
    std::string title, command;      ///< for the report
    const std::atomic<bool>* stop = nullptr;
};

/// Samples that a reference starts with, for each of the longest run.
inline constexpr int kReferenceFactor = 16;

/// `reference_time_s` of the command line.
inline constexpr double kReferenceTime_s = 60;

/// Reads "spp=2,4,8", "mu=0.5,1" or "s=1,2,4" into `budgets`. Throws Error(usage).
void parse_budgets(const std::string& text, Budgets& budgets);

/// Fills `config` from a JSON file (docs/bench.md), with the values under "short" on top if asked
/// for. Scene paths are relative to the file. Throws Error(bad_input) with the key.
void read_config(const std::filesystem::path& file, bool short_form, Config& config);

/// The same from an object that is read already. Throws Error(bad_input),
/// nlohmann::json::exception.
void apply_config(const nlohmann::json& object, const std::filesystem::path& folder,
                  bool short_form, Config& config);

/// Rungs of the ladder that `method` climbs.
std::vector<Budget> ladder(const Config& config, const Method& method);

/// Film by `Config::size`. Throws Error(usage).
Film film_for(const std::string& size, const Film& own);

/// Fills what was left out and checks the rest. Throws Error(usage).
void complete(Config& config);

}  // namespace wedge::converge
