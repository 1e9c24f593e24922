#include "host/render/filtered_run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/render/error_estimate.hpp"
#include "host/render/stages.hpp"
#include "host/render/told_error.hpp"

namespace wedge::rendering {
namespace {

constexpr float kFirstMu = 0.25f;
constexpr float kLargestMu = 10000;  // with 100 samples for each, what a film can count
// From round to round. Samples go with the square of mu at most, the error with its inverse.
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

    void run() {
        const float last = last_mu(options_);
        float mu = goes_in_rounds(options_) ? std::min(kFirstMu, last) : last;
        bool goes_on = probe(mu);
        while (goes_on && sample(mu) && mu < last) {
            const double step = next_step();
            goes_on = step >= kSmallestStep;
            if (goes_on) mu = std::min(float(mu * step), last);
        }
        if (!filtered_) filter();
    }

  private:
    void set_mu(float mu) {
        settings_ = make_filter_settings(scene_, options_, mu);
        filter_.set_settings(settings_);
        stats_.mu = mu;
        filtered_ = false;
    }

    /// False if it was stopped, as below.
    bool probe(float mu) {
        set_mu(mu);
        const auto probes = uint32_t(settings_.probe_samples);
        // How many samples there will be is known only afterwards; until then progress guesses.
        if (loop_.run("probe", 0, probes, 4 * probes * filter_.pixel_count(), true)) return true;
        loop_.add_pass("bandwidth", filter_.measure_bandwidth(false));
        return false;
    }

    /// Brings all pixels to what `mu` asks for.
    bool sample(float mu) {
        set_mu(mu);
        loop_.add_pass("bandwidth", filter_.measure_bandwidth(true));
        const std::vector<shared::SampleEnds> ends = filter_.read_sample_ends();
        const uint64_t total = loop_.samples_done() + samples_to_come(ends);
        for (const Stage& stage : cut_into_stages(ends, uint32_t(settings_.probe_samples))) {
            filter_.write_pixel_list(stage.pixels);
            if (!loop_.run("adaptive", stage.first, stage.end, total, false,
                           uint32_t(stage.pixels.size())))
                return false;
        }
        return true;
    }

    void filter() {
        const double before_s = loop_.elapsed_s();
        loop_.add_pass("filter", filter_.filter());
        filter_s_ = loop_.elapsed_s() - before_s;
        other_s_ += *filter_s_;
        filtered_ = true;
    }

    /// By what mu may be raised; below kSmallestStep: not at all.
    double next_step() {
        double step = kLargestStep;
        if (options_.target_error) step = std::min(step, step_to_target());
        if (options_.time_limit_s) step = std::min(step, step_in_time());
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
        const double before_s = loop_.elapsed_s();
        std::vector<shared::FilmPixel> film = tracer_.read_film();
        const FilteredLight light = filter_.read_light();
        replace_unfiltered(film, light);
        const EstimatedError error = estimate_of_filtered(
            film, told_errors(light.guarded, std::size_t(tracer_.crop().width)));
        other_s_ += loop_.elapsed_s() - before_s;
        return error;
    }

    /// What is left must also do for the last filter.
    double step_in_time() {
        if (!filter_s_) filter();
        const double spent = loop_.elapsed_s();
        const double left = *options_.time_limit_s - spent - *filter_s_;
        const double sampling = spent - other_s_;
        return left > 0 && sampling > 0 ? std::sqrt(1 + left / sampling) : 1;
    }

    const Scene& scene_;
    const RenderOptions& options_;
    SamplingLoop& loop_;
    PathTracer& tracer_;
    SignalFilter& filter_;
    RenderStats& stats_;
    shared::FilterSettings settings_{};
    bool filtered_ = false;  ///< all samples there are
    std::optional<double> filter_s_;
    double other_s_ = 0;  ///< spent neither on samples nor on bandwidths
};

}  // namespace

void run_filtered(const Scene& scene, const RenderOptions& options, SamplingLoop& loop,
                  PathTracer& tracer, SignalFilter& filter, RenderStats& stats) {
    FilteredRun(scene, options, loop, tracer, filter, stats).run();
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
