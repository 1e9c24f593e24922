#include "host/render/shadow_filter.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/stopwatch.hpp"
#include "host/device/program.hpp"

namespace wedge::rendering {
namespace {

constexpr int kProbeSamples = 9;      // thesis, section 3.6
constexpr float kAlpha = 1;           // thesis, section 3.6
constexpr float kGaussian = 3;        // k of eq. 3.13
constexpr float kUniform = 4.5;       // flat lights have side lobes; the thesis takes mu = 3 for 2
constexpr float kEdgeSamples = 16;    // as a pixel's box filter asks for; not from the thesis
constexpr float kSamplesPerMu = 100;  // the cap
constexpr float kLargestRadius = 0.125;  // of a filter, as a share of the film's larger side

template <typename... Args>
void set_kernel_args(cl::Kernel& kernel, const Args&... args) {
    cl_uint index = 0;
    (kernel.setArg(index++, args), ...);
}

}  // namespace

shared::ShadowSettings make_shadow_settings(const Scene& scene, const RenderOptions& options) {
    shared::ShadowSettings s{};
    s.mu = options.mu;
    s.alpha = kAlpha;
    s.k_gaussian = kGaussian;
    s.k_uniform = kUniform;
    s.probe_samples = kProbeSamples;
    s.edge_samples = kEdgeSamples;
    s.max_samples =
        std::max(kProbeSamples,
                 options.samples_per_pixel.value_or(int(kSamplesPerMu * std::max(1.0f, s.mu))));
    s.max_radius_px =
        int(std::ceil(kLargestRadius * std::max(scene.film.width, scene.film.height)));
    s.pixel_angle = 2 * std::tan(0.5f * scene.camera.vertical_fov_rad) / float(scene.film.height);
    return s;
}

ShadowFilter::ShadowFilter(device::Device& device, PathTracer& tracer, const Plan& plan,
                           const Rect& crop, const shared::ShadowSettings& settings,
                           const std::string& kernel_dir, RenderStats& stats)
    : device_(device),
      width_(uint32_t(crop.width)),
      height_(uint32_t(crop.height)),
      lights_(uint32_t(plan.shadow_lights)),
      light_list_(tracer.lights()),
      params_(tracer.params()),
      film_(tracer.film()) {
    const uint64_t pixels = tracer.pixel_count(), entries = pixels * lights_;
    const auto upload = [&](const auto& items, const char* what) {
        return device.upload_bytes(items.data(), items.size() * sizeof(items[0]), what,
                                   CL_MEM_READ_WRITE);
    };
    settings_ = device.upload_bytes(&settings, sizeof(settings), "shadow settings");
    shared::ShadowPixel empty{};
    empty.nearest = INFINITY;
    shadows_ = upload(std::vector<shared::ShadowPixel>(entries, empty), "shadows");
    sample_ends_ =
        upload(std::vector<cl_uint>(pixels, cl_uint(settings.probe_samples)), "sample counts");
    geometry_ = device.allocate(pixels * sizeof(shared::GeometryPixel), "pixel geometry");
    sigmas_ = device.allocate(entries * sizeof(float), "filter widths");
    filtered_ = device.allocate(entries * sizeof(cl_float2), "half-filtered shadows");
    radiance_ = device.allocate(pixels * sizeof(shared::float4), "filtered light");

    Stopwatch watch;
    const auto programs =
        device::build_programs(device, std::span(&plan.shadow_program, 1), kernel_dir);
    geometry_kernel_ = programs[0].kernel("shadow_geometry");
    bandwidth_kernel_ = programs[0].kernel("shadow_bandwidth");
    filter_x_ = programs[0].kernel("shadow_filter_x");
    filter_y_ = programs[0].kernel("shadow_filter_y");
    set_args();
    tracer.attach_shadows(shadows_, sample_ends_);
    (programs[0].from_cache ? stats.programs_from_cache : stats.programs_compiled) += 1;
    stats.compile_s += watch.lap();
    stats.device_bytes = device.allocated_bytes();
}

void ShadowFilter::set_args() {
    const auto width = cl_int(width_), height = cl_int(height_);
    set_kernel_args(geometry_kernel_, params_, settings_, film_, geometry_,
                    cl_uint(width_ * height_));
    set_kernel_args(bandwidth_kernel_, settings_, light_list_, film_, shadows_, geometry_, sigmas_,
                    sample_ends_, width, height);
    set_kernel_args(filter_x_, settings_, light_list_, film_, shadows_, geometry_, sigmas_,
                    filtered_, width, height);
    set_kernel_args(filter_y_, settings_, light_list_, film_, shadows_, geometry_, sigmas_,
                    filtered_, radiance_, width, height);
}

double ShadowFilter::measure_bandwidth() {
    const uint64_t pixels = pixel_count();
    const cl::Event geometry = device_.launch(geometry_kernel_, pixels);
    const cl::Event bandwidth = device_.launch(bandwidth_kernel_, pixels);
    return device::device_seconds(geometry) + device::device_seconds(bandwidth);
}

double ShadowFilter::filter() {
    const uint64_t pixels = pixel_count();
    // Where the samples met the scene is better known now than after the probe.
    const cl::Event geometry = device_.launch(geometry_kernel_, pixels);
    const cl::Event along_x = device_.launch(filter_x_, pixels);
    const cl::Event along_y = device_.launch(filter_y_, pixels);
    return device::device_seconds(geometry) + device::device_seconds(along_x) +
           device::device_seconds(along_y);
}

std::vector<uint32_t> ShadowFilter::read_sample_ends() {
    std::vector<uint32_t> ends(pixel_count());
    device_.download(sample_ends_, ends.data(), ends.size() * sizeof(ends[0]));
    return ends;
}

std::vector<shared::float4> ShadowFilter::read_radiance() {
    std::vector<shared::float4> radiance(pixel_count());
    device_.download(radiance_, radiance.data(), radiance.size() * sizeof(radiance[0]));
    return radiance;
}

std::vector<float> ShadowFilter::read_widths_px() {
    const std::size_t pixels = pixel_count();
    std::vector<float> sigmas(pixels * lights_), widths(pixels, 0.0f);
    std::vector<shared::GeometryPixel> geometry(pixels);
    device_.download(sigmas_, sigmas.data(), sigmas.size() * sizeof(float));
    device_.download(geometry_, geometry.data(), geometry.size() * sizeof(geometry[0]));
    for (std::size_t i = 0; i < pixels; ++i)
        if (geometry[i].normal.w > 0) widths[i] = sigmas[i * lights_] / geometry[i].normal.w;
    return widths;
}

}  // namespace wedge::rendering
