#include "bench/stability/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/converge/html.hpp"
#include "wedge/render.hpp"

namespace wedge::stability {
namespace {

using converge::short_number;

std::string percent(double share) {
    return fmt::format("{:.0f} %", 100 * share);
}

std::string row_text(const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text + "\n";
}

/// "1.03 (4 %)": ratio and share of blocks; bold where there is harm beyond luck, a question mark
/// where the ratio is above its limit by luck or little more.
std::string cell_text(const Verdict& v) {
    const std::string text =
        fmt::format("{}{:.2f}{} ({})", v.beyond ? "~" : "", v.rmse_ratio,
                    !v.rmse_holds && !v.rmse_is_worse ? "?" : "", percent(v.blocks.shown));
    return v.does_harm() ? "**" + text + "**" : text;
}

std::string rule_text(const Rule& rule, const Column& column) {
    return fmt::format("{} {} ≤ {}{}", name_of(rule.measure), short_number(column.worst_rule()),
                       short_number(rule.at_most), column.rule_holds() ? "" : ": **missed**");
}

nlohmann::json of(const Verdict& v) {
    nlohmann::json object = {{"budget", v.rung->budget.value},
                             {"unit", converge::name_of(v.rung->budget.unit)},
                             {"time_s", v.rung->time_s.median},
                             {"samples_per_pixel", v.rung->samples_per_pixel.median},
                             {"rmse", v.rung->metrics[0].median},
                             {"rmse_ratio", v.rmse_ratio},
                             {"beyond_yardstick", v.beyond},
                             {"rmse_holds", v.rmse_holds},
                             {"rmse_is_worse", v.rmse_is_worse},
                             {"blocks_seen_worse", v.blocks.seen},
                             {"blocks_shown_worse", v.blocks.shown},
                             {"blocks_hold", v.blocks_hold},
                             {"rule", v.rule},
                             {"rule_holds", v.rule_holds}};
    if (v.predicted_ratio) object["predicted_over_true"] = *v.predicted_ratio;
    return object;
}

nlohmann::json of(const Column& column) {
    nlohmann::json budgets = nlohmann::json::array();
    for (const Verdict& v : column.verdicts) budgets.push_back(of(v));
    return {{"method", column.curve->method->name}, {"budgets", budgets}};
}

std::string totals_sentence(const Totals& t) {
    std::string text = fmt::format(
        "RMSE is within its limit in {} of {} cells and above it beyond luck in {}; blocks are "
        "within theirs in {}; no harm is shown in {}; the recipes' own rules hold in {}. RMSE at "
        "equal time: median {:.2f}, worst {:.2f} ({}).",
        t.rmse_holds, t.cells, t.rmse_is_worse, t.blocks_hold, t.harmless, t.rules_hold,
        t.median_ratio, t.worst_ratio, t.worst_scene);
    if (t.predicted_median)
        text += fmt::format(
            " The error it predicts is {:.2f} times the true one in the median; within 30 % in {} "
            "of {} cells.",
            *t.predicted_median, t.predicted_within, t.predicted);
    return text;
}

/// All methods, a line each.
std::string totals_table(const std::vector<Row>& rows) {
    const std::vector<std::string> head{"",           "cells",       "RMSE holds",
                                        "RMSE worse", "blocks hold", "no harm",
                                        "rules hold", "median RMSE", "worst RMSE"};
    std::string text = row_text(head) + row_text(std::vector<std::string>(head.size(), "---"));
    for (std::size_t i = 0; i < rows.front().columns.size(); ++i) {
        const Totals t = totals_of(rows, method_column, i);
        text += row_text({rows.front().columns[i].curve->method->name, std::to_string(t.cells),
                          std::to_string(t.rmse_holds), std::to_string(t.rmse_is_worse),
                          std::to_string(t.blocks_hold), std::to_string(t.harmless),
                          std::to_string(t.rules_hold), fmt::format("{:.2f}", t.median_ratio),
                          fmt::format("{:.2f}, {}", t.worst_ratio, t.worst_scene)});
    }
    return text;
}

/// How many scenes have no harm, by budget.
std::string harmless_row(const std::vector<Row>& rows, std::size_t index) {
    std::vector<std::string> cells{"", "**no harm**"};
    for (std::size_t b = 0; b < rows.front().columns[index].verdicts.size(); ++b) {
        std::size_t harmless = 0;
        for (const Row& row : rows) harmless += !row.columns[index].verdicts[b].does_harm();
        cells.push_back(fmt::format("{} of {}", harmless, rows.size()));
    }
    std::size_t rules = 0;
    for (const Row& row : rows) rules += row.columns[index].rule_holds();
    cells.push_back(fmt::format("{} of {}", rules, rows.size()));
    return row_text(cells);
}

std::string method_table(const std::vector<Row>& rows, std::size_t index) {
    const Column& first = rows.front().columns[index];
    std::vector<std::string> head{"", "scene"};
    for (const Verdict& v : first.verdicts) head.push_back(converge::text_of(v.rung->budget));
    head.push_back("its own rule");
    std::string text = row_text(head) + row_text(std::vector<std::string>(head.size(), "---"));
    for (const Row& row : rows) {
        std::vector<std::string> cells{row.recipe->id, row.recipe->scene_name()};
        for (const Verdict& v : row.columns[index].verdicts) cells.push_back(cell_text(v));
        cells.push_back(rule_text(row.recipe->rule, row.columns[index]));
        text += row_text(cells);
    }
    return text + harmless_row(rows, index) + "\n" +
           totals_sentence(totals_of(rows, method_column, index)) + "\n";
}

}  // namespace

const Column& method_column(const Row& row, std::size_t index) {
    return row.columns[index];
}

const Column& yardstick_column(const Row& row, std::size_t) {
    return row.yardstick;
}

Totals totals_of(const std::vector<Row>& rows, const Column& (*column)(const Row&, std::size_t),
                 std::size_t index) {
    Totals t;
    std::vector<double> ratios, predicted;
    for (const Row& row : rows)
        for (const Verdict& v : column(row, index).verdicts) {
            ++t.cells;
            t.rmse_holds += v.rmse_holds;
            t.rmse_is_worse += v.rmse_is_worse;
            t.blocks_hold += v.blocks_hold;
            t.harmless += !v.does_harm();
            t.rules_hold += v.rule_holds;
            ratios.push_back(v.rmse_ratio);
            if (v.rmse_ratio > t.worst_ratio) {
                t.worst_ratio = v.rmse_ratio;
                t.worst_scene = row.recipe->scene_name();
            }
            if (v.predicted_ratio) predicted.push_back(*v.predicted_ratio);
        }
    t.median_ratio = converge::quantile(ratios, 0.5);
    t.predicted = predicted.size();
    for (double ratio : predicted) t.predicted_within += ratio > 0.7 && ratio < 1.3;
    if (!predicted.empty()) t.predicted_median = converge::quantile(predicted, 0.5);
    return t;
}

std::string verdicts_text(const std::vector<Row>& rows) {
    if (rows.empty()) return "";
    std::string text = fmt::format("{:5}{:15}", "", "worst of all budgets");
    for (const Column& c : rows.front().columns)
        text += fmt::format("{:>26}", c.curve->method->name);
    text += "\n";
    for (const Row& row : rows) {
        text += fmt::format("{:5}{:15}", row.recipe->id, row.recipe->scene_name());
        for (const Column& c : row.columns)
            text +=
                fmt::format("{:>11.2f} {:>5} {:4} {:4}", c.worst_ratio(), percent(c.worst_blocks()),
                            c.does_harm()     ? "HARM"
                            : c.limits_hold() ? "ok"
                                              : "luck",
                            c.rule_holds() ? "ok" : "RULE");
        text += "\n";
    }
    for (std::size_t i = 0; i < rows.front().columns.size(); ++i)
        text += fmt::format("{}: {}\n", rows.front().columns[i].curve->method->name,
                            totals_sentence(totals_of(rows, method_column, i)));
    return text;
}

std::string verdicts_markdown(const converge::Config& config, const Suite& suite,
                              const std::vector<Row>& rows) {
    if (rows.empty()) return "";
    const converge::RunRecord& run = *rows.front().yardstick.verdicts.front().rung->runs.front();
    std::string text = fmt::format(
        "Written by `{}`: Wedge {}{}, {}, {} seeds, {}.\n\n"
        "A cell is RMSE over that of {} in the same time (~: a time beyond its budgets), and the "
        "share of 16x16 blocks that have more than 1.1 times its RMSE beyond luck. Bold: harm, "
        "RMSE above {:g} beyond luck or more than {:g} % of blocks. ?: RMSE above {:g}, but not "
        "beyond luck. The rule shows the worst budget.\n\n",
        config.command, version(), run.commit.empty() ? "" : ", commit " + run.commit, run.device,
        config.seeds, config.cpu_clock ? "processor time" : "wall time",
        rows.front().yardstick.curve->method->name, suite.limits.rmse_ratio,
        100 * suite.limits.blocks_worse, suite.limits.rmse_ratio);
    text += totals_table(rows);
    for (std::size_t i = 0; i < rows.front().columns.size(); ++i) {
        const converge::Method& method = *rows.front().columns[i].curve->method;
        text += fmt::format("\n## {}: {}\n\n", method.name, method.label) + method_table(rows, i);
    }
    return text;
}

nlohmann::json verdicts_json(const Suite& suite, const std::vector<Row>& rows) {
    nlohmann::json object = {
        {"format", 1},
        {"limits",
         {{"rmse_ratio", suite.limits.rmse_ratio}, {"blocks_worse", suite.limits.blocks_worse}}},
        {"scenes", nlohmann::json::array()},
        {"waiting", nlohmann::json::array()}};
    for (const Row& row : rows) {
        nlohmann::json scene = {{"id", row.recipe->id},
                                {"scene", row.recipe->scene_name()},
                                {"measure", name_of(row.recipe->rule.measure)},
                                {"at_most", row.recipe->rule.at_most},
                                {"yardstick", of(row.yardstick)},
                                {"methods", nlohmann::json::array()}};
        for (const Column& column : row.columns) scene["methods"].push_back(of(column));
        object["scenes"].push_back(std::move(scene));
    }
    for (const Absent& absent : suite.waiting)
        object["waiting"].push_back(
            {{"id", absent.id}, {"name", absent.name}, {"reason", absent.reason}});
    return object;
}

}  // namespace wedge::stability
