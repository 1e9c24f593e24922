// The filter's kernel for rows against lines fitted in double precision, pixel by pixel, on films
// whose rows are not whole groups.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "filter_kernels.hpp"

namespace wedge::test {
namespace {

/// Bumpy ground; some pixels show it at two heights, some show nothing, some are not filtered.
/// Pixels are closer than their size, so that it counts how many of them a filter may reach, and
/// the ends of rows are no farther from each other than neighbours.
struct BumpyFilm : FilterFilm {
    BumpyFilm(int width, int height) : FilterFilm(width, height) {
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

/// Weight of surface b of pixel (qx, qy) for surface a of (px, py); docs/filtering.md.
double weight(BumpyFilm& f, int a, int px, int py, int b, int qx, int qy, int signal, double scale,
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
    const double over = std::abs(off) - 0.5 * f.place(a, WEDGE_PLACE_SIZE, px, py);
    if (over >= 0 && over * over >= std::pow(std::tan(ten_degrees), 2) * r2) return 0;
    if (along_y) {
        r2 = 0;
        const double below = double(kLampMiddle[1]) - f.place(a, WEDGE_PLACE_Y, px, py);
        for (int c = 0; c < 3; ++c) {
            const double to_lamp = double(kLampMiddle[c]) - f.place(a, WEDGE_PLACE_X + c, px, py);
            r2 += std::pow(d[c] - d[1] * to_lamp / below, 2);
        }
    }
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

Row sum_row(BumpyFilm& f, int surface, int signal, int x, int y, double scale) {
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

TEST_CASE("filters_along_rows_are_the_lines_that_they_should_be") {
    device::Device device;
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(5, 7), std::pair(21, 6)}) {
        BumpyFilm film(width, height);
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

}  // namespace
}  // namespace wedge::test
