// Pixels look for what is thinner than they are, where their samples have missed it.
#include <doctest/doctest.h>

#include <cmath>

#include "filter_scenes.hpp"
#include "kernel_harness.hpp"

namespace wedge::test {
namespace {

// A pixel is 0.01 wide, 10 away along -z.
TEST_CASE("thin_things_are_in_front_of_a_surface_by_more_than_a_pixel") {
    SamplingKernels kernels;
    const auto is_in_front = [&](float4 thing, float4 normal, float slanted, float eye) {
        return kernels.in_front({thing}, {{0, 0, -10, 0}}, {normal},
                                {{0.01f, slanted, eye, 0}})[0] > 0;
    };
    const float4 facing{0, 0, 1, 0}, away{0, 0, -1, 0}, near_by{0, 0, -9.98f, 0},
        nearer{0, 0, -9.995f, 0}, behind{0, 0, -10.5f, 0};
    for (const float4& normal : {facing, away}) {
        CHECK(is_in_front(near_by, normal, 0.01f, 0));
        CHECK(!is_in_front(nearer, normal, 0.01f, 0));
        CHECK(!is_in_front(behind, normal, 0.01f, 0));
    }
    // In a slanted surface, and where its mean normal is bent: nearer, but not off it, or not by
    // what a pixel is long along it.
    const float slanted = 0.01f / std::sqrt(0.05f);  // cosine 0.05: 0.2 long
    CHECK(!is_in_front({0, 0, -9.5f, 0}, {1, 0, 0.01f, 0}, slanted, 0));
    CHECK(is_in_front({0, 0, -9.5f, 0}, {0.999f, 0, 0.05f, 0}, slanted, 0));
    CHECK(!is_in_front({0, 0, -9.85f, 0}, {0.8f, 0, 0.6f, 0}, slanted, 0));
    // Far from the origin, floats do not tell.
    CHECK(!is_in_front(near_by, facing, 0.01f, 1e6f));
}

/// Black wires, `share` of a pixel wide, at a height over white ground that the film shows from
/// above, a pixel of the film being 1 there, under a lamp. `tilt`: of the view to the side.
Scene make_wires(float share, float height, float tilt_rad = 0) {
    constexpr int kPixels = 32;
    constexpr float kEye = 1000;
    std::vector<Mesh> meshes{make_quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, 0)};
    for (int i = 0; i < 8; ++i)
        meshes.push_back(
            make_quad({-24.7f + 6.2f * float(i), height, 50}, {share, 0, 0}, {1.7f, 0, -100}, 1));
    Scene scene = make_scene(meshes, {lambert(0.8f), lambert(0)});
    scene.film = {kPixels, kPixels};
    scene.camera = {.position = {kEye * std::sin(tilt_rad), kEye * std::cos(tilt_rad), 0},
                    .target = {0, 0, 0},
                    .up = {0, 0, -1},
                    .vertical_fov_rad = 2 * std::atan(0.5f * kPixels / kEye)};
    scene.rect_lights = {{.center = {0, 1500, 0},
                          .edge_u = {400, 0, 0},
                          .edge_v = {0, 0, 400},
                          .radiance = Vec3(20),
                          .profile = LightProfile::uniform}};
    return scene;
}

/// Of what wires hide of the ground, over all that they hide, in the film or a part of it.
double error_of_cover(const Image& found, const Image& truth, const Rect& crop) {
    const std::vector<double> a = channel_values(truth, "albedo.G"),
                              b = channel_values(found, "albedo.G");
    double square = 0, covered = 0;
    for (int y = crop.y; y < crop.y + crop.height; ++y)
        for (int x = crop.x; x < crop.x + crop.width; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(truth.width) + std::size_t(x);
            square += std::pow(a[i] - b[i], 2);
            covered += std::pow(0.8 - a[i], 2);
        }
    REQUIRE(covered > 0);
    return std::sqrt(square / covered);
}

// Eight samples miss a wire that covers a fortieth of a pixel more often than not.
TEST_CASE("pixels_look_for_what_is_thinner_than_they_are") {
    const Scene scene = make_wires(1.0f / 40, 20);
    const Image truth = render(scene, quick(8192, 0, Sampler::lattice, 9)).image;
    RenderOptions options = filtered(1);
    const auto result = render(scene, options);
    const Image& found = result.image;
    const double rays = double(result.stats.rays) / (32 * 32);
    CAPTURE(rays);
    CHECK(rays < 180);                                           // 228 if all pixels did
    CHECK(error_of_cover(found, truth, {0, 0, 32, 32}) < 0.35);  // 0.67 by the samples alone
}

// From aslant what lies elsewhere on the film is elsewhere in depth, too.
TEST_CASE("pixels_of_a_crop_look_for_thin_things_where_they_are") {
    for (const float tilt_rad : {-1.0f, 1.0f}) {
        CAPTURE(tilt_rad);
        const Scene scene = make_wires(1.0f / 20, 5, tilt_rad);
        const Image truth = render(scene, quick(8192, 0, Sampler::lattice, 9)).image;
        RenderOptions options = filtered(1);
        options.crop = Rect{17, 9, 15, 20};
        CHECK(error_of_cover(render(scene, options).image, truth, *options.crop) < 0.4);
    }
}

TEST_CASE("pixels_do_not_look_for_thin_things_under_or_in_the_ground") {
    const auto rays = [](const Scene& scene) { return render(scene, filtered(1)).stats.rays; };
    const uint64_t none = rays(make_wires(3, -20));
    CHECK(rays(make_wires(0.025f, -20)) == none);
    CHECK(rays(make_wires(0.025f, -0.001f)) == none);
    CHECK(rays(make_wires(0.025f, 20)) > 1.2 * double(none));
}

/// Light of white wires, a sixtieth of a pixel wide: the mean over seeds, and the error of pixels,
/// as shares of the truth.
struct LightOfWires {
    double mean = 0, error = 0;
};

/// Over a ground that reflects so much, or before nothing (below 0).
LightOfWires light_of_wires(float ground, float mu) {
    constexpr uint32_t kSeeds = 16;
    Scene scene = make_wires(1.0f / 60, 20);
    scene.materials = {lambert(std::fmax(ground, 0.0f)), lambert(0.8f)};
    if (ground < 0) scene.instances.erase(scene.instances.begin());
    const auto truth =
        channel_values(render(scene, quick(16384, 0, Sampler::lattice, 9)).image, "G");
    double sum = 0, true_sum = 0, square = 0, true_square = 0;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        const auto found = channel_values(render(scene, filtered(mu, seed)).image, "G");
        for (std::size_t i = 0; i < truth.size(); ++i) {
            sum += found[i];
            true_sum += truth[i];
            square += std::pow(found[i] - truth[i], 2);
            true_square += std::pow(truth[i], 2);
        }
    }
    return {sum / true_sum, std::sqrt(square / true_square)};
}

// Paths miss nearly all of them. What these say, who agree that there is nothing, is not the truth;
// and who has met one with a few camera rays looks on, or there would be too much of it.
TEST_CASE("wires_on_black_keep_their_light") {
    for (const float ground : {-1.0f, 0.0f})
        for (const auto& [mu, error] : {std::pair(1.0f, 0.4), {4.0f, 0.15}}) {
            CAPTURE(ground);
            CAPTURE(mu);
            const LightOfWires light = light_of_wires(ground, mu);
            CHECK(light.mean == doctest::Approx(1).epsilon(0.03).scale(1e-9));
            CHECK(light.error < error);
        }
}

TEST_CASE("explain_tells_whether_thin_things_are_looked_for") {
    const auto has = [](const Scene& scene, const RenderOptions& options, const char* line) {
        return explain(scene, options).find(line) != std::string::npos;
    };
    const Scene wires = make_wires(0.025f, 20);
    CHECK(has(wires, filtered(1), "thin things        looked for"));
    CHECK(has(wires, filtered(1), "16 of 20 triangles are four times as long as wide"));
    CHECK(has(wires, quick(1, 0), "thin things        Monte Carlo"));
    CHECK(has(make_wires(90, 20), filtered(1), "thin things        none"));
}

// However many mu asks for, camera rays have a limit; and in the dark there is nothing to find.
TEST_CASE("camera_rays_for_thin_things_have_a_limit") {
    Scene scene = make_wires(0.025f, 20);
    RenderOptions options = filtered(1000);
    options.samples_per_pixel = 16;
    const Frame frame = render(scene, options);
    CHECK(frame.stats.rays < 32 * 32 * (5 * 16 + 4096) / 2);
    scene.rect_lights[0].center = {0, -1500, 0};
    CHECK(render(scene, filtered(1)).stats.rays < 1.05 * 32 * 32 * 8 * 5);
}

}  // namespace
}  // namespace wedge::test
