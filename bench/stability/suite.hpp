// The suite: places where filters are known to fail, what is measured there, and what is good
// enough. One table, bench/stability.json, says it all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/converge/config.hpp"

namespace wedge::stability {

/// What a recipe is judged by, beside the rules that hold for all of them. Smaller is better.
enum class Measure {
    rmse,      ///< over the yardstick's at equal time; in `regions` if there are any
    rel_rmse,  ///< square root of relMSE, over the yardstick's
    dssim,     ///< 1 - SSIM, over the yardstick's
    energy,    ///< |mean - mean of the reference| / the latter, over seeds; in `regions` if any
    constant,  ///< largest deviation of a block of 8 x 8 from `value`, over `value`
    noise,     ///< RMSE over the mean of the reference
};
const char* name_of(Measure measure);

/// Share of the film, from the top left.
struct Region {
    double x = 0, y = 0, width = 1, height = 1;
};

struct Rule {
    Measure measure = Measure::rmse;
    double at_most = 1.1;
    double value = 0;  ///< of `constant`
    std::vector<Region> regions;
};

struct Recipe {
    std::string id;     ///< "F01"; several recipes may share one
    std::string scene;  ///< file
    std::string why;    ///< what goes wrong there
    Rule rule;
    std::string scene_name() const { return std::filesystem::path(scene).stem().string(); }
};

/// A recipe that is not rendered, with what it waits for or where it is checked instead.
struct Absent {
    std::string id, name, reason;
};

/// What must hold for every recipe, the same for all methods and budgets.
struct Limits {
    double rmse_ratio = 1.02;  ///< to the yardstick at equal time
    /// Share of 16 x 16 blocks with more than 1.1 times its RMSE, beyond luck.
    double blocks_worse = 0.05;
};

struct Suite {
    std::vector<Recipe> recipes;
    std::vector<Absent> waiting, elsewhere;
    Limits limits;
};

/// Reads the table and fills `config` with how it is to be measured. Scene paths are relative to
/// the file. Throws Error(bad_input) with the place.
Suite read_suite(const std::filesystem::path& file, bool short_form, converge::Config& config);

/// Leaves the recipes whose id or scene is in `names`; all if there are none. Throws Error(usage)
/// for a name that is not there.
void keep_only(const std::vector<std::string>& names, Suite& suite);

}  // namespace wedge::stability
