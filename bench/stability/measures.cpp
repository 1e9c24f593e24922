#include "bench/stability/measures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wedge::stability {
namespace {

using converge::Reference;
using converge::Rung;

constexpr int kBlock_px = 8;  // of the measure `constant`

/// True for pixels in any of the regions; all pixels if there are none.
std::vector<bool> mask_of(const std::vector<Region>& regions, int width, int height) {
    std::vector<bool> mask(std::size_t(width) * height, regions.empty());
    for (const Region& r : regions)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double u = (x + 0.5) / width, v = (y + 0.5) / height;
                if (u >= r.x && u < r.x + r.width && v >= r.y && v < r.y + r.height)
                    mask[std::size_t(y) * width + x] = true;
            }
    return mask;
}

double mean_where(const std::vector<bool>& mask, const std::vector<double>& values) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (mask[i]) {
            sum += values[i];
            count += 1;
        }
    return count > 0 ? sum / count : 0;
}

/// Mean of R, G, B, by pixel.
std::vector<double> grey_of(const Image& image) {
    const int rgb[3] = {image.channel("R"), image.channel("G"), image.channel("B")};
    std::vector<double> grey;
    grey.reserve(std::size_t(image.width) * image.height);
    for (std::size_t i = 0; i < image.pixels.size(); i += image.channels.size()) {
        double sum = 0;
        for (int c : rgb) sum += double(image.pixels[i + std::size_t(c)]);
        grey.push_back(sum / 3);
    }
    return grey;
}

double rmse_where(const std::vector<bool>& mask, const Rung& rung, const Reference& reference) {
    double sum = 0;
    for (const Image* image : rung.images)
        sum += mean_where(mask, converge::squared_error_map(*image, reference));
    return converge::root(sum / double(rung.images.size()));
}

double energy_error(const std::vector<bool>& mask, const Rung& rung, const Reference& reference) {
    double sum = 0;
    for (const Image* image : rung.images) sum += mean_where(mask, grey_of(*image));
    const double expected = mean_where(mask, grey_of(reference.mean));
    return std::abs(sum / double(rung.images.size()) - expected) / std::max(expected, 1e-30);
}

double deviation_from(double value, const Rung& rung) {
    double largest = 0;
    for (const Image* image : rung.images) {
        const std::vector<double> grey = grey_of(*image);
        for (int top = 0; top < image->height; top += kBlock_px)
            for (int left = 0; left < image->width; left += kBlock_px) {
                const int right = std::min(left + kBlock_px, image->width);
                const int bottom = std::min(top + kBlock_px, image->height);
                double sum = 0;
                for (int y = top; y < bottom; ++y)
                    for (int x = left; x < right; ++x)
                        sum += grey[std::size_t(y) * image->width + x];
                const double mean = sum / (double(right - left) * (bottom - top));
                largest = std::max(largest, std::abs(mean - value) / value);
            }
    }
    return largest;
}

}  // namespace

bool is_ratio(Measure measure) {
    return measure == Measure::rmse || measure == Measure::rel_rmse || measure == Measure::dssim;
}

double mean_of(const Image& rgb) {
    return std::accumulate(rgb.pixels.begin(), rgb.pixels.end(), 0.0) /
           double(std::max<std::size_t>(rgb.pixels.size(), 1));
}

double measure(const Rule& rule, const Rung& rung, const Reference& reference) {
    const std::vector<bool> mask =
        mask_of(rule.regions, reference.mean.width, reference.mean.height);
    switch (rule.measure) {
        case Measure::rmse:
            return rmse_where(mask, rung, reference);
        case Measure::rel_rmse:
            return std::sqrt(rung.metrics[2].median);
        case Measure::dssim:
            return std::max(0.0, rung.metrics[4].median);
        case Measure::energy:
            return energy_error(mask, rung, reference);
        case Measure::constant:
            return deviation_from(rule.value, rung);
        case Measure::noise:
            return rung.metrics[0].median / std::max(mean_of(reference.mean), 1e-30);
    }
    return 0;
}

}  // namespace wedge::stability
