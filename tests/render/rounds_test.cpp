// Filtered renders whose mu rises from round to round, to an end in time or in error.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

double largest_difference(const Image& a, const Image& b, const char* channel) {
    const std::vector<double> x = channel_values(a, channel), y = channel_values(b, channel);
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::fabs(x[i] - y[i]));
    return largest;
}

RenderOptions with_target(double rmse) {
    RenderOptions options = filtered(1);
    options.mu.reset();
    options.target_error = rmse;
    options.target_metric = ErrorMetric::rmse;
    return options;
}

// The same samples, however many rounds they come in: what a camera ray saw counts once, also where
// its path is traced only later.
TEST_CASE("rounds_add_each_sample_once") {
    Scene scene = make_penumbra(LightProfile::uniform);
    // Small in the dark: edges are far brighter than the mean, and get many camera rays at once.
    scene.camera.vertical_fov_rad = 1.8f;
    scene.materials.push_back(lambert(0.1f));
    scene.meshes.back().material_of = {1, 1};
    for (bool at_limits : {true, false}) {
        // So high that all counts are at their limits, or not.
        RenderOptions options = filtered(at_limits ? 1000 : 1.5f);
        options.bounces = 1;
        options.samples_per_pixel = at_limits ? 64 : 128;
        const Image at_once = render(scene, options).image;
        options.target_error = 1e-9;
        const Frame frame = render(scene, options);
        CHECK(frame.stats.mu == options.mu);
        const auto spp = channel_values(at_once, "spp");
        const auto in_rounds = channel_values(frame.image, "spp");
        const auto truth = channel_values(at_once, "unfiltered.G");
        const auto found = channel_values(frame.image, "unfiltered.G");
        const auto emission = channel_values(at_once, "emission.G");
        int same = 0, most = 0;
        for (std::size_t i = 0; i < spp.size(); ++i) {
            if (spp[i] != in_rounds[i]) continue;  // rounds know more of what is hardly noise
            same += 1;
            most += spp[i] == (at_limits ? 64 : 128) ? 1 : 0;
            if (at_limits || emission[i] == 0)  // of which camera rays know more
                CHECK(found[i] == doctest::Approx(truth[i]).epsilon(1e-4).scale(1e-9));
        }
        CHECK(most > 20);
        CHECK(same > 2000);
        if (!at_limits) continue;
        CHECK(largest_difference(at_once, frame.image, "albedo.G") < 1e-5);
        CHECK(largest_difference(at_once, frame.image, "G") < 1e-3);
    }
}

TEST_CASE("rounds_are_as_good_as_the_same_mu_at_once") {
    const Scene scene = make_penumbra(LightProfile::uniform);
    const Image truth = render(scene, quick(4096, 0, Sampler::lattice, 9)).image;
    double at_once = 0, in_rounds = 0, samples_at_once = 0, samples_in_rounds = 0;
    for (uint32_t seed = 0; seed < 4; ++seed) {
        RenderOptions options = filtered(2, seed);
        const Frame one = render(scene, options);
        options.target_error = 1e-9;
        const Frame many = render(scene, options);
        at_once += std::pow(rmse(one.image, truth), 2);
        in_rounds += std::pow(rmse(many.image, truth), 2);
        samples_at_once += double(one.stats.samples);
        samples_in_rounds += double(many.stats.samples);
    }
    CAPTURE(in_rounds / at_once);
    CAPTURE(samples_in_rounds / samples_at_once);
    CHECK(in_rounds < 1.2 * at_once);
    CHECK(samples_in_rounds < 1.2 * samples_at_once);
}

TEST_CASE("filtered_images_meet_a_target_error") {
    Scene scene = make_room(0);
    scene.film = {64, 48};
    const Image truth = render(scene, quick(2048, 1, Sampler::lattice, 9)).image;
    double samples = 0;
    for (double target : {0.002, 0.001}) {
        RenderOptions options = with_target(target);
        options.bounces = 1;
        const Frame frame = render(scene, options);
        CAPTURE(target);
        double square = 0;
        for (const char* c : {"R", "G", "B"})
            square += std::pow(channel_rmse(frame.image, truth, c), 2) / 3;
        const double found = std::sqrt(square);
        CAPTURE(found);
        CHECK(found < 1.3 * target);
        CHECK(found > 0.2 * target);
        REQUIRE(frame.stats.estimated_error.has_value());
        CHECK(frame.stats.estimated_error->rmse <= target);
        CHECK(double(frame.stats.samples) > samples);
        samples = double(frame.stats.samples);
    }
}

TEST_CASE("mu_rises_as_long_as_there_is_time") {
    const Scene scene = make_penumbra(LightProfile::uniform);
    RenderOptions options = filtered(1);
    options.mu.reset();
    options.time_limit_s = 1e-3;
    const double early = render(scene, options).stats.mu;
    options.time_limit_s = 1.5;
    const Frame late = render(scene, options);
    CHECK(early < 1);
    CHECK(late.stats.mu > 2 * early);
    CHECK(late.stats.render_s < 5);  // other work may slow it down
    options.mu = 0.5f;
    CHECK(render(scene, options).stats.mu == 0.5);
}

// A round that would be cut leaves filters narrower than what was sampled, and an error that nobody
// knows.
TEST_CASE("rounds_that_do_not_fit_are_not_begun") {
    RenderOptions options = filtered(1);
    options.mu.reset();
    options.time_limit_s = 6;
    bool slept = false;
    options.on_progress = [&](const Progress&) {  // the probe takes most of the time
        if (!slept) std::this_thread::sleep_for(std::chrono::milliseconds(5550));
        slept = true;
    };
    const Frame frame = render(make_penumbra(LightProfile::uniform), options);
    CHECK(slept);
    CHECK(frame.stats.mu < 0.25);
    CHECK(frame.stats.estimated_error.has_value());
}

// Filters take as long as some samples of every pixel, and the next launch takes its time, too.
TEST_CASE("a_probe_leaves_time_for_filters") {
    RenderOptions options = filtered(1);
    options.mu.reset();
    options.time_limit_s = 1;
    options.tile_pixels = 64 * 48;
    options.on_progress = [](const Progress&) {  // after four samples of eight
        std::this_thread::sleep_for(std::chrono::milliseconds(550));
    };
    const Frame frame = render(make_penumbra(LightProfile::uniform), options);
    CHECK(frame.stats.samples == 4 * 64 * 48);
    CHECK(frame.stats.estimated_error.has_value());
}

TEST_CASE("progress_goes_on_through_both_looks") {
    Scene scene = make_penumbra(LightProfile::uniform);
    scene.film = {32, 24};
    std::vector<Progress> steps;
    RenderOptions options = filtered(4);
    options.tile_pixels = 200;
    options.on_progress = [&](const Progress& p) { steps.push_back(p); };
    render(scene, options);
    REQUIRE(steps.size() > 10);
    for (std::size_t i = 1; i < steps.size(); ++i) {
        CHECK(steps[i].samples_done >= steps[i - 1].samples_done);
        CHECK(steps[i].elapsed_s >= steps[i - 1].elapsed_s);
        CHECK(steps[i - 1].samples_done < steps[i - 1].samples_total);
    }
    CHECK(steps.back().samples_done == steps.back().samples_total);
}

// Samples are limited: filters that go on narrowing would leave noise.
TEST_CASE("few_samples_stop_the_rise_of_mu") {
    RenderOptions options = with_target(1e-9);
    options.samples_per_pixel = 16;
    CHECK(render(make_penumbra(LightProfile::uniform), options).stats.mu == 1);
    options.samples_per_pixel = 192;
    CHECK(render(make_penumbra(LightProfile::uniform), options).stats.mu == 1.5);
}

}  // namespace
}  // namespace wedge::test
