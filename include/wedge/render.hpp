// Scene in, image out.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "wedge/bvh.hpp"
#include "wedge/device.hpp"
#include "wedge/image.hpp"
#include "wedge/scene.hpp"

namespace wedge {

/// `hash`: independent samples, textbook variance, for statistical tests. `sobol`: Owen-scrambled
/// Sobol with pixels in Z-order, the default. `stratified`: jittered strata, one sample in each,
/// the yardstick of the papers. `lattice`: shifted multiples of badly approximable numbers, to
/// judge the others with (docs/method.md).
enum class Sampler { sobol, hash, stratified, lattice };

/// As users write it: "sobol", "hash", "stratified", "lattice".
const char* to_string(Sampler sampler);

/// The other way round. Throws Error(usage) that begins with `option` and lists the names.
Sampler parse_sampler(const std::string& name, const std::string& option);

/// `mc`: plain path tracing, unbiased. `aaf`: soft shadows and indirect light are sampled as
/// densely as their frequencies ask for, and filtered (docs/filtering.md); all else as `mc`.
enum class Method { mc, aaf };

/// As users write it: "mc", "aaf".
const char* to_string(Method method);

/// What `aaf` does with what it sampled: filters where a guard lets it, filters as the papers do,
/// or leaves it as it is.
enum class FilterMode { guarded, plain, none };

/// As users write it: "guarded", "plain", "none".
const char* to_string(FilterMode mode);

/// docs/metrics.md.
enum class ErrorMetric { rmse, rel_mse };

struct Rect {
    int x = 0, y = 0, width = 0, height = 0;  ///< px
};

/// RenderOptions::mu where neither it nor an end is given.
inline constexpr float kDefaultMu = 1;

struct Progress {
    uint64_t samples_done = 0, samples_total = 0;  ///< pixel samples
    double elapsed_s = 0;
};

struct RenderOptions {
    std::string device;  ///< index, part of a name, `cpu`, `gpu`; empty: the best there is
    std::optional<int> samples_per_pixel;  ///< mc: else the scene's; aaf: see mu
    std::optional<int> bounces;            ///< else the scene's
    /// mc: stop at the first batch boundary after this. aaf: raise mu as long as there is time.
    std::optional<double> time_limit_s;
    std::optional<Rect> crop;  ///< other pixels are not rendered and stay 0
    uint64_t seed = 0;
    uint32_t sample_offset = 0;  ///< first sample index; a multiple of kSampleBatch
    Sampler sampler = Sampler::sobol;
    Method method = Method::mc;  ///< that of `wedge render` is aaf
    /// aaf: bandwidth scale, > 0. Larger: more samples, narrower filters, less bias;
    /// samples_per_pixel then is the most a pixel gets, by default 128 * max(1, mu), rounded
    /// to a power of two. With a time limit or a target error this is the most that mu rises to, by
    /// default 10000, or where samples are limited samples_per_pixel / 128 or 1; else 1 by default.
    std::optional<float> mu;
    FilterMode filter = FilterMode::guarded;  ///< aaf
    /// aaf: false gives every pixel the same number of samples, samples_per_pixel or the probe's.
    bool adaptive = true;
    /// Go on until the estimated error of the image is this small (> 0). mc: or all
    /// samples_per_pixel are there if they are given.
    std::optional<double> target_error;
    ErrorMetric target_metric = ErrorMetric::rel_mse;
    /// mc: estimate the error of the image; costs a few copies of the film from the device. With a
    /// target, and with aaf, it is estimated anyway.
    bool estimate_error = false;
    /// A file for the state of the render, method mc only: saved while it runs and at its end, and
    /// gone on from if it is there, to the same bits as without a break. The caller removes it.
    /// Empty: none.
    std::string resume_file;
    double checkpoint_interval_s = 30;  ///< between two saves; longer where saving takes long
    /// Most bytes that the film (112 a pixel) and what filters keep (1 to 2.5 kB) may take on the
    /// device; larger films are rendered in bands. 0: what the device allows.
    uint64_t film_bytes = 0;
    BvhOptions bvh;            ///< how rays find triangles (docs/tracing.md)
    std::string kernel_dir;    ///< read kernels from this source tree instead of the program
    uint32_t local_size = 0;   ///< work-group size; 0: what suits the device
    uint32_t tile_pixels = 0;  ///< pixels an enqueue; 0: what suits the device
    const std::atomic<bool>* stop = nullptr;           ///< set it to end early with what there is
    std::function<void(const Progress&)> on_progress;  ///< called from the rendering thread
};

/// Samples are summed in batches of this many, in order, so that any split of the work into batches
/// gives the same bits.
inline constexpr uint32_t kSampleBatch = 4;

struct PassStats {
    std::string name;
    double device_s = 0;
    uint64_t launches = 0;
};

/// Of the image, as a mean over pixels and R, G, B.
struct EstimatedError {
    double rmse = 0, rel_mse = 0;
};

struct RenderStats {
    DeviceInfo device;
    std::vector<PassStats> passes;
    uint64_t rays = 0;                ///< closest-hit and occlusion queries
    uint64_t samples = 0;             ///< pixel samples
    uint64_t non_finite_samples = 0;  ///< dropped
    uint64_t device_bytes = 0;
    uint64_t triangles = 0, degenerate_triangles = 0, non_finite_triangles = 0;
    double flatten_s = 0, bvh_build_s = 0, upload_s = 0, compile_s = 0, render_s = 0;
    double render_cpu_s = 0;  ///< of all threads of the process, while render_s went by
    std::optional<EstimatedError> estimated_error;
    double mu = 0;  ///< what aaf came to; 0: nothing was filtered
    int programs_compiled = 0, programs_from_cache = 0;
    bool interrupted = false;  ///< by `stop`
    std::string
        failure;  ///< device error that ended the render early; the image holds what was done
};

struct Frame {
    Image image;
    RenderStats stats;
};

/// Renders by the method asked for.
/// Throws Error(usage), Error(bad_input) or Error(device); a device error after the first samples
/// ends the render early instead and is told in `stats.failure`.
Frame render(const Scene& scene, const RenderOptions& options = {});

/// Traces one pixel again and tells what each path met: place, material, throughput, light. The
/// numbers are those of the render with the same options.
std::string replay_pixel(const Scene& scene, const RenderOptions& options, int x, int y);

/// Which effects of the scene are modelled how and why, with the kernels and buffers that takes, in
/// words. Throws as render() does; needs no device.
std::string explain(const Scene& scene, const RenderOptions& options = {});

/// "major.minor.patch".
const char* version();

/// JSON of everything in `stats`, for `--stats`.
std::string stats_to_json(const RenderStats& stats);

}  // namespace wedge
