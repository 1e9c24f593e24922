#include <cmath>

#include "bench/converge/session.hpp"
#include "wedge/render.hpp"

namespace wedge::converge {
namespace {

using nlohmann::json;

json of(const Spread& spread) {
    return {{"p10", spread.low}, {"median", spread.median}, {"p90", spread.high}};
}

json of(const std::optional<PowerLaw>& fit) {
    if (!fit) return nullptr;
    return {{"slope", fit->slope}, {"standard_error", fit->slope_error}};
}

json of(const std::vector<Ratio>& ratios) {
    constexpr const char* kKinds[] = {"exact", "at_most", "unreached", "late", "unknown"};
    json list = json::array();
    for (const Ratio& ratio : ratios)
        list.push_back({{"kind", kKinds[ratio.kind]},
                        {"ratio", ratio.has_value() ? json(ratio.value) : json()}});
    return list;
}

json of(const Rung& rung) {
    json object = {{"unit", name_of(rung.budget.unit)},
                   {"budget", rung.budget.value},
                   {"knob", rung.knob},
                   {"plotted", rung.is_plotted},
                   {"time_s", of(rung.time_s)},
                   {"rays", of(rung.rays)},
                   {"samples_per_pixel", of(rung.samples_per_pixel)},
                   {"blocks_worse", rung.blocks_worse},
                   {"blocks_twice", rung.blocks_twice}};
    for (std::size_t m = 0; m < all_metrics().size(); ++m)
        object[all_metrics()[m].name] = of(rung.metrics[m]);
    if (rung.split)
        object["split"] = {{"mse", rung.split->mse},
                           {"bias_squared", rung.split->bias_squared},
                           {"variance", rung.split->variance}};
    object["runs"] = json::array();
    for (std::size_t i = 0; i < rung.runs.size(); ++i) {
        json run = to_json(*rung.runs[i]);
        run["errors"] = to_json(rung.errors[i]);
        object["runs"].push_back(std::move(run));
    }
    return object;
}

json of(const ZTest& z) {
    return {{"tests", z.tests},
            {"mean_square_z", z.mean_square_z},
            {"largest_z", z.largest_z},
            {"p", z.p}};
}

json of(const Curve& curve, const Comparison& comparison) {
    json object = {{"method", curve.method->name},
                   {"label", curve.method->label},
                   {"slope_by_time", of(curve.by_time)},
                   {"slope_by_rays", of(curve.by_rays)},
                   {"error_at_equal_time", of(comparison.error_at_equal_time)},
                   {"time_at_equal_error", of(comparison.time_at_equal_error)},
                   {"rays_at_equal_error", of(comparison.rays_at_equal_error)},
                   {"rungs", json::array()}};
    if (curve.z_test) object["z_test"] = of(*curve.z_test);
    if (const auto& map = curve.bias_map)
        object["welch"] = {{"blocks", map->tests},
                           {"share_below_5_percent", map->share_below_5_percent},
                           {"significant_blocks", map->significant}};
    for (const Rung& rung : curve.rungs) object["rungs"].push_back(of(rung));
    return object;
}

json of(const Agreement& a) {
    json object = {{"method", a.method->name},
                   {"version", a.version},
                   {"samples_per_pixel", a.spp},
                   {"rmse", a.rmse},
                   {"rmse_of_noise", a.rmse_of_noise},
                   {"ratio_of_means", a.ratio_of_means},
                   {"z_test", of(a.test)},
                   {"own_errors", json::array()}};
    for (const OwnError& e : a.own_errors)
        object["own_errors"].push_back({{"method", e.method->name},
                                        {"unit", name_of(e.budget.unit)},
                                        {"budget", e.budget.value},
                                        {"rmse_to_reference", e.to_reference},
                                        {"rmse_to_own_reference", e.to_own}});
    return object;
}

json of(const SceneAnalysis& analysis) {
    const SceneRuns& scene = *analysis.scene;
    json object = {
        {"name", scene.name},
        {"file", scene.file},
        {"digest", scene.digest},
        {"width", scene.film.width},
        {"height", scene.film.height},
        {"bounces", scene.bounces},
        {"triangles", scene.triangles},
        {"reference",
         {{"file", scene.reference.file.filename().string()},
          {"samples_per_pixel", scene.reference.spp},
          {"sampler", scene.reference.sampler},
          {"rmse_estimate", analysis.reference_rmse},
          {"smallest_rmse", analysis.smallest_rmse}}},
        {"yardstick", analysis.curves[analysis.yardstick].method->name},
        {"warnings", analysis.warnings},
        {"methods", json::array()},
    };
    for (const Agreement& a : analysis.agreements) object["peers"].push_back(of(a));
    for (std::size_t i = 0; i < analysis.curves.size(); ++i)
        object["methods"].push_back(of(analysis.curves[i], analysis.comparisons[i]));
    return object;
}

json of(const Summary& summary) {
    return {{"geometric_mean", summary.geometric_mean},
            {"scenes", summary.scenes},
            {"unreached", summary.unreached},
            {"worst", of(std::vector{summary.worst})[0]},
            {"worst_scene", summary.worst_scene}};
}

}  // namespace

json results_json(const Config& config, const Analysis& analysis) {
    json object = {{"format", 1},
                   {"title", config.title},
                   {"command", config.command},
                   {"version", version()},
                   {"seeds", config.seeds},
                   {"metrics", json::object()},
                   {"summary", json::array()},
                   {"scenes", json::array()}};
    for (const Metric& metric : all_metrics()) object["metrics"][metric.name] = metric.formula;
    for (const MethodSummary& method : analysis.summaries) {
        json item = {{"method", method.method->name},
                     {"error_at_equal_time", json::array()},
                     {"time_at_equal_error", json::array()}};
        for (const Summary& s : method.error_at_equal_time)
            item["error_at_equal_time"].push_back(of(s));
        for (const Summary& s : method.time_at_equal_error)
            item["time_at_equal_error"].push_back(of(s));
        object["summary"].push_back(std::move(item));
    }
    for (const SceneAnalysis& scene : analysis.scenes) object["scenes"].push_back(of(scene));
    return object;
}

}  // namespace wedge::converge
