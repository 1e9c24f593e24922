// The filter's kernels against lines fitted in double precision, pixel by pixel, on films whose
// rows are not whole groups.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "host/device/device.hpp"
#include "host/device/program.hpp"
#include "planes.hpp"
#include "wedge/shared/filter.h"
#include "wedge/shared/frame.h"
#include "wedge/shared/scene.h"

namespace wedge::test {
namespace {

constexpr int kSignals = 2;  // of one light, and of the hemisphere
constexpr int kMeanPlanes = WEDGE_LIGHT_PLANES + WEDGE_HEMISPHERE_PLANES;
constexpr int kMaxRadius_px = 4;

/// Bumpy ground; some pixels show it at two heights, some show nothing, some are not filtered.
/// Pixels are closer than their size, so that it counts how many of them a filter may reach, and
/// the ends of rows are no farther from each other than neighbours.
struct Film {
    Planes places, sigmas, means;

    Film(int width, int height)
        : places(width, height, WEDGE_SURFACES * WEDGE_PLACE_PLANES),
          sigmas(width, height, WEDGE_SURFACES * kSignals),
          means(width, height, WEDGE_SURFACES * kMeanPlanes) {
        std::mt19937 random(uint32_t(width * 100 + height));
        std::uniform_real_distribution<float> uniform(0, 1);
        // Their memory was something else before.
        std::fill(means.values.begin(), means.values.end(), NAN);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const int surfaces = int(uniform(random) * 3.5f) % 3;
                for (int k = 0; k < surfaces; ++k) fill(k, x, y, random);
            }
    }

    void fill(int surface, int x, int y, std::mt19937& random) {
        std::uniform_real_distribution<float> uniform(0, 1);
        const int first = surface * WEDGE_PLACE_PLANES;
        const float tilt = uniform(random) < 0.2f ? 0.3f : 0.1f * uniform(random);
        places.at(first + WEDGE_PLACE_X, x, y) = 0.06f * float(x % 8);
        places.at(first + WEDGE_PLACE_Y, x, y) = 0.35f * float(surface) + 0.1f * uniform(random);
        places.at(first + WEDGE_PLACE_Z, x, y) = 0.1f * float(y);
        places.at(first + WEDGE_PLACE_SIZE, x, y) = 0.1f;
        places.at(first + WEDGE_PLACE_NX, x, y) = std::sin(tilt);
        places.at(first + WEDGE_PLACE_NY, x, y) = std::cos(tilt);
        for (int s = 0; s < kSignals; ++s)
            sigmas.at(surface * kSignals + s, x, y) =
                uniform(random) < 0.2f ? 0 : 0.3f * uniform(random);
        for (int c = 0; c < kMeanPlanes; ++c)
            means.at(surface * kMeanPlanes + c, x, y) = uniform(random);
        // A few pixels' second halves have not met the surface.
        if (uniform(random) < 0.2f)
            for (int c : {2, 3, 8, 9, 10, 11}) means.at(surface * kMeanPlanes + c, x, y) = 0;
    }

    double place(int surface, int what, int x, int y) {
        return double(places.at(surface * WEDGE_PLACE_PLANES + what, x, y));
    }
};

/// Weight of surface b of pixel (qx, qy) for surface a of (px, py); docs/method.md.
double weight(Film& f, int a, int px, int py, int b, int qx, int qy, int signal, double scale,
              bool along_y) {
    if (!(f.place(b, WEDGE_PLACE_SIZE, qx, qy) > 0)) return 0;
    double d[3], n[3], cosine = 0, off = 0, r2 = 0;
    for (int c = 0; c < 3; ++c) {
        d[c] = f.place(b, WEDGE_PLACE_X + c, qx, qy) - f.place(a, WEDGE_PLACE_X + c, px, py);
        n[c] = f.place(a, WEDGE_PLACE_NX + c, px, py);
        cosine += n[c] * f.place(b, WEDGE_PLACE_NX + c, qx, qy);
        off += d[c] * n[c];
        r2 += d[c] * d[c];
    }
    const double ten_degrees = 10 * 3.14159265358979 / 180, least = std::cos(2 * ten_degrees);
    if (cosine < least) return 0;
    const double over = std::abs(off) - 2 * f.place(a, WEDGE_PLACE_SIZE, px, py);
    if (over >= 0 && over * over >= std::pow(std::tan(ten_degrees), 2) * r2) return 0;
    if (along_y) r2 -= d[1] * d[1];
    const double sigma = scale * std::min(double(f.sigmas.at(a * kSignals + signal, px, py)),
                                          double(f.sigmas.at(b * kSignals + signal, qx, qy)));
    if (r2 >= 9 * sigma * sigma) return 0;
    return (cosine - least) / (1 - least) * std::exp(-r2 / (2 * sigma * sigma));
}

/// Sums over pixels of a row, by weight, for one surface of a pixel; the light's normal is +y.
struct Row {
    double weights = 0;
    double sums[WEDGE_HEMISPHERE_PLANES] = {}, moments[WEDGE_HEMISPHERE_PLANES] = {},
           squares[WEDGE_HEMISPHERE_PLANES] = {};
};

int planes_of(int signal) {
    return signal == 0 ? WEDGE_LIGHT_PLANES : WEDGE_HEMISPHERE_PLANES;
}

int first_plane(int surface, int signal) {
    return surface * kMeanPlanes + (signal == 0 ? 0 : WEDGE_LIGHT_PLANES);
}

Row sum_row(Film& f, int surface, int signal, int x, int y, double scale) {
    const double sigma = scale * double(f.sigmas.at(surface * kSignals + signal, x, y));
    const int reach = std::min(int(std::ceil(3 * sigma / 0.1)), kMaxRadius_px);
    Row row;
    const auto add = [&](int other, int q, double w) {
        row.weights += w;
        for (int c = 0; c < planes_of(signal); ++c) {
            const double v = double(f.means.at(first_plane(other, signal) + c, q, y));
            row.sums[c] += w * v;
            row.moments[c] += w * v * (q - x);
            row.squares[c] += w * v * (q - x) * (q - x);
        }
    };
    add(surface, x, 1);
    for (int q = std::max(x - reach, 0); q <= std::min(x + reach, f.means.width - 1); ++q)
        for (int b = 0; b < WEDGE_SURFACES && q != x; ++b) {
            const double w = weight(f, surface, x, y, b, q, y, signal, scale, signal == 0);
            if (w > 0) add(b, q, w);
        }
    return row;
}

/// Of a channel, whose weights are those of `seen`.
double slope(const Row& row, int channel, int seen) {
    const double n = row.sums[seen] > 0 ? row.sums[seen] : 1, distance = row.moments[seen] / n;
    return (row.moments[channel] - distance * row.sums[channel]) /
           (row.squares[seen] - distance * row.moments[seen] + n / 12);
}

/// What is made of a row: what a line fitted to it is at the pixel, as far as the slopes of both
/// halves agree.
std::vector<double> fit(const Row& row, int signal) {
    const int count = planes_of(signal), half = count / 2, seen = half - 1;
    std::vector<double> fitted(row.sums, row.sums + count);
    double product = 0, difference2 = 0;
    for (int c = 0; c < seen; ++c) {
        const double a = slope(row, c, seen), b = slope(row, half + c, half + seen);
        product += a * b;
        difference2 += (a - b) * (a - b);
    }
    const double trust = product > 0 ? product / (product + difference2 / 4) : 0;
    for (int h = 0; h < 2; ++h)
        for (int c = 0; c < seen; ++c) {
            double& v = fitted[std::size_t(h * half + c)];
            const double sum = row.sums[h * half + seen], moment = row.moments[h * half + seen];
            v = std::clamp(v - trust * slope(row, h * half + c, h * half + seen) * moment, 0.0,
                           2 * v);
            if (signal == 0) v = std::min(v, sum);
        }
    for (double& v : fitted) v /= row.weights;
    return fitted;
}

template <typename Items>
cl::Buffer upload(device::Device& device, const Items& items) {
    return device.upload_bytes(items.data(), items.size() * sizeof(items[0]), "array",
                               CL_MEM_READ_WRITE);
}

/// A filter's kernel and its first arguments, which rows and columns have in common.
struct FilterKernel {
    cl::Kernel kernel;
    std::vector<cl::Buffer> kept;  // kernels do not keep their buffers
    cl_uint index = 0;

    FilterKernel(device::Device& device, const char* name, const Film& film, float scale) {
        const device::ProgramRequest request{
            "kernels/filter.cl", {"WEDGE_SHADOW_LIGHTS=1", "WEDGE_FILTER_HEMISPHERE=1"}};
        kernel = device::build_programs(device, std::span(&request, 1), WEDGE_SOURCE_DIR)[0].kernel(
            name);
        std::vector<shared::FilterSettings> settings(1);
        settings[0].max_radius_px = kMaxRadius_px;
        std::vector<shared::Light> lights(1);
        lights[0].normal = {0, 1, 0, 0};
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

Planes run_filter_x(device::Device& device, Film& film, float scale) {
    FilterKernel filter(device, "filter_x", film, scale);
    Planes result(film.means.width, film.means.height, WEDGE_SURFACES * kMeanPlanes);
    const cl::Buffer filtered = filter.add(upload(device, result.values));
    device.launch(filter.kernel, result.size() / WEDGE_LANES);
    device.finish();
    device.download(filtered, result.values.data(), result.values.size() * sizeof(float));
    return result;
}

/// Of white surfaces: direct and indirect light of each pixel.
std::vector<shared::HalfLight> run_filter_y(device::Device& device, const Film& film, float scale) {
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
    std::vector<shared::HalfLight> light(2 * pixels);
    const cl::Buffer filtered = filter.add(upload(device, light));
    filter.kernel.setArg(filter.index, cl_int(0));
    device.launch(filter.kernel, film.means.size() / WEDGE_LANES);
    device.finish();
    device.download(filtered, light.data(), light.size() * sizeof(light[0]));
    return light;
}

TEST_CASE("filters_along_rows_are_the_lines_that_they_should_be") {
    device::Device device;
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(5, 7), std::pair(21, 6)}) {
        Film film(width, height);
        for (float scale : {1.0f, 0.25f}) {
            Planes found = run_filter_x(device, film, scale);
            CAPTURE(width);
            double worst = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    for (int k = 0; k < WEDGE_SURFACES; ++k) {
                        if (!(film.place(k, WEDGE_PLACE_SIZE, x, y) > 0)) continue;
                        for (int signal = 0; signal < kSignals; ++signal) {
                            const std::vector<double> truth =
                                fit(sum_row(film, k, signal, x, y, double(scale)), signal);
                            for (int c = 0; c < planes_of(signal); ++c) {
                                const double is =
                                    double(found.at(first_plane(k, signal) + c, x, y));
                                const double off = std::abs(is - truth[std::size_t(c)]);
                                worst = std::max(worst, std::isfinite(is) ? off : 1);
                            }
                        }
                    }
            CHECK(worst < 5e-4);
        }
    }
}

/// One row or column of flat ground, filtered over four pixels, whose light in the two halves is
/// `level` + `first`, `second` times the place in it.
Film sloping_line(bool is_column, float level, float first, float second) {
    constexpr int kLength = 21;
    Film film(is_column ? 1 : kLength, is_column ? kLength : 1);
    for (int i = 0; i < kLength; ++i) {
        const int x = is_column ? 0 : i, y = is_column ? i : 0;
        for (int k = 0; k < WEDGE_SURFACES; ++k)
            film.places.at(k * WEDGE_PLACE_PLANES + WEDGE_PLACE_SIZE, x, y) = 0;
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

Film sloping_row(float level, float first, float second) {
    return sloping_line(false, level, first, second);
}

TEST_CASE("light_that_rises_evenly_is_not_changed_where_a_surface_ends") {
    device::Device device;
    Film film = sloping_row(0.2f, 0.03f, 0.03f);
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
        Film row = sloping_line(false, 0.2f, 0.03f, second);
        Planes truth = run_filter_x(device, row, 1.0f);
        const Film column = sloping_line(true, 0.2f, 0.03f, second);
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
    Film film = sloping_row(0.5f, 0.02f, -0.02f);
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
    Film film = sloping_row(0, 0, 0);
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
    const device::ProgramRequest request{"kernels/filter.cl",
                                         {"WEDGE_SHADOW_LIGHTS=1", "WEDGE_FILTER_HEMISPHERE=1"}};
    const auto programs = device::build_programs(device, std::span(&request, 1), WEDGE_SOURCE_DIR);
    cl::Kernel kernel = programs[0].kernel("filter_means");
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
