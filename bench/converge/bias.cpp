// Noise or bias: the error split over seeds, and tests of the mean against the reference.
#include <algorithm>
#include <cmath>

#include "bench/converge/analysis.hpp"
#include "host/image/tone.hpp"

namespace wedge::converge {
namespace {

constexpr int kTestBlock_px = 8;
constexpr int kMapBlock_px = 4;
constexpr double kLevel = 0.05;

/// Sum and count by square blocks of pixels.
class Blocks {
  public:
    Blocks(int width, int height, int side)
        : width_(width),
          side_(side),
          across_((width + side - 1) / side),
          size_(std::size_t(across_) * ((height + side - 1) / side)) {}
    std::size_t size() const { return size_; }
    std::size_t of(std::size_t pixel) const {
        const int x = int(pixel % std::size_t(width_)), y = int(pixel / std::size_t(width_));
        return std::size_t(y / side_ * across_ + x / side_);
    }

  private:
    int width_, side_, across_;
    std::size_t size_;
};

double value_at(const Image& image, std::size_t pixel, int channel) {
    return double(image.pixels[pixel * image.channels.size() + std::size_t(channel)]);
}

/// Sums over the pixels of each block of one channel.
std::vector<double> block_sums(const Image& image, const std::string& channel,
                               const Blocks& blocks) {
    std::vector<double> sums(blocks.size(), 0.0);
    const int c = image.channel(channel);
    if (c < 0) return sums;
    for (std::size_t p = 0; p < std::size_t(image.width) * image.height; ++p)
        if (const double v = value_at(image, p, c); std::isfinite(v)) sums[blocks.of(p)] += v;
    return sums;
}

double luminance_at(const Image& image, std::size_t pixel) {
    const double rgb[3] = {value_at(image, pixel, image.channel("R")),
                           value_at(image, pixel, image.channel("G")),
                           value_at(image, pixel, image.channel("B"))};
    const double y = image::luminance(rgb[0], rgb[1], rgb[2]);
    return std::isfinite(y) ? y : 0;
}

std::vector<double> block_luminance(const Image& image, const Blocks& blocks) {
    std::vector<double> sums(blocks.size(), 0.0);
    for (std::size_t p = 0; p < std::size_t(image.width) * image.height; ++p)
        sums[blocks.of(p)] += luminance_at(image, p);
    return sums;
}

double sidak_p(double smallest_p, std::size_t tests) {
    return -std::expm1(double(tests) * std::log1p(-std::min(smallest_p, 1 - 1e-16)));
}

}  // namespace

void split_errors(const Reference& reference, Rung& rung) {
    const double n = double(rung.images.size());
    if (n < 2) return;
    double variance = 0, mse = 0;
    const std::size_t pixels = std::size_t(reference.mean.width) * reference.mean.height;
    const char* const names[3] = {"R", "G", "B"};
    for (std::size_t p = 0; p < pixels; ++p)
        for (int c = 0; c < 3; ++c) {
            double sum = 0, squares = 0;
            for (const Image* image : rung.images) {
                const double v = value_at(*image, p, image->channel(names[c]));
                if (!std::isfinite(v)) continue;
                sum += v;
                squares += v * v;
            }
            variance += std::max(0.0, squares - sum * sum / n) / (n - 1);
        }
    for (const Errors& errors : rung.errors) mse += errors.mse / n;
    variance /= 3 * double(pixels);
    rung.split = Rung::Split{mse, mse - variance, variance};
}

// All runs, weighted by their samples, against the reference. Variances are those of independent
// samples, which is more than stratified samples have: the test may miss a difference, but does not
// see one that is not there.
ZTest z_test(const Reference& reference, const Curve& curve) {
    const Blocks blocks(reference.mean.width, reference.mean.height, kTestBlock_px);
    ZTest test;
    double squares = 0;
    for (const char* channel : {"R", "G", "B"}) {
        std::vector<double> sum(blocks.size(), 0.0), variance(blocks.size(), 0.0);
        double weights = 0;
        for (const Rung& rung : curve.rungs)
            for (std::size_t i = 0; i < rung.runs.size(); ++i) {
                const double weight = double(rung.runs[i]->samples);
                const auto s = block_sums(*rung.images[i], channel, blocks);
                const auto v =
                    block_sums(*rung.images[i], std::string("variance.") + channel, blocks);
                for (std::size_t b = 0; b < blocks.size(); ++b) {
                    sum[b] += weight * s[b];
                    variance[b] += weight * weight * v[b];
                }
                weights += weight;
            }
        const auto r = block_sums(reference.mean, channel, blocks);
        const auto rv = block_sums(reference.variance, channel, blocks);
        for (std::size_t b = 0; b < blocks.size(); ++b) {
            const double difference = sum[b] / weights - r[b];
            const double deviation = std::sqrt(variance[b] / (weights * weights) + rv[b]);
            // Constant blocks differ by rounding only.
            if (deviation <= 1e-6 * std::abs(r[b])) continue;
            const double z = difference / deviation;
            ++test.tests;
            squares += z * z;
            test.largest_z = std::max(test.largest_z, std::abs(z));
        }
    }
    test.mean_square_z = test.tests ? squares / double(test.tests) : 0;
    test.p = test.tests ? sidak_p(std::erfc(test.largest_z / std::sqrt(2.0)), test.tests) : 1;
    return test;
}

std::optional<BiasMap> bias_map(const Reference& reference, const Rung& rung) {
    const double n = double(rung.images.size());
    if (n < 2) return {};
    const Image& r = reference.mean;
    const std::size_t pixels = std::size_t(r.width) * r.height;
    BiasMap map{{r.width, r.height, {"B"}, std::vector<float>(pixels), {}}};
    const Blocks blocks(r.width, r.height, kMapBlock_px);
    std::vector<std::vector<double>> by_seed;
    for (const Image* image : rung.images) by_seed.push_back(block_luminance(*image, blocks));
    const auto expected = block_luminance(r, blocks);
    const auto a = block_luminance(reference.half_a, blocks);
    const auto b = block_luminance(reference.half_b, blocks);

    std::vector<double> p_values;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        double sum = 0, squares = 0;
        for (const auto& seed : by_seed) {
            sum += seed[i];
            squares += seed[i] * seed[i];
        }
        const double mean = sum / n;
        const double own = std::max(0.0, squares - sum * mean) / (n - 1) / n;
        const double of_reference = squared_error_of_mean(a[i], b[i]);
        const double total = own + of_reference;
        const double difference = mean - expected[i];
        if (std::abs(difference) <= 1e-6 * std::abs(expected[i])) {
            p_values.push_back(1);
        } else if (total <= 0) {
            p_values.push_back(0);
        } else {
            // Welch and Satterthwaite; the reference's variance comes from two halves: one degree.
            const double freedom =
                total * total / (own * own / (n - 1) + of_reference * of_reference);
            p_values.push_back(student_p_value(difference / std::sqrt(total), freedom));
        }
    }
    map.tests = p_values.size();
    const double level = -std::expm1(std::log1p(-kLevel) / double(map.tests));
    for (double p : p_values) {
        map.share_below_5_percent += (p < kLevel) / double(map.tests);
        map.significant += p < level;
    }
    for (std::size_t p = 0; p < pixels; ++p) {
        double mean = 0;
        for (const Image* image : rung.images) mean += luminance_at(*image, p) / n;
        const double y = luminance_at(r, p);
        map.relative.pixels[p] = float((mean - y) / (std::max(y, 0.0) + 0.01));
    }
    return map;
}

}  // namespace wedge::converge
