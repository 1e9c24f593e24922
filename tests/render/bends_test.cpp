// Filters on surfaces that are bent, under light whose irradiance is known.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

constexpr float kAlbedo = 0.8f;

/// A ball of 23 px over black ground without end, under a white sky.
Scene make_ball_under_sky() {
    Scene scene = make_scene({make_sphere({0, 2, 0}, 1, 64, false, 0),
                              make_quad({-1e4f, 0, -1e4f}, {0, 0, 2e4f}, {2e4f, 0, 0}, 1)},
                             {lambert(kAlbedo), lambert(0)});
    scene.background = Vec3(1);
    scene.film = {32, 32};
    scene.camera = {.position = {0, 2, 5}, .target = {0, 2, 0}, .vertical_fov_rad = 0.55f};
    return scene;
}

/// Differences to the truth of pixels that show nothing but the ball: of the hemisphere of a point
/// whose normal has height y, (1 + y) / 2 is sky.
std::vector<double> differences_on_ball(const Image& image) {
    const auto value = channel_values(image, "indirect.G"), height = channel_values(image, "N.Y");
    const auto albedo = channel_values(image, "albedo.G");
    std::vector<double> differences;
    for (std::size_t i = 0; i < value.size(); ++i)
        if (std::abs(albedo[i] - double(kAlbedo)) < 1e-4)
            differences.push_back(value[i] - 0.5 * double(kAlbedo) * (1 + height[i]));
    return differences;
}

double mean_square(const std::vector<double>& values) {
    double sum = 0;
    for (double v : values) sum += v * v;
    return sum / double(values.size());
}

TEST_CASE("bent_surfaces_are_filtered_along_the_bend") {
    constexpr uint32_t kSeeds = 8;
    const Scene scene = make_ball_under_sky();
    double unfiltered = 0, error = 0;
    std::vector<double> sum;
    for (uint32_t seed = 0; seed < kSeeds; ++seed) {
        RenderOptions options = filtered(1, seed);
        options.bounces = 0;
        options.adaptive = false;
        options.samples_per_pixel = 16;
        const auto differences = differences_on_ball(render(scene, options).image);
        REQUIRE(differences.size() > 200);
        sum.resize(differences.size());
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += differences[i] / kSeeds;
        error += mean_square(differences) / kSeeds;
        options.filter = FilterMode::none;
        unfiltered += mean_square(differences_on_ball(render(scene, options).image)) / kSeeds;
    }
    const double ratio = std::sqrt(error / unfiltered), bias = std::sqrt(mean_square(sum));
    CAPTURE(std::sqrt(unfiltered));
    CAPTURE(ratio);
    CAPTURE(bias);
    CHECK(ratio < 0.3);  // 0.25; 0.34 where no more than 10 degrees are filtered together
    CHECK(bias < 0.02 * double(kAlbedo));
}

}  // namespace
}  // namespace wedge::test
