// What pixels take from neighbours that found an occluder, against means in double precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/device/device.hpp"
#include "host/device/program.hpp"
#include "planes.hpp"
#include "wedge/shared/filter.h"

namespace wedge::test {
namespace {

constexpr int kNeighbourhood_px = 5;

/// Level ground, in some pixels as the second surface; few pixels have found an occluder of the one
/// light.
struct Ground {
    Planes places, found;

    Ground(int width, int height)
        : places(width, height, WEDGE_SURFACES * WEDGE_PLACE_PLANES),
          found(width, height, WEDGE_SURFACES * WEDGE_FOUND_PLANES) {
        std::mt19937 random{uint32_t(width)};
        std::uniform_real_distribution<float> uniform(0, 1);
        std::fill(found.values.begin(), found.values.end(), -1.0f);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int k = 0; k < 2; ++k) {
                    places.at(k * WEDGE_PLACE_PLANES + WEDGE_PLACE_X, x, y) = float(x);
                    places.at(k * WEDGE_PLACE_PLANES + WEDGE_PLACE_Z, x, y) = float(y);
                    places.at(k * WEDGE_PLACE_PLANES + WEDGE_PLACE_SIZE, x, y) = 1;
                    places.at(k * WEDGE_PLACE_PLANES + WEDGE_PLACE_NY, x, y) = 1;
                    if (uniform(random) > 0.01f) continue;
                    found.at(k * WEDGE_FOUND_PLANES + WEDGE_FOUND_LEAST, x, y) = uniform(random);
                    found.at(k * WEDGE_FOUND_PLANES + WEDGE_FOUND_MOST, x, y) = uniform(random);
                }
    }

    float least(int surface, int x, int y) {
        return found.at(surface * WEDGE_FOUND_PLANES + WEDGE_FOUND_LEAST, x, y);
    }
};

/// The first surface's; below 0 where nobody near by found anything.
double mean_least(Ground& ground, int x, int y) {
    if (ground.least(0, x, y) >= 0) return double(ground.least(0, x, y));
    const int width = ground.found.width, height = ground.found.height;
    double sum = 0, count = 0;
    for (int j = std::max(y - kNeighbourhood_px, 0); j <= y + kNeighbourhood_px && j < height; ++j)
        for (int i = std::max(x - kNeighbourhood_px, 0); i <= x + kNeighbourhood_px && i < width;
             ++i)
            for (int k = 0; k < 2; ++k)
                if (ground.least(k, i, j) >= 0) {
                    sum += double(ground.least(k, i, j));
                    count += 1;
                }
    return count > 0 ? sum / count : -1;
}

Planes run_filter_neighbours(device::Device& device, Ground& ground) {
    const device::ProgramRequest request{"kernels/distances.cl", {"WEDGE_SHADOW_LIGHTS=1"}};
    const auto programs = device::build_programs(device, std::span(&request, 1), WEDGE_SOURCE_DIR);
    cl::Kernel kernel = programs[0].kernel("filter_neighbours");
    const int width = ground.found.width, height = ground.found.height;
    Planes near_by(width, height, WEDGE_SURFACES * WEDGE_FOUND_PLANES), ends(width, height, 1);
    const auto upload = [&](const Planes& planes) {
        return device.upload_bytes(planes.values.data(), planes.values.size() * sizeof(float),
                                   "planes", CL_MEM_READ_WRITE);
    };
    // Kernels do not keep their buffers.
    const cl::Buffer kept[] = {upload(ground.places), upload(ground.found), upload(near_by),
                               upload(ends)};
    cl_uint index = 0;
    for (const cl::Buffer& buffer : kept) kernel.setArg(index++, buffer);
    kernel.setArg(index++, cl_int(width));
    kernel.setArg(index, cl_int(height));
    device.launch(kernel, near_by.size() / WEDGE_LANES);
    device.finish();
    device.download(kept[2], near_by.values.data(), near_by.values.size() * sizeof(float));
    return near_by;
}

TEST_CASE("pixels_take_the_mean_of_neighbours_that_found_an_occluder") {
    device::Device device;
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(13, 9), std::pair(70, 40)}) {
        CAPTURE(width);
        Ground ground(width, height);
        Planes near_by = run_filter_neighbours(device, ground);
        double worst = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double is = double(near_by.at(WEDGE_FOUND_LEAST, x, y));
                const double off = std::abs(is - mean_least(ground, x, y));
                worst = std::max(worst, std::isfinite(is) ? off : 1);
            }
        CHECK(worst < 1e-5);
    }
}

}  // namespace
}  // namespace wedge::test
