#include "host/render/sampling_loop.hpp"

#include <algorithm>

#include "host/render/schedule.hpp"

namespace wedge::rendering {

bool SamplingLoop::must_stop(bool at_pass_end) {
    if (options_.stop && options_.stop->load()) {
        stats_.interrupted = true;
        return true;
    }
    return options_.time_limit_s && at_pass_end && done_ > 0 &&
           watch_.total() >= *options_.time_limit_s;
}

bool SamplingLoop::run(const char* name, uint32_t first, uint32_t end, uint64_t total, bool probing,
                       std::optional<uint32_t> pixels) {
    Schedule schedule(pixels.value_or(tracer_.pixel_count()), first, end - first,
                      options_.tile_pixels);
    if (checkpoints_) done_ += checkpoints_->begin(schedule, first);
    PassStats pass{name, 0, 0};
    bool stopped = false;
    while (!(stopped = must_stop(schedule.at_pass_end()))) {
        std::optional<Work> work = schedule.next();
        if (!work) break;
        work->probing = probing;
        const double seconds = tracer_.add_samples(*work);
        schedule.measured(seconds);
        pass.device_s += seconds;
        pass.launches += 1;
        done_ += uint64_t(work->pixel_count) * work->sample_count;
        if (checkpoints_) checkpoints_->between_launches(schedule.position());
        if (options_.on_progress)
            options_.on_progress({std::min(done_, total), total, watch_.total()});
    }
    if (checkpoints_) checkpoints_->save(schedule.position());
    // Bands of a film are one pass.
    if (stats_.passes.empty() || stats_.passes.back().name != pass.name)
        stats_.passes.push_back({name, 0, 0});
    stats_.passes.back().device_s += pass.device_s;
    stats_.passes.back().launches += pass.launches;
    return !stopped;
}

}  // namespace wedge::rendering
