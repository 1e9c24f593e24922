#include "host/render/render_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/render/filter_settings.hpp"
#include "host/render/plan.hpp"
#include "host/scene/check_scene.hpp"
#include "wedge/error.hpp"

namespace wedge::rendering {
namespace {

constexpr uint32_t kMaxSamples = 1u << 24;  // a float film counts samples up to here
constexpr int kMaxBounces = 1024;
// Where the number of samples is not known beforehand.
constexpr int kOpenEndedStrata = 16;

[[noreturn]] void refuse(const std::string& message) {
    throw Error(ErrorKind::usage, message);
}

/// Seeds of more than 32 bits become one of 2^32; smaller ones stay themselves.
uint32_t folded(uint64_t seed) {
    const uint64_t high = seed >> 32;
    // Steele, Lea, Flood 2014: the increment and a multiplier of SplitMix64.
    const uint64_t mixed = (high * 0x9e3779b97f4a7c15u ^ high >> 7) * 0xbf58476d1ce4e5b9u;
    return uint32_t(seed ^ mixed >> 32);
}

Rect checked_crop(const Film& film, const std::optional<Rect>& crop) {
    if (!crop) return {0, 0, film.width, film.height};
    const bool inside = crop->x >= 0 && crop->y >= 0 && crop->width > 0 && crop->height > 0 &&
                        crop->width <= film.width - crop->x &&
                        crop->height <= film.height - crop->y;
    if (!inside)
        refuse(fmt::format("the crop {},{} {}x{} does not lie in the film of {}x{} pixels", crop->x,
                           crop->y, crop->width, crop->height, film.width, film.height));
    return *crop;
}

void check_target(const RenderOptions& options) {
    if (!(*options.target_error > 0) || !std::isfinite(*options.target_error))
        refuse(fmt::format("the target error must be positive, got {}", *options.target_error));
    if (options.method == Method::aaf && !options.adaptive)
        refuse("a target error needs samples that may differ from pixel to pixel");
    if (!options.resume_file.empty())
        refuse("a render with a target error cannot be resumed: give the number of samples");
}

}  // namespace

uint32_t sample_count(const Scene& scene, const RenderOptions& options) {
    if (options.samples_per_pixel) {
        const int samples = *options.samples_per_pixel;
        if (samples < 1 || uint32_t(samples) > kMaxSamples)
            refuse(fmt::format("samples per pixel must be from 1 to {}, got {}", kMaxSamples,
                               samples));
        return uint32_t(samples);
    }
    if (options.time_limit_s || options.target_error) return kMaxSamples;
    return uint32_t(scene.defaults.samples_per_pixel);
}

PathSettings make_path_settings(const Scene& scene, const RenderOptions& options) {
    scene::check_scene(scene);
    PathSettings settings;
    settings.crop = checked_crop(scene.film, options.crop);
    settings.bounces = options.bounces.value_or(scene.defaults.bounces);
    if (settings.bounces < 0 || settings.bounces > kMaxBounces)
        refuse(fmt::format("bounces must be from 0 to {}, got {}", kMaxBounces, settings.bounces));
    if (options.time_limit_s && !(*options.time_limit_s > 0))
        refuse(fmt::format("the time must be positive, got {} s", *options.time_limit_s));
    if (options.target_error) check_target(options);
    if (options.sample_offset % kSampleBatch != 0)
        refuse(fmt::format("the sample offset must be a multiple of {}, got {}", kSampleBatch,
                           options.sample_offset));
    const uint32_t samples = sample_count(scene, options);
    if (samples > kMaxSamples - std::min(options.sample_offset, kMaxSamples))
        refuse(fmt::format("sample offset and samples together must be at most {}", kMaxSamples));
    if (options.method == Method::aaf) {
        if (options.mu && !(*options.mu > 0 && *options.mu <= kLargestMu))
            refuse(
                fmt::format("mu must be positive and at most {}, got {}", kLargestMu, *options.mu));
        if (options.sample_offset != 0)
            refuse("the method aaf decides its samples itself: no sample offset");
    }
    settings.bvh = options.bvh;
    settings.seed = folded(options.seed);
    settings.sampler = options.sampler;
    const bool open_ended =
        (options.time_limit_s || options.target_error) && !options.samples_per_pixel;
    // Where nothing is filtered there are no halves.
    settings.sequences = make_plan(scene, options.method, settings.bounces).signals > 0 ? 2 : 1;
    settings.strata = open_ended ? kOpenEndedStrata : int(samples);
    settings.local_size = options.local_size;
    settings.kernel_dir = options.kernel_dir;
    return settings;
}

}  // namespace wedge::rendering
