// A scene on a device, ready to add samples to a film.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "host/device/device.hpp"
#include "host/render/device_scene.hpp"
#include "host/render/plan.hpp"
#include "wedge/render.hpp"
#include "wedge/shared/frame.h"
#include "wedge/shared/replay.h"

namespace wedge::rendering {

/// What the path tracer needs beside the scene.
struct PathSettings {
    Rect crop;
    int bounces = 0;
    uint32_t seed = 0;
    Sampler sampler = Sampler::sobol;
    int sequences = 1;  ///< FrameParams::sequences
    int strata = 1;     ///< FrameParams::strata
    uint32_t local_size = 0;
    BvhOptions bvh;
    std::string kernel_dir;
};

/// Pixels [first, first + count) of the crop, or with filters of the list of pixels, and a range of
/// samples.
struct Work {
    uint32_t first_pixel = 0, pixel_count = 0;
    uint32_t first_sample = 0, sample_count = 0;
    bool probing = false;  ///< with filters: note distances
};

/// Whether paths are written down as they are traced.
enum class Recording { off, on };

class PathTracer {
  public:
    /// Flattens, builds, uploads and compiles; fills those parts of `stats`.
    PathTracer(device::Device& device, const Scene& scene, const PathSettings& settings,
               const Plan& plan, RenderStats& stats, Recording recording = Recording::off);

    /// Traces and waits. Returns seconds on the device.
    double add_samples(const Work& work);

    /// Recording::on, one pixel: traces the samples and returns bounces + 2 vertices for each.
    std::vector<shared::PathVertex> record_samples(uint32_t first_sample, uint32_t sample_count);

    /// A plan with signals: the buffers that take them, in the order of the kernel's arguments
    /// (kernels/lib/signals.clh). To be called before samples are added.
    void attach_signals(std::span<const cl::Buffer> buffers);

    const cl::Buffer& params() const { return params_; }
    const cl::Buffer& film() const { return film_; }
    const DeviceScene& scene() const { return scene_; }

    /// The crop's pixels as they are now; black where move_to() found no memory for them.
    std::vector<shared::FilmPixel> read_film();
    /// Replaces them: what read_film() gave, for samples to be added to.
    void write_film(const std::vector<shared::FilmPixel>& pixels);

    uint32_t pixel_count() const { return pixel_count_; }
    /// The part of the film that is rendered.
    const Rect& crop() const { return crop_; }
    /// From now on another part, black; what was attached is let go.
    void move_to(const Rect& crop);

  private:
    void upload(const Scene& scene, const PathSettings& settings, const Plan& plan,
                RenderStats& stats);
    void upload_frame(const Rect& crop);
    void compile(const Plan& plan, const PathSettings& settings, Recording recording,
                 RenderStats& stats);
    void warm_up();

    device::Device& device_;
    DeviceScene scene_;
    cl::Buffer params_, film_;
    cl::Kernel kernel_;
    cl_uint first_work_arg_ = 0, record_arg_ = 0;
    bool has_signals_ = false;
    shared::FrameParams frame_{};  ///< params_ as the device has it
    Rect crop_;
    uint32_t pixel_count_ = 0;
    uint32_t local_size_ = 0;
    uint32_t vertices_per_path_ = 0;
};

shared::FrameParams make_frame_params(const Scene& scene, const PathSettings& settings,
                                      const std::vector<shared::Light>& lights);

}  // namespace wedge::rendering
