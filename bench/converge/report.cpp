#include "bench/converge/report.hpp"

#include "bench/converge/html.hpp"
#include "bench/converge/report_sections.hpp"

namespace wedge::converge {
namespace {

std::string navigation(const Analysis& analysis) {
    std::string html = "<nav><a href=\"#summary\">Summary</a>";
    for (const SceneAnalysis& scene : analysis.scenes)
        html += fmt::format("<a href=\"#scene-{0}\">{0}</a>", escaped(scene.scene->name));
    return html + "<a href=\"#how\">How it was measured</a></nav>\n";
}

std::string warnings_html(const Analysis& analysis) {
    std::string items;
    for (const SceneAnalysis& scene : analysis.scenes)
        for (const std::string& warning : scene.warnings)
            items += "<li>" + escaped(warning) + "</li>";
    return items.empty() ? "" : "<div class=\"warn\"><ul>" + items + "</ul></div>\n";
}

std::string scene_html(const SceneAnalysis& scene) {
    const SceneRuns& runs = *scene.scene;
    return fmt::format(
               "<section>\n<h2 id=\"scene-{0}\">{0}</h2>\n<p class=\"soft\">{1}x{2} px, {3} "
               "triangles, {4} indirect bounces. Reference: {5} samples a pixel, sampler "
               "{6}, own error {7} (RMSE, estimated from its halves, subtracted from all "
               "mean squares).</p>\n",
               escaped(runs.name), runs.film.width, runs.film.height, runs.triangles, runs.bounces,
               runs.reference.spp, runs.reference.sampler, short_number(scene.reference_rmse)) +
           charts_section(scene) + comparison_section(scene) + pictures_section(scene) +
           bias_section(scene) + peers_section(scene) + costs_section(scene) + raw_section(scene) +
           "</section>\n";
}

}  // namespace

std::string report_html(const Config& config, const Analysis& analysis,
                        const std::string& section) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta "
        "name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
        escaped(config.title) + "</title>\n<style>" + kStyle + "</style>\n</head>\n<body>\n";
    html += fmt::format("<header><h1>{}</h1>\n<p class=\"lead\">{}</p>\n{}</header>\n",
                        escaped(config.title), headline(config, analysis), navigation(analysis));
    html += "<main>\n" + section + warnings_html(analysis) + summary_section(analysis);
    for (const SceneAnalysis& scene : analysis.scenes) html += scene_html(scene);
    return html + how_section(config, analysis) + "</main>\n</body>\n</html>\n";
}

}  // namespace wedge::converge
