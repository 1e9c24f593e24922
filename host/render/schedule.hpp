// Cutting a render into launches: long enough to pay for themselves, short enough to be interrupted
// and to stay clear of drivers' time limits. The cut does not change the image.
#pragma once

#include <cstdint>
#include <optional>

#include "host/render/path_tracer.hpp"

namespace wedge::rendering {

/// How far a render has come between two launches: all pixels have the samples before `sample`,
/// those before `pixel` have `pass_samples` more.
struct Position {
    uint32_t sample = 0, pixel = 0, pass_samples = 0;
};

class Schedule {
  public:
    /// `tile_pixels` 0: chosen from measured times.
    Schedule(uint32_t pixels, uint32_t first_sample, uint32_t samples, uint32_t tile_pixels);

    bool is_done() const { return sample_ >= end_sample_ || pixels_ == 0; }

    /// The next launch, or nothing when all is done. All pixels get a range of samples before any
    /// gets the next.
    std::optional<Work> next();

    /// Tells how long the last launch took on the device.
    void measured(double seconds);

    /// What the launches handed out so far lead to.
    Position position() const { return {sample_, pixel_, pass_samples_}; }
    /// Goes on from there instead of from the start.
    void go_on_from(const Position& position);

    /// True if all pixels have the same samples: a good place to stop.
    bool at_pass_end() const { return pixel_ == 0; }

  private:
    void begin_pass();

    uint32_t pixels_, sample_, end_sample_, tile_pixels_;
    uint32_t pixel_ = 0;             ///< next pixel of this pass
    uint32_t pass_samples_ = 0;      ///< samples of this pass
    uint32_t launch_pixels_ = 0;     ///< pixels of the last launch
    double seconds_per_sample_ = 0;  ///< of one pixel; 0: not known yet
};

}  // namespace wedge::rendering
