// The suite's section of the HTML report.
#include <algorithm>
#include <cmath>

#include "bench/converge/chart.hpp"
#include "bench/converge/html.hpp"
#include "bench/stability/luck.hpp"
#include "bench/stability/tables.hpp"

namespace wedge::stability {
namespace {

using converge::escaped;
using converge::short_number;

constexpr double kFullHeat = 1.0;  // |log2 of the ratio| with the strongest colour

/// Green below 1, red above; the colour lies over that of the page, light or dark.
std::string heat(double ratio, const std::string& text) {
    const double strength = std::clamp(std::abs(std::log2(ratio)) / kFullHeat, 0.0, 1.0);
    return fmt::format(
        "<span style=\"display:block;padding:0 "
        ".3rem;border-radius:3px;background:rgba({},{:.2f})\">"
        "{}</span>",
        ratio > 1 ? "200,40,30" : "20,140,70", 0.75 * strength, text);
}

std::string verdict_html(const Verdict& v) {
    const std::string mark = v.does_harm() ? " ✗" : v.rmse_holds ? "" : " ?";
    return heat(v.rmse_ratio,
                fmt::format("{}{:.2f}{}<small>{:.0f} % blocks</small>", v.beyond ? "~" : "",
                            v.rmse_ratio, mark, 100 * v.blocks.shown));
}

std::string rule_html(const Rule& rule, const Column& column) {
    return fmt::format("<span class=\"{}\">{} {}</span><small>at most {}</small>",
                       column.rule_holds() ? "good" : "bad", name_of(rule.measure),
                       short_number(column.worst_rule()), short_number(rule.at_most));
}

std::string heat_table(const std::vector<Row>& rows, std::size_t index) {
    converge::Table table{{"scene"}, {}};
    for (const Verdict& v : rows.front().columns[index].verdicts)
        table.head.push_back(converge::text_of(v.rung->budget));
    table.head.push_back("its own rule");
    table.head.push_back("why it is hard");
    for (const Row& row : rows) {
        std::vector<std::string> cells{fmt::format("{0} <a href=\"#scene-{1}\">{1}</a>",
                                                   row.recipe->id,
                                                   escaped(row.recipe->scene_name()))};
        for (const Verdict& v : row.columns[index].verdicts) cells.push_back(verdict_html(v));
        cells.push_back(rule_html(row.recipe->rule, row.columns[index]));
        cells.push_back(escaped(row.recipe->why));
        table.rows.push_back(std::move(cells));
    }
    return converge::table_html(table);
}

void add_predictions(const Column& column, converge::Series& series, const std::string& scene) {
    for (const Verdict& v : column.verdicts) {
        if (!v.predicted_ratio || *v.predicted_ratio <= 0) continue;
        const double truth = v.rung->metrics[0].median, told = truth * *v.predicted_ratio;
        series.places.push_back(
            {{truth, truth, truth},
             {told, told, told},
             fmt::format("{}, {}: true {}, predicted {}", scene, converge::text_of(v.rung->budget),
                         short_number(truth), short_number(told))});
    }
}

/// Predicted over true RMSE, of all scenes and budgets; the dashed line is where they are equal.
std::string calibration_html(const std::vector<Row>& rows) {
    converge::Chart chart{"Predicted error", "true RMSE", "predicted RMSE", {}, 0, true};
    converge::Table table{{"method", "cells", "median of predicted / true", "within 30 %"}, {}};
    const auto add = [&](const Column& (*column)(const Row&, std::size_t), std::size_t index) {
        const converge::Method& method = *column(rows.front(), index).curve->method;
        const Totals t = totals_of(rows, column, index);
        if (t.predicted == 0) return;
        converge::Series series{converge::series_of(method), method.name, {}};
        for (const Row& row : rows)
            add_predictions(column(row, index), series, row.recipe->scene_name());
        chart.series.push_back(std::move(series));
        table.rows.push_back({method.name, std::to_string(t.predicted),
                              short_number(*t.predicted_median),
                              fmt::format("{}", t.predicted_within)});
    };
    add(yardstick_column, 0);
    for (std::size_t i = 0; i < rows.front().columns.size(); ++i) add(method_column, i);
    if (chart.series.empty()) return "";
    return "<h3>Predicted against true error</h3>\n<p class=\"soft\">What `wedge render` prints "
           "at its end beside the error against the reference; medians over seeds, a point a scene "
           "and budget.</p>\n<div class=\"cards\"><figure>" +
           converge::chart_svg(chart) + "</figure></div>\n" + converge::table_html(table);
}

std::string absent_html(const char* title, const std::vector<Absent>& list) {
    if (list.empty()) return "";
    std::string items;
    for (const Absent& a : list)
        items += fmt::format("<li>{} {}: {}</li>", a.id, escaped(a.name), escaped(a.reason));
    return fmt::format("<h3>{}</h3><ul>{}</ul>\n", title, items);
}

}  // namespace

std::string verdicts_html(const Suite& suite, const std::vector<Row>& rows) {
    if (rows.empty()) return "";
    std::string html = fmt::format(
        "<section>\n<h2 id=\"stability\">Stability</h2>\n<p class=\"soft\">RMSE over that of {0} "
        "in the same time, by scene and budget; below, the share of 16x16 blocks with more than "
        "1.1 times its RMSE there, beyond luck: by Student's test over seeds at {3:g} %. ✗: RMSE "
        "above {1:g} beyond luck, or more than {2:g} % of blocks. ?: RMSE above {1:g}, not beyond "
        "luck. {0}'s error at a time is interpolated, straight in log-log; ~: beyond its budgets, "
        "error times square root of time is kept. Errors below a ten thousandth of the image's "
        "mean count as equal.</p>\n",
        rows.front().yardstick.curve->method->name, suite.limits.rmse_ratio,
        100 * suite.limits.blocks_worse, 100 * kLevel);
    for (std::size_t i = 0; i < rows.front().columns.size(); ++i) {
        const converge::Method& method = *rows.front().columns[i].curve->method;
        html += fmt::format("<h3>{}: {}</h3>\n", method.name, escaped(method.label)) +
                heat_table(rows, i);
    }
    return html + calibration_html(rows) + absent_html("Checked elsewhere", suite.elsewhere) +
           absent_html("Waiting for effects that are not there yet", suite.waiting) +
           "</section>\n";
}

}  // namespace wedge::stability
