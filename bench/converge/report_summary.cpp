#include <cmath>
#include <set>

#include "bench/converge/html.hpp"
#include "bench/converge/report_sections.hpp"
#include "wedge/render.hpp"

namespace wedge::converge {
namespace {

const Method& yardstick_of(const Analysis& analysis) {
    const SceneAnalysis& first = analysis.scenes.front();
    return *first.curves[first.yardstick].method;
}

/// Coloured where the difference is more than the noise of a few seeds.
std::string ratio_html(double ratio, const std::string& text) {
    if (ratio < 0.95) return "<span class=\"good\">" + text + "</span>";
    if (ratio > 1.05) return "<span class=\"bad\">" + text + "</span>";
    return text;
}

std::string summary_cell(const Summary& s) {
    if (s.scenes == 0) return "–";
    std::string text;
    if (s.unreached < s.scenes) text = ratio_html(s.geometric_mean, short_number(s.geometric_mean));
    if (s.unreached > 0)
        text += fmt::format(" <span class=\"bad\">{}{}</span>", text_of(s.worst),
                            s.scenes > 1 ? fmt::format(" in {}/{}", s.unreached, s.scenes) : "");
    if (s.scenes > 1)
        text +=
            fmt::format("<small>worst: {}, {}</small>", escaped(s.worst_scene), text_of(s.worst));
    return text;
}

std::string summary_table(const Analysis& analysis, const char* head,
                          std::vector<Summary> MethodSummary::*column) {
    Table table;
    table.head.push_back(head);
    for (const Budget& budget : analysis.yardstick_budgets) table.head.push_back(text_of(budget));
    for (const MethodSummary& method : analysis.summaries) {
        std::vector<std::string> row{method.method->name};
        const bool is_yardstick = method.method == &yardstick_of(analysis);
        for (const Summary& s : method.*column) row.push_back(is_yardstick ? "1" : summary_cell(s));
        table.rows.push_back(std::move(row));
    }
    return table_html(table);
}

/// One sentence a method, at the yardstick's last budget.
std::string findings(const Analysis& analysis) {
    std::string items;
    const Method& yardstick = yardstick_of(analysis);
    for (const MethodSummary& m : analysis.summaries) {
        if (m.method == &yardstick || m.time_at_equal_error.empty()) continue;
        const Summary &time = m.time_at_equal_error.back(), &error = m.error_at_equal_time.back();
        std::string text = fmt::format("<strong>{}</strong>: ", m.method->name);
        if (time.unreached < time.scenes)
            text += fmt::format("{} of the time of {} for the same error",
                                short_number(time.geometric_mean), yardstick.name);
        if (time.unreached > 0)
            text += fmt::format("{} does not get there in {} of {} scene{}",
                                time.unreached < time.scenes ? ", but" : "", time.unreached,
                                time.scenes, time.scenes == 1 ? "" : "s");
        if (std::isfinite(error.geometric_mean))
            text += fmt::format("; {} of the error in the same time, worst scene {} with {}",
                                short_number(error.geometric_mean), escaped(error.worst_scene),
                                text_of(error.worst));
        items += "<li>" + text + ".</li>\n";
    }
    if (items.empty()) return "";
    return fmt::format(
        "<div class=\"findings\"><p>Beside {} with {}, RMSE, geometric mean over {} "
        "scene{}:</p><ul>\n{}</ul></div>\n",
        yardstick.name, text_of(analysis.yardstick_budgets.back()), analysis.scenes.size(),
        analysis.scenes.size() == 1 ? "" : "s", items);
}

template <typename Get>
std::string distinct(const Analysis& analysis, const Get& get) {
    std::set<std::string> values;
    for (const SceneAnalysis& scene : analysis.scenes)
        for (const RunRecord& run : scene.scene->runs) values.insert(get(run));
    std::string text;
    for (const std::string& value : values)
        if (!value.empty()) text += (text.empty() ? "" : "; ") + value;
    return text.empty() ? "not known" : escaped(text);
}

std::string settings_html(const Analysis& analysis) {
    Table table{{"method", "what it is", "settings", "first run of the first scene"}, {}};
    for (const Curve& curve : analysis.scenes.front().curves) {
        const RunRecord& run = *curve.rungs.front().runs.front();
        table.rows.push_back({curve.method->name, escaped(curve.method->label),
                              "<code>" + escaped(run.settings.dump()) + "</code>",
                              "<code>" + escaped(run.command) + "</code>"});
    }
    return table_html(table);
}

}  // namespace

std::string headline(const Config& config, const Analysis& analysis) {
    std::size_t runs = 0;
    for (const SceneAnalysis& scene : analysis.scenes) runs += scene.scene->runs.size();
    return fmt::format("Wedge {}, {} scene{}, {} methods, {} seed{}, {} runs on {}", version(),
                       analysis.scenes.size(), analysis.scenes.size() == 1 ? "" : "s",
                       analysis.summaries.size(), config.seeds, config.seeds == 1 ? "" : "s", runs,
                       distinct(analysis, [](const RunRecord& r) { return r.device; }));
}

std::string summary_section(const Analysis& analysis) {
    const std::string yardstick = yardstick_of(analysis).name;
    return "<section>\n<h2 id=\"summary\">Summary</h2>\n" + findings(analysis) +
           fmt::format(
               "<h3>Equal time: error over that of {0}</h3>\n<p class=\"soft\">Columns: the "
               "time that {0} takes with this budget. Below 1 is better than {0}. Geometric "
               "mean over scenes, and the worst scene. “≤”: the method's largest budget was "
               "done before that time; “not done”: its smallest was not. Medians over seeds, "
               "interpolated in log-log, never "
               "beyond what was measured.</p>\n",
               yardstick) +
           summary_table(analysis, "RMSE ratio", &MethodSummary::error_at_equal_time) +
           fmt::format(
               "<h3>Equal error: time over that of {0}</h3>\n<p class=\"soft\">Columns: the "
               "error that {0} reaches with this budget. Below 1 is faster than {0}. “≤”: "
               "the smallest budget is already better than that.</p>\n",
               yardstick) +
           summary_table(analysis, "time ratio", &MethodSummary::time_at_equal_error) +
           "</section>\n";
}

std::string how_section(const Config& config, const Analysis& analysis) {
    std::string html = "<section>\n<h2 id=\"how\">How it was measured</h2>\n<dl>";
    const auto row = [&](const char* name, const std::string& value) {
        html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
    };
    row("command", "<code>" + escaped(config.command) + "</code>");
    row("device", distinct(analysis, [](const RunRecord& r) { return r.device; }));
    row("driver", distinct(analysis, [](const RunRecord& r) { return r.driver; }));
    row("platform", distinct(analysis, [](const RunRecord& r) { return r.platform; }));
    row("Wedge", distinct(analysis, [](const RunRecord& r) { return r.version; }));
    row("commit", distinct(analysis, [](const RunRecord& r) { return r.commit; }));
    row("build", distinct(analysis, [](const RunRecord& r) { return r.program; }));
    html +=
        "</dl>\n<p>Time is wall time of placing instances, copying to the device, all samples, "
        "and all filter passes up to the image on the device. Compiling kernels and building "
        "the BVH are not in it and have bars of their own; neither is reading files. Before the "
        "first run of a method on a scene there is one that does not count. Runs of the methods "
        "alternate, seed by seed.</p>\n<p>Lines join medians over seeds; ribbons reach from the "
        "10 % to the 90 % quantile, which for few seeds is nearly from the least to the most. "
        "Slopes are least squares of log error over log cost, through all runs, ± their "
        "standard error; plain Monte Carlo with independent samples has −0.5.</p>\n<p>Every "
        "method has the same settings in all scenes; the program stops if not.</p>\n";
    Table metrics{{"metric", "t: test, r: reference"}, {}};
    for (const Metric& metric : all_metrics())
        metrics.rows.push_back({metric.label, metric.formula});
    html +=
        "<h3>Metrics</h3>\n" + table_html(metrics) +
        "<p class=\"soft\">From squared errors the reference's own is subtracted, estimated from "
        "two independent halves a and b as the mean of (a − b)² / 4; SSIM and FLIP are as "
        "measured.</p>\n<h3>Methods</h3>\n" +
        settings_html(analysis);
    return html + "</section>\n";
}

}  // namespace wedge::converge
