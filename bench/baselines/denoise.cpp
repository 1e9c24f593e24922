#include "bench/baselines/denoise.hpp"

#include <CL/opencl.hpp>
#include <map>

#include "bench/baselines/layers.hpp"
#include "host/base/stopwatch.hpp"
#include "host/device/program.hpp"
#include "wedge/error.hpp"

namespace wedge::baselines {
namespace {

using device::Device;

constexpr int kNlmRadius_px = 7;

const char* name_of(Filter filter) {
    constexpr const char* kNames[] = {"gaussian", "bilateral", "atrous", "nlm", "svgf"};
    return kNames[int(filter)];
}

/// Launches of the same kernel with `pass_number` counting up.
int pass_count(Filter filter) {
    switch (filter) {
        case Filter::gaussian:
            return 2;
        case Filter::bilateral:
            return 1;
        default:
            return 5;
    }
}

template <typename... Args>
void set_args(cl::Kernel& kernel, const Args&... args) {
    cl_uint index = 0;
    (kernel.setArg(index++, args), ...);
}

/// One half of the samples on the device.
struct Half {
    cl::Buffer radiance, emission, albedo, variance, surface, place, light;
    cl::Buffer light_variance, total;  // nlm only
};

Half upload(Device& device, const Layers& layers, bool for_nlm) {
    Half half;
    const auto copy = [&](const std::vector<Float4>& values, const char* name) {
        return device.upload<Float4>(values, name);
    };
    half.radiance = copy(layers.radiance, "radiance");
    half.emission = copy(layers.emission, "emission");
    half.albedo = copy(layers.albedo, "albedo");
    half.variance = copy(layers.variance, "variance");
    half.surface = copy(layers.surface, "normals and depth");
    half.place = copy(layers.place, "positions");
    const uint64_t bytes = layers.radiance.size() * sizeof(Float4);
    half.light = device.allocate(bytes, "light");
    if (for_nlm) {
        half.light_variance = device.allocate(bytes, "variance of light");
        half.total = device.allocate(bytes, "weighted sums");
    }
    return half;
}

}  // namespace

bool needs_halves(Filter filter) {
    return filter == Filter::nlm;
}

struct Denoiser::Parts {
    Device device;
    std::string kernel_dir;
    std::map<std::string, cl::Program> programs;
    double compile_s = 0;

    int width = 0, height = 0;
    std::vector<cl::Event> events;

    cl::Kernel kernel(const std::string& file, const char* name) {
        auto found = programs.find(file);
        if (found == programs.end()) {
            Stopwatch watch;
            const device::ProgramRequest request{"kernels/baselines/" + file + ".cl", {}};
            found = programs
                        .emplace(file, device::build_programs(device, std::span(&request, 1),
                                                              kernel_dir)[0]
                                           .program)
                        .first;
            compile_s += watch.total();
        }
        return cl::Kernel(found->second, name);
    }

    uint64_t pixels() const { return uint64_t(width) * height; }
    void launch(const cl::Kernel& k) { events.push_back(device.launch(k, pixels())); }

    void demodulate(Half& half) {
        cl::Kernel k = kernel("demodulate", "demodulate");
        set_args(k, cl_int(pixels()), half.radiance, half.emission, half.albedo, half.variance,
                 half.light);
        launch(k);
    }

    void modulate(Half& half, const cl::Buffer& light) {
        cl::Kernel k = kernel("demodulate", "modulate");
        set_args(k, cl_int(pixels()), light, half.emission, half.albedo, half.radiance);
        launch(k);
    }

    /// Passes to and fro between two buffers. Returns where the result is.
    cl::Buffer run_passes(Filter filter, Half& half, cl::Buffer spare) {
        cl::Kernel k = kernel(name_of(filter), name_of(filter));
        cl::Buffer from = half.light, to = spare;
        for (int pass = 0; pass < pass_count(filter); ++pass) {
            set_args(k, cl_int(width), cl_int(height), from, half.surface, half.place, cl_int(pass),
                     to);
            launch(k);
            std::swap(from, to);
        }
        return from;
    }

    /// Adds to `guide.total` the light of `other`, weighted by what `guide` shows.
    void run_nlm(Half& guide, Half& other, const cl::Buffer& distances, const cl::Buffer& sums) {
        cl::Kernel distance = kernel("nlm", "nlm_distance"), rows = kernel("nlm", "nlm_rows"),
                   add = kernel("nlm", "nlm_add"), prepare = kernel("nlm", "nlm_prepare");
        set_args(prepare, cl_int(pixels()), guide.albedo, guide.variance, guide.light_variance,
                 guide.total);
        launch(prepare);
        for (int v = -kNlmRadius_px; v <= kNlmRadius_px; ++v)
            for (int u = -kNlmRadius_px; u <= kNlmRadius_px; ++u) {
                set_args(distance, cl_int(width), cl_int(height), cl_int(u), cl_int(v), guide.light,
                         guide.light_variance, distances);
                launch(distance);
                set_args(rows, cl_int(width), cl_int(height), distances, sums);
                launch(rows);
                set_args(add, cl_int(width), cl_int(height), cl_int(u), cl_int(v), sums,
                         other.light, guide.total);
                launch(add);
            }
    }

    void finish_nlm(Half& a, Half& b, const cl::Buffer& light) {
        cl::Kernel k = kernel("nlm", "nlm_finish");
        set_args(k, cl_int(pixels()), a.total, b.total, light);
        launch(k);
    }
};

Denoiser::Denoiser(const std::string& device, const std::string& kernel_dir)
    : parts_(new Parts{Device(device), kernel_dir, {}, 0, 0, 0, {}}) {}
Denoiser::~Denoiser() = default;

Denoised Denoiser::apply(Filter filter, const Image& noisy, const Image* other_half,
                         double pixel_angle) {
    Parts& p = *parts_;
    p.width = noisy.width;
    p.height = noisy.height;
    p.events.clear();
    p.compile_s = 0;
    const bool halves = needs_halves(filter);
    const Layers layers = layers_of(noisy, pixel_angle);
    Half a = upload(p.device, layers, halves), b;
    if (halves) b = upload(p.device, layers_of(*other_half, pixel_angle), true);
    const cl::Buffer spare = p.device.allocate(p.pixels() * sizeof(Float4), "filtered light");
    const uint64_t plane = p.pixels() * sizeof(float);
    const cl::Buffer distances = p.device.allocate(halves ? plane : 0, "distances");
    const cl::Buffer sums = p.device.allocate(halves ? plane : 0, "sums of distances");
    // Compiled before time starts.
    p.kernel("demodulate", "demodulate");
    p.kernel(name_of(filter), halves ? "nlm_finish" : name_of(filter));
    p.device.finish();

    Stopwatch watch;
    p.demodulate(a);
    if (halves) {
        p.demodulate(b);
        p.run_nlm(a, b, distances, sums);
        p.run_nlm(b, a, distances, sums);
        p.finish_nlm(a, b, spare);
        p.modulate(a, spare);
    } else {
        p.modulate(a, p.run_passes(filter, a, spare));
    }
    p.device.finish();

    Denoised out;
    out.wall_s = watch.total();
    out.compile_s = p.compile_s;
    out.pass = {name_of(filter), 0, p.events.size()};
    for (const cl::Event& event : p.events) out.pass.device_s += device::device_seconds(event);
    std::vector<Float4> rgb(p.pixels());
    p.device.download(a.radiance, rgb.data(), rgb.size() * sizeof(Float4));
    out.image = Image{noisy.width, noisy.height, {"R", "G", "B"}, {}, noisy.metadata};
    for (const Float4& c : rgb) out.image.pixels.insert(out.image.pixels.end(), {c.x, c.y, c.z});
    return out;
}

}  // namespace wedge::baselines
