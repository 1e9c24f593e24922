#include "host/render/signal_filter.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <numeric>

#include "host/base/stopwatch.hpp"
#include "host/device/program.hpp"

namespace wedge::rendering {
namespace {

constexpr cl_uint kScaleArg = 7;        // of filter_x and filter_y
constexpr cl_uint kIndexArg = 15;       // of filter_y
constexpr cl_uint kBrightnessArg = 16;  // of filter_bandwidth
constexpr cl_uint kRangeArg = 5;        // of filter_thin_things

template <typename... Args>
void set_kernel_args(cl::Kernel& kernel, const Args&... args) {
    cl_uint index = 0;
    (kernel.setArg(index++, args), ...);
    assert(index == kernel.getInfo<CL_KERNEL_NUM_ARGS>());
}

/// Direct and indirect light, as far as they are filtered.
int plan_parts(const Plan& plan) {
    return (plan.direct_signals > 0) + plan.hemisphere;
}

/// For each light, of a surface.
uint64_t reflected_sums(const Plan& plan) {
    return 1 + (plan.shadow_hues ? WEDGE_HUE_SUMS : 0);
}

/// For each light, of a pixel.
uint64_t corrections(const Plan& plan) {
    return plan.shadow_hues ? WEDGE_HUE_CORRECTIONS : 1;
}

/// Of a surface.
uint64_t mean_planes(uint64_t lights, uint64_t signals) {
    return WEDGE_LIGHT_PLANES * lights + WEDGE_HEMISPHERE_PLANES * (signals - lights);
}

/// Of a pixel, for what was found, then for means of signals, then for the errors of filters, then
/// for what was made of it.
uint64_t shared_planes(uint64_t lights, uint64_t signals, uint64_t parts) {
    return std::max({WEDGE_SURFACES * signals * WEDGE_FOUND_PLANES,
                     WEDGE_SURFACES * mean_planes(lights, signals),
                     parts * sizeof(shared::ScaleErrors) / sizeof(float),
                     sizeof(shared::GuardedPixel) / sizeof(float)});
}

template <typename T>
std::vector<T> read(device::Device& device, const cl::Buffer& buffer, uint64_t count) {
    std::vector<T> items(count);
    device.download(buffer, items.data(), count * sizeof(T));
    return items;
}

}  // namespace

std::vector<FilterBuffer> filter_buffers(const Plan& plan, uint64_t pixels) {
    if (plan.signals == 0) return {};
    const uint64_t surfaces = pixels * WEDGE_SURFACES, entries = surfaces * uint64_t(plan.signals);
    const uint64_t lights = uint64_t(plan.shadow_lights), parts = uint64_t(plan_parts(plan));
    const uint64_t in_planes = shared_planes(lights, uint64_t(plan.signals), parts);
    const char *counts = "sample counts", *seen = "surfaces of pixels";
    const char* in_turn = "distances, then signals, then errors of filters, then guarded light";
    const char* widths = "filter widths, edges of surfaces, thin things";
    const char *unshadowed = "unshadowed light", *light = "light before and after filters";
    return {{counts, pixels * sizeof(shared::SampleEnds)},
            {counts, pixels * sizeof(cl_uint)},
            {seen, surfaces * sizeof(shared::SurfaceSum)},
            {seen, surfaces * WEDGE_PLACE_PLANES * sizeof(float)},
            {seen, pixels * sizeof(cl_uint)},
            {"signals, sampled", entries * 2 * sizeof(shared::float4)},
            {"distances", entries * sizeof(shared::DistanceRange)},
            {in_turn, pixels * in_planes * sizeof(float)},
            {in_turn, pixels * in_planes * sizeof(float)},
            {widths, entries * sizeof(float)},
            {widths, pixels * sizeof(float)},
            {widths, pixels * sizeof(float)},
            {unshadowed, lights * surfaces * reflected_sums(plan) * sizeof(shared::float4)},
            {unshadowed, lights * pixels * corrections(plan) * sizeof(float)},
            {light, pixels * sizeof(shared::SampledLight)},
            {light, pixels * sizeof(shared::Remainder)},
            {light, pixels * parts * WEDGE_SCALES * sizeof(shared::HalfLight)},
            {light, pixels * parts * sizeof(float)}};
}

SignalFilter::SignalFilter(device::Device& device, PathTracer& tracer, const Plan& plan,
                           const Rect& crop, const shared::FilterSettings& settings,
                           const std::string& kernel_dir, RenderStats& stats)
    : device_(device),
      width_(uint32_t(crop.width)),
      height_(uint32_t(crop.height)),
      lights_(uint32_t(plan.shadow_lights)),
      reflected_sums_(uint32_t(reflected_sums(plan))),
      light_corrections_(uint32_t(corrections(plan))),
      direct_signals_(uint32_t(plan.direct_signals)),
      signals_(uint32_t(plan.signals)),
      parts_(uint32_t(plan_parts(plan))),
      scene_(tracer.scene()),
      params_(tracer.params()),
      film_(tracer.film()) {
    Stopwatch watch;
    allocate(settings);
    device_.finish();
    stats.upload_s += watch.lap();
    compile(plan, kernel_dir, stats);
    const cl::Buffer kept[] = {settings_,   surface_sums_, sums_, distances_,   reflected_,
                               unfiltered_, remainders_,   more_, sample_ends_, pixel_list_};
    tracer.attach_signals(kept);
    stats.device_bytes = device.allocated_bytes();
}

void SignalFilter::allocate(const shared::FilterSettings& settings) {
    const uint64_t pixels = pixel_count(), surfaces = pixels * WEDGE_SURFACES;
    const uint64_t entries = surfaces * signals_;
    const auto upload = [&](const auto& items, const char* what) {
        return device_.upload_bytes(items.data(), items.size() * sizeof(items[0]), what,
                                    CL_MEM_READ_WRITE);
    };
    settings_ = device_.upload_bytes(&settings, sizeof(settings), "filter settings");
    const auto probes = cl_uint(settings.probe_samples);
    sample_ends_ =
        upload(std::vector<shared::SampleEnds>(pixels, {probes, probes, 0, 0}), "sample counts");
    std::vector<uint32_t> all(pixels);
    std::iota(all.begin(), all.end(), 0u);
    pixel_list_ = upload(all, "list of pixels");
    const auto zeros = [&](uint64_t count, uint64_t item_bytes, const char* what) {
        return device_.allocate_zeros(count * item_bytes, what);
    };
    more_ = zeros(pixels + 1, sizeof(cl_uint), "places of further surfaces");
    surface_sums_ = zeros(surfaces, sizeof(shared::SurfaceSum), "surfaces of pixels");
    sums_ = zeros(2 * entries, sizeof(shared::float4), "signals");
    distances_ = zeros(entries, sizeof(shared::DistanceRange), "distances");
    reflected_ =
        zeros(surfaces * lights_ * reflected_sums_, sizeof(shared::float4), "unshadowed light");
    corrections_ = device_.allocate(pixels * lights_ * light_corrections_ * sizeof(float),
                                    "corrections of unshadowed light");
    unfiltered_ = zeros(pixels, sizeof(shared::SampledLight), "unfiltered light");
    remainders_ = zeros(pixels, sizeof(shared::Remainder), "remainders of pixels");
    thin_things_ = zeros(pixels, sizeof(float), "thin things");
    rows_ = device_.allocate(height_ * sizeof(float), "brightness of rows");
    allocate_planes();
    light_ =
        device_.allocate(WEDGE_SCALES * part_count() * sizeof(shared::HalfLight), "filtered light");
    coverage_ = device_.allocate(part_count() * sizeof(float), "noise of coverage");
}

void SignalFilter::allocate_planes() {
    const uint64_t surfaces = WEDGE_SURFACES, entries = surfaces * signals_;
    const auto bytes = [&](uint64_t count) {
        return (count * plane_size() + 2 * WEDGE_PLANE_MARGIN) * sizeof(float);
    };
    const auto planes = [&](uint64_t count, const char* what) {
        return device_.allocate(bytes(count), what);
    };
    // Where there is no surface or beside the film these are read, though for nothing, and where a
    // surface is found late it has no width yet.
    const auto zeros = [&](uint64_t count, const char* what) {
        return device_.allocate_zeros(bytes(count), what);
    };
    places_ = zeros(surfaces * WEDGE_PLACE_PLANES, "places of surfaces");
    ends_ = planes(1, "edges of surfaces");
    sigmas_ = zeros(entries, "filter widths");
    // Memory costs time when it is touched first, and each of these is needed when the one before
    // is not any more. Widths are measured before what was made of pixels is there, or make it
    // worthless.
    const uint64_t count = shared_planes(lights_, signals_, parts_);
    found_ = means_ = errors_ = guarded_ =
        planes(count, "slopes and depths, means of signals, errors, guarded light");
    near_by_ = filtered_ = smoothed_ = planes(count, "the same of pixels near by");
}

void SignalFilter::compile(const Plan& plan, const std::string& kernel_dir, RenderStats& stats) {
    Stopwatch watch;
    const auto programs = device::build_programs(device_, plan.filter_programs, kernel_dir);
    const device::Program &distances = programs[0], &bandwidth = programs[1];
    const device::Program &filters = programs[2], &guard = programs[3];
    thin_kernel_ = distances.kernel("filter_thin_things");
    surfaces_kernel_ = distances.kernel("filter_surfaces");
    distances_kernel_ = distances.kernel("filter_distances");
    neighbours_kernel_ = distances.kernel("filter_neighbours");
    brightness_kernel_ = bandwidth.kernel("filter_brightness");
    bandwidth_kernel_ = bandwidth.kernel("filter_bandwidth");
    edge_noise_ = bandwidth.kernel("filter_edge_noise");
    flat_ = filters.kernel("filter_flat");
    means_kernel_ = filters.kernel("filter_means");
    filter_x_ = filters.kernel("filter_x");
    filter_y_ = filters.kernel("filter_y");
    filter_none_ = filters.kernel("filter_none");
    guard_errors_ = guard.kernel("guard_errors");
    guard_smooth_ = guard.kernel("guard_smooth");
    choose_ = guard.kernel("guard_choose");
    for (const device::Program& program : programs)
        (program.from_cache ? stats.programs_from_cache : stats.programs_compiled) += 1;
    // Some drivers compile at the first launch: empty ones keep that out of the rendering time.
    set_args(0, 0);
    run(std::array{Launch{thin_kernel_, 1}});
    knows_thin_things_ = true;
    measure_bandwidth();
    filter();
    knows_thin_things_ = false;
    set_args(width_, height_);
    stats.compile_s += watch.lap();
}

void SignalFilter::set_args(uint32_t film_width, uint32_t film_height) {
    const auto width = cl_int(film_width), height = cl_int(film_height);
    const auto parts = cl_uint(film_width * film_height * parts_);
    set_kernel_args(thin_kernel_, params_, scene_.vertices, scene_.triangles, scene_.long_triangles,
                    thin_things_, cl_uint(0), cl_uint(0));
    set_kernel_args(surfaces_kernel_, params_, settings_, surface_sums_, more_, places_, width,
                    height);
    set_kernel_args(distances_kernel_, distances_, sums_, more_, found_, width, height);
    set_kernel_args(neighbours_kernel_, places_, found_, near_by_, ends_, width, height);
    set_kernel_args(brightness_kernel_, film_, rows_, width, height);
    set_kernel_args(bandwidth_kernel_, settings_, params_, scene_.lights, thin_things_, film_,
                    surface_sums_, more_, places_, near_by_, ends_, reflected_, sigmas_,
                    sample_ends_, unfiltered_, width, height, 0.0f);
    set_kernel_args(edge_noise_, film_, surface_sums_, more_, ends_, guarded_, width, height);
    set_kernel_args(flat_, params_, scene_.lights, film_, surface_sums_, reflected_, corrections_,
                    width, height);
    set_kernel_args(means_kernel_, unfiltered_, places_, sums_, more_, means_, width, height);
    set_kernel_args(filter_none_, places_, film_, surface_sums_, more_, reflected_, corrections_,
                    remainders_, sums_, means_, light_, coverage_, width, height);
    set_kernel_args(filter_x_, settings_, scene_.lights, places_, sigmas_, means_, width, height,
                    1.0f, filtered_);
    set_kernel_args(filter_y_, settings_, scene_.lights, places_, sigmas_, filtered_, width, height,
                    1.0f, film_, surface_sums_, more_, reflected_, corrections_, remainders_,
                    light_, cl_int(0));
    set_kernel_args(guard_errors_, unfiltered_, light_, coverage_, errors_, parts);
    set_kernel_args(guard_smooth_, errors_, smoothed_, width, height);
    set_kernel_args(choose_, settings_, unfiltered_, light_, smoothed_, guarded_, width, height);
}

double SignalFilter::run(std::span<const Launch> launches) {
    std::vector<cl::Event> events;
    for (const Launch& launch : launches)
        events.push_back(device_.launch(launch.kernel, launch.count));
    double seconds = 0;
    for (const cl::Event& event : events) seconds += device::device_seconds(event);
    return seconds;
}

void SignalFilter::set_settings(const shared::FilterSettings& settings) {
    device_.overwrite(settings_, &settings, sizeof(settings));
}

// Each may be as long as the film is wide, and drivers have limits of time for a launch.
double SignalFilter::find_thin_things() {
    constexpr cl_uint kAtOnce = 1 << 14;
    double seconds = 0;
    for (cl_uint first = 0; first < scene_.long_triangle_count; first += kAtOnce) {
        const cl_uint end = std::min(first + kAtOnce, scene_.long_triangle_count);
        thin_kernel_.setArg(kRangeArg, first);
        thin_kernel_.setArg(kRangeArg + 1, end);
        seconds += run(std::array{Launch{thin_kernel_, end - first}});
    }
    return seconds;
}

double SignalFilter::measure_bandwidth() {
    const uint64_t pixels = pixel_count();
    double seconds = knows_thin_things_ ? 0 : find_thin_things();
    knows_thin_things_ = true;
    const Launch measured[] = {{surfaces_kernel_, pixels},
                               {distances_kernel_, pixels},
                               {neighbours_kernel_, group_count()},
                               {brightness_kernel_, height_}};
    seconds += run(measured);
    bandwidth_kernel_.setArg(kBrightnessArg, mean_brightness());
    return seconds + run(std::array{Launch{bandwidth_kernel_, pixels}});
}

float SignalFilter::mean_brightness() {
    double sum = 0;
    for (float row : read<float>(device_, rows_, height_)) sum += double(row);
    return float(sum / double(pixel_count()));
}

void SignalFilter::write_pixel_list(std::span<const uint32_t> pixels) {
    device_.overwrite(pixel_list_, pixels.data(), pixels.size_bytes());
}

double SignalFilter::filter() {
    constexpr float widths[] = WEDGE_SCALE_WIDTHS;
    const uint64_t pixels = pixel_count(), groups = group_count();
    // Where the samples met the scene is better known now than after the probe.
    double seconds = run(std::array{Launch{surfaces_kernel_, pixels}, Launch{flat_, pixels},
                                    Launch{means_kernel_, pixels}, Launch{filter_none_, groups}});
    for (int scale = 1; scale < WEDGE_SCALES; ++scale) {
        filter_x_.setArg(kScaleArg, widths[scale]);
        filter_y_.setArg(kScaleArg, widths[scale]);
        filter_y_.setArg(kIndexArg, cl_int(scale));
        seconds += run(std::array{Launch{filter_x_, groups}, Launch{filter_y_, groups}});
    }
    const Launch guard[] = {{guard_errors_, part_count()},
                            {guard_smooth_, part_count()},
                            {choose_, pixels},
                            {edge_noise_, pixels}};
    return seconds + run(guard);
}

std::vector<shared::SampleEnds> SignalFilter::read_sample_ends() {
    return read<shared::SampleEnds>(device_, sample_ends_, pixel_count());
}

void SignalFilter::write_sample_ends(std::span<const shared::SampleEnds> ends) {
    device_.overwrite(sample_ends_, ends.data(), ends.size_bytes());
}

FilteredLight SignalFilter::read_light() {
    FilteredLight light;
    light.guarded = read<shared::GuardedPixel>(device_, guarded_, pixel_count());
    light.unfiltered = read<shared::SampledLight>(device_, unfiltered_, pixel_count());
    return light;
}

void SignalFilter::read_layers(FilteredLight& light) {
    if (direct_signals_ > 0) light.direct = read_signal(0);
    if (signals_ > direct_signals_) light.indirect = read_signal(direct_signals_);
}

SignalLayers SignalFilter::read_signal(uint32_t signal) {
    const std::size_t pixels = pixel_count(), pitch = WEDGE_PLANE_PITCH(width_);
    const auto planes = [&](const cl::Buffer& buffer, std::size_t count) {
        return read<float>(device_, buffer, WEDGE_PLANE_MARGIN + count * plane_size());
    };
    const auto sigmas = planes(sigmas_, signal + 1);
    const auto places = planes(places_, WEDGE_PLACE_PLANES);
    const auto distances = read<shared::DistanceRange>(device_, distances_, pixels * signals_);
    SignalLayers layers;
    for (std::vector<float>* layer : {&layers.width_px, &layers.nearest, &layers.farthest})
        layer->assign(pixels, 0.0f);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::size_t at = WEDGE_PLANE_MARGIN + i / width_ * pitch + i % width_;
        const std::size_t entry = i * signals_ + signal;
        const float size = places[WEDGE_PLACE_SLANTED_SIZE * plane_size() + at];
        if (size > 0) layers.width_px[i] = sigmas[signal * plane_size() + at] / size;
        if (distances[entry].farthest > 0) {
            layers.nearest[i] = distances[entry].nearest;
            layers.farthest[i] = distances[entry].farthest;
        }
    }
    return layers;
}

}  // namespace wedge::rendering
