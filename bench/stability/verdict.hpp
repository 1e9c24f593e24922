// Judges what was rendered of a recipe: every method at every budget beside plain Monte Carlo.
#pragma once

#include <optional>
#include <vector>

#include "bench/converge/analysis.hpp"
#include "bench/stability/harm.hpp"
#include "bench/stability/suite.hpp"

namespace wedge::stability {

/// One method at one budget in one scene. Equal time: the yardstick's median error over its median
/// time is interpolated, straight in log-log; beyond its budgets error times square root of time is
/// kept.
struct Verdict {
    const converge::Rung* rung = nullptr;
    double rmse_ratio = 0;       ///< to the yardstick at equal time
    bool rmse_holds = false;     ///< the ratio is within its limit
    bool rmse_is_worse = false;  ///< it is above its limit beyond luck
    Harm blocks;                 ///< limited is what is shown
    bool blocks_hold = false;
    double rule = 0;  ///< the recipe's own measure
    bool rule_holds = false;
    bool beyond = false;  ///< the time is outside of the yardstick's budgets
    bool limits_hold() const { return rmse_holds && blocks_hold; }
    bool does_harm() const { return rmse_is_worse || !blocks_hold; }  ///< beyond luck
    /// RMSE that the render itself estimated, over the true one; medians over seeds.
    std::optional<double> predicted_ratio;
};

/// One method in one scene.
struct Column {
    const converge::Curve* curve = nullptr;
    std::vector<Verdict> verdicts;  ///< one a budget

    double worst_ratio() const, worst_blocks() const, worst_rule() const;
    bool limits_hold() const, does_harm() const, rule_holds() const;
};

struct Row {
    const Recipe* recipe = nullptr;
    const converge::SceneAnalysis* scene = nullptr;
    std::vector<Column> columns;  ///< all methods but the yardstick
    Column yardstick;             ///< its own rules and predictions; ratios are 1
};

/// `recipe` must be that of the scene.
Row judge(const Recipe& recipe, const converge::SceneAnalysis& scene, const Limits& limits);

}  // namespace wedge::stability
