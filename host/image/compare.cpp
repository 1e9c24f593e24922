// The public face of the metrics.
#include <cmath>

#include "host/image/metrics.hpp"
#include "wedge/image_io.hpp"

namespace wedge {

ImageDifference compare_images(const Image& test, const Image& reference) {
    const image::ImagePair pair = image::pair_images(test, reference);
    ImageDifference difference;
    difference.non_finite = pair.counted.size() - pair.counted_pixels;
    difference.mse = image::mean_squared_error(pair);
    difference.rmse = std::sqrt(difference.mse);
    difference.rel_mse = image::relative_mean_squared_error(pair);
    difference.ssim = image::structural_similarity(pair);
    difference.flip = image::mean_of_counted(pair, image::flip_map(pair));
    return difference;
}

Image difference_image(const Image& test, const Image& reference, float gain) {
    const image::ImagePair pair = image::pair_images(test, reference);
    Image result{test.width, test.height, {"R", "G", "B"}, {}, {}};
    result.pixels.resize(pair.counted.size() * 3);
    for (std::size_t i = 0; i < pair.counted.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            result.pixels[i * 3 + c] =
                gain * std::abs(pair.test[c].values[i] - pair.reference[c].values[i]);
    return result;
}

}  // namespace wedge
