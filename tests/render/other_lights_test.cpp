// Filtered light of lamps whose shadows are not filtered one by one.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

constexpr float kRadius = 0.3f, kHeight = 1.5f, kEmission = 40, kAlbedo = 0.7f;

/// A ball that shines over the ground, in sight.
Scene make_lantern() {
    Material lamp = lambert(0);
    lamp.emission = Vec3(kEmission);
    Scene scene = make_scene({make_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 0),
                              make_sphere({0, kHeight, 0}, kRadius, 24, false, 1)},
                             {lambert(kAlbedo), lamp});
    scene.film = {48, 36};
    scene.camera = {.position = {0, 2.5f, 5}, .target = {0, 0, 1}, .vertical_fov_rad = 0.5f};
    return scene;
}

/// Samples as the filtered image has, in the mean.
Image path_traced(const Scene& scene, const Image& like, int bounces) {
    return render(scene, quick(int(std::ceil(channel_mean(like, "spp"))), bounces)).image;
}

/// Light of the ball on the ground, all of it above the horizon: irradiance is pi L (r / d)^2 cos.
std::vector<double> expected_light(const Image& image) {
    const auto x = channel_values(image, "P.X"), z = channel_values(image, "P.Z");
    std::vector<double> expected;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double d2 = x[i] * x[i] + z[i] * z[i] + double(kHeight * kHeight);
        expected.push_back(double(kAlbedo * kEmission * kRadius * kRadius * kHeight) /
                           (d2 * std::sqrt(d2)));
    }
    return expected;
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST_CASE("a_shining_ball_lights_the_ground_by_its_solid_angle") {
    const Image image = render(make_lantern(), filtered(4)).image;
    const auto found = channel_values(image, "direct.G"), expected = expected_light(image);
    CHECK(channel_mean(image, "A") == 1);
    double squares = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
        squares += std::pow(found[i] / expected[i] - 1, 2);
    CHECK(sum_of(found) == doctest::Approx(sum_of(expected)).epsilon(0.005).scale(1e-9));
    CHECK(std::sqrt(squares / double(found.size())) < 0.02);
}

TEST_CASE("numbers_of_samples_do_not_make_light_that_is_bright_by_luck_last") {
    const Scene scene = make_lantern();
    double found = 0, expected = 0;
    for (uint32_t seed = 0; seed < 16; ++seed) {
        RenderOptions options = filtered(0.5f, seed);
        options.filter = FilterMode::none;
        const Image image = render(scene, options).image;
        CHECK(channel_mean(image, "spp") > 12);  // so that the first ones do not decide alone
        found += sum_of(channel_values(image, "direct.G"));
        expected += sum_of(expected_light(image));
    }
    CHECK(found == doctest::Approx(expected).epsilon(0.008).scale(1e-9));
}

TEST_CASE("light_of_meshes_is_filtered_apart_from_what_bounces") {
    Scene scene = make_lantern();
    scene.meshes.push_back(make_quad({-1.2f, 0, -1}, {0, 0, 3}, {0, 2, 0}, 0));
    scene.instances.push_back({.mesh = 2});
    const Image truth = render(scene, quick(1024, 2, Sampler::lattice, 9)).image;
    for (const char* channel : {"direct.G", "indirect.G"}) {
        CAPTURE(channel);
        RenderOptions options = filtered(1);
        options.bounces = 2;
        const Image coarse = render(scene, options).image, plain = path_traced(scene, coarse, 2);
        CHECK(channel_rmse(coarse, truth, channel) < 0.4 * channel_rmse(plain, truth, channel));
        options.mu = 4;
        const Image fine = render(scene, options).image;
        CHECK(channel_mean(fine, channel) ==
              doctest::Approx(channel_mean(truth, channel)).epsilon(0.01).scale(1e-9));
    }
}

TEST_CASE("lamps_beside_filtered_ones_are_counted_once") {
    // Near a large filtered rectangle and a large ball, that rays which look for neither meet as
    // well.
    Scene scene = make_lantern();
    scene.materials[0].specular = Vec3(0.2f);
    scene.materials[0].exponent = 8;
    scene.materials[0].model = SpecularModel::phong;
    scene.rect_lights = {{.center = {0, 2.2f, 1},
                          .edge_u = {2, 0, 0},
                          .edge_v = {0, 0, 2},
                          .radiance = {10, 30, 60}}};
    scene.materials[1].emission = {20, 6, 2};
    const Image truth = render(scene, quick(2048, 1, Sampler::lattice, 9)).image;
    RenderOptions options = filtered(4);
    options.bounces = 1;
    const std::string plan = explain(scene, options);
    CHECK(plan.find("WEDGE_SHADOW_LIGHTS=1") != std::string::npos);
    CHECK(plan.find("WEDGE_FILTER_OTHER_LIGHTS=1") != std::string::npos);
    for (FilterMode mode : {FilterMode::guarded, FilterMode::plain}) {
        options.filter = mode;
        const Image image = render(scene, options).image;
        for (const char* channel : {"direct.R", "direct.G", "direct.B"}) {
            CAPTURE(channel);
            CHECK(channel_mean(image, channel) ==
                  doctest::Approx(channel_mean(truth, channel)).epsilon(0.005).scale(1e-9));
        }
    }
}

TEST_CASE("nothing_but_lobes_and_points_is_left_to_plain_sampling") {
    // Rays of paths meet both lamps, each of which takes its own part of that.
    Scene scene = make_lantern();
    scene.rect_lights = {
        {.center = {0, 2.2f, 1}, .edge_u = {2, 0, 0}, .edge_v = {0, 0, 2}, .radiance = Vec3(50)}};
    const Image truth = render(scene, quick(4096, 1, Sampler::lattice, 9)).image;
    RenderOptions options = filtered(1);
    options.bounces = 1;
    const Image image = render(scene, options).image;
    CHECK(rmse(image, truth) < 0.25 * rmse(path_traced(scene, image, 1), truth));
}

TEST_CASE("probes_note_how_far_away_lamps_are_and_what_hides_them") {
    Scene scene = make_lantern();
    const auto check = [&](auto is_right) {
        const Image image = render(scene, filtered(1)).image;
        const auto nearest = channel_values(image, "near.direct"),
                   farthest = channel_values(image, "far.direct"), x = channel_values(image, "P.X"),
                   y = channel_values(image, "P.Y"), z = channel_values(image, "P.Z");
        int count = 0;
        for (std::size_t i = 0; i < nearest.size(); ++i) {
            if (std::abs(y[i]) > 1e-3) continue;  // not on the ground alone
            const double d = std::sqrt(x[i] * x[i] + z[i] * z[i] + double(kHeight * kHeight));
            count += is_right(d, nearest[i], farthest[i]);
        }
        return count;
    };
    // The half of the ball that is seen. Pixels are up to 0.1 long.
    const auto sees_ball = [](double d, double nearest, double farthest) {
        return nearest > d - double(kRadius) - 0.06 && farthest < d + 0.06 && farthest > nearest;
    };
    const int all = check(sees_ball);
    CHECK(all > 1000);
    // A plate 0.2 above the ground that hides it from there.
    scene.meshes.push_back(make_quad({-0.5f, 0.2f, 0.5f}, {0, 0, 1}, {1, 0, 0}, 0));
    scene.instances.push_back({.mesh = 2});
    CHECK(check(sees_ball) < all - 50);
    CHECK(check([](double, double nearest, double) { return nearest > 0.19 && nearest < 0.3; }) >
          50);
}

/// A penumbra of nine equal lamps, of which no four have half of the power.
Scene nine_lamps() {
    Scene scene = make_penumbra(LightProfile::uniform);
    const RectLight lamp = scene.rect_lights[0];
    scene.rect_lights.clear();
    for (int i = 0; i < 9; ++i) {
        scene.rect_lights.push_back(lamp);
        scene.rect_lights.back().center +=
            Vec3(0.8f * float(i % 3 - 1), 0, 0.8f * float(i / 3 - 1));
    }
    return scene;
}

TEST_CASE("many_lamps_are_filtered_together") {
    const Scene scene = nine_lamps();  // at which paths look four times
    CHECK(explain(scene, filtered(1)).find("WEDGE_LIGHT_RAYS=4") != std::string::npos);
    const Image truth = render(scene, quick(4096, 0, Sampler::lattice, 9)).image;
    const Image image = render(scene, filtered(1)).image;
    CHECK(channel_mean(image, "direct.G") ==
          doctest::Approx(channel_mean(truth, "direct.G")).epsilon(0.005).scale(1e-9));
    CHECK(rmse(image, truth) < 0.5 * rmse(path_traced(scene, image, 0), truth));
}

TEST_CASE("paths_that_look_often_at_lamps_are_asked_for_by_their_own_noise") {
    Scene scene = nine_lamps();
    RenderOptions options = filtered(2);
    options.samples_per_pixel = 4096;  // no limit
    const auto often = channel_values(render(scene, options).image, "spp");
    scene.background = Vec3(1e-6f);  // which paths look for by going on, and then look once
    CHECK(explain(scene, options).find("WEDGE_LIGHT_RAYS") == std::string::npos);
    const auto once = channel_values(render(scene, options).image, "spp");
    double sum_once = 0, sum_often = 0;
    for (std::size_t i = 0; i < once.size(); ++i) {
        if (!(often[i] > 64)) continue;  // that least numbers do not matter
        sum_once += once[i];
        sum_often += often[i];
    }
    REQUIRE(sum_often > 100 * 64);
    CAPTURE(sum_once / sum_often);
    // A quarter of the variance: what is asked for goes with its power 0.4.
    CHECK(sum_once / sum_often == doctest::Approx(std::pow(4, 0.4)).epsilon(0.15).scale(1e-9));
}

TEST_CASE("points_are_not_filtered_with_flat_lamps") {
    // Their shadows have no width: an edge that filters would blur.
    Scene scene = make_lantern();
    scene.materials[1].emission = Vec3(2);
    scene.point_lights = {{.position = {1, 2.5f, 0.5f}, .intensity = Vec3(3)}};
    scene.meshes.push_back(make_quad({-0.5f, 0.2f, 0.5f}, {0, 0, 1}, {1, 0, 0}, 0));
    scene.instances.push_back({.mesh = 2});
    const Image truth = render(scene, quick(2048, 0, Sampler::lattice, 9)).image;
    RenderOptions options = filtered(1);
    options.filter = FilterMode::plain;
    const Image image = render(scene, options).image;
    CHECK(channel_mean(image, "direct.G") ==
          doctest::Approx(channel_mean(truth, "direct.G")).epsilon(0.01).scale(1e-9));
    CHECK(rmse(image, truth) < 1.05 * rmse(path_traced(scene, image, 0), truth));
}

}  // namespace
}  // namespace wedge::test
