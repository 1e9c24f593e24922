// The guard's kernels on light made up for them: what they take for a filter's bias.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include "host/device/device.hpp"
#include "host/device/program.hpp"
#include "wedge/shared/filter.h"

namespace wedge::test {
namespace {

constexpr int kSide = 33, kMiddle = kSide / 2, kPixels = kSide * kSide;
constexpr int kParts = 2;       // direct and indirect light
constexpr float kSamples = 8;   // of a half
constexpr float kNoise = 0.1f;  // standard deviation of one half of a pixel's samples

/// Light of one, direct and indirect, with noise that filters take away, and `bias` with it.
struct Light {
    std::vector<shared::SampledLight> unfiltered = std::vector<shared::SampledLight>(kPixels);
    std::vector<shared::HalfLight> scales =
        std::vector<shared::HalfLight>(WEDGE_SCALES * kParts * kPixels);
    std::vector<float> coverage = std::vector<float>(kParts * kPixels);

    explicit Light(float bias = 0, uint32_t seed = 1) {
        std::mt19937 random(seed);
        std::normal_distribution<float> noise(0, kNoise);
        for (int i = 0; i < kPixels; ++i)
            for (int half = 0; half < 2; ++half) {
                set(i, half, 0, 1 + noise(random));
                for (int scale = 1; scale < WEDGE_SCALES; ++scale)
                    set(i, half, scale, 1 - bias + 0.1f * noise(random) / float(scale));
            }
    }

    static Light without_noise() {
        Light light;
        for (int i = 0; i < kPixels; ++i)
            for (int half = 0; half < 2; ++half)
                for (int scale = 0; scale < WEDGE_SCALES; ++scale) light.set(i, half, scale, 1);
        return light;
    }

    /// Makes direct light so much brighter, as it is sampled and at every scale.
    void brighten_direct(float factor) {
        for (int pixel = 0; pixel < kPixels; ++pixel)
            for (int half = 0; half < 2; ++half) {
                for (int scale = 0; scale < WEDGE_SCALES; ++scale)
                    scale_by(at(scale, pixel, 0).halves[half], factor);
                shared::float4& sum = unfiltered[std::size_t(pixel)].direct[half];
                scale_by(sum, factor);
                sum.w = kSamples;
            }
    }

    static void scale_by(shared::float4& v, float factor) {
        v = {factor * v.x, factor * v.y, factor * v.z, factor * v.w};
    }

    /// Scale 0, the pixel's own samples, is also what was sampled.
    void set(int pixel, int half, int scale, float value) {
        for (int part = 0; part < kParts; ++part)
            at(scale, pixel, part).halves[half] = {value, value, value, scale == 0 ? value : 0};
        if (scale == 0) sample(pixel, half, value);
    }

    shared::HalfLight& at(int scale, int pixel, int part) {
        return scales[std::size_t((scale * kPixels + pixel) * kParts + part)];
    }

    void sample(int pixel, int half, float value) {
        shared::SampledLight& sums = unfiltered[std::size_t(pixel)];
        const float sum = kSamples * value;
        sums.direct[half] = {sum, sum, sum, kSamples};
        sums.indirect[half] = {sum, sum, sum, 0};
    }
};

std::vector<shared::GuardedPixel> run_guard(const Light& light,
                                            int mode = WEDGE_FILTER_MODE_GUARDED) {
    device::Device device;
    const device::ProgramRequest request{"kernels/guard.cl",
                                         {"WEDGE_SHADOW_LIGHTS=1", "WEDGE_FILTER_HEMISPHERE=1"}};
    const auto programs = device::build_programs(device, std::span(&request, 1), WEDGE_SOURCE_DIR);
    shared::FilterSettings settings{};
    settings.mode = mode;
    const auto upload = [&](const auto& items, const char* what) {
        return device.upload_bytes(items.data(), items.size() * sizeof(items[0]), what,
                                   CL_MEM_READ_WRITE);
    };
    std::vector<shared::ScaleErrors> no_errors(kParts * kPixels);
    std::vector<shared::GuardedPixel> guarded(kPixels);
    const cl::Buffer settings_buffer = device.upload_bytes(&settings, sizeof(settings), "settings");
    const cl::Buffer unfiltered = upload(light.unfiltered, "unfiltered");
    const cl::Buffer scales = upload(light.scales, "light");
    const cl::Buffer coverage = upload(light.coverage, "coverage");
    const cl::Buffer errors = upload(no_errors, "errors"), smoothed = upload(no_errors, "errors");
    const cl::Buffer result = upload(guarded, "guarded");
    const auto launch = [&](const char* name, const auto&... args) {
        cl::Kernel kernel = programs[0].kernel(name);
        cl_uint index = 0;
        (kernel.setArg(index++, args), ...);
        device.launch(kernel, kParts * kPixels);
    };
    launch("guard_errors", unfiltered, scales, coverage, errors, cl_uint(kParts * kPixels));
    launch("guard_smooth", errors, smoothed, cl_int(kSide), cl_int(kSide));
    launch("guard_choose", settings_buffer, unfiltered, scales, smoothed, result, cl_int(kSide),
           cl_int(kSide));
    device.download(result, guarded.data(), guarded.size() * sizeof(guarded[0]));
    return guarded;
}

/// Of the 4x4 pixels from (x, x) on: share of the full width that is taken, error that is told.
struct Corner {
    double direct = 0, indirect = 0, error = 0;
};

Corner mean_from(const std::vector<shared::GuardedPixel>& guarded, int x) {
    Corner mean;
    for (int i = 0; i < 16; ++i) {
        const auto& pixel = guarded[std::size_t((x + i / 4) * kSide + x + i % 4)];
        mean.direct += double(pixel.direct.w) / 16;
        mean.indirect += double(pixel.indirect.w) / 16;
        mean.error += double(pixel.error.x) / 16;
    }
    return mean;
}

Corner sum(const Corner& a, const Corner& b) {
    return {a.direct + b.direct, a.indirect + b.indirect, a.error + b.error};
}

TEST_CASE("noise_alone_is_filtered") {
    constexpr uint32_t kSeeds = 16;
    Corner corner, middle;
    for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
        const auto guarded = run_guard(Light(0, seed));
        corner = sum(corner, mean_from(guarded, 0));
        middle = sum(middle, mean_from(guarded, kMiddle));
    }
    for (double width : {corner.direct, corner.indirect, middle.direct, middle.indirect})
        CHECK(width / kSeeds > 0.95);
    // What luck makes of products goes with the root of the pixels they are means over: 6 of 12
    // along each axis.
    CHECK(corner.error / middle.error > 1.2);
    CHECK(corner.error / middle.error < 3);
}

TEST_CASE("what_pixels_measure_is_their_error_in_the_mean") {
    for (float bias : {0.0f, 0.03f, 0.1f, 0.3f}) {
        CAPTURE(bias);
        constexpr uint32_t kSeeds = 16;
        double measured = 0, squares = 0, found = 0, direct = 0;
        for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
            Light light(bias, seed);
            light.brighten_direct(2);
            for (const shared::GuardedPixel& pixel : run_guard(light)) {
                measured += double(pixel.measured.y);
                squares += std::pow(double(pixel.measured.y), 2);
                found += std::pow(double(pixel.indirect.x) - 1, 2);
                direct += double(pixel.measured.x);
            }
        }
        CHECK(found > 0);
        // Which filter is taken goes by the same halves: luck that makes it look good counts, too.
        CHECK(std::abs(measured - found) < 4 * std::sqrt(squares) + 0.1 * found);
        // Direct light is twice as bright: four times the mean square.
        CHECK(direct == doctest::Approx(4 * measured).epsilon(1e-3).scale(1e-9));
    }
}

TEST_CASE("filters_everywhere_or_nowhere_are_measured_too") {
    constexpr float kBias = 0.3f;
    double everywhere = 0, nowhere = 0, told = 0;
    for (const auto& pixel : run_guard(Light(kBias), WEDGE_FILTER_MODE_PLAIN))
        everywhere += double(pixel.measured.x) / kPixels;
    for (const auto& pixel : run_guard(Light(kBias), WEDGE_FILTER_MODE_NONE)) {
        nowhere += double(pixel.measured.x) / kPixels;
        told += double(pixel.error.x) / kPixels;
    }
    CHECK(everywhere == doctest::Approx(kBias * kBias).epsilon(0.05).scale(1e-9));
    CHECK(told > 0);
    CHECK(nowhere == doctest::Approx(told).epsilon(1e-3).scale(1e-9));
}

TEST_CASE("bias_that_filters_share_is_measured") {
    // What was sampled is brighter than any product of means.
    constexpr float kDifference = 0.1f;
    Light light;
    std::mt19937 random(5);
    std::normal_distribution<float> noise(0, kNoise);
    for (int i = 0; i < kPixels; ++i)
        for (int half = 0; half < 2; ++half)
            light.sample(i, half, light.at(0, i, 0).halves[half].x + kDifference + noise(random));
    double measured = 0;
    for (const auto& pixel : run_guard(light, WEDGE_FILTER_MODE_PLAIN))
        measured += double(pixel.measured.x) / kPixels;
    // More by what luck adds to roots of products.
    CHECK(measured > 0.9 * kDifference * kDifference);
    CHECK(measured < 2 * kDifference * kDifference);
}

TEST_CASE("noise_of_samples_goes_with_their_brightness") {
    // Up to where its square, and down to where that of what is sampled, has no place in a float.
    for (float brightness : {1e-30f, 1e-12f, 1.0f, 1e12f}) {
        Light light;
        std::mt19937 random(4);
        std::normal_distribution<float> noise(0, kNoise);
        for (int i = 0; i < kPixels; ++i)
            for (int half = 0; half < 2; ++half)
                light.set(i, half, 0, brightness * (1 + noise(random)));
        double error = 0;
        for (const auto& pixel : run_guard(light, WEDGE_FILTER_MODE_NONE))
            error += double(pixel.error.x) / kPixels;
        CAPTURE(brightness);
        const double square = double(brightness) * double(brightness);
        if (brightness < 1e-20f)
            CHECK(error == 0);
        else
            CHECK(error / square ==
                  doctest::Approx(0.5 * kNoise * kNoise).epsilon(0.15).scale(1e-9));
    }
}

TEST_CASE("a_bright_pixel_leaves_its_neighbours_filtered") {
    // Both halves have met what is rare and bright, one of them much brighter: the product of their
    // drifts is large, but it is that of one pixel. In a corner it is one of 40, not of 140.
    for (int x : {0, kMiddle})
        for (const auto& [first, second] :
             {std::pair(100.f, 3.f), {100.f, 20.f}, {100.f, 100.f}, {1e15f, 1e15f}}) {
            Light light;
            light.set(x * kSide + x, 0, 0, first);
            light.set(x * kSide + x, 1, 0, second);
            const auto guarded = run_guard(light);
            CAPTURE(x);
            CAPTURE(first);
            CAPTURE(second);
            CHECK(mean_from(guarded, x).direct > 0.95);
            CHECK(mean_from(guarded, x).indirect > 0.95);
            for (const auto& pixel : guarded) CHECK(std::isfinite(pixel.error.x));
        }
}

TEST_CASE("a_thin_line_that_filters_wipe_out_is_kept") {
    Light light;
    std::mt19937 random(2);
    std::normal_distribution<float> noise(0, kNoise);
    for (int y = 0; y < kSide; ++y)
        for (int half = 0; half < 2; ++half)
            light.set(y * kSide + kMiddle, half, 0, 3 + noise(random));
    const auto guarded = run_guard(light);
    const shared::GuardedPixel& middle = guarded[std::size_t(kSide * kMiddle + kMiddle)];
    for (float value : {middle.direct.x, middle.indirect.x}) {
        CHECK(value > 2.7f);
        CHECK(value < 3.1f);
    }
}

TEST_CASE("a_pixel_that_was_sampled_badly_keeps_its_filter") {
    // Both halves have missed what is rare and bright, which the pixel's own light knows of.
    Light light = Light::without_noise();
    for (int half = 0; half < 2; ++half) light.sample(kMiddle * kSide + kMiddle, half, 0.5f);
    const auto guarded = run_guard(light);
    const shared::GuardedPixel& middle = guarded[std::size_t(kMiddle * kSide + kMiddle)];
    CHECK(middle.direct.x == doctest::Approx(1).epsilon(1e-3).scale(1e-9));
    CHECK(middle.indirect.x == doctest::Approx(1).epsilon(1e-3).scale(1e-9));
}

TEST_CASE("what_is_near_counts_more") {
    // One pixel where all filters are off: others are told its square by their weights.
    constexpr float kBias = 0.5f;
    Light light = Light::without_noise();
    for (int half = 0; half < 2; ++half)
        for (int scale = 1; scale < WEDGE_SCALES; ++scale)
            light.set(kMiddle * kSide + kMiddle, half, scale, 1 - kBias);
    const auto guarded = run_guard(light, WEDGE_FILTER_MODE_PLAIN);
    const auto told = [&](int x, int y) {
        return double(guarded[std::size_t((kMiddle + y) * kSide + kMiddle + x)].error.x);
    };
    const double most = double(kBias) * double(kBias) / (8 * 8);
    for (const auto& [x, y, share] : {std::tuple(0, 0, 1.0),
                                      {3, 0, 5 / 8.0},
                                      {0, -3, 5 / 8.0},
                                      {-7, 4, 1 / 8.0 * 4 / 8.0},
                                      {8, 0, 0.0},
                                      {0, 8, 0.0}}) {
        CAPTURE(x);
        CAPTURE(y);
        CHECK(told(x, y) == doctest::Approx(share * most).epsilon(1e-3).scale(1e-9));
    }
}

TEST_CASE("a_bias_of_all_filters_is_seen") {
    // Light and colour vary together inside a surface: what was sampled is brighter by a tenth than
    // any product of means, the pixel's own included. Paths alone have more noise, at edges.
    const float difference = 0.1f, edge_noise = 0.05f;
    Light light;
    std::mt19937 random(3);
    std::normal_distribution<float> noise(0, edge_noise);
    for (int i = 0; i < kPixels; ++i)
        for (int half = 0; half < 2; ++half) {
            const float own = light.at(0, i, 0).halves[half].x;
            light.sample(i, half, own + difference + noise(random));
        }
    double direct = 0, indirect = 0, error = 0, measured = 0;
    for (const auto& pixel : run_guard(light)) {
        measured += double(pixel.measured.x) / kPixels;
        direct += double(pixel.direct.x) / kPixels;
        indirect += double(pixel.indirect.x) / kPixels;
        error += double(pixel.error.x) / kPixels;
    }
    // What the halves differ by at edges hardly counts: the noise of what was sampled is 0.072, so
    // that the mixture has 0.66 of the difference.
    CHECK(direct > 1 + 0.5 * double(difference));
    CHECK(indirect > 1 + 0.5 * double(difference));
    CHECK(error > 0.002);
    CHECK(error < 0.006);
    CHECK(measured > 0.8 * error);
    CHECK(measured < 1.2 * error);
}

/// Direct light that is taken where paths, too few to meet what is bright, are darker by a fifth
/// and agree.
double light_that_paths_miss(float coverage_noise) {
    Light light = Light::without_noise();
    for (int i = 0; i < kPixels; ++i)
        for (int half = 0; half < 2; ++half) light.sample(i, half, 0.8f);
    light.coverage.assign(light.coverage.size(), coverage_noise);
    double sum = 0;
    for (const auto& pixel : run_guard(light)) sum += double(pixel.direct.x) / kPixels;
    return sum;
}

TEST_CASE("what_camera_rays_alone_have_met_is_no_bias") {
    CHECK(light_that_paths_miss(0.02f) < 0.9);  // 0.04 is the square of what they miss
    CHECK(light_that_paths_miss(0.028f) == doctest::Approx(1).epsilon(1e-4).scale(1e-9));
}

/// Mean widths that are taken, of direct and of indirect light, where the noise of the mean of both
/// halves falls by `gain` to the widest filter, whose bias has `price` times that as its square.
std::array<double, kParts> widths_at_a_price(double price) {
    constexpr uint32_t kSeeds = 16;
    constexpr float kOthers = 0.1f, kWidest = 0.02f;  // standard deviations of a half
    const double gain = 0.5 * double(kOthers * kOthers - kWidest * kWidest);
    const auto bias = float(std::sqrt(price * gain));
    std::array<double, kParts> widths{};
    for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
        Light light;
        std::mt19937 random(seed);
        std::normal_distribution<float> noise(0, 1);
        for (int pixel = 0; pixel < kPixels; ++pixel)
            for (int half = 0; half < 2; ++half) {
                light.set(pixel, half, 0, 1 + 10 * kOthers * noise(random));
                const float narrow = 1 + kOthers * noise(random);
                for (int scale = 1; scale < WEDGE_SCALES - 1; ++scale)
                    light.set(pixel, half, scale, narrow);
                const float widest = 1 - bias + kWidest * noise(random);
                light.set(pixel, half, WEDGE_SCALES - 1, widest);
            }
        for (const auto& pixel : run_guard(light)) {
            widths[0] += double(pixel.direct.w) / (kPixels * kSeeds);
            widths[1] += double(pixel.indirect.w) / (kPixels * kSeeds);
        }
    }
    return widths;
}

TEST_CASE("drifts_between_filters_are_doubted_by_half_a_standard_error") {
    // By luck alone the square of the drift would be twice the gain. Half of that is taken off, so
    // that the widest filter is taken up to a price of 2.
    for (double width : widths_at_a_price(1.6)) CHECK(width > 0.8);
    for (double width : widths_at_a_price(2.4)) CHECK(width < 0.7);
}

TEST_CASE("bias_within_doubt_is_told") {
    // Its square is not two standard errors of what so many pixels tell of it: filters are taken.
    const double bias = 0.04;
    double width = 0, error = 0;
    for (const auto& pixel : run_guard(Light(float(bias)))) {
        width += double(pixel.direct.w) / kPixels;
        error += double(pixel.error.x) / kPixels;
    }
    CHECK(width > 0.6);
    CHECK(error > 0.6 * bias * bias);
    CHECK(error < 1.5 * bias * bias);
}

}  // namespace
}  // namespace wedge::test
