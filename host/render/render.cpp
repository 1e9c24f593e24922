#include "wedge/render.hpp"

#include <fmt/format.h>

#include <bit>

#include "host/base/stopwatch.hpp"
#include "host/device/self_test.hpp"
#include "host/render/film_image.hpp"
#include "host/render/path_tracer.hpp"
#include "host/render/render_settings.hpp"
#include "host/render/schedule.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge {
namespace {

using namespace rendering;

struct Loop {
    const RenderOptions& options;
    PathTracer& tracer;
    RenderStats& stats;
    Stopwatch watch{};
    uint64_t done = 0, total = 0;

    bool must_stop(const Schedule& schedule) {
        if (options.stop && options.stop->load()) {
            stats.interrupted = true;
            return true;
        }
        return options.time_limit_s && schedule.at_pass_end() && done > 0 &&
               watch.total() >= *options.time_limit_s;
    }

    void run(uint32_t samples) {
        Schedule schedule(tracer.pixel_count(), options.sample_offset, samples,
                          options.tile_pixels);
        total = uint64_t(samples) * tracer.pixel_count();
        PassStats pass{"trace_paths", 0, 0};
        while (!must_stop(schedule)) {
            const std::optional<Work> work = schedule.next();
            if (!work) break;
            const double seconds = tracer.add_samples(*work);
            schedule.measured(seconds);
            pass.device_s += seconds;
            pass.launches += 1;
            done += uint64_t(work->pixel_count) * work->sample_count;
            if (options.on_progress) options.on_progress({done, total, watch.total()});
        }
        stats.passes.push_back(pass);
        stats.render_s = watch.total();
    }
};

void count_film(const std::vector<shared::FilmPixel>& film, const Rect& crop, RenderStats& stats) {
    constexpr std::size_t kNamed = 4;
    std::vector<std::string> places;
    for (std::size_t i = 0; i < film.size(); ++i) {
        const shared::FilmPixel& p = film[i];
        stats.samples += uint64_t(p.direct.w) + uint64_t(p.square.w);
        stats.rays += uint64_t(p.indirect.w);
        stats.non_finite_samples += uint64_t(p.square.w);
        if (p.square.w > 0 && places.size() < kNamed)
            places.push_back(
                fmt::format("{},{}", crop.x + int(i % crop.width), crop.y + int(i / crop.width)));
    }
    if (stats.non_finite_samples > 0)
        log_warning(
            fmt::format("{} samples were not finite and have been dropped, first at pixel {}; "
                        "look at one with --pixel X,Y",
                        stats.non_finite_samples, fmt::join(places, " and ")));
}

void add_metadata(Image& image, const Scene& scene, const RenderOptions& options,
                  const RenderStats& stats, const PathSettings& settings) {
    auto& m = image.metadata;
    m["wedge:scene"] = scene.name;
    m["wedge:device"] = stats.device.name;
    m["wedge:driver"] = stats.device.driver;
    m["wedge:version"] = version();
    m["wedge:method"] = "mc";
    m["wedge:sampler"] = settings.sampler == Sampler::sobol ? "sobol" : "hash";
    m["wedge:seed"] = std::to_string(options.seed);
    m["wedge:bounces"] = std::to_string(settings.bounces);
    m["wedge:sampleOffset"] = std::to_string(options.sample_offset);
    m["wedge:samples"] = std::to_string(stats.samples);
    m["wedge:rays"] = std::to_string(stats.rays);
    m["wedge:renderSeconds"] = fmt::format("{:.6g}", stats.render_s);
}

}  // namespace

const char* version() {
    return WEDGE_VERSION;
}

Frame render(const Scene& scene, const RenderOptions& options) {
    const PathSettings settings = rendering::make_path_settings(scene, options);
    device::Device device(options.device);
    device::self_test(device);

    Frame frame;
    frame.stats.device = device.info();
    PathTracer tracer(device, scene, settings, frame.stats);
    Loop loop{options, tracer, frame.stats};
    try {
        loop.run(rendering::sample_count(scene, options));
    } catch (const Error& error) {
        // What was traced before may still be there; only if it is not, nothing can be saved.
        if (error.kind() != ErrorKind::device || loop.done == 0) throw;
        frame.stats.failure = error.what();
        frame.stats.render_s = loop.watch.total();
    }
    const std::vector<shared::FilmPixel> film = tracer.read_film();
    count_film(film, settings.crop, frame.stats);
    frame.image = film_to_image(film, scene.film, settings.crop);
    add_metadata(frame.image, scene, options, frame.stats, settings);
    return frame;
}

}  // namespace wedge
