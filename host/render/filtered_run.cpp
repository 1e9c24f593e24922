#include "host/render/filtered_run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/render/error_estimate.hpp"
#include "host/render/filter_settings.hpp"
#include "host/render/stages.hpp"
#include "host/render/told_error.hpp"

namespace wedge::rendering {
namespace {

constexpr float kFirstMu = 0.25f;
constexpr float kLeastMu = 1.0f / 64;  // asks for hardly more than the probe
// A given mu from this one on is measured twice: what a few samples happen to meet decides much.
constexpr float kLooksTwiceFrom = 2, kFirstLookMu = 1;
// Before they have run once: bandwidth and filters take as long as so many samples of every pixel,
// two to eight by scene.
constexpr double kFiltersInSamples = 5;
// From round to round; the error goes with 1 / mu at best.
constexpr double kLargestStep = 2, kSmallestStep = 1.08;

uint64_t samples_to_come(std::span<const shared::SampleEnds> ends) {
    uint64_t count = 0;
    for (const shared::SampleEnds& e : ends)
        count += e.paths - e.paths_before + e.camera_rays -
                 std::min(e.camera_rays, std::max(e.camera_rays_before, e.paths));
    return count;
}

/// Where the number of samples is limited, filters may not become so narrow that they need more.
float last_mu(const RenderOptions& options) {
    if (options.mu) return *options.mu;
    if (!goes_in_rounds(options)) return kDefaultMu;
    if (!options.samples_per_pixel) return kLargestMu;
    return std::clamp(float(*options.samples_per_pixel) / kSamplesPerMu, kDefaultMu, kLargestMu);
}

class FilteredRun {
  public:
    FilteredRun(const Scene& scene, const RenderOptions& options, SamplingLoop& loop,
                PathTracer& tracer, SignalFilter& filter, RenderStats& stats)
        : scene_(scene),
          options_(options),
          loop_(loop),
          tracer_(tracer),
          filter_(filter),
          stats_(stats) {}

    /// False if it was stopped before all samples were there.
    bool run() {
        const float last = last_mu(options_);
        float mu = first_mu(last);
        if (!probe(mu)) return end_early(mu);
        measure(mu);
        while (goes_in_rounds(options_) && !fits_in_time() && mu > kLeastMu) measure(mu /= 2);
        bool complete = sample(goes_in_rounds(options_) ? 1 : last / mu);
        while (complete && mu < last && !loop_.must_stop()) {
            const float next = goes_in_rounds(options_) ? next_mu(mu, last) : look_again(last);
            if (next == mu) break;
            mu = next;
            complete = sample();
        }
        if (!filtered_) filter();
        stats_.mu = mu;
        return complete;
    }

  private:
    void set_mu(float mu) {
        settings_ = make_filter_settings(scene_, options_, mu);
        filter_.set_settings(settings_);
        filtered_ = false;
    }

    float first_mu(float last) const {
        if (goes_in_rounds(options_)) return std::min(kFirstMu, last);
        return options_.adaptive && last >= kLooksTwiceFrom ? kFirstLookMu : last;
    }

    float look_again(float mu) {
        measure(mu);
        return mu;
    }

    /// False if it was stopped.
    bool probe(float mu) {
        set_mu(mu);
        const auto probes = uint32_t(settings_.probe_samples);
        const double before_s = loop_.elapsed_s();
        // How many samples there will be is known only afterwards; until then progress guesses.
        loop_.keep_time_for(kFiltersInSamples + kSampleBatch);
        const bool complete =
            loop_.run("probe", 0, probes, 4 * probes * filter_.pixel_count(), true);
        loop_.keep_time_for(0);
        sampling_s_ += loop_.elapsed_s() - before_s;
        ends_.assign(filter_.pixel_count(), {probes, probes, probes, probes});
        filter_.write_sample_ends(ends_);
        return complete;
    }

    /// With a part of the probe. Where time ended it, all pixels have as many samples.
    bool end_early(float mu) {
        measure(goes_in_rounds(options_) ? std::min(kLeastMu, mu) : mu);
        filter();
        stats_.mu = settings_.mu;
        return !stats_.interrupted;
    }

    /// Widths and counts; samples so far stay as they are.
    void measure(float mu) {
        set_mu(mu);
        loop_.add_pass("bandwidth", filter_.measure_bandwidth());
        ends_ = filter_.read_sample_ends();
    }

    /// Brings all pixels to the counts that were measured. False if it was stopped. `more`: how
    /// many times as many there may be in the end, which progress goes by.
    bool sample(float more = 1) {
        const double before_s = loop_.elapsed_s();
        const uint64_t to_come = uint64_t(more * double(samples_to_come(ends_)));
        const uint64_t total = loop_.samples_of_band() + to_come;
        bool complete = true;
        for (const Stage& stage : cut_into_stages(ends_, uint32_t(settings_.probe_samples))) {
            filter_.write_pixel_list(stage.pixels);
            complete = loop_.run("adaptive", stage.first, stage.end, total, false,
                                 uint32_t(stage.pixels.size()));
            if (!complete) break;
        }
        sampling_s_ += loop_.elapsed_s() - before_s;
        for (shared::SampleEnds& e : ends_) {
            e.paths_before = e.paths;
            e.camera_rays_before = e.camera_rays;
        }
        filter_.write_sample_ends(ends_);
        return complete;
    }

    void filter() {
        const double before_s = loop_.elapsed_s();
        loop_.add_pass("filter", filter_.filter());
        filter_s_ = loop_.elapsed_s() - before_s;
        filtered_ = true;
    }

    /// Measured; `mu` itself if that is the end.
    float next_mu(float mu, float last) {
        bool measured = false;
        for (double step = next_step(); step >= kSmallestStep; step = std::sqrt(step)) {
            const float next = std::min(float(mu * step), last);
            measure(next);
            measured = true;
            if (fits_in_time()) return next;
        }
        if (measured) measure(mu);
        return mu;
    }

    /// By what mu may be raised; below kSmallestStep: not at all.
    double next_step() {
        double step = kLargestStep;
        if (options_.target_error) step = std::min(step, step_to_target());
        if (options_.time_limit_s) {
            if (!filter_s_) filter();  // to know how long that takes
            step = std::min(step, std::sqrt(1 + std::max(time_left_s(), 0.0) / sampling_s_));
        }
        return step;
    }

    double step_to_target() {
        if (!filtered_) filter();
        const EstimatedError error = estimate();
        const double missing = options_.target_metric == ErrorMetric::rmse
                                   ? error.rmse / *options_.target_error
                                   : std::sqrt(error.rel_mse / *options_.target_error);
        return missing > 1 ? std::max(missing, kSmallestStep) : 0;
    }

    EstimatedError estimate() {
        std::vector<shared::FilmPixel> film = tracer_.read_film();
        const FilteredLight light = filter_.read_light();
        replace_unfiltered(film, light);
        return estimate_of_filtered(film,
                                    told_errors(light.guarded, std::size_t(tracer_.crop().width)));
    }

    /// Before the last filter.
    double time_left_s() const {
        return *options_.time_limit_s - loop_.elapsed_s() -
               filter_s_.value_or(kFiltersInSamples * loop_.sample_s());
    }

    bool fits_in_time() const {
        if (!options_.time_limit_s) return true;
        const double sample_s = sampling_s_ / double(loop_.samples_done());
        return double(samples_to_come(ends_)) * sample_s <= time_left_s();
    }

    const Scene& scene_;
    const RenderOptions& options_;
    SamplingLoop& loop_;
    PathTracer& tracer_;
    SignalFilter& filter_;
    RenderStats& stats_;
    shared::FilterSettings settings_{};
    std::vector<shared::SampleEnds> ends_;
    bool filtered_ = false;  ///< all samples there are
    std::optional<double> filter_s_;
    double sampling_s_ = 0;
};

}  // namespace

bool run_filtered(const Scene& scene, const RenderOptions& options, SamplingLoop& loop,
                  PathTracer& tracer, SignalFilter& filter, RenderStats& stats) {
    return FilteredRun(scene, options, loop, tracer, filter, stats).run();
}

void replace_unfiltered(std::vector<shared::FilmPixel>& film, const FilteredLight& light) {
    const auto replace = [](shared::float4& sum, const shared::float4* before,
                            const shared::float4& after, float samples) {
        sum.x += after.x * samples - (before[0].x + before[1].x);
        sum.y += after.y * samples - (before[0].y + before[1].y);
        sum.z += after.z * samples - (before[0].z + before[1].z);
    };
    for (std::size_t i = 0; i < light.guarded.size(); ++i) {
        const float samples = film[i].direct.w;
        replace(film[i].direct, light.unfiltered[i].direct, light.guarded[i].direct, samples);
        replace(film[i].indirect, light.unfiltered[i].indirect, light.guarded[i].indirect, samples);
    }
}

}  // namespace wedge::rendering
