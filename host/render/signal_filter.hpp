// The passes of axis-aligned filtering, around the path tracer.
#pragma once

#include <functional>

#include "host/render/path_tracer.hpp"
#include "host/render/stages.hpp"
#include "wedge/shared/filter.h"
#include "wedge/shared/planes.h"

namespace wedge::rendering {

/// What is known of a signal, by pixel; empty: there is no such signal.
struct SignalLayers {
    std::vector<float> width_px;           ///< standard deviation of the filter, as computed
    std::vector<float> nearest, farthest;  ///< distances the probe found, world units; 0: none
};

/// By pixel.
struct FilteredLight {
    std::vector<shared::GuardedPixel> guarded;  ///< what takes the place of `unfiltered`
    std::vector<shared::SampledLight> unfiltered;
    SignalLayers direct;    ///< of the most powerful light
    SignalLayers indirect;  ///< diffuse
};

/// Device memory that a plan's signals take for so many pixels, buffer by buffer; those of one name
/// come one after the other.
struct FilterBuffer {
    const char* name;
    uint64_t bytes;
};
std::vector<FilterBuffer> filter_buffers(const Plan& plan, uint64_t pixels);

class SignalFilter {
  public:
    /// Allocates, compiles, and attaches itself to `tracer`.
    SignalFilter(device::Device& device, PathTracer& tracer, const Plan& plan, const Rect& crop,
                 const shared::FilterSettings& settings, const std::string& kernel_dir,
                 RenderStats& stats);

    uint64_t pixel_count() const { return uint64_t(width_) * height_; }

    void set_settings(const shared::FilterSettings& settings);

    /// All of these return seconds on the device.
    /// From the samples so far to widths and counts.
    double measure_bandwidth();
    /// From all samples to filtered light.
    double filter();

    std::vector<shared::SampleEnds> read_sample_ends();
    void write_sample_ends(std::span<const shared::SampleEnds> ends);
    /// The pixels that the path tracer counts from now on; at most all.
    void write_pixel_list(std::span<const uint32_t> pixels);
    /// Both after filter().
    FilteredLight read_light();
    void read_layers(FilteredLight& light);

  private:
    /// A kernel and its number of work-items.
    struct Launch {
        const cl::Kernel& kernel;
        uint64_t count;
    };

    uint64_t part_count() const { return pixel_count() * parts_; }
    /// Floats in a plane, and groups of pixels that are filtered at once (shared/planes.h).
    uint64_t plane_size() const { return uint64_t(WEDGE_PLANE_PITCH(width_)) * height_; }
    uint64_t group_count() const { return plane_size() / WEDGE_LANES; }

    void allocate(const shared::FilterSettings& settings);
    void allocate_planes();
    double find_thin_things();
    float mean_brightness();
    double run(std::span<const Launch> launches);
    void compile(const Plan& plan, const std::string& kernel_dir, RenderStats& stats);
    void set_args(uint32_t film_width, uint32_t film_height);
    SignalLayers read_signal(uint32_t signal);

    device::Device& device_;
    uint32_t width_, height_, lights_, reflected_sums_, light_corrections_, direct_signals_,
        signals_, parts_;
    bool knows_thin_things_ = false;  ///< thin_things_ is filled
    DeviceScene scene_;
    cl::Buffer params_, film_;
    cl::Buffer settings_, sample_ends_, pixel_list_, rows_, surface_sums_, more_, sums_, distances_,
        reflected_, corrections_, unfiltered_, remainders_, thin_things_;
    cl::Buffer places_, found_, near_by_, ends_, sigmas_, means_, filtered_;  // in planes
    cl::Buffer light_, coverage_, errors_, smoothed_, guarded_;
    cl::Kernel thin_kernel_, surfaces_kernel_, distances_kernel_, neighbours_kernel_,
        brightness_kernel_, bandwidth_kernel_, edge_noise_, flat_, means_kernel_, filter_none_,
        filter_x_, filter_y_, guard_errors_, guard_smooth_, choose_;
};

}  // namespace wedge::rendering
