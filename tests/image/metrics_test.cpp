#include "host/image/metrics.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "tests/image/support.hpp"
#include "wedge/image_io.hpp"

using namespace wedge;
using wedge::test::error_message;

namespace {

/// Radiances of a wide range, uncorrelated from pixel to pixel.
Image noise(int width, int height, uint32_t seed) {
    Image image{width, height, {"R", "G", "B"}, {}, {}};
    uint32_t state = seed;
    for (int i = 0; i < width * height * 3; ++i) {
        state = state * 1664525u + 1013904223u;
        image.pixels.push_back(std::exp2(float(state >> 8) / float(1 << 24) * 8 - 5));
    }
    return image;
}

Image flat(int width, int height, float value) {
    Image image{width, height, {"R", "G", "B"}, {}, {}};
    image.pixels.assign(std::size_t(width * height * 3), value);
    return image;
}

double display_grey(const Image& image, int x, int y) {
    const double luminance =
        0.2126 * image.at(x, y, 0) + 0.7152 * image.at(x, y, 1) + 0.0722 * image.at(x, y, 2);
    const double v = luminance / (1 + luminance);
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

/// The definition, pixel by pixel: weighted mean, then weighted (co)variance about it.
double brute_force_ssim(const Image& a, const Image& b) {
    double total = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const auto sum = [&](auto&& term) {
                double result = 0;
                for (int v = std::max(y - 5, 0); v <= std::min(y + 5, a.height - 1); ++v)
                    for (int u = std::max(x - 5, 0); u <= std::min(x + 5, a.width - 1); ++u)
                        result += std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / 4.5) *
                                  term(display_grey(a, u, v), display_grey(b, u, v));
                return result;
            };
            const double weight = sum([](double, double) { return 1.0; });
            const double ma = sum([](double p, double) { return p; }) / weight;
            const double mb = sum([](double, double q) { return q; }) / weight;
            const double va = sum([&](double p, double) { return (p - ma) * (p - ma); }) / weight;
            const double vb = sum([&](double, double q) { return (q - mb) * (q - mb); }) / weight;
            const double ab = sum([&](double p, double q) { return (p - ma) * (q - mb); }) / weight;
            total += (2 * ma * mb + 1e-4) * (2 * ab + 9e-4) /
                     ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
        }
    return total / (a.width * a.height);
}

}  // namespace

TEST_CASE("equal_images_have_no_difference") {
    const Image image = noise(40, 30, 1);
    const ImageDifference difference = compare_images(image, image);
    CHECK(difference.mse == 0);
    CHECK(difference.rmse == 0);
    CHECK(difference.rel_mse == 0);
    CHECK(difference.ssim == doctest::Approx(1).epsilon(1e-12));
    CHECK(difference.flip == 0);
    CHECK(difference.non_finite == 0);
}

TEST_CASE("constant_offset_has_its_analytic_errors") {
    const ImageDifference difference = compare_images(flat(9, 7, 0.75f), flat(9, 7, 0.5f));
    CHECK(difference.mse == doctest::Approx(0.0625).epsilon(1e-12));
    CHECK(difference.rmse == doctest::Approx(0.25).epsilon(1e-12));
    CHECK(difference.rel_mse == doctest::Approx(0.0625 / (0.51 * 0.51)).epsilon(1e-12));
}

TEST_CASE("errors_are_means_over_all_channels_and_pixels") {
    Image test = flat(4, 5, 2);
    test.at(3, 2, 1) = 8;  // one value of 60, off by 6
    const ImageDifference difference = compare_images(test, flat(4, 5, 2));
    CHECK(difference.mse == doctest::Approx(36.0 / 60).epsilon(1e-12));
    CHECK(difference.rel_mse == doctest::Approx(36.0 / (2.01 * 2.01) / 60).epsilon(1e-12));
}

TEST_CASE("negative_reference_counts_as_black_in_the_denominator") {
    const ImageDifference difference = compare_images(flat(2, 2, 0), flat(2, 2, -0.01f));
    CHECK(difference.rel_mse == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("relative_error_is_not_symmetric") {
    const Image dark = flat(2, 2, 0.1f), bright = flat(2, 2, 1);
    CHECK(compare_images(dark, bright).rel_mse == doctest::Approx(0.81 / (1.01 * 1.01)));
    CHECK(compare_images(bright, dark).rel_mse == doctest::Approx(0.81 / (0.11 * 0.11)));
}

TEST_CASE("ssim_agrees_with_brute_force_up_to_the_border") {
    Image related = noise(23, 17, 1);
    for (float& value : related.pixels) value = 0.8f * value + 0.1f;
    const Image reference = noise(23, 17, 1);
    const Image unrelated = noise(23, 17, 2);
    for (const Image* test : {&std::as_const(related), &unrelated})
        CHECK(compare_images(*test, reference).ssim ==
              doctest::Approx(brute_force_ssim(*test, reference)).epsilon(1e-5));
    CHECK(compare_images(unrelated, reference).ssim < 0.3);
}

TEST_CASE("ssim_of_images_smaller_than_its_window") {
    for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {1, 20}}) {
        const Image a = noise(width, height, 3), b = noise(width, height, 4);
        CHECK(compare_images(a, b).ssim == doctest::Approx(brute_force_ssim(a, b)).epsilon(1e-5));
    }
}

TEST_CASE("pixels_that_are_not_finite_are_left_out_and_counted") {
    Image test = flat(8, 8, 0.75f), reference = flat(8, 8, 0.5f);
    test.at(1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
    reference.at(1, 1, 2) = std::numeric_limits<float>::infinity();
    reference.at(6, 3, 1) = -std::numeric_limits<float>::infinity();
    const ImageDifference difference = compare_images(test, reference);
    CHECK(difference.non_finite == 2);
    CHECK(difference.mse == doctest::Approx(0.0625).epsilon(1e-12));
    CHECK(std::isfinite(difference.ssim));
    CHECK(std::isfinite(difference.flip));

    const Image nothing = flat(2, 2, std::numeric_limits<float>::quiet_NaN());
    CHECK(compare_images(nothing, nothing).non_finite == 4);
    CHECK(compare_images(nothing, nothing).mse == 0);
}

TEST_CASE("other_channels_and_their_order_do_not_matter") {
    const Image rgb = noise(5, 4, 7);
    Image layered{5, 4, {"A", "B", "direct.R", "G", "R"}, {}, {}};
    for (int i = 0; i < 20; ++i) {
        const float* p = &rgb.pixels[std::size_t(i * 3)];
        layered.pixels.insert(layered.pixels.end(), {0.3f, p[2], 99, p[1], p[0]});
    }
    CHECK(compare_images(layered, rgb).mse == 0);
}

TEST_CASE("images_that_cannot_be_compared_say_why") {
    const auto message = [](const Image& test, const Image& reference) {
        return error_message(ErrorKind::bad_input, [&] { compare_images(test, reference); });
    };
    CHECK(message(flat(2, 3, 0), flat(3, 2, 0)).find("2 x 3") != std::string::npos);
    Image depth{2, 2, {"Z"}, {1, 1, 1, 1}, {}};
    CHECK(message(depth, flat(2, 2, 0)).find("test") != std::string::npos);
    CHECK(message(flat(2, 2, 0), depth).find("reference") != std::string::npos);
}

TEST_CASE("difference_image_is_the_scaled_absolute_difference") {
    Image test = flat(2, 1, 1), reference = flat(2, 1, 1);
    test.at(1, 0, 0) = 0.5f;
    reference.at(1, 0, 2) = 3;
    const Image difference = difference_image(test, reference, 4);
    CHECK(difference.channels == std::vector<std::string>{"R", "G", "B"});
    CHECK(difference.pixels == std::vector<float>{0, 0, 0, 2, 0, 8});
}

TEST_CASE("comparing_1280_by_720_takes_seconds_at_most") {
    const Image test = noise(1280, 720, 1), reference = noise(1280, 720, 2);
    const auto start = std::chrono::steady_clock::now();
    compare_images(test, reference);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    MESSAGE("1280 x 720 compared in " << seconds.count() << " s");
    CHECK(seconds.count() < 60);  // generous: machines that run tests are busy, sanitizers slow
}
