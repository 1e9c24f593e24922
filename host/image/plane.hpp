// One channel of an image, and separable filters over it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace wedge::image {

template <typename T>
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<T> values;  ///< width * height, row 0 at the top

    Plane() = default;
    Plane(int w, int h) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
    T* row(int y) { return values.data() + std::size_t(y) * std::size_t(width); }
    const T* row(int y) const { return values.data() + std::size_t(y) * std::size_t(width); }
};

using Planes = std::array<Plane<float>, 3>;

/// What a filter sees beyond the border: the nearest pixel, or 0.
enum class Border { nearest, zero };

/// out(x, y) = sum over i, j of across[i] * down[j] * in(x + i - radius, y + j - radius). Weights
/// are of odd count, the middle one on the pixel itself. T is float or double.
template <typename T>
Plane<T> filter_separable(const Plane<T>& in, const std::vector<T>& across,
                          const std::vector<T>& down, Border border);

/// exp(-x^2 / (2 sigma^2)) at -radius..radius, scaled to the sum 1. `sigma` in px, > 0.
template <typename T>
std::vector<T> gaussian_weights(double sigma, int radius);

}  // namespace wedge::image
