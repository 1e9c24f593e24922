#include "bench/converge/method_run.hpp"

#include <algorithm>
#include <cmath>

#include "bench/converge/reference.hpp"
#include "wedge/error.hpp"

namespace wedge::converge {
namespace {

constexpr uint32_t kOtherHalf = 1u << 16;  // added to the seed; runs count up from 0

/// Adds what a second half of the samples cost. Its scene is that of the first: placed, built and
/// copied once.
void add_half(RenderStats& stats, const RenderStats& half) {
    stats.render_s += half.render_s;
    stats.rays += half.rays;
    stats.samples += half.samples;
    stats.non_finite_samples += half.non_finite_samples;
    for (std::size_t i = 0; i < std::min(stats.passes.size(), half.passes.size()); ++i) {
        stats.passes[i].device_s += half.passes[i].device_s;
        stats.passes[i].launches += half.passes[i].launches;
    }
}

}  // namespace

double counted_seconds(const RenderStats& stats, bool cpu_clock) {
    if (cpu_clock) return stats.render_cpu_s / std::max(1u, stats.device.compute_units);
    return stats.flatten_s + stats.upload_s + stats.render_s;
}

RenderOptions MethodRunner::options(const Method& method, double knob, uint32_t seed) const {
    RenderOptions o = options_for(method, knob, seed);
    o.device = config_.device;
    o.kernel_dir = config_.kernel_dir;
    o.stop = config_.stop;
    o.estimate_error = config_.estimate_errors;
    return o;
}

Frame MethodRunner::render_whole(const RenderOptions& options) const {
    Frame frame = render(scene_, options);
    if (frame.stats.interrupted) throw Stopped{};
    if (!frame.stats.failure.empty()) throw Error(ErrorKind::device, frame.stats.failure);
    return frame;
}

Frame MethodRunner::run(const Method& method, double knob, uint32_t seed) {
    return method.filter ? run_filtered(method, knob, seed)
                         : render_whole(options(method, knob, seed));
}

Frame MethodRunner::run_filtered(const Method& method, double knob, uint32_t seed) {
    if (!denoiser_)
        denoiser_ = std::make_unique<baselines::Denoiser>(config_.device, config_.kernel_dir);
    const bool halves = baselines::needs_halves(*method.filter);
    const double knob_each = halves ? std::max(2.0, std::ceil(knob / 2)) : knob;
    Frame frame = render_whole(options(method, knob_each, seed));
    Frame other;
    if (halves) {
        other = render_whole(options(method, knob_each, seed + kOtherHalf));
        add_half(frame.stats, other.stats);
    }
    const double pixel_angle =
        2 * std::tan(0.5 * double(scene_.camera.vertical_fov_rad)) / scene_.film.height;
    baselines::Denoised denoised =
        denoiser_->apply(*method.filter, frame.image, halves ? &other.image : nullptr, pixel_angle);
    frame.image = std::move(denoised.image);
    frame.stats.passes.push_back(denoised.pass);
    frame.stats.render_s += denoised.wall_s;
    frame.stats.compile_s += denoised.compile_s;
    return frame;
}

}  // namespace wedge::converge
