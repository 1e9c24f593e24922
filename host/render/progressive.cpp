#include "host/render/progressive.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/render/error_estimate.hpp"

namespace wedge::rendering {
namespace {

constexpr uint32_t kLeastForTarget = 16;  // before an estimate is trusted

uint32_t whole_batches(double samples, uint32_t largest) {
    const double batches = std::ceil(std::min(samples, double(largest)) / kSampleBatch);
    return std::min(uint32_t(batches) * kSampleBatch, largest);
}

class ProgressiveRun {
  public:
    ProgressiveRun(const RenderOptions& options, uint32_t first, uint32_t samples,
                   SamplingLoop& loop, PathTracer& tracer)
        : options_(options),
          first_(first),
          samples_(samples),
          loop_(loop),
          tracer_(tracer),
          estimate_(options.sampler),
          // With a known end the last five images are enough.
          next_(options.target_error || options.time_limit_s
                    ? kSampleBatch
                    : std::max(kSampleBatch, std::bit_floor(samples) / 16)) {}

    void run() {
        uint32_t end = samples_;
        while (done_ < end) {
            const bool looks = next_ <= end;
            if (!go_to(looks ? next_ : end)) break;
            if (!looks) continue;
            estimate_.add(done_, tracer_.read_film());
            next_ = done_ * 2;
            if (options_.target_error && done_ >= kLeastForTarget) end = end_for_target();
        }
    }

    std::optional<EstimatedError> error() const { return estimate_.at(std::max(done_, 1u)); }

  private:
    /// False if it was stopped.
    bool go_to(uint32_t end) {
        const uint64_t total = options_.target_error ? uint64_t(expected_) : samples_;
        const bool finished = loop_.run("trace_paths", first_ + done_, first_ + end,
                                        std::max<uint64_t>(total, end) * tracer_.pixel_count());
        done_ = uint32_t(loop_.samples_done() / tracer_.pixel_count());
        return finished;
    }

    uint32_t end_for_target() {
        expected_ = estimate_.samples_for(*options_.target_error, options_.target_metric);
        if (expected_ <= done_) return done_;
        // Farther ahead than twice as many the estimate is not trusted.
        return expected_ < next_ ? whole_batches(expected_, samples_) : samples_;
    }

    const RenderOptions& options_;
    uint32_t first_, samples_;
    SamplingLoop& loop_;
    PathTracer& tracer_;
    ErrorEstimate estimate_;
    uint32_t done_ = 0, next_;
    double expected_ = kLeastForTarget;
};

}  // namespace

bool estimates_error(const RenderOptions& options, std::size_t bands) {
    return (options.estimate_error || options.target_error) && bands == 1 &&
           options.resume_file.empty();
}

void run_progressively(const RenderOptions& options, uint32_t first, uint32_t samples,
                       SamplingLoop& loop, PathTracer& tracer, RenderStats& stats) {
    ProgressiveRun run(options, first, samples, loop, tracer);
    run.run();
    if (!stats.interrupted) stats.estimated_error = run.error();
}

}  // namespace wedge::rendering
