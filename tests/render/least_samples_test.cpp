// Samples that pixels get, however little they ask for.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

// Else what a few samples agree on by luck stays wrong, whatever mu.
TEST_CASE("no_pixel_is_left_to_the_luck_of_a_few_samples") {
    const Scene scene = make_penumbra(LightProfile::uniform);
    for (const auto& [mu, least] : {std::pair(0.25f, 8), {1.0f, 8}, {2.0f, 16}, {8.0f, 64}}) {
        const auto spp = channel_values(render(scene, filtered(mu)).image, "spp");
        CHECK(*std::min_element(spp.begin(), spp.end()) == least);
    }
}

/// Ground, its left half as bright as told, under strips that hide so much of the lamp at most:
/// penumbrae two pixels wide, filters a tenth of a pixel.
Scene make_faint_shadows(float left, float most_hidden = 1.0f / 400) {
    std::vector<Mesh> meshes{make_quad({-4, 0, -4}, {0, 0, 8}, {4, 0, 0}, 1),
                             make_quad({0, 0, -4}, {0, 0, 8}, {4, 0, 0}, 0)};
    for (float x : {-0.8f, 0.0f, 0.8f})
        meshes.push_back(make_quad({x, 0.6f, -2}, {0, 0, 4}, {0.8f * most_hidden, 0, 0}, 0));
    Scene scene = make_penumbra(LightProfile::uniform);
    const Scene strips = make_scene(meshes, {lambert(0.7f), lambert(left)});
    scene.meshes = strips.meshes;
    scene.instances = strips.instances;
    scene.materials = strips.materials;
    scene.film = {48, 36};
    return scene;
}

struct MeanSamples {
    double shadows = 0, others = 0;
};

/// Of pixels that show the left half of the ground alone.
MeanSamples samples_in_faint_shadows(float left, float mu, float most_hidden = 1.0f / 400) {
    Scene scene = make_faint_shadows(left, most_hidden);
    const Image image = render(scene, filtered(mu)).image;
    const auto lit = channel_values(render(scene, quick(1024, 0)).image, "direct.G");
    scene.meshes.resize(2);
    scene.instances.resize(2);
    const auto bare = channel_values(render(scene, quick(1024, 0)).image, "direct.G");
    const auto spp = channel_values(image, "spp"), height = channel_values(image, "P.Y"),
               x = channel_values(image, "P.X");
    MeanSamples sum, count;
    for (std::size_t i = 0; i < spp.size(); ++i) {
        if (height[i] > 1e-4 || x[i] > -0.1) continue;
        const double hidden = 1 - lit[i] / bare[i];
        if (hidden > 0.32 * double(most_hidden)) sum.shadows += spp[i], count.shadows += 1;
        if (hidden < 1e-5) sum.others += spp[i], count.others += 1;
    }
    REQUIRE(count.shadows > 50);
    REQUIRE(count.others > 50);
    return {sum.shadows / count.shadows, sum.others / count.others};
}

// Path tracing would give all pixels as many. Where filters cannot make up for less, few samples
// would make shadows worse that ask for little, because they are faint.
TEST_CASE("faint_shadows_that_no_filter_helps_keep_up") {
    const MeanSamples mean = samples_in_faint_shadows(0.7f, 4);
    CAPTURE(mean.shadows);
    CAPTURE(mean.others);
    CHECK(mean.shadows > 200);
    CHECK(mean.others < 80);
}

TEST_CASE("shadows_too_dark_to_be_seen_need_not_keep_up") {
    const MeanSamples mean = samples_in_faint_shadows(0.007f, 4);
    CAPTURE(mean.shadows);
    CHECK(mean.shadows < 100);
}

TEST_CASE("with_small_mu_they_keep_up_with_its_root") {
    const MeanSamples mean = samples_in_faint_shadows(0.7f, 0.25f, 1.0f / 40);
    CAPTURE(mean.shadows);
    CHECK(mean.shadows > 24);
}

// There neighbours make up for few samples.
TEST_CASE("pixels_in_wide_penumbrae_need_not_keep_up") {
    Scene scene = make_penumbra(LightProfile::gaussian);
    for (Vec3& p : scene.meshes[1].positions) p.y = 2;
    const Image image = render(scene, filtered(0.5f)).image;
    const auto spp = channel_values(image, "spp"), width = channel_values(image, "width.direct");
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < spp.size(); ++i) {
        if (!(width[i] > 1)) continue;
        sum += spp[i];
        count += 1;
    }
    REQUIRE(count > 100);
    CAPTURE(sum / count);
    CHECK(sum / count < 19);  // 22 if they had to
}

// A filter that reaches five pixels is worth less than five times the samples, for it has a bias.
TEST_CASE("pixels_with_narrow_filters_keep_up_by_half") {
    Scene scene = make_faint_shadows(0.7f);
    for (std::size_t i = 2; i < scene.meshes.size(); ++i)
        for (Vec3& p : scene.meshes[i].positions) p.y = 1.8f;
    const Image image = render(scene, filtered(4)).image;
    const auto spp = channel_values(image, "spp"), width = channel_values(image, "width.direct"),
               height = channel_values(image, "P.Y");
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < spp.size(); ++i) {
        if (height[i] > 1e-4 || width[i] < 0.5 || width[i] > 0.7) continue;
        sum += spp[i];
        count += 1;
    }
    CAPTURE(sum / count);
    REQUIRE(count > 100);
    CHECK(sum / count > 65);   // 50 over the number of pixels
    CHECK(sum / count < 105);  // 137 over nothing
}

/// A wire, a fiftieth of a pixel wide, on black ground: in the penumbra of a board close to it,
/// which filters cannot make smooth.
Scene make_wire_in_shadow() {
    Scene scene = make_scene({make_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 1),
                              make_quad({-0.0106f, 0.2f, -2}, {0, 0, 4}, {0.0012f, 0, 0}, 0),
                              make_quad({0, 0.4f, -2}, {0, 0, 4}, {2, 0, 0}, 1)},
                             {lambert(0.8f), lambert(0)});
    look_down_aslant(scene);
    return scene;
}

/// Light on the wire, pixel by pixel: mean square of its relative error.
double error_of_light_on_wire(float mu, uint32_t seed) {
    const Scene scene = make_wire_in_shadow();
    const Image frame = render(scene, filtered(mu, seed)).image;
    const Image truth = render(scene, quick(4096, 0, Sampler::lattice, 9)).image;
    // By how much of the pixel it covers, of which noise is another matter.
    const double expected = channel_mean(truth, "direct.G") / channel_mean(truth, "albedo.G");
    const auto light = channel_values(frame, "direct.G"), share = channel_values(frame, "albedo.G");
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        if (!(share[i] > 0)) continue;
        sum += std::pow(light[i] / (share[i] * expected) - 1, 2);
        count += 1;
    }
    REQUIRE(count > 30);
    return sum / count;
}

// Hardly a path of a pixel meets what its camera rays look for.
TEST_CASE("light_on_what_covers_little_of_a_pixel_keeps_up_with_mu") {
    double sum = 0;
    for (uint32_t seed = 0; seed < 4; ++seed) sum += error_of_light_on_wire(8, seed);
    CAPTURE(std::sqrt(sum / 4));
    CHECK(std::sqrt(sum / 4) < 0.055);
}

}  // namespace
}  // namespace wedge::test
