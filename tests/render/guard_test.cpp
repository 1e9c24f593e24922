// What filters are kept from doing, and what is known of their error.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

TEST_CASE("the_guard_takes_back_filters_that_do_harm") {
    // Wires much thinner than a pixel's filter, near the ground and under a large lamp: the probe
    // sees few of them, and a filter as wide as it asks for wipes their shadows out.
    std::vector<Mesh> meshes = {make_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 0)};
    for (int i = -6; i <= 6; ++i)
        meshes.push_back(make_box({0.15f * i, 0.02f, -1}, {0.15f * i + 0.02f, 0.04f, 1}, false, 0));
    meshes.push_back(make_box({-2, 1.2f, -2}, {-0.4f, 1.25f, 2}, false, 0));
    Scene scene = make_scene(meshes, {lambert(0.7f)});
    scene.film = {64, 48};
    scene.camera = {.position = {0, 2, 1.5f}, .target = {0, 0, 0}, .vertical_fov_rad = 0.8f};
    scene.rect_lights = {{.center = {0, 3, 0}, .edge_u = {1.5f, 0, 0}, .edge_v = {0, 0, 1.5f}}};
    const Image truth = render(scene, quick(2048, 0, Sampler::sobol, 9)).image;
    for (float mu : {0.25f, 1.0f, 4.0f}) {
        const Image image = render(scene, filtered(mu)).image;
        const int same = int(std::ceil(channel_mean(image, "spp")));
        CAPTURE(mu);
        // Not 1: two halves of the samples are less evenly spread than the whole.
        CHECK(rmse(image, truth) < 1.4 * rmse(render(scene, quick(same, 0)).image, truth));
    }
}

TEST_CASE("more_samples_overrule_a_filter_that_is_too_wide") {
    // A filter nearly twice as wide as theory asks for at mu = 1, and samples enough to see that it
    // does harm.
    const Scene scene = make_penumbra(LightProfile::uniform);
    const Image truth = render(scene, quick(4096, 0, Sampler::sobol, 9)).image;
    RenderOptions options = filtered(0.0625f);
    options.adaptive = false;
    options.samples_per_pixel = 256;
    const double guarded = rmse(render(scene, options).image, truth);
    options.filter = FilterMode::plain;
    CHECK(guarded < 0.3 * rmse(render(scene, options).image, truth));
    CHECK(guarded < 1.5 * rmse(render(scene, quick(256, 0)).image, truth));
}

/// What the layer tells over what is true, without emission, whose error it does not know.
double told_over_true(const Scene& scene, FilterMode filter = FilterMode::guarded) {
    const Image truth = render(scene, quick(1024, 1, Sampler::sobol, 9)).image;
    RenderOptions options = filtered(1);
    options.bounces = 1;
    options.filter = filter;
    const Image image = render(scene, options).image;
    double told = 0;
    for (double e : channel_values(image, "error")) told += e * e;
    told /= double(image.width) * image.height;
    double found = 0;
    for (const char* channel :
         {"direct.R", "direct.G", "direct.B", "indirect.R", "indirect.G", "indirect.B"})
        found += std::pow(channel_rmse(image, truth, channel), 2) / 3;
    return std::sqrt(told / found);
}

TEST_CASE("the_error_layer_tells_the_error") {
    // The highlights of the second are not filtered.
    for (float gloss : {0.0f, 100.0f}) {
        Scene scene = make_room(gloss);
        scene.film = {64, 48};
        const double ratio = told_over_true(scene);
        CAPTURE(gloss);
        CAPTURE(ratio);
        CHECK(ratio > (gloss > 0 ? 0.85 : 0.6));
        // Bias that there may be is told; 1.8 without gloss.
        CHECK(ratio < 2.0);
    }
}

/// The same of the number that a render ends with, for direct light without filters.
double told_over_true_unfiltered(const Scene& scene) {
    const Image truth = render(scene, quick(2048, 0, Sampler::lattice, 9)).image;
    RenderOptions options = filtered(0.5f);
    options.filter = FilterMode::none;
    const Frame frame = render(scene, options);
    return frame.stats.estimated_error->rmse / rmse(frame.image, truth);
}

TEST_CASE("without_filters_the_error_of_what_was_sampled_is_told") {
    const double ratio = told_over_true_unfiltered(make_penumbra(LightProfile::uniform));
    CAPTURE(ratio);
    CHECK(ratio > 0.75);
    CHECK(ratio < 1.35);
}

TEST_CASE("without_filters_colours_inside_pixels_are_no_noise_of_light") {
    // Ground of dark and bright stripes: samples of a pixel are spread evenly over both sides of an
    // edge, and light is as noisy on both.
    Scene scene = make_penumbra(LightProfile::uniform);
    std::vector<Mesh> meshes = {scene.meshes[1]};
    constexpr float width = 0.16f;
    for (int i = -25; i < 25; ++i)
        meshes.push_back(make_quad({width * float(i), 0, -4}, {0, 0, 8}, {width, 0, 0}, i & 1));
    Scene striped = make_scene(meshes, {lambert(0.1f), lambert(0.8f)});
    striped.film = scene.film;
    striped.camera = scene.camera;
    striped.rect_lights = scene.rect_lights;
    const double ratio = told_over_true_unfiltered(striped);
    CAPTURE(ratio);
    CHECK(ratio > 0.75);
    CHECK(ratio < 1.6);
}

TEST_CASE("without_filters_the_error_of_indirect_light_is_told") {
    Scene scene = make_room(0);
    scene.film = {64, 48};
    const double ratio = told_over_true(scene, FilterMode::none);
    CAPTURE(ratio);
    CHECK(ratio > 0.75);
    CHECK(ratio < 1.35);
}

TEST_CASE("unfiltered_layer_is_the_plain_estimate") {
    // Its mean over seeds is the truth, also where filters are wide: Welch's test over blocks would
    // need many renders; the image's mean has hardly any variance.
    Scene scene = make_room(20);
    scene.film = {40, 32};
    const Image truth = render(scene, quick(1024, 1, Sampler::sobol, 9)).image;
    RenderOptions options = filtered(0.5f);
    options.bounces = 1;
    const Image image = render(scene, options).image;
    for (const auto& [layer, channel] : {std::pair("unfiltered.R", "R"), {"unfiltered.B", "B"}})
        CHECK(channel_mean(image, layer) ==
              doctest::Approx(channel_mean(truth, channel)).epsilon(0.01).scale(1e-9));
}

TEST_CASE("renders_stopped_early_are_filtered") {
    Scene scene = make_room(0);
    scene.film = {48, 36};
    const Image truth = render(scene, quick(1024, 1, Sampler::sobol, 9)).image;
    const uint64_t probe = 16ull * 48 * 36;
    for (uint64_t samples : {probe, probe + 1}) {  // with the probe, a little later
        RenderOptions options = filtered(4);       // narrow filters, many samples
        options.bounces = 1;
        std::atomic<bool> stop{false};
        options.stop = &stop;
        options.on_progress = [&](const Progress& p) { stop = p.samples_done >= samples; };
        const Frame frame = render(scene, options);
        REQUIRE(frame.stats.interrupted);
        CHECK(!frame.stats.estimated_error.has_value());  // half of it is not there
        CHECK(rmse(frame.image, truth) < 0.8 * rmse_of(channel_values(frame.image, "unfiltered.G"),
                                                       channel_values(truth, "G")));
    }
}

TEST_CASE("halves_of_the_samples_are_alike") {
    // With filters too narrow to do anything, a pixel is the mean of its halves. Of 32 independent
    // samples that has the variance of all only if each half has 16.
    Scene scene = make_room(0);
    scene.film = {64, 48};
    const Image truth = render(scene, quick(2048, 1, Sampler::sobol, 9)).image;
    RenderOptions options = filtered(1e4f);
    options.bounces = 1;
    options.sampler = Sampler::hash;
    options.adaptive = false;
    options.samples_per_pixel = 32;
    options.filter = FilterMode::plain;
    const double halves = channel_rmse(render(scene, options).image, truth, "indirect.G");
    const double whole =
        channel_rmse(render(scene, quick(32, 1, Sampler::hash)).image, truth, "indirect.G");
    CAPTURE(halves / whole);
    CHECK(halves < 1.07 * whole);  // 8 and 24 samples: 1.15
}

}  // namespace
}  // namespace wedge::test
