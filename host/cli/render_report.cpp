#include "host/cli/render_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/cli/messages.hpp"
#include "host/cli/text.hpp"
#include "wedge/log.hpp"

namespace wedge::cli {
namespace {

// Only the pixels of the crop are rendered.
double rendered_pixels(const Scene& scene, const RenderOptions& options) {
    if (options.crop) return double(options.crop->width) * options.crop->height;
    return double(scene.film.width) * scene.film.height;
}

std::string programs(const RenderStats& stats) {
    return fmt::format("{} compiled, {} from cache", stats.programs_compiled,
                       stats.programs_from_cache);
}

}  // namespace

Outcome judge(const Scene& scene, const RenderOptions& options, const RenderStats& stats) {
    Outcome outcome;
    outcome.samples_per_pixel = double(stats.samples) / rendered_pixels(scene, options);
    outcome.samples_per_pixel_asked =
        options.samples_per_pixel.value_or(scene.defaults.samples_per_pixel);
    outcome.is_short = !stats.interrupted && !options.time_limit_s &&
                       outcome.samples_per_pixel < outcome.samples_per_pixel_asked;
    return outcome;
}

std::string stats_json(const RenderStats& stats, const Outcome& outcome, const std::string& scene,
                       double load_s) {
    auto json = nlohmann::ordered_json::parse(stats_to_json(stats));
    json["scene"] = scene;
    json["load_s"] = load_s;
    json["samples_per_pixel"] = outcome.samples_per_pixel;
    return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void report(const RenderStats& stats, const Outcome& outcome, const Scene& scene,
            const RenderOptions& options, double load_s) {
    const double rate = stats.render_s > 0 ? double(stats.rays) / stats.render_s : 0;
    say(fmt::format("{} {}x{} px, {:.4g} samples per pixel, in {} on {}",
                    stats.interrupted ? "stopped: saved" : "rendered", scene.film.width,
                    scene.film.height, outcome.samples_per_pixel, text_of_seconds(stats.render_s),
                    stats.device.name));
    if (options.crop)
        say(fmt::format("  of these the {}x{} px of the crop", options.crop->width,
                        options.crop->height));
    say(fmt::format("  {} rays, {} rays/s; {} triangles, {} on the device",
                    text_of_count(double(stats.rays)), text_of_count(rate),
                    text_of_number(stats.triangles), text_of_bytes(stats.device_bytes)));
    say(fmt::format("  scene {}, BVH {}, kernels {} ({}), render {}", text_of_seconds(load_s),
                    text_of_seconds(stats.flatten_s + stats.bvh_build_s + stats.upload_s),
                    text_of_seconds(stats.compile_s), programs(stats),
                    text_of_seconds(stats.render_s)));
    if (stats.non_finite_samples > 0)
        log_warning(
            fmt::format("{} samples were not finite and were left out; `--pixel X,Y` replays "
                        "one pixel",
                        text_of_number(stats.non_finite_samples)));
}

}  // namespace wedge::cli
