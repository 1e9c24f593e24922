// The passes of axis-aligned filtering of soft shadows, around the path tracer.
#pragma once

#include <functional>

#include "host/render/path_tracer.hpp"
#include "wedge/shared/shadow.h"

namespace wedge::rendering {

/// Settings of the thesis (docs/method.md), one set for all scenes.
shared::ShadowSettings make_shadow_settings(const Scene& scene, const RenderOptions& options);

class ShadowFilter {
  public:
    /// Allocates, compiles, and attaches itself to `tracer`.
    ShadowFilter(device::Device& device, PathTracer& tracer, const Plan& plan, const Rect& crop,
                 const shared::ShadowSettings& settings, const std::string& kernel_dir,
                 RenderStats& stats);

    uint64_t pixel_count() const { return uint64_t(width_) * height_; }

    /// From the probe samples to widths and counts. Returns seconds on the device.
    double measure_bandwidth();
    /// From all samples to filtered light. Returns seconds on the device.
    double filter();

    /// Samples each pixel is to be brought to.
    std::vector<uint32_t> read_sample_ends();
    /// Radiance of the filtered lights, rgb, by pixel; after filter().
    std::vector<shared::float4> read_radiance();
    /// Standard deviations of the filter of the first light in pixels, after measure_bandwidth().
    std::vector<float> read_widths_px();

  private:
    void set_args();

    device::Device& device_;
    uint32_t width_, height_, lights_;
    cl::Buffer settings_, light_list_, params_, film_;
    cl::Buffer shadows_, geometry_, sigmas_, sample_ends_, filtered_, radiance_;
    cl::Kernel geometry_kernel_, bandwidth_kernel_, filter_x_, filter_y_;
};

}  // namespace wedge::rendering
