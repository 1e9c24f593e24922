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

/// "1.03 (4 %)": ratio and share of blocks; bold where a limit is missed.
std::string cell_text(const Verdict& v) {
    const std::string text = fmt::format("{:.2f} ({})", v.rmse_ratio, percent(v.blocks_worse));
    return v.limits_hold ? text : "**" + text + "**";
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
                             {"blocks_worse", v.blocks_worse},
                             {"limits_hold", v.limits_hold},
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

std::string totals_sentence(const std::vector<Row>& rows, std::size_t index) {
    const Totals t = totals_of(rows, method_column, index);
    std::string text = fmt::format(
        "The limits hold in {} of {} cells, the recipes' own rules in {}. RMSE at equal time: "
        "median {:.2f}, worst {:.2f} ({}).",
        t.limits_hold, t.cells, t.rules_hold, t.median_ratio, t.worst_ratio, t.worst_scene);
    if (t.predicted_median)
        text += fmt::format(
            " The error it predicts is {:.2f} times the true one in the median; within 30 % in {} "
            "of {} cells.",
            *t.predicted_median, t.predicted_within, t.predicted);
    return text;
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
    return text + "\n" + totals_sentence(rows, index) + "\n";
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
            t.limits_hold += v.limits_hold;
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
                            c.limits_hold() ? "ok" : "MISS", c.rule_holds() ? "ok" : "RULE");
        text += "\n";
    }
    for (std::size_t i = 0; i < rows.front().columns.size(); ++i)
        text += fmt::format("{}: {}\n", rows.front().columns[i].curve->method->name,
                            totals_sentence(rows, i));
    return text;
}

std::string verdicts_markdown(const converge::Config& config, const Suite& suite,
                              const std::vector<Row>& rows) {
    if (rows.empty()) return "";
    const converge::RunRecord& run = *rows.front().yardstick.verdicts.front().rung->runs.front();
    std::string text = fmt::format(
        "Written by `{}`. Wedge {}{}, {}, {} seeds. A cell: RMSE over that of {} in the same time; "
        "in brackets the share of 16x16 blocks with more than 1.1 times its RMSE. Bold: above "
        "{:g} or {:g} %.\n",
        config.command, version(), run.commit.empty() ? "" : ", commit " + run.commit, run.device,
        config.seeds, rows.front().yardstick.curve->method->name, suite.limits.rmse_ratio,
        100 * suite.limits.blocks_worse);
    for (std::size_t i = 0; i < rows.front().columns.size(); ++i)
        text += fmt::format("\n### {}\n\n", rows.front().columns[i].curve->method->name) +
                method_table(rows, i);
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
