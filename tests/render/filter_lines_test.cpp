// What lines that are fitted to rows and columns make of light: slopes, ends, halves that differ.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "filter_kernels.hpp"

namespace wedge::test {
namespace {

/// One row or column of flat ground, filtered over four pixels, whose light in the two halves is
/// `level` + `first`, `second` times the place in it.
FilterFilm sloping_line(bool is_column, float level, float first, float second) {
    constexpr int kLength = 21;
    FilterFilm film(is_column ? 1 : kLength, is_column ? kLength : 1);
    for (int i = 0; i < kLength; ++i) {
        const int x = is_column ? 0 : i, y = is_column ? i : 0;
        const int place[] = {WEDGE_PLACE_X,  WEDGE_PLACE_Y,  WEDGE_PLACE_Z, WEDGE_PLACE_SIZE,
                             WEDGE_PLACE_NX, WEDGE_PLACE_NY, WEDGE_PLACE_NZ};
        const float at[] = {0.1f * float(x), 0, 0.1f * float(y), 0.1f, 0, 1, 0};
        for (int j = 0; j < 7; ++j) film.places.at(place[j], x, y) = at[j];
        for (int s = 0; s < kSignals; ++s) film.sigmas.at(s, x, y) = 0.4f;
        for (int c = 0; c < kMeanPlanes; ++c) {
            const bool is_first = c < WEDGE_LIGHT_PLANES
                                      ? c < WEDGE_LIGHT_PLANES / 2
                                      : c - WEDGE_LIGHT_PLANES < WEDGE_HEMISPHERE_PLANES / 2;
            film.means.at(c, x, y) = level + (is_first ? first : second) * float(i);
        }
        for (int c : {1, 3, WEDGE_LIGHT_PLANES + 3, WEDGE_LIGHT_PLANES + 7})
            film.means.at(c, x, y) = 1;
    }
    return film;
}

FilterFilm sloping_row(float level, float first, float second) {
    return sloping_line(false, level, first, second);
}

TEST_CASE("light_that_rises_evenly_is_not_changed_where_a_surface_ends") {
    device::Device device;
    FilterFilm film = sloping_row(0.2f, 0.03f, 0.03f);
    Planes found = run_filter_x(device, film, 1.0f);
    for (int x : {0, 1, 10, 20})
        for (int c : {0, 2, WEDGE_LIGHT_PLANES, WEDGE_LIGHT_PLANES + 6}) {
            CAPTURE(x);
            CAPTURE(c);
            // A mean at the border is off by 0.05; what is left is that pixels are not points.
            CHECK(found.at(c, x, 0) ==
                  doctest::Approx(film.means.at(c, x, 0)).epsilon(0.02).scale(1e-9));
        }
}

TEST_CASE("columns_are_filtered_as_rows_are") {
    device::Device device;
    // An even slope, and halves that agree on half of one.
    for (float second : {0.03f, 0.01f}) {
        const FilterFilm row = sloping_line(false, 0.2f, 0.03f, second);
        Planes truth = run_filter_x(device, row, 1.0f);
        const FilterFilm column = sloping_line(true, 0.2f, 0.03f, second);
        const std::vector<shared::HalfLight> found = run_filter_y(device, column, 1.0f);
        for (int i = 0; i < row.means.width; ++i) {
            CAPTURE(i);
            const shared::HalfLight &direct = found[std::size_t(2 * i)],
                                    &indirect = found[std::size_t(2 * i + 1)];
            const float pairs[][2] = {
                {direct.halves[0].x, truth.at(0, i, 0)},
                {direct.halves[1].z, truth.at(2, i, 0)},
                {indirect.halves[0].y, truth.at(WEDGE_LIGHT_PLANES + 1, i, 0)},
                {indirect.halves[1].z, truth.at(WEDGE_LIGHT_PLANES + 6, i, 0)}};
            for (const auto& [is, should_be] : pairs)
                CHECK(is == doctest::Approx(should_be).epsilon(1e-4).scale(1e-9));
        }
    }
}

TEST_CASE("slopes_that_the_halves_do_not_agree_on_are_none") {
    device::Device device;
    FilterFilm film = sloping_row(0.5f, 0.02f, -0.02f);
    Planes found = run_filter_x(device, film, 1.0f);
    const double gaussian[] = {1, std::exp(-0.03125), std::exp(-0.125), std::exp(-0.28125),
                               std::exp(-0.5)};
    double weights = 0, mean = 0;
    for (int i = 0; i <= kMaxRadius_px; ++i) {
        weights += gaussian[i];
        mean += gaussian[i] * (0.5 + 0.02 * i);
    }
    for (int c : {0, WEDGE_LIGHT_PLANES, WEDGE_LIGHT_PLANES + 2}) {
        CAPTURE(c);
        CHECK(found.at(c, 0, 0) == doctest::Approx(mean / weights).epsilon(1e-3));
    }
}

TEST_CASE("lines_make_no_light_less_than_none") {
    // Dark at one end, and steep beyond: the line through it is below 0 at the end.
    device::Device device;
    FilterFilm film = sloping_row(0, 0, 0);
    for (int x = 3; x < 21; ++x)
        for (int c : {0, 2, WEDGE_LIGHT_PLANES, WEDGE_LIGHT_PLANES + 4})
            film.means.at(c, x, 0) = 0.4f * float(x - 2);
    Planes found = run_filter_x(device, film, 1.0f);
    for (int c : {0, 2, WEDGE_LIGHT_PLANES, WEDGE_LIGHT_PLANES + 4}) CHECK(found.at(c, 0, 0) == 0);
    CHECK(found.at(0, 2, 0) > 0);
}

TEST_CASE("a_half_without_samples_has_no_say") {
    // A render that was stopped after the first sample of a pixel.
    device::Device device;
    cl::Kernel kernel = filter_kernel(device, "filter_means");
    Planes places(1, 1, WEDGE_SURFACES * WEDGE_PLACE_PLANES);
    places.at(WEDGE_PLACE_SIZE, 0, 0) = 1;
    Planes means(1, 1, WEDGE_SURFACES * kMeanPlanes);
    std::fill(means.values.begin(), means.values.end(), NAN);
    shared::SampledLight unfiltered{};
    unfiltered.direct[0].w = 1;
    std::vector<shared::float4> sums(std::size_t(2 * kSignals * WEDGE_SURFACES));
    for (int signal = 0; signal < kSignals; ++signal)
        sums[std::size_t(2 * signal)] = {0.1f, 0.2f, 0.3f, 1};
    const std::vector<cl_uint> more(2);
    const cl::Buffer kept[] = {upload(device, std::vector{unfiltered}),
                               upload(device, places.values), upload(device, sums),
                               upload(device, more), upload(device, means.values)};
    cl_uint index = 0;
    for (const cl::Buffer& buffer : kept) kernel.setArg(index++, buffer);
    kernel.setArg(index++, cl_int(1));
    kernel.setArg(index, cl_int(1));
    device.launch(kernel, 1);
    device.finish();
    device.download(kept[4], means.values.data(), means.values.size() * sizeof(float));
    CHECK(means.at(0, 0, 0) == 0.1f);
    CHECK(means.at(WEDGE_LIGHT_PLANES + 3, 0, 0) == 1);
    for (int c : {2, 3, WEDGE_LIGHT_PLANES + 4, WEDGE_LIGHT_PLANES + 7})
        CHECK(means.at(c, 0, 0) == 0);
}

}  // namespace
}  // namespace wedge::test
