// Launch after launch, until all samples are there or somebody says stop.
#pragma once

#include <optional>

#include "host/base/stopwatch.hpp"
#include "host/render/path_tracer.hpp"
#include "host/render/resume.hpp"
#include "wedge/render.hpp"

namespace wedge::rendering {

class SamplingLoop {
  public:
    SamplingLoop(const RenderOptions& options, PathTracer& tracer, RenderStats& stats)
        : options_(options), tracer_(tracer), stats_(stats) {}

    /// From now on states are saved, and the next run goes on from the one found.
    void keep(Checkpoints& checkpoints) { checkpoints_ = &checkpoints; }

    /// Brings all pixels from sample `first` to `end`, as a pass of that name in the statistics.
    /// `total`: pixel samples of the whole render, or from begin_band() on, for progress. False if
    /// it was stopped. `pixels`: of a list, if not all.
    bool run(const char* name, uint32_t first, uint32_t end, uint64_t total, bool probing = false,
             std::optional<uint32_t> pixels = {});

    /// Adds to the statistics of the pass of that name; bands of a film, or rounds, are one.
    void add_pass(const char* name, double device_s, uint64_t launches = 1);

    bool has_samples() const { return done_ > 0; }
    uint64_t samples_done() const { return done_; }  ///< pixel samples
    uint64_t samples_of_band() const { return done_ - before_band_; }
    double elapsed_s() const { return watch_.total(); }

    /// What is rendered from now on is a band of a film, of which so many times as much is to come;
    /// for progress, which counts `total` of run() from here.
    void begin_band(double more_to_come) {
        before_band_ = done_;
        more_to_come_ = more_to_come;
    }

    /// Time is over as soon as there is no more than that of so many samples of every pixel.
    void keep_time_for(double samples_per_pixel) { kept_samples_ = samples_per_pixel; }

    /// Of a sample of every pixel, so far.
    double sample_s() const {
        return done_ > 0 ? elapsed_s() / double(done_) * double(tracer_.pixel_count()) : 0;
    }

    /// Somebody said stop, or time is over and all pixels have the same samples.
    bool must_stop(bool at_pass_end = true);

  private:
    const RenderOptions& options_;
    PathTracer& tracer_;
    RenderStats& stats_;
    Checkpoints* checkpoints_ = nullptr;
    Stopwatch watch_;
    uint64_t done_ = 0, before_band_ = 0;
    double more_to_come_ = 0;
    double kept_samples_ = 0;
};

}  // namespace wedge::rendering
