#include "bench/converge/markdown.hpp"

#include <cmath>

#include "bench/converge/html.hpp"
#include "wedge/render.hpp"

namespace wedge::converge {
namespace {

std::string cell(const Summary& s) {
    if (s.scenes == 0) return "–";
    std::string text;
    if (s.unreached < s.scenes) text = short_number(s.geometric_mean);
    if (s.unreached > 0)
        text += fmt::format("{}{} in {}/{}", text.empty() ? "" : ", ", text_of(s.worst),
                            s.unreached, s.scenes);
    if (s.unreached < s.scenes && s.scenes > 1)
        text += fmt::format("; worst {}: {}", s.worst_scene, text_of(s.worst));
    return text;
}

std::string row(const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& c : cells) text += " " + c + " |";
    return text + "\n";
}

std::string rule(std::size_t columns) {
    return row(std::vector<std::string>(columns, "---"));
}

std::string summary_table(const Analysis& analysis, const std::string& head,
                          std::vector<Summary> MethodSummary::*column) {
    std::vector<std::string> heads{head};
    for (const Budget& budget : analysis.yardstick_budgets) heads.push_back(text_of(budget));
    std::string text = row(heads) + rule(heads.size());
    for (const MethodSummary& method : analysis.summaries) {
        std::vector<std::string> cells{method.method->name};
        for (const Summary& s : method.*column) cells.push_back(cell(s));
        text += row(cells);
    }
    return text;
}

std::string scene_table(const SceneAnalysis& scene) {
    const std::vector<std::string> heads{"method",          "budget",      "time",   "rays",
                                         "samples a pixel", "RMSE",        "relMSE", "FLIP",
                                         "bias² share",     "blocks worse"};
    std::string text = row(heads) + rule(heads.size());
    for (std::size_t i = 0; i < scene.curves.size(); ++i)
        for (const Rung& rung : scene.curves[i].rungs)
            text += row(
                {scene.curves[i].method->name, text_of(rung.budget),
                 short_seconds(rung.time_s.median), short_count(rung.rays.median),
                 short_number(rung.samples_per_pixel.median),
                 (rung.is_plotted ? "" : "≈ ") + short_number(rung.metrics[0].median),
                 short_number(rung.metrics[2].median), short_number(rung.metrics[5].median),
                 rung.split
                     ? fmt::format("{:.0f} %", 100 * rung.split->bias_squared / rung.split->mse)
                     : "–",
                 i == scene.yardstick ? "–" : fmt::format("{:.0f} %", 100 * rung.blocks_worse)});
    return text;
}

}  // namespace

std::string markdown_tables(const Config& config, const Analysis& analysis) {
    if (analysis.scenes.empty()) return "";
    const SceneAnalysis& first = analysis.scenes.front();
    const RunRecord& run = first.scene->runs.front();
    const std::string yardstick = first.curves[first.yardstick].method->name;
    std::string text = fmt::format(
        "# {}\n\nWritten by `{}`. Wedge {}{}, {} ({}), {} seeds. What is measured and how: "
        "bench.md.\n\n",
        config.title, config.command, version(), run.commit.empty() ? "" : ", commit " + run.commit,
        run.device, run.platform, config.seeds);
    text += fmt::format(
                "## Equal time\n\nRMSE over that of {0}, in the time that {0} takes with the "
                "budget at the head of the column. Geometric mean over {1} scenes; below 1 "
                "is better.\n\n",
                yardstick, analysis.scenes.size()) +
            summary_table(analysis, "RMSE ratio", &MethodSummary::error_at_equal_time) +
            fmt::format(
                "\n## Equal error\n\nTime over that of {0}, to reach the RMSE that {0} has "
                "with the budget at the head of the column.\n\n",
                yardstick) +
            summary_table(analysis, "time ratio", &MethodSummary::time_at_equal_error) +
            "\n## Scenes\n\nMedians over seeds. Blocks worse: share of 16x16 blocks with more "
            "than 1.1 times the RMSE that " +
            yardstick +
            " has in the same time. ≈: the reference's own error is not five times smaller, "
            "charts and slopes leave it out.\n";
    for (const SceneAnalysis& scene : analysis.scenes) {
        const SceneRuns& runs = *scene.scene;
        text += fmt::format(
                    "\n### {}\n\n{}x{} px, {} indirect bounces, {} triangles; reference of {} "
                    "samples a pixel, own RMSE {}.\n\n",
                    runs.name, runs.film.width, runs.film.height, runs.bounces, runs.triangles,
                    runs.reference.spp, short_number(scene.reference_rmse)) +
                scene_table(scene);
        for (const std::string& warning : scene.warnings) text += "\n- Warning: " + warning + "\n";
    }
    return text;
}

}  // namespace wedge::converge
