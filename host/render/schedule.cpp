#include "host/render/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace wedge::rendering {
namespace {

constexpr double kLaunch_s = 0.2;           // aimed at
constexpr uint32_t kFirstPixels = 1 << 14;  // of the first launch, before anything is measured

}  // namespace

Schedule::Schedule(uint32_t pixels, uint32_t first_sample, uint32_t samples, uint32_t tile_pixels)
    : pixels_(pixels),
      sample_(first_sample),
      end_sample_(first_sample + samples),
      tile_pixels_(tile_pixels) {}

void Schedule::go_on_from(const Position& position) {
    sample_ = position.sample;
    pixel_ = position.pixel;
    pass_samples_ = position.pass_samples;
}

void Schedule::begin_pass() {
    uint32_t batches = 1;
    if (seconds_per_sample_ > 0) {
        const double batch_s = seconds_per_sample_ * kSampleBatch * pixels_;
        batches = uint32_t(std::clamp(std::floor(kLaunch_s / batch_s), 1.0, 1e6));
    }
    pass_samples_ = std::min(batches * kSampleBatch, end_sample_ - sample_);
}

std::optional<Work> Schedule::next() {
    if (is_done()) return std::nullopt;
    if (pixel_ == 0) begin_pass();

    double count = tile_pixels_;
    if (count == 0)
        count = seconds_per_sample_ > 0 ? kLaunch_s / (seconds_per_sample_ * pass_samples_)
                                        : kFirstPixels;
    launch_pixels_ = uint32_t(std::clamp(count, 1.0, double(pixels_ - pixel_)));
    const Work work{pixel_, launch_pixels_, sample_, pass_samples_};
    pixel_ += launch_pixels_;
    if (pixel_ == pixels_) {
        pixel_ = 0;
        sample_ += pass_samples_;
    }
    return work;
}

void Schedule::measured(double seconds) {
    if (launch_pixels_ > 0 && pass_samples_ > 0)
        seconds_per_sample_ = seconds / (double(launch_pixels_) * pass_samples_);
}

}  // namespace wedge::rendering
