// Errors that renders estimate of themselves, and stop by.
#include <doctest/doctest.h>

#include <cmath>

#include "suite.hpp"
#include "wedge/error.hpp"

namespace wedge::test {
namespace {

Scene small_room() {
    Scene scene = make_room(0);
    scene.film = {40, 30};
    return scene;
}

const Image& truth() {
    static const Image image = render(small_room(), quick(4096, 1, Sampler::sobol, 99)).image;
    return image;
}

TEST_CASE("estimated_errors_are_the_true_ones_within_a_third") {
    const Scene scene = small_room();
    for (Sampler sampler : {Sampler::sobol, Sampler::hash})
        for (int samples : {16, 64, 100}) {
            CAPTURE(std::string(to_string(sampler)));
            CAPTURE(samples);
            RenderOptions options = quick(samples, 1, sampler);
            options.estimate_error = true;
            const Frame frame = render(scene, options);
            REQUIRE(frame.stats.estimated_error.has_value());
            const double told = frame.stats.estimated_error->rmse;
            const double found = rmse_between(frame.image, truth());
            CHECK(told / found > 0.75);
            CHECK(told / found < 1.33);
        }
}

TEST_CASE("estimating_the_error_does_not_change_a_bit") {
    const Scene scene = small_room();
    RenderOptions options = quick(23, 1);
    const Image plain = render(scene, options).image;
    options.estimate_error = true;
    CHECK(render(scene, options).image.pixels == plain.pixels);
}

TEST_CASE("a_target_error_is_reached_and_not_by_far_too_many_samples") {
    const Scene scene = small_room();
    double samples = 0;
    for (double target : {0.004, 0.0015}) {
        RenderOptions options;
        options.bounces = 1;
        options.target_error = target;
        options.target_metric = ErrorMetric::rmse;
        const Frame frame = render(scene, options);
        CAPTURE(target);
        const double found = rmse_between(frame.image, truth());
        CHECK(found < 1.3 * target);
        CHECK(found > 0.4 * target);
        CHECK(frame.stats.estimated_error->rmse <= target * 1.0001);
        CHECK(double(frame.stats.samples) > samples);
        samples = double(frame.stats.samples);
    }
}

TEST_CASE("samples_per_pixel_are_the_most_a_target_may_take") {
    RenderOptions options = quick(24, 1);
    options.target_error = 1e-6;
    CHECK(render(small_room(), options).stats.samples == 24 * 40 * 30);
}

TEST_CASE("targets_that_cannot_be_are_refused") {
    RenderOptions options = quick(24, 1);
    for (double target : {0.0, -1.0, double(NAN)}) {
        options.target_error = target;
        CHECK_THROWS_AS(render(small_room(), options), Error);
    }
    options.target_error = 0.1;
    options.method = Method::aaf;
    options.adaptive = false;
    CHECK_THROWS_AS(render(small_room(), options), Error);
}

}  // namespace
}  // namespace wedge::test
