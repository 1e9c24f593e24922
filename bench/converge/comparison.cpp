// Equal time and equal error, scene by scene and over all of them.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "bench/converge/analysis.hpp"
#include "wedge/error.hpp"

namespace wedge::converge {
namespace {

Ratio error_ratio(const LogLogCurve& curve, double time, double yardstick_error) {
    if (curve.empty()) return {};
    if (const auto error = curve.at(time)) return {Ratio::exact, *error / yardstick_error};
    // Done before: its last image is there at that time.
    if (curve.points().back().x < time)
        return {Ratio::at_most, curve.points().back().y / yardstick_error};
    return {Ratio::late, 0};
}

Ratio cost_ratio(const LogLogCurve& curve, double error, double yardstick_cost) {
    if (curve.empty()) return {};
    const LogLogCurve::Crossing crossing = curve.comes_down_to(error);
    if (crossing.kind == LogLogCurve::Crossing::above) return {Ratio::unreached, 0};
    const bool bound = crossing.kind == LogLogCurve::Crossing::below &&
                       curve.points().front().y < error * (1 - 1e-12);
    return {bound ? Ratio::at_most : Ratio::exact, crossing.x / yardstick_cost};
}

bool is_worse(const Ratio& a, const Ratio& b) {
    if (!b.has_value()) return false;
    if (!a.has_value()) return true;
    return a.value > b.value;
}

Summary summarise_ratios(const std::vector<std::pair<std::string, Ratio>>& ratios) {
    Summary summary;
    std::vector<double> values;
    for (const auto& [scene, ratio] : ratios) {
        if (ratio.kind == Ratio::unknown) continue;
        ++summary.scenes;
        if (!ratio.has_value())
            ++summary.unreached;
        else
            values.push_back(ratio.value);
        if (summary.worst.kind == Ratio::unknown || is_worse(ratio, summary.worst)) {
            summary.worst = ratio;
            summary.worst_scene = scene;
        }
    }
    summary.geometric_mean = geometric_mean(values);
    return summary;
}

void check_settings(const std::vector<SceneAnalysis>& scenes) {
    std::map<std::string, nlohmann::json> settings;
    for (const SceneAnalysis& scene : scenes)
        for (const RunRecord& run : scene.scene->runs) {
            const auto [known, is_new] = settings.try_emplace(run.method, run.settings);
            if (!is_new && known->second != run.settings)
                throw Error(
                    ErrorKind::internal,
                    fmt::format("{} ran with other settings in scene {} than before: {} "
                                "and {}",
                                run.method, run.scene, run.settings.dump(), known->second.dump()));
        }
}

}  // namespace

std::vector<Comparison> compare(const std::vector<Curve>& curves, std::size_t yardstick) {
    std::vector<Comparison> comparisons;
    for (const Curve& curve : curves) {
        Comparison comparison;
        comparison.method = curve.method;
        const LogLogCurve by_time = curve.rmse_by_time(), by_rays = curve.rmse_by_rays();
        for (const Rung& rung : curves[yardstick].rungs) {
            const double error = rung.metrics[0].median;
            comparison.error_at_equal_time.push_back(
                error_ratio(by_time, rung.time_s.median, error));
            comparison.time_at_equal_error.push_back(
                cost_ratio(by_time, error, rung.time_s.median));
            comparison.rays_at_equal_error.push_back(cost_ratio(by_rays, error, rung.rays.median));
        }
        comparisons.push_back(std::move(comparison));
    }
    return comparisons;
}

Analysis summarise(std::vector<SceneAnalysis> scenes) {
    check_settings(scenes);
    Analysis analysis;
    analysis.scenes = std::move(scenes);
    if (analysis.scenes.empty()) return analysis;
    const SceneAnalysis& first = analysis.scenes.front();
    for (const Rung& rung : first.curves[first.yardstick].rungs)
        analysis.yardstick_budgets.push_back(rung.budget);
    for (std::size_t m = 0; m < first.curves.size(); ++m) {
        MethodSummary summary;
        summary.method = first.curves[m].method;
        for (std::size_t rung = 0; rung < analysis.yardstick_budgets.size(); ++rung) {
            std::vector<std::pair<std::string, Ratio>> errors, times;
            for (const SceneAnalysis& scene : analysis.scenes) {
                const Comparison& c = scene.comparisons[m];
                errors.emplace_back(scene.scene->name, c.error_at_equal_time[rung]);
                times.emplace_back(scene.scene->name, c.time_at_equal_error[rung]);
            }
            summary.error_at_equal_time.push_back(summarise_ratios(errors));
            summary.time_at_equal_error.push_back(summarise_ratios(times));
        }
        analysis.summaries.push_back(std::move(summary));
    }
    return analysis;
}

}  // namespace wedge::converge
