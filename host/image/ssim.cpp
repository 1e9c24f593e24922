// Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error Visibility to
// Structural Similarity".
#include <algorithm>

#include "host/base/parallel.hpp"
#include "host/base/srgb.hpp"
#include "host/image/metrics.hpp"
#include "host/image/tone.hpp"

namespace wedge::image {
namespace {

constexpr int kRadius_px = 5;
constexpr double kSigma_px = 1.5;
constexpr double kC1 = 0.01 * 0.01;  // (K1 L)^2
constexpr double kC2 = 0.03 * 0.03;  // (K2 L)^2

// Double, because variances are differences of nearly equal means.
using Grey = Plane<double>;

Grey display_grey(const Planes& rgb) {
    Grey grey(rgb[0].width, rgb[0].height);
    parallel_ranges(grey.values.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float x = luminance(rgb[0].values[i], rgb[1].values[i], rgb[2].values[i]);
            grey.values[i] = double(srgb_encode(apply_tone_curve(ToneCurve::reinhard, x)));
        }
    });
    return grey;
}

Grey product(const Grey& a, const Grey& b) {
    Grey result = a;
    for (std::size_t i = 0; i < a.values.size(); ++i) result.values[i] *= b.values[i];
    return result;
}

/// Mean under the window at every pixel, the window cut at the border and scaled to the sum 1.
Grey local_mean(const Grey& image, const std::vector<double>& weights, const Grey& coverage) {
    Grey mean = filter_separable(image, weights, weights, Border::zero);
    for (std::size_t i = 0; i < mean.values.size(); ++i) mean.values[i] /= coverage.values[i];
    return mean;
}

}  // namespace

double structural_similarity(const ImagePair& pair) {
    const auto weights = gaussian_weights<double>(kSigma_px, kRadius_px);
    Grey coverage(pair.width(), pair.height());
    std::fill(coverage.values.begin(), coverage.values.end(), 1.0);
    coverage = filter_separable(coverage, weights, weights, Border::zero);

    const Grey x = display_grey(pair.test), y = display_grey(pair.reference);
    const Grey mean_x = local_mean(x, weights, coverage);
    const Grey mean_y = local_mean(y, weights, coverage);
    const Grey mean_xx = local_mean(product(x, x), weights, coverage);
    const Grey mean_yy = local_mean(product(y, y), weights, coverage);
    const Grey mean_xy = local_mean(product(x, y), weights, coverage);

    double sum = 0;
    for (std::size_t i = 0; i < x.values.size(); ++i) {
        if (!pair.counted[i]) continue;
        const double mx = mean_x.values[i], my = mean_y.values[i];
        const double variance_x = std::max(mean_xx.values[i] - mx * mx, 0.0);
        const double variance_y = std::max(mean_yy.values[i] - my * my, 0.0);
        const double covariance = mean_xy.values[i] - mx * my;
        sum += (2 * mx * my + kC1) * (2 * covariance + kC2) /
               ((mx * mx + my * my + kC1) * (variance_x + variance_y + kC2));  // Eq. 13
    }
    return pair.counted_pixels ? sum / double(pair.counted_pixels) : 1.0;
}

}  // namespace wedge::image
