// Axis-aligned filtering: images.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "filter_scenes.hpp"
#include "wedge/shared/filter.h"

namespace wedge::test {
namespace {

TEST_CASE("light_without_occluders_is_not_touched") {
    for (LightProfile profile : {LightProfile::uniform, LightProfile::gaussian}) {
        Scene scene = make_penumbra(profile);
        scene.instances.pop_back();
        const Image truth = render(scene, quick(512, 0, Sampler::sobol, 9)).image;
        const Image image = render(scene, filtered(1)).image;
        CHECK(channel_mean(image, "G") ==
              doctest::Approx(channel_mean(truth, "G")).epsilon(1e-3).scale(1e-9));
        // Visibility is exactly one, and unshadowed light all but free of noise; edges are not.
        CHECK(rmse(image, truth) < 0.006 * channel_mean(truth, "G"));
    }
}

// Filters do nothing for them, so they must be worth as much as those of plain sampling: halves of
// different sequences would be worth less.
TEST_CASE("samples_find_edges_as_well_as_without_filters") {
    constexpr int kSamples = 64;
    Scene scene = make_penumbra(LightProfile::uniform);
    scene.materials.push_back(lambert(0.1f));
    scene.meshes.back().material_of = {1, 1};
    const Image truth = render(scene, quick(8192, 0, Sampler::lattice, 9)).image;
    double with = 0, without = 0;  // mean square errors of albedo
    for (uint32_t seed = 0; seed < 12; ++seed) {
        RenderOptions options = filtered(1, seed);
        options.adaptive = false;
        options.samples_per_pixel = kSamples;
        with += std::pow(channel_rmse(render(scene, options).image, truth, "albedo.G"), 2);
        const Image plain = render(scene, quick(kSamples, 0, Sampler::sobol, seed)).image;
        without += std::pow(channel_rmse(plain, truth, "albedo.G"), 2);
    }
    CAPTURE(with / without);
    CHECK(without > 0);
    CHECK(with < 1.3 * without);
}

TEST_CASE("filtered_shadows_need_fewer_samples") {
    const Scene scene = make_penumbra(LightProfile::gaussian);
    const Image truth = render(scene, quick(4096, 0, Sampler::sobol, 9)).image;
    const Frame frame = render(scene, filtered(1));
    const double samples = channel_mean(frame.image, "spp");
    const int same = int(std::ceil(samples));
    const double plain = rmse(render(scene, quick(same, 0)).image, truth);
    CHECK(rmse(frame.image, truth) < 0.8 * plain);
}

TEST_CASE("other_lights_gloss_and_bounces_stay_right_beside_filtered_shadows") {
    Scene scene = make_room(20);
    // With half of these pixels filters take 0.9 % of the indirect light.
    scene.film = {80, 64};
    scene.point_lights = {{.position = {0.5f, 0.8f, 0.3f}, .intensity = {0.3f, 0.5f, 0.8f}}};
    scene.materials[1].emission = {0.5f, 0.1f, 0.1f};
    const Image truth = render(scene, quick(1024, 1, Sampler::sobol, 9)).image;
    RenderOptions options = filtered(4);
    options.bounces = 1;
    const Image image = render(scene, options).image;
    for (const char* channel : {"direct.R", "direct.B", "indirect.G", "emission.G"})
        CHECK(channel_mean(image, channel) ==
              doctest::Approx(channel_mean(truth, channel)).epsilon(0.01).scale(1e-9));
}

TEST_CASE("a_large_lamp_over_gloss_is_counted_once") {
    // So near that rays which happen to meet the lamp matter as much as those sent to it.
    Material shiny = lambert(0.4f);
    shiny.specular = Vec3(0.4f);
    shiny.exponent = 20;
    shiny.model = SpecularModel::phong;
    Scene scene = make_scene({make_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, 0)}, {shiny});
    scene.film = {32, 24};
    scene.camera = {.position = {0, 0.3f, 1.5f}, .target = {0, 0, 0}, .vertical_fov_rad = 0.5f};
    scene.rect_lights = {{.center = {0, 0.7f, 0}, .edge_u = {2, 0, 0}, .edge_v = {0, 0, 2}}};
    const Image truth = render(scene, quick(1024, 0, Sampler::sobol, 9)).image;
    const Image image = render(scene, filtered(4)).image;
    CHECK(channel_mean(image, "direct.G") ==
          doctest::Approx(channel_mean(truth, "direct.G")).epsilon(0.01).scale(1e-9));
}

TEST_CASE("surfaces_that_one_half_has_missed_are_not_darkened") {
    // Small tiles, a little above ground of the same colour, under a far lamp: all is of one
    // brightness, but eight samples of a pixel meet a tile once or not at all.
    std::vector<Mesh> meshes = {make_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 0)};
    for (int i = 0; i < 24; ++i)
        for (int j = 0; j < 24; ++j)
            meshes.push_back(make_quad({-1.2f + 0.1f * i, 0.3f, -1.2f + 0.1f * j}, {0, 0, 0.03f},
                                       {0.03f, 0, 0}, 0));
    Scene scene = make_scene(meshes, {lambert(0.6f)});
    scene.film = {20, 20};
    scene.camera = {
        .position = {0, 90, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .vertical_fov_rad = 0.02f};
    scene.rect_lights = {
        {.center = {0, 900, 0}, .edge_u = {3, 0, 0}, .edge_v = {0, 0, 3}, .radiance = Vec3(1e5f)}};
    const double expected = 0.6 / double(kPi) * 1e5 * 9 / (900.0 * 900.0);
    for (FilterMode mode : {FilterMode::guarded, FilterMode::plain}) {
        RenderOptions options = filtered(4);
        options.filter = mode;
        const Image image = render(scene, options).image;
        // The shadows of the tiles are hidden by them, seen from so high above.
        int dark = 0;
        for (double value : channel_values(image, "G")) dark += value < 0.9 * expected;
        CHECK(dark == 0);
        CHECK(channel_mean(image, "G") == doctest::Approx(expected).epsilon(0.01).scale(1e-9));
    }
}

TEST_CASE("filtered_indirect_light_needs_a_third_of_the_samples") {
    Scene scene = make_room(0);
    scene.film = {64, 48};
    const Image truth = render(scene, quick(2048, 1, Sampler::sobol, 9)).image;
    RenderOptions options = filtered(1);
    options.bounces = 1;
    const Image image = render(scene, options).image;
    const int threefold = int(3 * channel_mean(image, "spp"));
    for (Sampler sampler : {Sampler::sobol, Sampler::stratified}) {
        const Image plain = render(scene, quick(threefold, 1, sampler)).image;
        CHECK(channel_rmse(image, truth, "indirect.G") < channel_rmse(plain, truth, "indirect.G"));
    }
}

TEST_CASE("light_does_not_leak_over_corners_or_steps") {
    // Under an even sky, over black ground that has no end: what faces up and has nothing above it
    // receives all of the sky, what stands upright half. The filters of both are wide.
    Scene scene = make_scene({make_quad({-1e3f, 0, -1e3f}, {0, 0, 2e3f}, {2e3f, 0, 0}, 0),
                              make_box({-0.5f, 0.01f, -0.5f}, {0.5f, 1, 0.5f}, false, 1)},
                             {lambert(0), lambert(0.8f)});
    scene.film = {48, 40};
    scene.camera = {
        .position = {1.4f, 1.8f, 1.9f}, .target = {0, 0.6f, 0}, .vertical_fov_rad = 0.6f};
    scene.background = Vec3(1);
    RenderOptions options = filtered(0.0625f);
    options.filter = FilterMode::plain;
    const Image image = render(scene, options).image;
    const int g = image.channel("G"), up = image.channel("N.Y"), albedo = image.channel("albedo.G");
    int tops = 0, sides = 0, ground = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const float n = image.at(x, y, up), kd = image.at(x, y, albedo);
            const float value = image.at(x, y, g);
            if (kd == 0) CHECK((ground++, value == 0));
            if (std::abs(kd - 0.8f) > 1e-5f) continue;  // an edge against the ground
            if (n > 0.9999f)
                CHECK((tops++, value == doctest::Approx(0.8).epsilon(0.02).scale(1e-9)));
            if (n < 1e-4f) CHECK((sides++, value == doctest::Approx(0.4).epsilon(0.1).scale(1e-9)));
        }
    CHECK(std::min({tops, sides, ground}) > 50);
}

TEST_CASE("light_does_not_leak_over_steps_of_a_pixel") {
    // A slab a pixel high, seen from above under an even sky: all of it is as bright as can be, the
    // ground beside it is not.
    constexpr float kPixel = 0.02f, kHalf = 0.45f;
    Scene scene = make_scene({make_quad({-1e3f, 0, -1e3f}, {0, 0, 2e3f}, {2e3f, 0, 0}, 0),
                              make_box({-kHalf, -1, -kHalf}, {kHalf, kPixel, kHalf}, false, 0)},
                             {lambert(0.8f)});
    scene.film = {64, 64};
    scene.camera = {.position = {0, 100, 0},
                    .target = {0, 0, 0},
                    .up = {0, 0, 1},
                    .vertical_fov_rad = 64 * kPixel / 100};
    scene.background = Vec3(1);
    RenderOptions options = filtered(0.25f);
    options.filter = FilterMode::plain;
    const Image image = render(scene, options).image;
    const int g = image.channel("G"), height = image.channel("P.Y");
    double sum = 0;
    int rim = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const int beside[] = {std::max(x - 1, 0), std::max(y - 1, 0), std::min(x + 1, 63),
                                  std::min(y + 1, 63)};
            const auto on_slab = [&](int i, int j) {
                return image.at(i, j, height) > 0.9999f * kPixel;
            };
            const bool is_rim = on_slab(x, y) && !(on_slab(beside[0], y) && on_slab(beside[2], y) &&
                                                   on_slab(x, beside[1]) && on_slab(x, beside[3]));
            if (is_rim) sum += image.at(x, y, g);
            rim += is_rim;
        }
    REQUIRE(rim > 100);
    CAPTURE(sum / rim);
    CHECK(sum / rim > 0.98 * 0.8);  // 0.763 where levels may differ by two pixels
}

TEST_CASE("gloss_is_filtered_in_its_own_colour") {
    // A red ball with a blue lobe: neither colour may be multiplied with the other's light.
    Material ball;
    ball.diffuse = {0.5f, 0.2f, 0.02f};
    ball.specular = {0.02f, 0.1f, 0.5f};
    ball.exponent = 20;
    ball.model = SpecularModel::phong;
    Scene scene = make_scene({make_sphere(Vec3(0), 1, 24, false, 0)}, {ball});
    scene.film = {32, 32};
    scene.camera = {.position = {0, 0, 3}, .vertical_fov_rad = 0.5f};
    scene.background = {0.9f, 0.6f, 0.8f};
    const Image truth = render(scene, quick(1024, 0, Sampler::sobol, 9)).image;
    const Image image = render(scene, filtered(1)).image;
    for (const char* channel : {"R", "G", "B"})
        CHECK(channel_mean(image, channel) ==
              doctest::Approx(channel_mean(truth, channel)).epsilon(0.01).scale(1e-9));
}

TEST_CASE("filters_keep_a_closed_enclosure_at_radiance_one") {
    // Every wall shines 0.4 and reflects 0.6: radiance is 1 - 0.6^(bounces + 1) everywhere, borders
    // and corners of the image too, whatever is filtered with what.
    Material wall = lambert(0.6f);
    wall.emission = Vec3(0.4f);
    Scene scene = make_scene({make_box(Vec3(-1), Vec3(1), true, 0)}, {wall});
    scene.film = {33, 21};
    scene.camera = {
        .position = {0, 0, 0.9f}, .target = {0.3f, -0.2f, -1}, .vertical_fov_rad = 1.4f};
    RenderOptions options = filtered(0.25f);
    options.bounces = 3;
    const Image image = render(scene, options).image;
    const double expected = 1 - std::pow(0.6, 5);
    CHECK(channel_mean(image, "G") == doctest::Approx(expected).epsilon(2e-3).scale(1e-9));
    for (double value : channel_values(image, "G"))
        CHECK(value == doctest::Approx(expected).epsilon(0.05).scale(1e-9));
}

TEST_CASE("light_of_the_background_is_filtered_without_bias") {
    // A box on the ground under an even sky: ambient occlusion.
    Scene scene = make_scene({make_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 0),
                              make_box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f}, false, 0)},
                             {lambert(0.8f)});
    scene.film = {48, 36};
    scene.camera = {.position = {1, 2, 4}, .target = {0, 0.3f, 0}, .vertical_fov_rad = 0.7f};
    scene.background = Vec3(1);
    const Image truth = render(scene, quick(2048, 0, Sampler::sobol, 9)).image;
    const Frame frame = render(scene, filtered(1));
    CHECK(channel_mean(frame.image, "G") ==
          doctest::Approx(channel_mean(truth, "G")).epsilon(3e-3).scale(1e-9));
    const int same = int(std::ceil(channel_mean(frame.image, "spp")));
    const Image plain = render(scene, quick(same, 0)).image;
    CHECK(rmse(frame.image, truth) < 0.6 * rmse(plain, truth));
}

TEST_CASE("ambient_occlusion_beside_a_wall_is_that_of_the_form_factor") {
    // A wall of height h hides (1 - d / sqrt(d^2 + h^2)) / 2 of the hemisphere at distance d, if it
    // is long.
    Scene scene = make_scene({make_quad({-500, 0, 0}, {0, 0, 40}, {1000, 0, 0}, 0),
                              make_quad({-500, 0, 0}, {1000, 0, 0}, {0, 2, 0}, 0)},
                             {lambert(0.2f)});
    scene.rect_lights = {{.center = {0, 9, 9}, .edge_u = {1, 0, 0}, .edge_v = {0, 0, 1}}};
    make_ambient_occlusion(scene);
    scene.film = {3, 61};
    scene.camera = {
        .position = {0, 50, 2}, .target = {0, 0, 2}, .up = {0, 0, -1}, .vertical_fov_rad = 0.06f};
    for (RenderOptions options : {quick(1024, 0), filtered(2)}) {
        const Image image = render(scene, options).image;
        for (int y : {10, 30, 50}) {
            const double d = 2 + (y + 0.5 - 30.5) / 61 * 2 * 50 * std::tan(0.03);
            CHECK(image.at(1, y, image.channel("G")) ==
                  doctest::Approx(0.5 * (1 + d / std::sqrt(d * d + 4))).epsilon(0.03).scale(1e-9));
        }
    }
}

TEST_CASE("parts_of_the_method_can_be_had_alone") {
    Scene scene = make_room(0);
    scene.film = {32, 24};
    RenderOptions options = filtered(1);
    options.bounces = 1;
    options.filter = FilterMode::none;
    const Image none = render(scene, options).image;
    for (const auto& [a, b] : {std::pair("R", "unfiltered.R"), {"B", "unfiltered.B"}})
        CHECK(rmse_of(channel_values(none, a), channel_values(none, b)) <
              1e-5 * channel_mean(none, a));
    options.filter = FilterMode::plain;
    for (double share : channel_values(render(scene, options).image, "guard.indirect"))
        CHECK(share == 1);
    options.adaptive = false;
    options.samples_per_pixel = 24;
    for (double samples : channel_values(render(scene, options).image, "spp")) CHECK(samples == 24);
}

TEST_CASE("what_shines_is_sampled_for_what_it_reflects") {
    // A plate in a penumbra: that it shines as well makes the light that it reflects no less noisy.
    const auto samples_on_plate = [](float emission) {
        Scene scene = make_penumbra(LightProfile::uniform);
        scene.materials.push_back(lambert(0.6f));
        scene.materials.back().emission = Vec3(emission);
        scene.meshes.push_back(make_quad({0.3f, 0.001f, 0.2f}, {0, 0, 0.6f}, {0.3f, 0, 0}, 1));
        scene.instances.push_back({.mesh = 2});
        const Image image = render(scene, filtered(4)).image;
        const auto albedo = channel_values(image, "albedo.G"), spp = channel_values(image, "spp");
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < spp.size(); ++i)
            if (std::abs(albedo[i] - 0.6) < 1e-4) {
                sum += spp[i];
                ++count;
            }
        REQUIRE(count >= 4);
        return sum / count;
    };
    const double dark = samples_on_plate(0);
    CHECK(dark > 4 * WEDGE_LIGHT_PROBES);
    CHECK(samples_on_plate(20) > 0.5 * dark);
}

TEST_CASE("filtered_images_do_not_depend_on_work_groups_or_tiles") {
    const Scene scene = make_penumbra(LightProfile::uniform);
    const Image reference = render(scene, filtered(1)).image;
    for (uint32_t tile : {100u, 100000u}) {
        RenderOptions options = filtered(1);
        options.tile_pixels = tile;
        options.local_size = 16;
        const Image image = render(scene, options).image;
        CHECK(std::memcmp(image.pixels.data(), reference.pixels.data(),
                          image.pixels.size() * sizeof(float)) == 0);
    }
}

TEST_CASE("variances_are_of_what_was_sampled") {
    const Scene scene = make_penumbra(LightProfile::uniform);
    RenderOptions options = filtered(1);
    options.adaptive = false;
    options.samples_per_pixel = 16;
    options.sampler = Sampler::hash;
    constexpr int kSeeds = 16;
    std::vector<double> sum, squares;
    double told = 0;
    for (int seed = 0; seed < kSeeds; ++seed) {
        options.seed = uint64_t(seed);
        const Image image = render(scene, options).image;
        const auto values = channel_values(image, "unfiltered.G");
        sum.resize(values.size());
        squares.resize(values.size());
        for (std::size_t i = 0; i < values.size(); ++i) {
            sum[i] += values[i];
            squares[i] += values[i] * values[i];
        }
        told += channel_mean(image, "variance.G") / kSeeds;
    }
    double found = 0;
    for (std::size_t i = 0; i < sum.size(); ++i)
        found += (squares[i] - sum[i] * sum[i] / kSeeds) / (kSeeds - 1) / double(sum.size());
    CHECK(told == doctest::Approx(found).epsilon(0.05).scale(1e-12));
}

}  // namespace
}  // namespace wedge::test
