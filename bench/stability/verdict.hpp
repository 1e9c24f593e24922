// Judges what was rendered of a recipe: every method at every budget beside plain Monte Carlo.
#pragma once

#include <optional>
#include <vector>

#include "bench/converge/analysis.hpp"
#include "bench/stability/suite.hpp"

namespace wedge::stability {

/// One method at one budget in one scene. Equal time: the yardstick's median error over its median
/// time is interpolated, straight in log-log; beyond its budgets error times square root of time is
/// kept.
struct Verdict {
    const converge::Rung* rung = nullptr;
    double rmse_ratio = 0;    ///< to the yardstick at equal time
    double blocks_worse = 0;  ///< share with more than 1.1 times its RMSE
    double rule = 0;          ///< the recipe's own measure
    bool rule_holds = false;
    bool limits_hold = false;
    bool beyond = false;  ///< the time is outside of the yardstick's budgets
    /// RMSE that the render itself estimated, over the true one; medians over seeds.
    std::optional<double> predicted_ratio;
};

/// One method in one scene.
struct Column {
    const converge::Curve* curve = nullptr;
    std::vector<Verdict> verdicts;  ///< one a budget

    double worst_ratio() const, worst_blocks() const, worst_rule() const;
    bool limits_hold() const, rule_holds() const;
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
