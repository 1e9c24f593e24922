// Runs the kernels of kernels/filter.cl on films built in memory: one light, and the hemisphere.
#pragma once

#include <vector>

#include "host/device/device.hpp"
#include "planes.hpp"
#include "wedge/shared/filter.h"

namespace wedge::test {

constexpr int kSignals = 2;  // of one light, and of the hemisphere
constexpr int kMeanPlanes = WEDGE_LIGHT_PLANES + WEDGE_HEMISPHERE_PLANES;
constexpr int kMaxRadius_px = 4;

/// Of the light, a point whose normal is +y.
constexpr float kLampMiddle[3] = {1.3f, 4, -0.4f};

/// What filters read, by surfaces of pixels: places (world units), widths (the same), means of
/// signals. Nothing is anywhere at first.
struct FilterFilm {
    Planes places, sigmas, means;

    FilterFilm(int width, int height);
};

template <typename Items>
cl::Buffer upload(device::Device& device, const Items& items) {
    return device.upload_bytes(items.data(), items.size() * sizeof(items[0]), "array",
                               CL_MEM_READ_WRITE);
}

/// A kernel of kernels/filter.cl with that light and the hemisphere.
cl::Kernel filter_kernel(device::Device& device, const char* name);

/// Means along rows; the light's normal is +y, `scale` that of widths.
Planes run_filter_x(device::Device& device, const FilterFilm& film, float scale);

/// From means along rows: direct and indirect light of each pixel, of white surfaces. There is none
/// but the first surface.
std::vector<shared::HalfLight> run_filter_y(device::Device& device, const FilterFilm& film,
                                            float scale);

}  // namespace wedge::test
