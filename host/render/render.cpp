#include "wedge/render.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "host/device/self_test.hpp"
#include "host/render/bands.hpp"
#include "host/render/film_image.hpp"
#include "host/render/filter_settings.hpp"
#include "host/render/filtered_run.hpp"
#include "host/render/finished_band.hpp"
#include "host/render/path_tracer.hpp"
#include "host/render/progressive.hpp"
#include "host/render/render_settings.hpp"
#include "host/render/sampling_loop.hpp"
#include "host/render/signal_filter.hpp"
#include "wedge/error.hpp"

namespace wedge {
namespace {

using namespace rendering;

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

/// A frame from its scene, band by band.
class FrameRun {
  public:
    FrameRun(const Scene& scene, const RenderOptions& options, const PathSettings& settings,
             device::Device& device, Frame& frame)
        : scene_(scene),
          options_(options),
          device_(device),
          frame_(frame),
          plan_(make_plan(scene, options.method, settings.bounces)),
          bands_(
              cut_into_bands(settings.crop, options, device.info(), band_needs(plan_, scene.film))),
          settings_(with_crop(settings, bands_[0].rendered)),
          tracer_(device, scene, settings_, plan_, frame.stats),
          scene_bytes_(frame.stats.device_bytes) {
        make_filter();
        if (!options.resume_file.empty())
            checkpoints_.emplace(scene, options, settings_, frame.stats, tracer_);
    }

    void run() {
        loop_.emplace(options_, tracer_, frame_.stats);
        const CpuStopwatch cpu_watch;
        // For all methods alike, what is read back at the end is not rendering.
        const auto note_times = [&] {
            frame_.stats.render_s = loop_->elapsed_s();
            frame_.stats.render_cpu_s = cpu_watch.total();
        };
        try {
            if (checkpoints_) loop_->keep(*checkpoints_);
            if (filter_)
                run_with_filters();
            else
                run_plain();
            note_times();
            if (filter_) read_filtered();
        } catch (const Error& error) {
            // What was traced before may still be there; only if it is not, nothing can be saved.
            if (error.kind() != ErrorKind::device || !loop_->has_samples()) throw;
            note_times();
            frame_.stats.failure = error.what();
            complete_ = false;
            frame_.stats.mu = 0;
            filtered_ = {};
        }
        finish();
        // Bands that were finished before it was stopped do not tell that of the frame.
        if (plan_.signals > 0 && !complete_) frame_.stats.estimated_error.reset();
    }

  private:
    static PathSettings with_crop(PathSettings settings, const Rect& crop) {
        settings.crop = crop;
        return settings;
    }

    /// Of the band that is on the device. What is told of memory is the most that there is at once,
    /// of programs what the first band takes.
    void make_filter() {
        if (plan_.signals == 0) return;
        const auto settings =
            make_filter_settings(scene_, options_, options_.mu.value_or(kDefaultMu));
        const RenderStats so_far = frame_.stats;
        const uint64_t before = device_.allocated_bytes();
        filter_.emplace(device_, tracer_, plan_, tracer_.crop(), settings, settings_.kernel_dir,
                        frame_.stats);
        const uint64_t bytes = scene_bytes_ + device_.allocated_bytes() - before;
        frame_.stats.device_bytes = std::max(so_far.device_bytes, bytes);
        if (band_ == 0) return;
        frame_.stats.programs_compiled = so_far.programs_compiled;
        frame_.stats.programs_from_cache = so_far.programs_from_cache;
    }

    /// All bands; the last one is left on the device.
    void run_plain() {
        const uint32_t first = options_.sample_offset, samples = sample_count(scene_, options_);
        if (estimates_error(options_, bands_.size()))
            return run_progressively(options_, first, samples, *loop_, tracer_, frame_.stats);
        for (;;) {
            loop_->begin_band(bands_to_come());
            if (!loop_->run("trace_paths", first, first + samples,
                            uint64_t(samples) * tracer_.pixel_count()))
                return;
            if (band_ + 1 == bands_.size()) return;
            go_on();
        }
    }

    /// The same.
    void run_with_filters() {
        for (;;) {
            loop_->begin_band(bands_to_come());
            complete_ = run_filtered(scene_, options_, *loop_, tracer_, *filter_, frame_.stats);
            if (!complete_ || band_ + 1 == bands_.size()) return;
            read_filtered();
            filter_.reset();  // there may be no room for two
            go_on();
            make_filter();
        }
    }

    /// Over the band that is on the device.
    double bands_to_come() const {
        double rows = 0;
        for (std::size_t i = band_ + 1; i < bands_.size(); ++i) rows += bands_[i].rendered.height;
        return rows / bands_[band_].rendered.height;
    }

    void read_filtered() {
        filtered_ = filter_->read_light();
        filter_->read_layers(filtered_);
    }

    void go_on() {
        finish();
        band_ += 1;
        tracer_.move_to(bands_[band_].rendered);
    }

    void finish() {
        const Band& band = bands_[band_];
        const auto rows_before = uint64_t(band.kept.y - bands_[0].kept.y);
        finish_band(tracer_, options_, band, filtered_, complete_,
                    rows_before * uint64_t(band.kept.width), frame_);
        filtered_ = {};
    }

    const Scene& scene_;
    const RenderOptions& options_;
    device::Device& device_;
    Frame& frame_;
    const Plan plan_;
    const std::vector<Band> bands_;
    const PathSettings settings_;  ///< of the first band
    PathTracer tracer_;
    std::size_t band_ = 0;        ///< that is on the device
    const uint64_t scene_bytes_;  ///< with the first band's film
    std::optional<SignalFilter> filter_;
    std::optional<Checkpoints> checkpoints_;
    std::optional<SamplingLoop> loop_;  ///< time begins with it
    FilteredLight filtered_;            ///< of it
    bool complete_ = false;             ///< it is all filtered
};

}  // namespace

const char* version() {
    return WEDGE_VERSION;
}

Frame render(const Scene& scene, const RenderOptions& options) {
    const PathSettings settings = make_path_settings(scene, options);
    device::Device device(options.device);
    check_local_size(device, options.local_size);
    device::self_test(device, settings.kernel_dir);

    Frame frame;
    frame.stats.device = device.info();
    frame.image = black_image(scene.film);
    FrameRun(scene, options, settings, device, frame).run();
    add_metadata(frame.image, scene, options, frame.stats, settings);
    return frame;
}

}  // namespace wedge
