// One run of one method: a render, and where the method says so a filter over it.
#pragma once

#include <memory>

#include "bench/baselines/denoise.hpp"
#include "bench/converge/config.hpp"

namespace wedge::converge {

/// Runs methods on one scene. Throws Stopped, Error(device).
class MethodRunner {
  public:
    MethodRunner(const Config& config, const Scene& scene) : config_(config), scene_(scene) {}

    /// `stats` are of render and filter together. Layers beside R, G, B: those of the render, or
    /// none if it was filtered afterwards.
    Frame run(const Method& method, double knob, uint32_t seed);

    RenderOptions options(const Method& method, double knob, uint32_t seed) const;

  private:
    Frame render_whole(const RenderOptions& options) const;
    Frame run_filtered(const Method& method, double knob, uint32_t seed);

    const Config& config_;
    const Scene& scene_;
    std::unique_ptr<baselines::Denoiser> denoiser_;
};

/// What charts show: wall time of everything but reading files, compiling kernels, building the
/// BVH; or processor time of samples and filters over the number of compute units.
double counted_seconds(const RenderStats& stats, bool cpu_clock = false);

}  // namespace wedge::converge
