#include "host/image/metrics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wedge/error.hpp"

namespace wedge::image {
namespace {

std::array<int, 3> rgb_of(const Image& image, const char* which) {
    const std::array<int, 3> rgb = {image.channel("R"), image.channel("G"), image.channel("B")};
    if (rgb[0] < 0 || rgb[1] < 0 || rgb[2] < 0)
        throw Error(ErrorKind::bad_input,
                    fmt::format("the {} has no channels R, G and B to compare", which));
    return rgb;
}

/// Mean over counted pixels and channels of term(test, reference).
template <typename Term>
double mean_over_channels(const ImagePair& pair, const Term& term) {
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
        const auto& test = pair.test[std::size_t(c)].values;
        const auto& reference = pair.reference[std::size_t(c)].values;
        for (std::size_t i = 0; i < test.size(); ++i)
            if (pair.counted[i]) sum += term(double(test[i]), double(reference[i]));
    }
    return pair.counted_pixels ? sum / (3.0 * double(pair.counted_pixels)) : 0.0;
}

}  // namespace

ImagePair pair_images(const Image& test, const Image& reference) {
    if (test.width != reference.width || test.height != reference.height)
        throw Error(ErrorKind::bad_input,
                    fmt::format("the test is {} x {} pixels, the reference {} x {}; they must be "
                                "of one size",
                                test.width, test.height, reference.width, reference.height));
    const std::array<int, 3> t = rgb_of(test, "test"), r = rgb_of(reference, "reference");
    ImagePair pair;
    for (auto* planes : {&pair.test, &pair.reference})
        planes->fill(Plane<float>(test.width, test.height));
    const std::size_t pixel_count = pair.test[0].values.size();
    pair.counted.assign(pixel_count, 0);
    for (std::size_t i = 0; i < pixel_count; ++i) {
        const float* a = &test.pixels[i * test.channels.size()];
        const float* b = &reference.pixels[i * reference.channels.size()];
        bool finite = true;
        for (int c = 0; c < 3; ++c)
            finite = finite && std::isfinite(a[t[c]]) && std::isfinite(b[r[c]]);
        if (!finite) continue;
        pair.counted[i] = 1;
        ++pair.counted_pixels;
        for (std::size_t c = 0; c < 3; ++c) {
            pair.test[c].values[i] = a[t[c]];
            pair.reference[c].values[i] = b[r[c]];
        }
    }
    return pair;
}

double mean_of_counted(const ImagePair& pair, const Plane<float>& map) {
    double sum = 0;
    for (std::size_t i = 0; i < map.values.size(); ++i)
        if (pair.counted[i]) sum += double(map.values[i]);
    return pair.counted_pixels ? sum / double(pair.counted_pixels) : 0.0;
}

double mean_squared_error(const ImagePair& pair) {
    return mean_over_channels(pair, [](double t, double r) { return (t - r) * (t - r); });
}

double relative_mean_squared_error(const ImagePair& pair) {
    constexpr double kOffset = 0.01;  // pbrt-v4, imgtool diff --metric MRSE
    return mean_over_channels(pair, [](double t, double r) {
        const double relative = (t - r) / (std::max(r, 0.0) + kOffset);
        return relative * relative;
    });
}

}  // namespace wedge::image
