#include "bench/converge/errors.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/image/metrics.hpp"

namespace wedge::converge {
namespace {

constexpr double kRelativeOffset = 0.01;  // as in `wedge compare`, docs/metrics.md

struct PixelErrors {
    std::vector<double> squares;  ///< of counted pixels, mean over channels, as measured
    std::vector<double> own;      ///< the reference's part of each
};

/// `weigh` gives the factor of a channel's squared error, from the reference's value.
template <typename Weigh>
PixelErrors pixel_errors(const image::ImagePair& pair, const Reference& reference,
                         const Weigh& weigh) {
    PixelErrors errors;
    for (std::size_t i = 0; i < pair.counted.size(); ++i) {
        if (!pair.counted[i]) continue;
        double square = 0, own = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double t = double(pair.test[c].values[i]);
            const double r = double(pair.reference[c].values[i]);
            const double weight = weigh(r) / 3;
            square += weight * (t - r) * (t - r);
            own += weight * squared_error_of_mean(reference.half_a.pixels[i * 3 + c],
                                                  reference.half_b.pixels[i * 3 + c]);
        }
        errors.squares.push_back(square);
        errors.own.push_back(own);
    }
    return errors;
}

double mean_of(const std::vector<double>& values) {
    return values.empty()
               ? 0
               : std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// Without the kTrimmedShare of pixels that have the largest errors.
double trimmed_mean(const PixelErrors& errors) {
    std::vector<std::size_t> order(errors.squares.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    const auto dropped = std::size_t(std::ceil(kTrimmedShare * double(order.size())));
    if (dropped >= order.size()) return 0;
    const auto kept = std::ptrdiff_t(order.size() - dropped);
    std::nth_element(
        order.begin(), order.begin() + kept, order.end(),
        [&](std::size_t a, std::size_t b) { return errors.squares[a] < errors.squares[b]; });
    double sum = 0;
    for (std::ptrdiff_t i = 0; i < kept; ++i)
        sum += errors.squares[order[std::size_t(i)]] - errors.own[order[std::size_t(i)]];
    return sum / double(kept);
}

}  // namespace

nlohmann::json to_json(const Errors& e) {
    return {{"mse", e.mse},
            {"mse_trimmed", e.mse_trimmed},
            {"rel_mse", e.rel_mse},
            {"rel_mse_trimmed", e.rel_mse_trimmed},
            {"mse_measured", e.mse_measured},
            {"ssim", e.ssim},
            {"flip", e.flip},
            {"non_finite", e.non_finite}};
}

Errors errors_from(const nlohmann::json& o) {
    Errors e;
    o.at("mse").get_to(e.mse);
    o.at("mse_trimmed").get_to(e.mse_trimmed);
    o.at("rel_mse").get_to(e.rel_mse);
    o.at("rel_mse_trimmed").get_to(e.rel_mse_trimmed);
    o.at("mse_measured").get_to(e.mse_measured);
    o.at("ssim").get_to(e.ssim);
    o.at("flip").get_to(e.flip);
    o.at("non_finite").get_to(e.non_finite);
    return e;
}

double mean_squared_error(const Image& test, const Reference& reference) {
    const PixelErrors errors = pixel_errors(image::pair_images(test, reference.mean), reference,
                                            [](double) { return 1.0; });
    return mean_of(errors.squares) - mean_of(errors.own);
}

Errors measure_errors(const Image& test, const Reference& reference) {
    const image::ImagePair pair = image::pair_images(test, reference.mean);
    const PixelErrors absolute = pixel_errors(pair, reference, [](double) { return 1.0; });
    const PixelErrors relative = pixel_errors(pair, reference, [](double r) {
        const double scale = std::max(r, 0.0) + kRelativeOffset;
        return 1 / (scale * scale);
    });
    Errors errors;
    errors.mse_measured = mean_of(absolute.squares);
    errors.mse = errors.mse_measured - mean_of(absolute.own);
    errors.mse_trimmed = trimmed_mean(absolute);
    errors.rel_mse = mean_of(relative.squares) - mean_of(relative.own);
    errors.rel_mse_trimmed = trimmed_mean(relative);
    errors.ssim = image::structural_similarity(pair);
    errors.flip = image::mean_of_counted(pair, image::flip_map(pair));
    errors.non_finite = pair.counted.size() - pair.counted_pixels;
    return errors;
}

double root(double mean_square) {
    return mean_square > 0 ? std::sqrt(mean_square) : 0;
}

std::vector<double> squared_error_map(const Image& test, const Reference& reference) {
    const image::ImagePair pair = image::pair_images(test, reference.mean);
    std::vector<double> map(pair.counted.size(), 0.0);
    for (std::size_t i = 0; i < map.size(); ++i) {
        if (!pair.counted[i]) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            const double d = double(pair.test[c].values[i]) - pair.reference[c].values[i];
            map[i] += (d * d - squared_error_of_mean(reference.half_a.pixels[i * 3 + c],
                                                     reference.half_b.pixels[i * 3 + c])) /
                      3;
        }
    }
    return map;
}

}  // namespace wedge::converge
