#include "bench/converge/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/converge/reference_margin.hpp"
#include "wedge/error.hpp"
#include "wedge/image_io.hpp"

namespace wedge::converge {
namespace {

constexpr Metric kMetrics[] = {
    {"rmse", "RMSE", "square root of the mean of (t − r)² over pixels and R, G, B",
     [](const Errors& e) { return root(e.mse); }},
    {"rmse_trimmed", "RMSE, trimmed", "RMSE without the 0.1 % of pixels with the largest errors",
     [](const Errors& e) { return root(e.mse_trimmed); }},
    {"rel_mse", "relMSE", "mean of (t − r)² / (max(r, 0) + 0.01)²",
     [](const Errors& e) { return std::max(0.0, e.rel_mse); }},
    {"rel_mse_trimmed", "relMSE, trimmed",
     "relMSE without the 0.1 % of pixels with the largest relative errors",
     [](const Errors& e) { return std::max(0.0, e.rel_mse_trimmed); }},
    {"dssim", "1 − SSIM", "structural dissimilarity of tone-mapped grey (Wang et al. 2004)",
     [](const Errors& e) { return 1 - e.ssim; }},
    {"flip", "FLIP", "mean of HDR-FLIP (Andersson et al. 2021)",
     [](const Errors& e) { return e.flip; }},
};

template <typename Value>
std::vector<double> over_runs(const Rung& rung, const Value& value) {
    std::vector<double> values;
    for (std::size_t i = 0; i < rung.runs.size(); ++i) values.push_back(double(value(i)));
    return values;
}

void take_spreads(Rung& rung) {
    rung.time_s = spread_of(over_runs(rung, [&](auto i) { return rung.runs[i]->time_s; }));
    rung.rays = spread_of(over_runs(rung, [&](auto i) { return rung.runs[i]->rays; }));
    rung.samples_per_pixel = spread_of(over_runs(rung, [&](auto i) {
        const RunRecord& r = *rung.runs[i];
        return double(r.samples) / (double(r.width) * r.height);
    }));
    for (const Metric& metric : kMetrics)
        rung.metrics.push_back(
            spread_of(over_runs(rung, [&](auto i) { return metric.value(rung.errors[i]); })));
}

Curve make_curve(const Method& method, const SceneRuns& scene, const std::vector<Image>& images,
                 const std::vector<Errors>& errors, double reference_rmse) {
    Curve curve;
    curve.method = &method;
    for (std::size_t i = 0; i < scene.runs.size(); ++i) {
        const RunRecord& run = scene.runs[i];
        if (run.method != method.name) continue;
        auto rung = std::find_if(curve.rungs.begin(), curve.rungs.end(),
                                 [&](const Rung& r) { return r.budget == run.budget; });
        if (rung == curve.rungs.end())
            rung = curve.rungs.insert(rung, Rung{run.budget, run.knob, {}, {}, {}});
        rung->runs.push_back(&run);
        rung->images.push_back(&images[i]);
        rung->errors.push_back(errors[i]);
    }
    std::vector<double> times, rays, rmse;
    std::size_t plotted = 0;
    for (Rung& rung : curve.rungs) {
        take_spreads(rung);
        rung.is_plotted = rung.metrics[0].median >= kReferenceMargin * reference_rmse;
        if (!rung.is_plotted) continue;
        ++plotted;
        for (std::size_t i = 0; i < rung.runs.size(); ++i) {
            times.push_back(rung.runs[i]->time_s);
            rays.push_back(double(rung.runs[i]->rays));
            rmse.push_back(kMetrics[0].value(rung.errors[i]));
        }
    }
    if (plotted < 2) return curve;  // times that differ by chance are no slope
    curve.by_time = fit_power_law(times, rmse);
    curve.by_rays = fit_power_law(rays, rmse);
    return curve;
}

void check_reference(SceneAnalysis& analysis) {
    const Reference& reference = analysis.scene->reference;
    analysis.smallest_rmse = INFINITY;
    std::string left_out;
    for (const Curve& curve : analysis.curves)
        for (const Rung& rung : curve.rungs) {
            analysis.smallest_rmse = std::min(analysis.smallest_rmse, rung.metrics[0].median);
            if (!rung.is_plotted)
                left_out +=
                    fmt::format("{}{} {}={:g}", left_out.empty() ? "" : ", ", curve.method->name,
                                name_of(rung.budget.unit), rung.budget.value);
        }
    if (left_out.empty()) return;
    const double ratio = analysis.smallest_rmse / analysis.reference_rmse;
    const double factor = std::pow(kReferenceMargin / std::max(ratio, 0.1), 2);
    analysis.warnings.push_back(fmt::format(
        "{}: not in the charts and slopes, because the reference's own error, {:.2g}, is not {:g} "
        "times smaller: {}. In tables its part is subtracted. {:.0f} samples a pixel would do for "
        "all, which take about {:.0f} s: --reference-time, --reference-limit.",
        analysis.scene->name, analysis.reference_rmse, kReferenceMargin, left_out,
        std::ceil(double(reference.spp) * factor / 256) * 256,
        std::ceil(reference.time_s * factor)));
}

}  // namespace

std::span<const Metric> all_metrics() {
    return kMetrics;
}

LogLogCurve Curve::rmse_by_time() const {
    std::vector<Point> points;
    for (const Rung& rung : rungs) points.push_back({rung.time_s.median, rung.metrics[0].median});
    return LogLogCurve(points);
}

LogLogCurve Curve::rmse_by_rays() const {
    std::vector<Point> points;
    for (const Rung& rung : rungs) points.push_back({rung.rays.median, rung.metrics[0].median});
    return LogLogCurve(points);
}

std::vector<Image> read_images(const Config& config, const SceneRuns& scene) {
    std::vector<Image> images;
    for (const RunRecord& run : scene.runs) images.push_back(read_image(config.folder / run.image));
    return images;
}

std::vector<Errors> errors_of_runs(const Config& config, const SceneRuns& scene,
                                   const std::vector<Image>& images) {
    const std::filesystem::path file = config.folder / "errors.jsonl";
    // A run that was made again has the same key but another time.
    const auto name = [&](const RunRecord& run) {
        return fmt::format("{}|{}|{}", run.key, run.program, scene.reference.id);
    };
    std::map<std::string, Errors> known;
    for (const nlohmann::json& line : read_lines(file)) {
        try {
            known[line.at("run").get<std::string>()] = errors_from(line.at("errors"));
        } catch (const nlohmann::json::exception&) {
        }
    }
    std::vector<Errors> errors;
    for (std::size_t i = 0; i < scene.runs.size(); ++i) {
        const std::string run = name(scene.runs[i]);
        auto found = known.find(run);
        if (found == known.end()) {
            found = known.emplace(run, measure_errors(images[i], scene.reference)).first;
            append_line(file,
                        nlohmann::json{{"run", run}, {"errors", to_json(found->second)}}.dump());
        }
        errors.push_back(found->second);
    }
    return errors;
}

SceneAnalysis analyse(const Config& config, const SceneRuns& scene,
                      const std::vector<Image>& images, const std::vector<Errors>& errors) {
    SceneAnalysis analysis;
    analysis.scene = &scene;
    analysis.reference_rmse = std::sqrt(mean_squared_error_of(scene.reference));
    for (const std::string& name : config.methods)
        analysis.curves.push_back(
            make_curve(find_method(name), scene, images, errors, analysis.reference_rmse));
    std::vector<Curve>& curves = analysis.curves;
    const auto plain = std::find_if(curves.begin(), curves.end(),
                                    [](const Curve& c) { return !c.method->biased; });
    analysis.yardstick = plain == curves.end() ? 0 : std::size_t(plain - curves.begin());
    for (Curve& curve : curves) {
        for (Rung& rung : curve.rungs) split_errors(scene.reference, rung);
        measure_blocks(scene.reference, curves[analysis.yardstick], curve);
        if (curve.method->biased || curve.method->peer_script)
            curve.bias_map = bias_map(scene.reference, curve.rungs.back());
        else
            curve.z_test = z_test(scene.reference, curve);
        uint64_t dropped = 0;
        for (const Rung& rung : curve.rungs)
            for (const RunRecord* run : rung.runs) dropped += run->non_finite_samples;
        if (dropped)
            analysis.warnings.push_back(fmt::format("{}: {} samples of {} were not finite",
                                                    scene.name, dropped, curve.method->name));
        if (curve.z_test && curve.z_test->p < 1e-3)
            analysis.warnings.push_back(fmt::format(
                "{}: {} differs from the reference by more than noise (largest |z| {:.1f}, p = "
                "{:.1g})",
                scene.name, curve.method->name, curve.z_test->largest_z, curve.z_test->p));
    }
    analysis.comparisons = compare(curves, analysis.yardstick);
    for (const PeerReference& peer : scene.peer_references) {
        const Agreement a = agreement_of(scene.reference, peer, curves);
        if (a.test.p < 1e-3)
            analysis.warnings.push_back(fmt::format(
                "{}: {} and Wedge differ by more than noise (largest |z| {:.1f}, p = {:.1g})",
                scene.name, a.version, a.test.largest_z, a.test.p));
        analysis.agreements.push_back(a);
    }
    check_reference(analysis);
    return analysis;
}

}  // namespace wedge::converge
