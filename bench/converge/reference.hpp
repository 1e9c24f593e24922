// The image that errors are measured against: many samples, in two independent halves, whose
// difference tells how far the reference itself is from the truth.
#pragma once

#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

#include "wedge/image.hpp"
#include "wedge/render.hpp"

namespace wedge::converge {

struct Reference {
    Image mean;             ///< R, G, B: of both halves
    Image half_a, half_b;   ///< R, G, B
    Image variance;         ///< R, G, B: of `mean`, as if samples were independent
    uint64_t spp = 0;       ///< samples per pixel of `mean`
    int piece_samples = 0;  ///< it is made of renders with so many samples per pixel
    double time_s = 0;      ///< that these have taken, whenever that was
    std::string id;         ///< names file and samples; results computed with it are kept under it
    std::string sampler;
    std::filesystem::path file;
};

/// Unbiased estimate of the squared error of one value of the mean, from its two halves: their
/// difference has twice the variance of each, the mean half of it.
inline double squared_error_of_mean(double half_a, double half_b) {
    return 0.25 * (half_a - half_b) * (half_a - half_b);
}

/// Mean of it over pixels and channels.
double mean_squared_error_of(const Reference& reference);

struct ReferenceRequest {
    std::filesystem::path folder;
    std::string name, scene_digest;
    int spp = 0;  ///< at least, unless `limit_s` is reached
    Sampler sampler = Sampler::hash;
    int piece_samples = 0;  ///< of the reference that is to have more; 0: by `spp`
    /// No further samples if the reference would have taken more than this.
    double limit_s = INFINITY;
    std::string device, kernel_dir;
    const std::atomic<bool>* stop = nullptr;
    std::function<void(const std::string&)> say;
};

/// From the folder, or rendered in pieces that are kept there one by one: a killed program goes on
/// where it was, and a request for more samples adds them. Seeds are apart from those of runs.
/// Throws Stopped if stopped.
Reference make_reference(const Scene& scene, const ReferenceRequest& request);

/// Thrown when `stop` was set; what was finished is kept.
struct Stopped {};

}  // namespace wedge::converge
