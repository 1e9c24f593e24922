// Calls the kernels of tests/kernels/sampling.cl.
#pragma once

#include <vector>

#include "host/device/device.hpp"
#include "host/device/program.hpp"
#include "wedge/shared/scene.h"

namespace wedge::test {

using shared::float4;

struct float2 {
    float x, y;
};

class SamplingKernels {
  public:
    SamplingKernels();

    /// kernels/lib/random.clh
    /// `strata` counts for WEDGE_SAMPLER_STRATIFIED, `sequences`, 1 or 2, for WEDGE_SAMPLER_SOBOL.
    std::vector<float2> points(int sampler, uint32_t seed, int sequences, uint32_t pixel,
                               uint32_t first_sample, uint32_t dimension, uint32_t count,
                               uint32_t strata = 1);
    /// The same of the first `count` / `parts` samples, with `parts` in the place of each.
    std::vector<float2> parts(int sampler, uint32_t seed, int sequences, uint32_t pixel,
                              uint32_t parts, uint32_t dimension, uint32_t count,
                              uint32_t strata = 1);
    /// Directions and weights f cos / pdf; `parameters`: diffuse, specular, exponent, model.
    std::vector<float4> bsdf_directions(float4 parameters, float4 wo, uint32_t seed,
                                        uint32_t count);
    /// Value and pdf.
    std::vector<float2> bsdf_values(float4 parameters, float4 wo, const std::vector<float4>& wi);
    /// Positions and density over solid angle seen from `from`.
    std::vector<float4> light_points(const std::vector<shared::Light>& lights, float4 from,
                                     uint32_t seed, uint32_t count);

    /// kernels/lib/angles.clh; `in`: turn; cosine; y, x. Sine and cosine; arc_cosine4; arc_of.
    std::vector<float4> angles(const std::vector<float4>& in);
    /// inverse_erf of in[i].x, falling_exp of in[i].y.
    std::vector<float2> erf_and_exp(const std::vector<float4>& in);

    /// kernels/lib/bandwidth.clh; `in`: s_min, s_max, light sigma, pixel; `settings`: mu, alpha, k.
    /// Filter width and sample count.
    std::vector<float2> shadow_bandwidth(const std::vector<float4>& in, float4 settings);
    /// The same of indirect light; `in`: z_min, z_max, band, pixel; `settings`: mu, alpha, share.
    std::vector<float2> indirect_bandwidth(const std::vector<float4>& in, float4 settings);
    /// in[i]: mu, samples asked for.
    std::vector<float> samples_granted(const std::vector<float4>& in);
    /// Band limit of lobes of exponents in[i].x and their share of the hemisphere.
    std::vector<float2> lobe_bands(const std::vector<float4>& in, int model);
    /// is_level of kernels/lib/surfaces.clh, 1 or 0, of each place for one at 0 that faces y;
    /// `pixel`: length of one in the world.
    std::vector<float> levels(const std::vector<float4>& positions, float pixel);
    /// is_in_front of kernels/lib/thin_things.clh, 1 or 0; `sizes`: face-on, along the surface, and
    /// the eye's largest coordinate.
    std::vector<float> in_front(const std::vector<float4>& things,
                                const std::vector<float4>& places,
                                const std::vector<float4>& normals,
                                const std::vector<float4>& sizes);
    /// kernels/lib/filter_weight.clh; w of `positions`: widths. Weights of all for the first.
    std::vector<float> filter_weights(const std::vector<float4>& positions,
                                      const std::vector<float4>& normals, float4 along,
                                      float4 middle, float pixel);
    /// kernels/lib/coverage.clh; `rays`: grey colour and irradiance, `each` of them on one surface.
    /// Mean square error of so many paths beyond that of the rays.
    float coverage_noise(const std::vector<float4>& rays, uint32_t each, uint32_t paths);
    /// kernels/lib/shadow_hue.clh; `rays`: light, w: half, and 2 more where it is seen. Factors of
    /// both halves, of light of which such a share is seen.
    std::vector<float4> shadow_hues(const std::vector<float4>& rays, float share = 1e-3f);

  private:
    template <typename T, typename... Args>
    std::vector<T> run(const char* name, uint32_t count, const Args&... args);

    device::Device device_;
    device::Program program_;
};

}  // namespace wedge::test
