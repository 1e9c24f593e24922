// HDR-FLIP: Andersson, Nilsson, Shirley, Akenine-Möller 2021, "Visualizing Errors in Rendered High
// Dynamic Range Images", Eurographics Short Papers.
#include <algorithm>
#include <cmath>

#include "host/base/parallel.hpp"
#include "host/image/flip.hpp"
#include "host/image/metrics.hpp"
#include "host/image/tone.hpp"

namespace wedge::image {
namespace {

/// Narkowicz' fit with the exposure of the ACES reference (0.6) folded in: (a x^2 + b x) / (c x^2 +
/// d x + e).
constexpr float kExposure = 0.6f;
constexpr float kA = 2.51f * kExposure * kExposure, kB = 0.03f * kExposure;
constexpr float kC = 2.43f * kExposure * kExposure, kD = 0.59f * kExposure, kE = 0.14f;

float aces(float x) {
    x = std::clamp(x, 0.0f, 1e8f);  // the curve is flat there, and x^2 stays finite
    return std::min((kA * x * x + kB * x) / (kC * x * x + kD * x + kE), 1.0f);
}

/// Luminance that is displayed at 0.85 of the maximum: the positive root of aces(x) = 0.85.
double well_exposed_luminance() {
    constexpr double kTarget = 0.85;
    const double a = kA - kTarget * kC, b = kB - kTarget * kD, c = -kTarget * kE;
    return (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
}

struct Exposures {
    double start, stop;  ///< in stops
    int count;
};

/// From the exposure that suits the brightest pixel to the one that suits the median (Sec. 3.2).
Exposures exposures_of(const ImagePair& pair) {
    std::vector<float> luminances;
    for (std::size_t i = 0; i < pair.counted.size(); ++i) {
        const auto& rgb = pair.reference;
        const float y = luminance(rgb[0].values[i], rgb[1].values[i], rgb[2].values[i]);
        if (pair.counted[i]) luminances.push_back(std::max(y, 0.0f));
    }
    // The paper divides by the median; where most of the image is black, the rest decides.
    std::sort(luminances.begin(), luminances.end());
    auto first = luminances.begin();
    if (!luminances.empty() && luminances[luminances.size() / 2] <= 0)
        first = std::upper_bound(luminances.begin(), luminances.end(), 0.0f);
    if (first == luminances.end()) return {0, 0, 1};  // a black reference prefers no exposure
    const double median = *(first + (luminances.end() - first) / 2);
    const double start = std::log2(well_exposed_luminance() / luminances.back());
    const double stop = std::log2(well_exposed_luminance() / median);
    if (start == stop) return {start, stop, 1};
    return {start, stop, std::max(2, int(std::ceil(stop - start)))};
}

Planes displayed(const Planes& radiance, double exposure) {
    const float gain = float(std::exp2(exposure));
    Planes result = radiance;
    parallel_ranges(radiance[0].values.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (Plane<float>& plane : result)
            for (std::size_t i = begin; i < end; ++i)
                plane.values[i] = aces(plane.values[i] * gain);
    });
    return result;
}

}  // namespace

Plane<float> flip_map(const ImagePair& pair) {
    const Exposures range = exposures_of(pair);
    Plane<float> largest(pair.width(), pair.height());
    for (int i = 0; i < range.count; ++i) {
        const double part = range.count > 1 ? double(i) / (range.count - 1) : 0.0;
        const double exposure = range.start + part * (range.stop - range.start);
        const Plane<float> map =
            ldr_flip_map(displayed(pair.test, exposure), displayed(pair.reference, exposure));
        for (std::size_t p = 0; p < map.values.size(); ++p)
            largest.values[p] = std::max(largest.values[p], map.values[p]);
    }
    return largest;
}

}  // namespace wedge::image
