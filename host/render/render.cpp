#include "wedge/render.hpp"

#include <fmt/format.h>

#include <optional>

#include "host/device/self_test.hpp"
#include "host/render/bands.hpp"
#include "host/render/error_estimate.hpp"
#include "host/render/film_image.hpp"
#include "host/render/filter_layers.hpp"
#include "host/render/filter_settings.hpp"
#include "host/render/filtered_run.hpp"
#include "host/render/path_tracer.hpp"
#include "host/render/progressive.hpp"
#include "host/render/render_settings.hpp"
#include "host/render/sampling_loop.hpp"
#include "host/render/signal_filter.hpp"
#include "host/render/told_error.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge {
namespace {

using namespace rendering;

void count_film(const std::vector<shared::FilmPixel>& film, const Rect& crop, uint64_t seed,
                RenderStats& stats) {
    constexpr std::size_t kNamed = 4;
    std::vector<std::string> places;
    uint64_t dropped = 0;
    for (std::size_t i = 0; i < film.size(); ++i) {
        const shared::FilmPixel& p = film[i];
        stats.samples += uint64_t(p.direct.w) + uint64_t(p.square.w);
        stats.rays += uint64_t(p.indirect.w);
        dropped += uint64_t(p.square.w);
        if (p.square.w > 0 && places.size() < kNamed)
            places.push_back(
                fmt::format("{},{}", crop.x + int(i % crop.width), crop.y + int(i / crop.width)));
    }
    stats.non_finite_samples += dropped;
    if (dropped > 0)
        log_warning(
            fmt::format("{} samples were not finite and have been dropped, first at pixel {}, seed "
                        "{}; look at one with --pixel X,Y",
                        dropped, fmt::join(places, " and "), seed));
}

void add_metadata(Image& image, const Scene& scene, const RenderOptions& options,
                  const RenderStats& stats, const PathSettings& settings) {
    auto& m = image.metadata;
    m["wedge:scene"] = scene.name;
    m["wedge:device"] = stats.device.name;
    m["wedge:driver"] = stats.device.driver;
    m["wedge:version"] = version();
    m["wedge:method"] = to_string(options.method);
    if (stats.mu > 0) m["wedge:mu"] = fmt::format("{:g}", stats.mu);
    if (options.method == Method::aaf) {
        m["wedge:filter"] = to_string(options.filter);
        m["wedge:adaptive"] = options.adaptive ? "yes" : "no";
    }
    m["wedge:sampler"] = to_string(settings.sampler);
    m["wedge:seed"] = std::to_string(options.seed);
    m["wedge:bounces"] = std::to_string(settings.bounces);
    m["wedge:sampleOffset"] = std::to_string(options.sample_offset);
    m["wedge:samples"] = std::to_string(stats.samples);
    m["wedge:rays"] = std::to_string(stats.rays);
    m["wedge:renderSeconds"] = fmt::format("{:.6g}", stats.render_s);
}

void check_local_size(const device::Device& device, uint32_t local_size) {
    const auto largest = device.handle().getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    if (local_size > largest)
        throw Error(ErrorKind::usage, fmt::format("the local size must be at most {} on {}, got {}",
                                                  largest, device.info().name, local_size));
}

/// Takes the pixels of a band that is done into the image.
void finish_band(PathTracer& tracer, const RenderOptions& options, Frame& frame) {
    const std::vector<shared::FilmPixel> film = tracer.read_film();
    count_film(film, tracer.crop(), options.seed, frame.stats);
    write_film(film, tracer.crop(), frame.image);
}

/// Path tracing alone, band by band; the last one is left on the device.
void run_plain(const Scene& scene, const RenderOptions& options, const std::vector<Rect>& bands,
               SamplingLoop& loop, PathTracer& tracer, Frame& frame) {
    const uint32_t first = options.sample_offset, samples = sample_count(scene, options);
    if (estimates_error(options, bands.size()))
        return run_progressively(options, first, samples, loop, tracer, frame.stats);
    uint64_t pixels = 0;
    for (const Rect& band : bands) pixels += uint64_t(band.width) * uint64_t(band.height);
    for (std::size_t band = 0; band < bands.size(); ++band) {
        if (band > 0) {
            finish_band(tracer, options, frame);
            tracer.move_to(bands[band]);
        }
        if (!loop.run("trace_paths", first, first + samples, samples * pixels)) return;
    }
}

/// Takes what is on the device, and what filters have made of it, into the image. `complete`: all
/// of it is filtered.
void finish_frame(PathTracer& tracer, const RenderOptions& options, const FilteredLight& filtered,
                  bool complete, Frame& frame) {
    std::vector<shared::FilmPixel> film = tracer.read_film();
    count_film(film, tracer.crop(), options.seed, frame.stats);
    write_film(film, tracer.crop(), frame.image);  // variances, too, are of what was sampled
    if (filtered.guarded.empty()) return;
    const std::vector<Vec3> errors =
        told_errors(filtered.guarded, std::size_t(tracer.crop().width));
    const std::vector<NamedChannel> layers = filter_layers(filtered, film, errors);
    replace_unfiltered(film, filtered);
    if (complete) frame.stats.estimated_error = estimate_of_filtered(film, errors);
    write_light(film, tracer.crop(), frame.image);
    add_channels(frame.image, layers, tracer.crop());
}

}  // namespace

const char* version() {
    return WEDGE_VERSION;
}

Frame render(const Scene& scene, const RenderOptions& options) {
    PathSettings settings = make_path_settings(scene, options);
    device::Device device(options.device);
    check_local_size(device, options.local_size);
    device::self_test(device, settings.kernel_dir);

    Frame frame;
    frame.stats.device = device.info();
    const Plan plan = make_plan(scene, options.method, settings.bounces);
    const std::vector<Rect> bands = cut_into_bands(settings.crop, options, device.info());
    settings.crop = bands[0];
    PathTracer tracer(device, scene, settings, plan, frame.stats);
    std::optional<SignalFilter> filter;
    if (plan.signals > 0)
        filter.emplace(device, tracer, plan, settings.crop,
                       make_filter_settings(scene, options, options.mu.value_or(kDefaultMu)),
                       settings.kernel_dir, frame.stats);
    std::optional<Checkpoints> checkpoints;
    if (!options.resume_file.empty())
        checkpoints.emplace(scene, options, settings, frame.stats, tracer);
    SamplingLoop loop(options, tracer, frame.stats);
    const CpuStopwatch cpu_watch;
    FilteredLight filtered;
    bool complete = false;  // what is filtered
    frame.image = black_image(scene.film);
    // For all methods alike, what is read back at the end is not rendering.
    const auto note_times = [&] {
        frame.stats.render_s = loop.elapsed_s();
        frame.stats.render_cpu_s = cpu_watch.total();
    };
    try {
        if (checkpoints) loop.keep(*checkpoints);
        if (filter)
            complete = run_filtered(scene, options, loop, tracer, *filter, frame.stats);
        else
            run_plain(scene, options, bands, loop, tracer, frame);
        note_times();
        if (filter) {
            filtered = filter->read_light();
            filter->read_layers(filtered);
        }
    } catch (const Error& error) {
        // What was traced before may still be there; only if it is not, nothing can be saved.
        if (error.kind() != ErrorKind::device || !loop.has_samples()) throw;
        note_times();
        frame.stats.failure = error.what();
        complete = false;
        frame.stats.mu = 0;
        filtered = {};
    }
    finish_frame(tracer, options, filtered, complete, frame);
    add_metadata(frame.image, scene, options, frame.stats, settings);
    return frame;
}

}  // namespace wedge
