#include "kernel_harness.hpp"

#include "wedge/shared/filter.h"

namespace wedge::test {

SamplingKernels::SamplingKernels() {
    const device::ProgramRequest request{"tests/kernels/sampling.cl",
                                         {"WEDGE_SPECULAR=1", "WEDGE_SHADOW_HUES=1"}};
    program_ = device::build_programs(device_, std::span(&request, 1), WEDGE_SOURCE_DIR).front();
}

/// The output buffer is the kernel's last argument.
template <typename T, typename... Args>
std::vector<T> SamplingKernels::run(const char* name, uint32_t count, const Args&... args) {
    std::vector<T> out(count);
    const uint64_t bytes = out.size() * sizeof(T);
    cl::Buffer buffer = device_.allocate(bytes, "results");
    cl::Kernel kernel = program_.kernel(name);
    cl_uint index = 0;
    (kernel.setArg(index++, args), ...);
    kernel.setArg(index, buffer);
    device_.launch(kernel, count);
    device_.finish();
    device_.download(buffer, out.data(), bytes);
    return out;
}

std::vector<float2> SamplingKernels::points(int sampler, uint32_t seed, int sequences,
                                            uint32_t pixel, uint32_t first_sample,
                                            uint32_t dimension, uint32_t count, uint32_t strata) {
    return run<float2>("draw_points", count, cl_int(sampler), seed, cl_int(sequences), strata,
                       pixel, first_sample, dimension, count);
}

std::vector<float2> SamplingKernels::parts(int sampler, uint32_t seed, int sequences,
                                           uint32_t pixel, uint32_t parts, uint32_t dimension,
                                           uint32_t count, uint32_t strata) {
    return run<float2>("draw_parts", count, cl_int(sampler), seed, cl_int(sequences), strata, pixel,
                       parts, dimension, count);
}

std::vector<float4> SamplingKernels::bsdf_directions(float4 parameters, float4 wo, uint32_t seed,
                                                     uint32_t count) {
    return run<float4>("sample_bsdf_directions", count, parameters, wo, seed, count);
}

std::vector<float2> SamplingKernels::bsdf_values(float4 parameters, float4 wo,
                                                 const std::vector<float4>& wi) {
    const cl::Buffer directions =
        device_.upload_bytes(wi.data(), wi.size() * sizeof(wi[0]), "directions");
    return run<float2>("eval_bsdf_directions", uint32_t(wi.size()), parameters, wo, directions,
                       uint32_t(wi.size()));
}

std::vector<float4> SamplingKernels::light_points(const std::vector<shared::Light>& lights,
                                                  float4 from, uint32_t seed, uint32_t count) {
    const cl::Buffer list =
        device_.upload_bytes(lights.data(), lights.size() * sizeof(lights[0]), "lights");
    return run<float4>("sample_light_points", count, list, uint32_t(lights.size()), from, seed,
                       count);
}

std::vector<float4> SamplingKernels::angles(const std::vector<float4>& in) {
    const cl::Buffer buffer = device_.upload_bytes(in.data(), in.size() * sizeof(in[0]), "angles");
    return run<float4>("eval_angles", uint32_t(in.size()), buffer, uint32_t(in.size()));
}

std::vector<float2> SamplingKernels::erf_and_exp(const std::vector<float4>& in) {
    const cl::Buffer buffer = device_.upload_bytes(in.data(), in.size() * sizeof(in[0]), "values");
    return run<float2>("eval_erf_and_exp", uint32_t(in.size()), buffer, uint32_t(in.size()));
}

std::vector<float2> SamplingKernels::shadow_bandwidth(const std::vector<float4>& in,
                                                      float4 settings) {
    const cl::Buffer buffer = device_.upload_bytes(in.data(), in.size() * sizeof(in[0]), "slopes");
    return run<float2>("eval_shadow_bandwidth", uint32_t(in.size()), buffer, settings,
                       uint32_t(in.size()));
}

std::vector<float2> SamplingKernels::indirect_bandwidth(const std::vector<float4>& in,
                                                        float4 settings) {
    const cl::Buffer buffer = device_.upload_bytes(in.data(), in.size() * sizeof(in[0]), "depths");
    return run<float2>("eval_indirect_bandwidth", uint32_t(in.size()), buffer, settings,
                       uint32_t(in.size()));
}

std::vector<float> SamplingKernels::samples_granted(const std::vector<float4>& in) {
    const cl::Buffer buffer = device_.upload_bytes(in.data(), in.size() * sizeof(in[0]), "counts");
    return run<float>("eval_samples_granted", uint32_t(in.size()), buffer, uint32_t(in.size()));
}

std::vector<float2> SamplingKernels::lobe_bands(const std::vector<float4>& in, int model) {
    const cl::Buffer buffer = device_.upload_bytes(in.data(), in.size() * sizeof(in[0]), "lobes");
    return run<float2>("eval_lobe_band", uint32_t(in.size()), buffer, cl_int(model),
                       uint32_t(in.size()));
}

std::vector<float> SamplingKernels::levels(const std::vector<float4>& positions, float pixel) {
    const cl::Buffer places =
        device_.upload_bytes(positions.data(), positions.size() * sizeof(float4), "places");
    const auto count = uint32_t(positions.size());
    return run<float>("eval_is_level", count, places, pixel, count);
}

std::vector<float> SamplingKernels::in_front(const std::vector<float4>& things,
                                             const std::vector<float4>& places,
                                             const std::vector<float4>& normals,
                                             const std::vector<float4>& sizes) {
    const auto upload = [&](const std::vector<float4>& items) {
        return device_.upload_bytes(items.data(), items.size() * sizeof(float4), "places");
    };
    const cl::Buffer a = upload(things), b = upload(places), c = upload(normals), d = upload(sizes);
    const auto count = uint32_t(things.size());
    return run<float>("eval_is_in_front", count, a, b, c, d, count);
}

std::vector<float> SamplingKernels::filter_weights(const std::vector<float4>& positions,
                                                   const std::vector<float4>& normals, float4 along,
                                                   float4 middle, float pixel) {
    const auto count = uint32_t(positions.size());
    const uint64_t bytes = positions.size() * sizeof(positions[0]);
    const cl::Buffer places = device_.upload_bytes(positions.data(), bytes, "places");
    const cl::Buffer directions = device_.upload_bytes(normals.data(), bytes, "normals");
    std::vector<float> weights;
    for (const float4& w :
         run<float4>("eval_filter_weights", count, places, directions, along, middle, pixel, count))
        weights.push_back(w.x);
    return weights;
}

float SamplingKernels::coverage_noise(const std::vector<float4>& rays, uint32_t each,
                                      uint32_t paths) {
    const cl::Buffer list =
        device_.upload_bytes(rays.data(), rays.size() * sizeof(rays[0]), "rays");
    const auto count = uint32_t(rays.size());
    const cl::Buffer surfaces =
        device_.allocate_zeros((count / each + 1) * sizeof(shared::SurfaceSum), "surfaces");
    return run<float>("eval_coverage_noise", 1, list, count, each, surfaces, paths)[0];
}

std::vector<float4> SamplingKernels::shadow_hues(const std::vector<float4>& rays, float share) {
    const cl::Buffer list =
        device_.upload_bytes(rays.data(), rays.size() * sizeof(rays[0]), "rays");
    const cl::Buffer sums = device_.allocate_zeros((1 + WEDGE_HUE_SUMS) * sizeof(float4), "sums");
    return run<float4>("eval_shadow_hues", 2, list, uint32_t(rays.size()), sums, share, 2u);
}

}  // namespace wedge::test
