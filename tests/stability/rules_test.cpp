// Pass rules of the suite that do not depend on time.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "suite.hpp"

namespace wedge::test {
namespace {

constexpr FilterMode kModes[] = {FilterMode::guarded, FilterMode::plain};

// F22: filters' weights and demodulation lose no energy.
TEST_CASE("a_white_ball_in_a_white_world_stays_invisible") {
    for (FilterMode mode : kModes) {
        const Image image = render(suite_scene("furnace", 40, 30), filtered(mode, 0.5f, 16)).image;
        CAPTURE(std::string(to_string(mode)));
        CHECK(mean_of(image) == doctest::Approx(1).epsilon(2e-3));
        for (double g : channel_values(image, "G")) CHECK(g == doctest::Approx(1).epsilon(0.1));
    }
}

// F27: visibility is exactly one where nothing hides the lamp, so what filters make of it is what
// unfiltered light has, and unfiltered light of a rectangle has next to no noise.
TEST_CASE("light_that_nothing_hides_is_exact") {
    const Scene scene = suite_scene("empty", 40, 30);
    const Image truth = render(scene, quick(512, 0, Sampler::sobol, 9)).image;
    for (FilterMode mode : kModes) {
        const Image image = render(scene, filtered(mode, 1, 16)).image;
        CAPTURE(std::string(to_string(mode)));
        CHECK(mean_of(image) == doctest::Approx(mean_of(truth)).epsilon(1e-3));
        CHECK(rmse_between(image, truth) < 0.02 * mean_of(truth));
    }
}

// F27: plain Monte Carlo is exactly black there; whatever is else leaked in.
TEST_CASE("the_guard_lets_no_light_leak_into_the_umbra") {
    const Scene scene = suite_scene("umbra", 96, 72);
    const Image plain = render(scene, quick(64, 0)).image;
    const Image image = render(scene, filtered(FilterMode::guarded, 1, 64)).image;
    double leaked = 0, pixels = 0;
    const int g = image.channel("G");
    for (int y = 2; y + 2 < image.height; ++y)
        for (int x = 2; x + 2 < image.width; ++x) {
            double around = 0;
            for (int j = -2; j <= 2; ++j)
                for (int i = -2; i <= 2; ++i) around += plain.at(x + i, y + j, g);
            if (around > 0) continue;
            leaked += image.at(x, y, g);
            pixels += 1;
        }
    REQUIRE(pixels > 500);
    // What the guard is known to leak is a half per cent.
    CHECK(leaked / pixels < 0.01 * mean_of(plain));
}

// F18: everything that has a length is multiplied alike, by powers of two, so that nothing but
// constants in world units can make a difference.
TEST_CASE("no_constant_in_world_units_shows_in_filtered_images") {
    const Scene scene = suite_scene("scale-1", 48, 36);
    const auto scaled = [&](float s) {
        Scene copy = scene;
        for (Mesh& mesh : copy.meshes)
            for (Vec3& p : mesh.positions) p *= s;
        for (Instance& instance : copy.instances)
            for (int i = 0; i < 3; ++i) instance.transform[3][i] *= s;
        for (RectLight& light : copy.rect_lights) {
            light.center *= s;
            light.edge_u *= s;
            light.edge_v *= s;
        }
        copy.camera.position *= s;
        copy.camera.target *= s;
        return copy;
    };
    for (FilterMode mode : kModes) {
        const Image one = render(scene, filtered(mode, 1, 32)).image;
        for (float s : {0x1p-13f, 0x1p17f}) {
            CAPTURE(s);
            const Image image = render(scaled(s), filtered(mode, 1, 32)).image;
            CHECK(rmse_between(image, one) < 1e-4 * mean_of(one));
        }
    }
}

// F21: pixels at the border are filtered with what is there, and no darker than others.
TEST_CASE("borders_are_as_bright_as_in_a_larger_film") {
    const Scene large = suite_scene("border", 96, 72);
    Scene small = large;
    small.film = {64, 48};
    // The middle two thirds of the large film, pixel by pixel.
    small.camera.vertical_fov_rad =
        2 * std::atan(std::tan(0.5f * large.camera.vertical_fov_rad) * 48 / 72);
    const Image truth = render(large, quick(512, 0, Sampler::sobol, 9)).image;
    for (FilterMode mode : kModes) {
        Image image = render(small, filtered(mode, 0.5f, 32)).image;
        double found = 0, expected = 0;
        const int g = image.channel("G");
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 64; ++x) {
                if (x > 2 && x < 61 && y > 2 && y < 45) continue;
                found += image.at(x, y, g);
                expected += truth.at(x + 16, y + 12, truth.channel("G"));
            }
        CAPTURE(std::string(to_string(mode)));
        CHECK(found == doctest::Approx(expected).epsilon(0.01));
    }
}

// F19, F05, F16, F17 …: nothing that is not a number comes out of any scene of the suite, and no
// energy is made or lost where light is not all fireflies.
TEST_CASE("every_scene_of_the_suite_keeps_its_energy_and_is_finite") {
    const std::vector<std::string> rare = {"fireflies", "caustic", "coplanar"};
    for (const std::string& name : suite_scene_names()) {
        CAPTURE(name);
        const Scene scene = suite_scene(name, 32, 24);
        const Frame frame = render(scene, filtered(FilterMode::guarded, 1, 16));
        CHECK(all_finite(frame.image));
        CHECK(frame.stats.non_finite_samples == 0);
        // Of the same samples, so that noise cancels.
        double unfiltered = 0;
        for (const char* channel : {"unfiltered.R", "unfiltered.G", "unfiltered.B"}) {
            REQUIRE(frame.image.channel(channel) >= 0);
            unfiltered += channel_mean(frame.image, channel) / 3;
        }
        const bool is_rare = std::count(rare.begin(), rare.end(), name) > 0;
        CHECK(mean_of(frame.image) == doctest::Approx(unfiltered).epsilon(is_rare ? 0.3 : 0.05));
    }
}

// F29: what a rare bright sample spreads over its neighbours must not add up to more than it is.
TEST_CASE("filtered_fireflies_keep_their_energy_over_seeds") {
    const Scene scene = suite_scene("fireflies", 32, 24);
    double filtered_sum = 0, plain_sum = 0;
    for (uint64_t seed = 0; seed < 4; ++seed) {
        const Image image = render(scene, filtered(FilterMode::guarded, 1, 32, seed)).image;
        filtered_sum += mean_of(image);
        for (const char* channel : {"unfiltered.R", "unfiltered.G", "unfiltered.B"})
            plain_sum += channel_mean(image, channel) / 3;
    }
    CHECK(filtered_sum == doctest::Approx(plain_sum).epsilon(0.15));
}

// F28.
TEST_CASE("filters_survive_films_of_any_shape") {
    for (const Film film : {Film{1, 1}, Film{3, 7}, Film{257, 1}, Film{1, 61}, Film{97, 13}}) {
        CAPTURE(film.width);
        const Frame frame = render(suite_scene("scale-1", film.width, film.height),
                                   filtered(FilterMode::guarded, 1, 16));
        CHECK(all_finite(frame.image));
        CHECK(frame.image.width == film.width);
        CHECK(mean_of(frame.image) > 0);
    }
}

// F30: ten renders, however the work is cut.
TEST_CASE("filtered_images_have_the_same_bits_ten_times") {
    const Scene scene = suite_scene("gloss", 31, 23);
    const Image first = render(scene, filtered(FilterMode::guarded, 1, 16)).image;
    for (uint32_t run = 0; run < 9; ++run) {
        RenderOptions options = filtered(FilterMode::guarded, 1, 16);
        options.local_size = run % 3 == 0 ? 0 : 7;
        options.tile_pixels = run % 2 == 0 ? 0 : 100 * run;
        const Image image = render(scene, options).image;
        REQUIRE(image.pixels.size() == first.pixels.size());
        CHECK(std::memcmp(image.pixels.data(), first.pixels.data(),
                          image.pixels.size() * sizeof(float)) == 0);
    }
}

}  // namespace
}  // namespace wedge::test
