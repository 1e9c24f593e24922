#include "host/render/path_tracer.hpp"

#include <algorithm>
#include <cassert>

#include "host/base/stopwatch.hpp"
#include "host/bvh/bvh.hpp"
#include "host/bvh/prim_refs.hpp"
#include "host/render/camera.hpp"
#include "host/render/flatten.hpp"
#include "wedge/log.hpp"

namespace wedge::rendering {
namespace {

constexpr cl_uint kWorkArgs = 4;        // first_pixel, pixel_count, first_sample, sample_count
constexpr cl_uint kSignalBuffers = 10;  // kernels/lib/signals.clh; then probing

int sampler_kind(Sampler sampler) {
    switch (sampler) {
        case Sampler::sobol:
            return WEDGE_SAMPLER_SOBOL;
        case Sampler::hash:
            return WEDGE_SAMPLER_HASH;
        case Sampler::stratified:
            return WEDGE_SAMPLER_STRATIFIED;
        case Sampler::lattice:
            return WEDGE_SAMPLER_LATTICE;
    }
    return WEDGE_SAMPLER_SOBOL;
}

/// Triangles of lamps come last and do not count: a default view brings one.
void warn_if_nothing_shows(const Scene& scene, const FlatScene& flat) {
    const std::size_t of_meshes = flat.triangles.size() - 2 * scene.rect_lights.size();
    const auto shows = [&](const UVec3& t) {
        const Vec3 &a = flat.positions[t.x], &b = flat.positions[t.y], &c = flat.positions[t.z];
        return bvh::is_usable(a) && bvh::is_usable(b) && bvh::is_usable(c) &&
               !bvh::is_degenerate(a, b, c);
    };
    const auto end = flat.triangles.begin() + std::ptrdiff_t(of_meshes);
    if (flat.triangles.empty() ||
        (of_meshes > 0 && std::none_of(flat.triangles.begin(), end, shows)))
        log_warning(
            "no triangle of the scene's meshes can be rendered: none has finite vertices and an "
            "area");
}

}  // namespace

shared::FrameParams make_frame_params(const Scene& scene, const PathSettings& settings,
                                      const std::vector<shared::Light>& lights) {
    shared::FrameParams params{};
    params.camera = make_camera_rays(scene.camera, scene.film);
    params.background = {scene.background.x, scene.background.y, scene.background.z, 0};
    params.crop_x = settings.crop.x;
    params.crop_y = settings.crop.y;
    params.crop_width = settings.crop.width;
    params.crop_height = settings.crop.height;
    params.seed = settings.seed;
    params.sampler = sampler_kind(settings.sampler);
    params.strata = settings.strata;
    params.sequences = settings.sequences;
    params.bounces = settings.bounces;
    const bool mesh_lights = std::any_of(lights.begin(), lights.end(), [](const auto& light) {
        return light.kind == WEDGE_LIGHT_TRIANGLE;
    });
    params.search_lights = mesh_lights || scene.background != Vec3(0);
    return params;
}

PathTracer::PathTracer(device::Device& device, const Scene& scene, const PathSettings& settings,
                       const Plan& plan, RenderStats& stats, Recording recording)
    : device_(device),
      pixel_count_(uint32_t(settings.crop.width) * uint32_t(settings.crop.height)),
      local_size_(settings.local_size),
      vertices_per_path_(uint32_t(settings.bounces) + 2) {
    upload(scene, settings, plan, stats);
    compile(plan, settings, recording, stats);
    stats.device_bytes = device.allocated_bytes();
}

void PathTracer::upload(const Scene& scene, const PathSettings& settings, const Plan& plan,
                        RenderStats& stats) {
    Stopwatch watch;
    const FlatScene flat = flatten(scene);
    stats.flatten_s = watch.lap();
    const bvh::Bvh bvh = bvh::build(flat.positions, flat.triangles, settings.bvh.quality);
    stats.triangles = flat.triangles.size();
    stats.degenerate_triangles = bvh.degenerate_count;
    stats.non_finite_triangles = bvh.non_finite_count;
    stats.bvh_build_s = watch.lap();

    if (flat.lights.empty() && scene.background == Vec3(0))
        log_warning(
            "the scene has no light, no shining material and no background: it will be black");
    warn_if_nothing_shows(scene, flat);
    scene_ = upload_scene(device_, flat, bvh, scene.textures, settings.bvh);
    if (plan.signals > 0) upload_long_triangles(device_, flat, scene_);
    const shared::FrameParams params = make_frame_params(scene, settings, flat.lights);
    frame_ = params;
    upload_frame(settings.crop);
    stats.upload_s = watch.lap();
}

void PathTracer::upload_frame(const Rect& crop) {
    crop_ = crop;
    pixel_count_ = uint32_t(crop.width) * uint32_t(crop.height);
    frame_.crop_x = crop.x;
    frame_.crop_y = crop.y;
    frame_.crop_width = crop.width;
    frame_.crop_height = crop.height;
    params_ = device_.upload_bytes(&frame_, sizeof(frame_), "frame parameters");
    film_ = cl::Buffer();  // two at a time may be too much
    film_ = device_.allocate_zeros(pixel_count_ * sizeof(shared::FilmPixel), "film");
}

void PathTracer::move_to(const Rect& crop) {
    kernel_.setArg(first_work_arg_ - 1, cl::Buffer());
    for (cl_uint i = 0; has_signals_ && i < kSignalBuffers; ++i)
        kernel_.setArg(first_work_arg_ + kWorkArgs + i, cl::Buffer());
    upload_frame(crop);
    kernel_.setArg(0, params_);
    kernel_.setArg(first_work_arg_ - 1, film_);
}

void PathTracer::compile(const Plan& plan, const PathSettings& settings, Recording recording,
                         RenderStats& stats) {
    Stopwatch watch;
    device::ProgramRequest request = plan.path_program;
    if (recording == Recording::on) request.defines.push_back("WEDGE_REPLAY=1");
    request.defines.insert(request.defines.end(), scene_.tree.defines.begin(),
                           scene_.tree.defines.end());
    const auto programs =
        device::build_programs(device_, std::span(&request, 1), settings.kernel_dir);
    kernel_ = programs[0].kernel("trace_paths");
    kernel_.setArg(0, params_);
    const cl_uint film_arg = scene_.set_args(kernel_, 1);
    kernel_.setArg(film_arg, film_);
    first_work_arg_ = film_arg + 1;

    has_signals_ = plan.signals > 0;
    record_arg_ = first_work_arg_ + kWorkArgs + (has_signals_ ? kSignalBuffers + 1 : 0);
    if (!has_signals_ && recording == Recording::off) warm_up();
    (programs[0].from_cache ? stats.programs_from_cache : stats.programs_compiled) += 1;
    stats.compile_s = watch.lap();
}

// Some drivers compile at the first launch: an empty one keeps that out of the rendering time. All
// buffers must be there.
void PathTracer::warm_up() {
    add_samples({});
}

void PathTracer::attach_signals(std::span<const cl::Buffer> buffers) {
    assert(has_signals_ && buffers.size() == kSignalBuffers);
    cl_uint arg = first_work_arg_ + kWorkArgs;
    for (const cl::Buffer& buffer : buffers) kernel_.setArg(arg++, buffer);
    warm_up();
}

double PathTracer::add_samples(const Work& work) {
    cl_uint arg = first_work_arg_;
    for (uint32_t value :
         {work.first_pixel, work.pixel_count, work.first_sample, work.sample_count})
        kernel_.setArg(arg++, cl_uint(value));
    if (has_signals_) kernel_.setArg(arg + kSignalBuffers, cl_int(work.probing));
    const uint32_t work_items = work.pixel_count > 0 ? work.pixel_count : 1;
    const cl::Event event = device_.launch(kernel_, work_items, local_size_);
    return device::device_seconds(event);
}

std::vector<shared::PathVertex> PathTracer::record_samples(uint32_t first_sample,
                                                           uint32_t sample_count) {
    std::vector<shared::PathVertex> record(std::size_t(sample_count) * vertices_per_path_);
    const uint64_t bytes = record.size() * sizeof(record[0]);
    cl::Buffer buffer =
        device_.upload_bytes(record.data(), bytes, "path vertices", CL_MEM_READ_WRITE);
    kernel_.setArg(record_arg_, buffer);
    add_samples({0, 1, first_sample, sample_count});
    device_.download(buffer, record.data(), bytes);
    return record;
}

void PathTracer::write_film(const std::vector<shared::FilmPixel>& pixels) {
    film_ = device_.upload_bytes(pixels.data(), pixels.size() * sizeof(pixels[0]), "film",
                                 CL_MEM_READ_WRITE);
    kernel_.setArg(first_work_arg_ - 1, film_);
}

std::vector<shared::FilmPixel> PathTracer::read_film() {
    std::vector<shared::FilmPixel> pixels(pixel_count_);
    if (!film_()) return pixels;
    device_.download(film_, pixels.data(), pixels.size() * sizeof(pixels[0]));
    return pixels;
}

}  // namespace wedge::rendering
