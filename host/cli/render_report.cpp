#include "host/cli/render_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/messages.hpp"
#include "host/cli/text.hpp"

namespace wedge::cli {
namespace {

std::string headline(const RenderStats& stats) {
    if (stats.interrupted) return "stopped early, saved";
    return stats.failure.empty() ? "rendered" : "failed early, saved";
}

bool misses_target(const EstimatedError& error, const RenderOptions& options) {
    const bool rmse = options.target_metric == ErrorMetric::rmse;
    return options.target_error && (rmse ? error.rmse : error.rel_mse) > *options.target_error;
}

std::string missed_target(const RenderOptions& options) {
    return fmt::format(
        "; the target, {} {:.3g}, was not reached: raise what ended it, --spp, --mu or --time",
        options.target_metric == ErrorMetric::rmse ? "RMSE" : "relMSE", *options.target_error);
}

}  // namespace

double samples_per_pixel(const RenderStats& stats, const Scene& scene,
                         const RenderOptions& options) {
    const int width = options.crop ? options.crop->width : scene.film.width;
    const int height = options.crop ? options.crop->height : scene.film.height;
    return double(stats.samples) / (double(width) * height);
}

std::string stats_json(const RenderStats& stats, const Scene& scene, const RenderOptions& options,
                       const std::string& scene_file, double load_s) {
    auto json = nlohmann::ordered_json::parse(stats_to_json(stats));
    json["scene"] = scene_file;
    json["load_s"] = load_s;
    json["samples_per_pixel"] = samples_per_pixel(stats, scene, options);
    return json.dump(4, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void report(const RenderStats& stats, const Scene& scene, const RenderOptions& options,
            double load_s) {
    const double rate = stats.render_s > 0 ? double(stats.rays) / stats.render_s : 0;
    const std::string crop =
        options.crop ? fmt::format(" (of these {}x{})", options.crop->width, options.crop->height)
                     : "";
    say(fmt::format("{} {}x{} px{}, {:.4g} samples per pixel, in {} on {}", headline(stats),
                    scene.film.width, scene.film.height, crop,
                    samples_per_pixel(stats, scene, options), text_of_seconds(stats.render_s),
                    stats.device.name));
    say(fmt::format("  {} rays, {} rays/s; {} triangles, {} on the device",
                    text_of_count(double(stats.rays)), text_of_count(rate),
                    text_of_number(stats.triangles), text_of_bytes(stats.device_bytes)));
    if (stats.mu > 0)
        say(fmt::format("  {} with mu {:.3g}",
                        options.filter == FilterMode::none ? "sampled, not filtered," : "filtered",
                        stats.mu));
    if (const auto& error = stats.estimated_error)
        say(fmt::format("  estimated error: RMSE {:.3g}, relMSE {:.3g}{}", error->rmse,
                        error->rel_mse,
                        misses_target(*error, options) ? missed_target(options) : ""));
    say(fmt::format(
        "  scene {}, BVH {}, upload {}, kernels {} ({} given to the driver, {} from cache), render "
        "{}",
        text_of_seconds(load_s), text_of_seconds(stats.flatten_s + stats.bvh_build_s),
        text_of_seconds(stats.upload_s), text_of_seconds(stats.compile_s), stats.programs_compiled,
        stats.programs_from_cache, text_of_seconds(stats.render_s)));
}

}  // namespace wedge::cli
