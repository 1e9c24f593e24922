#include "bench/converge/chart.hpp"
#include "bench/converge/html.hpp"
#include "bench/converge/report_sections.hpp"
#include "bench/converge/strips.hpp"

namespace wedge::converge {
namespace {

std::string note_of(const Rung& rung) {
    return fmt::format("{}, {}, {} rays, {} samples a pixel", text_of(rung.budget),
                       short_seconds(rung.time_s.median), short_count(rung.rays.median),
                       short_number(rung.samples_per_pixel.median));
}

std::string chart_figure(const SceneAnalysis& scene, std::size_t metric, bool by_rays) {
    Chart chart;
    chart.x_label = by_rays ? "rays" : "time, s";
    chart.y_label = all_metrics()[metric].label;
    chart.title = scene.scene->name + ": " + chart.y_label + " over " + chart.x_label;
    chart.guide_slope = metric == 0 ? -0.5 : 0;
    for (std::size_t i = 0; i < scene.curves.size(); ++i) {
        Series series{series_of(*scene.curves[i].method), scene.curves[i].method->name, {}};
        for (const Rung& rung : scene.curves[i].rungs)
            if (rung.is_plotted)
                series.places.push_back(
                    {by_rays ? rung.rays : rung.time_s, rung.metrics[metric],
                     note_of(rung) + fmt::format(", {} {}", chart.y_label,
                                                 short_number(rung.metrics[metric].median))});
        chart.series.push_back(std::move(series));
    }
    return "<figure>" + chart_svg(chart) +
           fmt::format("<figcaption><strong>{} over {}</strong></figcaption></figure>\n",
                       chart.y_label, by_rays ? "rays" : "time");
}

std::string slope_text(const std::optional<PowerLaw>& fit) {
    return fit ? fmt::format("{:.2f} ± {:.2f}", fit->slope, fit->slope_error) : "–";
}

std::string slopes_table(const SceneAnalysis& scene) {
    Table table{{"slope of RMSE", "over time", "over rays"}, {}};
    for (const Curve& curve : scene.curves)
        table.rows.push_back(
            {curve.method->name, slope_text(curve.by_time), slope_text(curve.by_rays)});
    return table_html(table);
}

std::string ratio_table(const SceneAnalysis& scene, const char* head,
                        std::vector<Ratio> Comparison::*column, bool head_is_time) {
    Table table;
    table.head.push_back(head);
    for (const Rung& rung : scene.curves[scene.yardstick].rungs)
        table.head.push_back(fmt::format("{}<br/>{}", text_of(rung.budget),
                                         head_is_time ? short_seconds(rung.time_s.median)
                                                      : short_number(rung.metrics[0].median)));
    for (const Comparison& comparison : scene.comparisons) {
        std::vector<std::string> row{comparison.method->name};
        for (const Ratio& ratio : comparison.*column) row.push_back(text_of(ratio));
        table.rows.push_back(std::move(row));
    }
    return table_html(table);
}

std::string percent(double share) {
    return fmt::format("{:.0f} %", 100 * share);
}

}  // namespace

std::string charts_section(const SceneAnalysis& scene) {
    std::string html = legend_html(scene.curves) + "<div class=\"cards\">\n" +
                       chart_figure(scene, 0, false) + chart_figure(scene, 0, true) +
                       "</div>\n<p class=\"soft\">Dashed: slope −½ through the first point of " +
                       std::string(scene.curves.front().method->name) + ".</p>\n";
    html += "<details><summary>The other metrics over time</summary>\n<div class=\"cards\">\n";
    for (std::size_t metric = 1; metric < all_metrics().size(); ++metric)
        html += chart_figure(scene, metric, false);
    return html + "</div></details>\n" + slopes_table(scene);
}

std::string comparison_section(const SceneAnalysis& scene) {
    const std::string yardstick = scene.curves[scene.yardstick].method->name;
    return "<h3>Ratios to " + yardstick + "</h3>\n<div class=\"tables\">" +
           ratio_table(scene, "RMSE, equal time", &Comparison::error_at_equal_time, true) +
           ratio_table(scene, "time, equal RMSE", &Comparison::time_at_equal_error, false) +
           ratio_table(scene, "rays, equal RMSE", &Comparison::rays_at_equal_error, false) +
           "</div>\n";
}

std::string pictures_section(const SceneAnalysis& scene) {
    return "<h3>Pictures at equal time</h3>\n" + strip_html(scene);
}

std::string bias_section(const SceneAnalysis& scene) {
    Table table{{"method", "budget", "mean squared error", "bias²", "variance", "bias² share",
                 "blocks worse", "twice as bad"},
                {}};
    for (std::size_t i = 0; i < scene.curves.size(); ++i)
        for (const Rung& rung : scene.curves[i].rungs) {
            std::vector<std::string> row{scene.curves[i].method->name, text_of(rung.budget)};
            if (rung.split)
                row.insert(row.end(),
                           {short_number(rung.split->mse), short_number(rung.split->bias_squared),
                            short_number(rung.split->variance),
                            percent(rung.split->bias_squared / rung.split->mse)});
            else
                row.insert(row.end(), {"–", "–", "–", "–"});
            if (i == scene.yardstick)
                row.insert(row.end(), {"–", "–"});
            else
                row.insert(row.end(), {percent(rung.blocks_worse), percent(rung.blocks_twice)});
            table.rows.push_back(std::move(row));
        }
    std::string html =
        "<h3>Bias, variance, and blocks that lose</h3>\n<p class=\"soft\">Split over seeds; bias² "
        "is "
        "an unbiased estimate, so noise can make it slightly negative. Blocks of 16 x 16 px with "
        "more than 1.1 times the RMSE that " +
        std::string(scene.curves[scene.yardstick].method->name) +
        " has in the same time, and with more than twice its mean squared error.</p>\n" +
        table_html(table);
    Table tests{{"unfiltered", "tests", "mean z²", "largest |z|", "p, corrected"}, {}};
    for (const Curve& curve : scene.curves)
        if (const auto& z = curve.z_test)
            tests.rows.push_back({curve.method->name, std::to_string(z->tests),
                                  short_number(z->mean_square_z), short_number(z->largest_z),
                                  short_number(z->p)});
    if (!tests.rows.empty())
        html +=
            "<h3>Unfiltered methods against the reference</h3>\n<p class=\"soft\">All runs of a "
            "method pooled, blocks of 8 x 8 px, each channel; variances as if samples were "
            "independent, so mean z² is 1 for those and less for stratified ones.</p>\n" +
            table_html(tests);
    return html + bias_maps_html(scene);
}

std::string raw_section(const SceneAnalysis& scene) {
    Table table{{"method", "budget", "time", "spread", "rays", "samples a pixel"}, {}};
    for (const Metric& metric : all_metrics()) table.head.push_back(metric.label);
    for (const Curve& curve : scene.curves)
        for (const Rung& rung : curve.rungs) {
            std::vector<std::string> row{curve.method->name,
                                         text_of(rung.budget),
                                         short_seconds(rung.time_s.median),
                                         fmt::format("{}–{}", short_seconds(rung.time_s.low),
                                                     short_seconds(rung.time_s.high)),
                                         short_count(rung.rays.median),
                                         short_number(rung.samples_per_pixel.median)};
            for (const Spread& value : rung.metrics)
                row.push_back(fmt::format("{}<small>{}–{}</small>", short_number(value.median),
                                          short_number(value.low), short_number(value.high)));
            table.rows.push_back(std::move(row));
        }
    return "<details><summary>Raw numbers</summary>\n<p class=\"soft\">Medians over seeds, 10–90 % "
           "below. Every run by itself is in results.json, its pixels in images/.</p>\n" +
           table_html(table) + "</details>\n";
}

}  // namespace wedge::converge
