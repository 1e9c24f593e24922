// Verdicts for people and for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/stability/verdict.hpp"

namespace wedge::stability {

/// Worst of all budgets, a line a scene, for a terminal.
std::string verdicts_text(const std::vector<Row>& rows);

/// How it was measured, totals, and a table a method: for documentation.
std::string verdicts_markdown(const converge::Config& config, const Suite& suite,
                              const std::vector<Row>& rows);

/// A section of the report: heat tables, and predicted against true errors.
std::string verdicts_html(const Suite& suite, const std::vector<Row>& rows);

nlohmann::json verdicts_json(const Suite& suite, const std::vector<Row>& rows);

/// Of a method over all scenes and budgets.
struct Totals {
    std::size_t cells = 0, rmse_holds = 0, blocks_hold = 0, rules_hold = 0;
    std::size_t rmse_is_worse = 0, harmless = 0;  ///< beyond luck
    double worst_ratio = 0, median_ratio = 0;
    std::string worst_scene;
    std::optional<double> predicted_median;           ///< of predicted over true RMSE
    std::size_t predicted = 0, predicted_within = 0;  ///< those within 30 %
};
Totals totals_of(const std::vector<Row>& rows, const Column& (*column)(const Row&, std::size_t),
                 std::size_t index);
const Column& method_column(const Row& row, std::size_t index);     ///< of `Row::columns`
const Column& yardstick_column(const Row& row, std::size_t index);  ///< ignores `index`

}  // namespace wedge::stability
