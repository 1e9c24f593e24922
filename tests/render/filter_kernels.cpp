#include "filter_kernels.hpp"

#include <span>
#include <utility>

#include "host/device/program.hpp"
#include "wedge/shared/frame.h"
#include "wedge/shared/scene.h"

namespace wedge::test {
namespace {

/// A filter's kernel and its first arguments, which rows and columns have in common.
struct FilterKernel {
    cl::Kernel kernel;
    std::vector<cl::Buffer> kept;  // kernels do not keep their buffers
    cl_uint index = 0;

    FilterKernel(device::Device& device, const char* name, const FilterFilm& film, float scale) {
        kernel = filter_kernel(device, name);
        std::vector<shared::FilterSettings> settings(1);
        settings[0].max_radius_px = kMaxRadius_px;
        std::vector<shared::Light> lights(1);
        lights[0].normal = {0, 1, 0, 0};
        lights[0].origin = {kLampMiddle[0], kLampMiddle[1], kLampMiddle[2], 0};
        add(upload(device, settings));
        add(upload(device, lights));
        for (const Planes* planes : {&film.places, &film.sigmas, &film.means})
            add(upload(device, planes->values));
        kernel.setArg(index++, cl_int(film.means.width));
        kernel.setArg(index++, cl_int(film.means.height));
        kernel.setArg(index++, scale);
    }

    const cl::Buffer& add(cl::Buffer buffer) {
        kernel.setArg(index++, buffer);
        kept.push_back(std::move(buffer));
        return kept.back();
    }
};

}  // namespace

FilterFilm::FilterFilm(int width, int height)
    : places(width, height, WEDGE_SURFACES * WEDGE_PLACE_PLANES),
      sigmas(width, height, WEDGE_SURFACES * kSignals),
      means(width, height, WEDGE_SURFACES * kMeanPlanes) {}

cl::Kernel filter_kernel(device::Device& device, const char* name) {
    const device::ProgramRequest request{"kernels/filter.cl",
                                         {"WEDGE_SHADOW_LIGHTS=1", "WEDGE_FILTER_HEMISPHERE=1"}};
    return device::build_programs(device, std::span(&request, 1), WEDGE_SOURCE_DIR)[0].kernel(name);
}

Planes run_filter_x(device::Device& device, const FilterFilm& film, float scale) {
    FilterKernel filter(device, "filter_x", film, scale);
    Planes result(film.means.width, film.means.height, WEDGE_SURFACES * kMeanPlanes);
    const cl::Buffer filtered = filter.add(upload(device, result.values));
    device.launch(filter.kernel, result.size() / WEDGE_LANES);
    device.finish();
    device.download(filtered, result.values.data(), result.values.size() * sizeof(float));
    return result;
}

std::vector<shared::HalfLight> run_filter_y(device::Device& device, const FilterFilm& film,
                                            float scale) {
    FilterKernel filter(device, "filter_y", film, scale);
    const std::size_t pixels = std::size_t(film.means.width * film.means.height);
    std::vector<shared::FilmPixel> seen(pixels);
    for (auto& pixel : seen) pixel.normal.w = 1;
    std::vector<shared::SurfaceSum> surfaces(pixels * WEDGE_SURFACES);
    for (auto& surface : surfaces) surface.diffuse = {1, 1, 1, 0};
    filter.add(upload(device, seen));
    filter.add(upload(device, surfaces));
    filter.add(upload(device, std::vector<cl_uint>(pixels + 1)));
    filter.add(upload(device, std::vector<shared::float4>(surfaces.size(), {1, 1, 1, 0})));
    filter.add(upload(device, std::vector<float>(pixels, 1.0f)));
    filter.add(upload(device, std::vector<shared::Remainder>(pixels)));
    std::vector<shared::HalfLight> light(2 * pixels);
    const cl::Buffer filtered = filter.add(upload(device, light));
    filter.kernel.setArg(filter.index, cl_int(0));
    device.launch(filter.kernel, film.means.size() / WEDGE_LANES);
    device.finish();
    device.download(filtered, light.data(), light.size() * sizeof(light[0]));
    return light;
}

}  // namespace wedge::test
