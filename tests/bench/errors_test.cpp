#include "bench/converge/errors.hpp"

#include <doctest/doctest.h>

#include "tests/bench/approx.hpp"
#include "tests/bench/synthetic.hpp"

using namespace wedge;
using namespace wedge::converge;
using test::Synthetic;

namespace {

constexpr int kWidth = 160, kHeight = 120;
// Mean squares over 57 600 values: a relative deviation of sqrt(2 / 57 600) = 0.6 %.
constexpr double kTolerance = 0.03;

}  // namespace

TEST_CASE("noise_of_the_reference_is_subtracted_from_mean_squares") {
    Synthetic synthetic(kWidth, kHeight, 1);
    const double noise = 0.01, own = 0.004;
    const Reference reference = synthetic.reference(own);
    CHECK(mean_squared_error_of(reference) == test::close_to(own, kTolerance));
    const Errors errors = measure_errors(synthetic.image(noise), reference);
    CHECK(errors.mse_measured == test::close_to(noise + own, kTolerance));
    CHECK(errors.mse == test::close_to(noise, kTolerance));
}

TEST_CASE("relative_errors_lose_the_noise_of_the_reference_too") {
    // relMSE of noise v around r: mean of v / (r + 0.01)^2, here by the sum over columns.
    Synthetic synthetic(kWidth, kHeight, 2);
    const double noise = 1e-3, own = 5e-4;
    double expected = 0;
    for (int x = 0; x < kWidth; ++x) {
        const double r = synthetic.truth(std::size_t(x)) + 0.01;
        expected += noise / (r * r) / kWidth;
    }
    const Errors errors = measure_errors(synthetic.image(noise), synthetic.reference(own));
    CHECK(errors.rel_mse == test::close_to(expected, kTolerance));
}

TEST_CASE("a_perfect_image_beside_a_noisy_reference_has_no_error") {
    Synthetic synthetic(kWidth, kHeight, 3);
    const double own = 0.01;
    const Errors errors = measure_errors(synthetic.image(0), synthetic.reference(own));
    CHECK(errors.mse_measured == test::close_to(own, kTolerance));
    CHECK(std::abs(errors.mse) < kTolerance * own);
}

TEST_CASE("trimming_drops_fireflies_and_nothing_else") {
    Synthetic synthetic(kWidth, kHeight, 4);
    const Reference reference = synthetic.reference(0);
    Image image = synthetic.image(0, 0.1);
    const Errors clean = measure_errors(image, reference);
    CHECK(clean.mse_trimmed == test::close_to(clean.mse, 1e-4));
    // 19 of 19 200 pixels are less than 0.1 %.
    for (int i = 0; i < 19; ++i) image.at(7 * i, 3, 1) = 1e4f;
    const Errors spotted = measure_errors(image, reference);
    CHECK(spotted.mse > 1e4);
    CHECK(spotted.mse_trimmed == test::close_to(clean.mse, 1e-4));
    CHECK(spotted.rel_mse > 1e3);
    CHECK(spotted.rel_mse_trimmed == test::close_to(clean.rel_mse, 1e-2));
}

TEST_CASE("errors_survive_being_written_and_read") {
    Synthetic synthetic(32, 32, 5);
    const Errors errors = measure_errors(synthetic.image(0.01), synthetic.reference(0.001));
    CHECK(to_json(errors_from(to_json(errors))) == to_json(errors));
}
