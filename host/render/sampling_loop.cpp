#include "host/render/sampling_loop.hpp"

#include <algorithm>
#include <cmath>

#include "host/render/schedule.hpp"

namespace wedge::rendering {

bool SamplingLoop::must_stop(bool at_pass_end) {
    if (options_.stop && options_.stop->load()) {
        stats_.interrupted = true;
        return true;
    }
    return options_.time_limit_s && at_pass_end && done_ > 0 &&
           elapsed_s() + kept_samples_ * sample_s() >= *options_.time_limit_s;
}

void SamplingLoop::add_pass(const char* name, double device_s, uint64_t launches) {
    auto& passes = stats_.passes;
    auto pass = std::find_if(passes.begin(), passes.end(),
                             [&](const PassStats& p) { return p.name == name; });
    if (pass == passes.end()) pass = passes.insert(pass, {name, 0, 0});
    pass->device_s += device_s;
    pass->launches += launches;
}

bool SamplingLoop::run(const char* name, uint32_t first, uint32_t end, uint64_t total, bool probing,
                       std::optional<uint32_t> pixels) {
    Schedule schedule(pixels.value_or(tracer_.pixel_count()), first, end - first,
                      options_.tile_pixels);
    if (checkpoints_) done_ += checkpoints_->begin(schedule, first);
    PassStats pass;
    bool stopped = false;
    const uint64_t all =
        before_band_ + total + uint64_t(std::llround(more_to_come_ * double(total)));
    while (!schedule.is_done() && !(stopped = must_stop(schedule.at_pass_end()))) {
        std::optional<Work> work = schedule.next();
        work->probing = probing;
        const double seconds = tracer_.add_samples(*work);
        schedule.measured(seconds);
        pass.device_s += seconds;
        pass.launches += 1;
        done_ += uint64_t(work->pixel_count) * work->sample_count;
        if (checkpoints_) checkpoints_->between_launches(schedule.position());
        if (options_.on_progress) options_.on_progress({std::min(done_, all), all, watch_.total()});
    }
    if (checkpoints_) checkpoints_->save(schedule.position());
    add_pass(name, pass.device_s, pass.launches);
    return !stopped;
}

}  // namespace wedge::rendering
