#include "host/image/plane.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/parallel.hpp"

namespace wedge::image {
namespace {

constexpr std::size_t kRowsAtOnce = 8;

/// `row` with `radius` values more on either side.
template <typename T>
void pad_row(const T* row, int width, int radius, Border border, std::vector<T>& padded) {
    padded.resize(std::size_t(width + 2 * radius));
    const bool nearest = border == Border::nearest;
    std::fill_n(padded.begin(), radius, nearest ? row[0] : T(0));
    std::copy_n(row, width, padded.begin() + radius);
    std::fill_n(padded.begin() + radius + width, radius, nearest ? row[width - 1] : T(0));
}

/// Tap by tap over whole rows, which compilers turn into vector code.
template <typename T>
void add_scaled(const T* source, T weight, int width, T* sum) {
    for (int x = 0; x < width; ++x) sum[x] += weight * source[x];
}

}  // namespace

template <typename T>
Plane<T> filter_separable(const Plane<T>& in, const std::vector<T>& across,
                          const std::vector<T>& down, Border border) {
    const int radius_x = int(across.size() / 2), radius_y = int(down.size() / 2);
    Plane<T> between(in.width, in.height), out(in.width, in.height);
    parallel_ranges(std::size_t(in.height), kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
        std::vector<T> padded;
        for (int y = int(begin); y < int(end); ++y) {
            pad_row(in.row(y), in.width, radius_x, border, padded);
            for (std::size_t i = 0; i < across.size(); ++i)
                add_scaled(padded.data() + i, across[i], in.width, between.row(y));
        }
    });
    parallel_ranges(std::size_t(in.height), kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
        for (int y = int(begin); y < int(end); ++y)
            for (int j = 0; j < int(down.size()); ++j) {
                const int wanted = y + j - radius_y;
                if (border == Border::zero && (wanted < 0 || wanted >= in.height)) continue;
                add_scaled(between.row(std::clamp(wanted, 0, in.height - 1)), down[std::size_t(j)],
                           in.width, out.row(y));
            }
    });
    return out;
}

template <typename T>
std::vector<T> gaussian_weights(double sigma, int radius) {
    std::vector<T> weights;
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += std::exp(-0.5 * x * x / (sigma * sigma));
    for (int x = -radius; x <= radius; ++x)
        weights.push_back(T(std::exp(-0.5 * x * x / (sigma * sigma)) / sum));
    return weights;
}

template Plane<float> filter_separable(const Plane<float>&, const std::vector<float>&,
                                       const std::vector<float>&, Border);
template Plane<double> filter_separable(const Plane<double>&, const std::vector<double>&,
                                        const std::vector<double>&, Border);
template std::vector<float> gaussian_weights(double, int);
template std::vector<double> gaussian_weights(double, int);

}  // namespace wedge::image
