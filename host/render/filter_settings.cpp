#include "host/render/filter_settings.hpp"

#include <algorithm>
#include <cmath>

#include "host/render/plan.hpp"

namespace wedge::rendering {
namespace {

// Thesis, section 4.5; for shadows alone it takes 9.
constexpr int kProbeSamples = 16, kShadowProbeSamples = WEDGE_LIGHT_PROBES;
constexpr float kAlphaDirect = 1;       // section 3.6
constexpr float kAlphaIndirect = 0.3f;  // section 4.5
constexpr float kGaussian = 3;          // k of eq. 3.13
constexpr float kUniform = 4.5;  // flat lights have side lobes; the thesis takes mu = 3 for 2
constexpr float kNarrowShadows = 1.4f, kWideDiffuse = 1.25f;  // for mu = 1
constexpr float kCameraRays = 80;        // of a pixel with an edge as high as the image is bright
constexpr float kLargestRadius = 0.125;  // of a filter, as a share of the film's larger side

/// The longer paths are, the cheaper beside them (kernels/bandwidth.cl).
int camera_rays_at_edges(int bounces) {
    return int(std::lround(kCameraRays * std::pow(float(bounces + 1), 0.4f)));
}

/// By the equations widths go with 1 / mu, and the samples a filter reaches stay as many: noise
/// would be the same for any mu, and bias, which goes with the square of a width, hopeless where mu
/// is small. The squares of bias (w^4) and noise (1 / (n^p w^2)) have the least sum for widths w
/// that go with n^(-p / 6), about the cube root of 1 / mu: n, the samples, goes with mu^1.4, and p
/// is up to 1.5. By measurement (docs/tried.md) shadows are worth narrower filters than the
/// equations ask for, since few samples tell more of a lamp than of the hemisphere, and diffuse
/// light from there wider ones, which the guard holds back where they do harm. Faint shadows, with
/// fewer samples and less noise than most, are left with bias before all others, so that shadows
/// take the fourth root up to mu = 1, as for p = 1, and the square root beyond. Light that the
/// guard knows less well, of lobes and of other lamps, has the square root for any mu.
struct Narrowing {
    float shadows, diffuse, others;
};

Narrowing narrowing_at(float mu) {
    const float square_root = std::sqrt(mu), fourth_root = std::sqrt(square_root);
    return {kNarrowShadows * std::max(square_root, fourth_root), std::cbrt(mu) / kWideDiffuse,
            square_root};
}

/// A power of two, which the sampler likes best.
int most_samples(float mu) {
    const float doublings = std::round(std::log2(std::max(1.0f, mu)));
    return int(kSamplesPerMu * std::exp2(doublings));
}

/// Few samples may agree by luck and promise that there is no noise. The less error is aimed at,
/// the less may be left to luck.
int least_samples(const shared::FilterSettings& s) {
    const float doublings = std::round(std::log2(std::max(1.0f, s.mu)));
    return int(std::min(float(s.probe_samples) * std::exp2(doublings), float(s.max_samples)));
}

int mode_of(FilterMode mode) {
    switch (mode) {
        case FilterMode::guarded:
            return WEDGE_FILTER_MODE_GUARDED;
        case FilterMode::plain:
            return WEDGE_FILTER_MODE_PLAIN;
        case FilterMode::none:
            return WEDGE_FILTER_MODE_NONE;
    }
    return WEDGE_FILTER_MODE_GUARDED;
}

/// Samples that every pixel starts with.
int probe_samples(const Scene& scene, int bounces) {
    return has_hemisphere_light(scene, bounces) ? kProbeSamples : kShadowProbeSamples;
}

}  // namespace

shared::FilterSettings make_filter_settings(const Scene& scene, const RenderOptions& options,
                                            float mu) {
    shared::FilterSettings s{};
    s.mu = mu;
    const Narrowing narrowing = narrowing_at(mu);
    s.narrowing_shadows = narrowing.shadows;
    s.narrowing_diffuse = narrowing.diffuse;
    s.narrowing_others = narrowing.others;
    s.alpha_direct = kAlphaDirect;
    s.alpha_indirect = kAlphaIndirect;
    s.k_gaussian = kGaussian;
    s.k_uniform = kUniform;
    s.max_samples = options.samples_per_pixel.value_or(most_samples(mu));
    const int bounces = options.bounces.value_or(scene.defaults.bounces);
    s.probe_samples = std::min(probe_samples(scene, bounces), s.max_samples);
    if (!options.adaptive) s.max_samples = options.samples_per_pixel.value_or(s.probe_samples);
    s.least_samples = options.adaptive ? least_samples(s) : s.max_samples;
    s.mode = mode_of(options.filter);
    s.max_radius_px = largest_filter_radius_px(scene.film);
    s.camera_rays_at_edges = camera_rays_at_edges(bounces);
    s.pixel_angle = 2 * std::tan(0.5f * scene.camera.vertical_fov_rad) / float(scene.film.height);
    return s;
}

int largest_filter_radius_px(const Film& film) {
    return int(std::ceil(kLargestRadius * float(std::max(film.width, film.height))));
}

bool goes_in_rounds(const RenderOptions& options) {
    return (options.time_limit_s || options.target_error) && options.adaptive;
}

}  // namespace wedge::rendering
