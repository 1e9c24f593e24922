// Filters of others over finished renders, as OpenCL kernels (kernels/baselines), to compare with.
#pragma once

#include <memory>
#include <string>

#include "wedge/image.hpp"
#include "wedge/render.hpp"

namespace wedge::baselines {

enum class Filter { gaussian, bilateral, atrous, nlm, svgf };

/// nlm only: weights come from one half of the samples and filter the other.
bool needs_halves(Filter filter);

struct Denoised {
    Image image;           ///< R, G, B
    PassStats pass;        ///< the time of all launches on the device
    double wall_s = 0;     ///< from the first launch until the last has ended
    double compile_s = 0;  ///< the first time a filter is used; else 0
};

/// A device with the kernels that were needed so far.
class Denoiser {
  public:
    /// `device` and `kernel_dir` as in RenderOptions. Throws Error(device).
    Denoiser(const std::string& device, const std::string& kernel_dir);
    ~Denoiser();

    /// `noisy`: a render with all layers. `other_half`: a second one of the same scene with another
    /// seed, for a filter that needs halves, else null; the result then is of both. `pixel_angle`:
    /// tan of half the field of view over half the film's height. Data are on the device already
    /// when time starts, as they would be in a renderer. Throws Error(device).
    Denoised apply(Filter filter, const Image& noisy, const Image* other_half, double pixel_angle);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace wedge::baselines
