// Errors of axis-aligned filtering fall with mu: bias, noise, and what filters cannot help.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "filter_scenes.hpp"
#include "host/render/filter_settings.hpp"

namespace wedge::test {
namespace {

TEST_CASE("filtered_shadows_converge_with_mu") {
    for (LightProfile profile : {LightProfile::uniform, LightProfile::gaussian}) {
        const Scene scene = make_penumbra(profile);
        const Image truth = render(scene, quick(2048, 0, Sampler::sobol, 9)).image;
        double previous = 1e9;
        for (float mu : {0.25f, 1.0f, 4.0f}) {
            const double error = rmse(render(scene, filtered(mu)).image, truth);
            CAPTURE(mu);
            CHECK(error < 0.8 * previous);
            previous = error;
        }
        CHECK(previous < 0.02 * channel_mean(truth, "G"));
    }
}

TEST_CASE("filtered_indirect_light_converges_with_mu") {
    constexpr uint32_t kSeeds = 4;
    for (float gloss : {0.0f, 20.0f}) {
        Scene scene = make_room(gloss);
        scene.film = {32, 24};
        const Image truth = render(scene, quick(2048, 2, Sampler::sobol, 9)).image;
        double previous = 1e9;
        for (float mu : {0.25f, 1.0f, 4.0f}) {
            double square = 0;  // of few pixels; one seed scatters by a tenth
            for (uint32_t seed = 0; seed < kSeeds; ++seed) {
                RenderOptions options = filtered(mu, seed);
                options.bounces = 2;
                const double error =
                    channel_rmse(render(scene, options).image, truth, "indirect.G");
                square += error * error / kSeeds;
            }
            const double error = std::sqrt(square);
            CAPTURE(gloss);
            CAPTURE(mu);
            CHECK(error < 0.9 * previous);
            previous = error;
        }
        CHECK(previous < 0.04 * channel_mean(truth, "indirect.G"));
    }
}

// Bias goes with the square of a width, which for shadows goes with mu^-1/3: from mu = 1 to 1/4 by
// 2.5. With widths of mu^-1/2 it would go by 4, of 1 / mu by 16. The errors of two seeds have only
// bias in common, so their products tell its square.
TEST_CASE("bias_of_filtered_light_grows_as_mu_shrinks") {
    constexpr uint32_t kSeeds = 8;
    const Scene scene = make_penumbra(LightProfile::gaussian);
    const auto truth =
        channel_values(render(scene, quick(8192, 0, Sampler::lattice, 9)).image, "G");
    const auto bias_with = [&](float mu) {
        // The sum over pairs: (the square of the sum less the sum of squares) / 2.
        std::vector<double> sum(truth.size(), 0.0), squares = sum;
        for (uint32_t seed = 0; seed < kSeeds; ++seed) {
            RenderOptions options = filtered(mu, seed);
            options.filter = FilterMode::plain;
            options.adaptive = false;
            options.samples_per_pixel = 64;
            const auto values = channel_values(render(scene, options).image, "G");
            for (std::size_t i = 0; i < truth.size(); ++i) {
                const double error = values[i] - truth[i];
                sum[i] += error;
                squares[i] += error * error;
            }
        }
        double products = 0;
        for (std::size_t i = 0; i < truth.size(); ++i) products += sum[i] * sum[i] - squares[i];
        const double pairs = kSeeds * (kSeeds - 1.0) * double(truth.size());
        return std::sqrt(std::max(products, 0.0) / pairs);
    };
    const double wide = bias_with(0.25f), middle = bias_with(1);
    CAPTURE(wide);
    CAPTURE(middle);
    CHECK(middle > 0);
    CHECK(wide > 2.0 * middle);
    CHECK(wide < 3.2 * middle);
}

// Where filters shrink as fast as samples grow, noise stays.
TEST_CASE("noise_of_filtered_light_falls_beyond_mu_one") {
    Scene scene = make_room(0);
    scene.film = {64, 48};
    const auto render_with = [&](float mu, uint32_t seed) {
        RenderOptions options = filtered(mu, seed);
        options.bounces = 2;
        options.filter = FilterMode::plain;
        return render(scene, options);
    };
    double noise[2], rays[2];
    for (int i = 0; i < 2; ++i) {
        const float mu = i == 0 ? 1.0f : 4.0f;
        const Frame a = render_with(mu, 1), b = render_with(mu, 2);
        noise[i] = channel_rmse(a.image, b.image, "indirect.G");
        rays[i] = double(a.stats.rays);
    }
    const double slope = std::log(noise[1] / noise[0]) / std::log(rays[1] / rays[0]);
    CAPTURE(slope);
    CHECK(slope < -0.3);
}

/// Share of each pixel that a rectangle facing the camera covers: exact, in rows from the top.
std::vector<double> coverage_of(const Film& film, double x0, double y0, double x1, double y1,
                                double half_height) {
    const auto overlap = [](double a, double b, double c, double d) {
        return std::max(0.0, std::min(b, d) - std::max(a, c)) / (b - a);
    };
    const double step = 2 * half_height / film.height, left = -0.5 * step * film.width;
    std::vector<double> shares;
    for (int y = 0; y < film.height; ++y)
        for (int x = 0; x < film.width; ++x) {
            const double px = left + step * x, py = half_height - step * (y + 1);
            shares.push_back(overlap(px, px + step, x0, x1) * overlap(py, py + step, y0, y1));
        }
    return shares;
}

TEST_CASE("rims_of_small_bright_lamps_get_better_beyond_mu_one") {
    Scene scene = make_scene({make_quad({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0)}, {lambert(0.5f)});
    scene.film = {24, 24};
    scene.camera = {.position = {0, 0, 5}, .target = {0, 0, 0}, .vertical_fov_rad = 0.8f};
    scene.rect_lights = {{.center = {0.013f, 0.021f, 0.5f},
                          .edge_u = {0.3f, 0, 0},
                          .edge_v = {0, 0.3f, 0},
                          .radiance = Vec3(1)}};
    const std::vector<double> truth =
        coverage_of(scene.film, -0.137, -0.129, 0.163, 0.171, 4.5 * std::tan(0.4));
    double errors[2] = {0, 0};
    for (int i = 0; i < 2; ++i)
        for (uint32_t seed = 0; seed < 4; ++seed) {
            RenderOptions options = filtered(i == 0 ? 1.0f : 8.0f, seed);
            options.bounces = 1;
            const Image image = render(scene, options).image;
            errors[i] += rmse_of(channel_values(image, "emission.G"), truth);
        }
    CAPTURE(errors[0]);
    CAPTURE(errors[1]);
    CHECK(errors[0] < 4 * 1e-3);
    CHECK(errors[1] < 0.5 * errors[0]);
}

// By luck a few samples meet what is thin or not. What is spent for a large mu is decided with more
// of them, so that it is much the same whatever the seed.
TEST_CASE("samples_for_a_large_mu_are_no_matter_of_luck") {
    std::vector<Mesh> meshes{make_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, 0)};
    for (float x : {-0.8f, 0.0f, 0.8f})
        meshes.push_back(make_quad({x, 0.6f, -2}, {0, 0, 4}, {0.01f, 0, 0}, 0));
    Scene scene = make_penumbra(LightProfile::uniform);
    const Scene wires = make_scene(meshes, {lambert(0.7f)});
    scene.meshes = wires.meshes;
    scene.instances = wires.instances;
    scene.materials = wires.materials;
    scene.film = {48, 36};
    const auto a = channel_values(render(scene, filtered(4, 1)).image, "spp");
    const auto b = channel_values(render(scene, filtered(4, 2)).image, "spp");
    double apart = 0;  // in doublings
    for (std::size_t i = 0; i < a.size(); ++i) apart += std::abs(std::log2(a[i] / b[i]));
    apart /= double(a.size());
    CAPTURE(apart);
    CHECK(apart < 0.2);
}

// Four lamps in one place are one lamp four times as bright. Each has samples of its own, so that
// the noise of all is half of that of the one; that of any is a quarter.
TEST_CASE("noise_of_all_lamps_decides_how_many_samples_there_are") {
    const Scene one = make_penumbra(LightProfile::uniform);
    Scene four = one;
    four.rect_lights[0].radiance = 0.25f * one.rect_lights[0].radiance;
    four.rect_lights.resize(4, four.rect_lights[0]);
    // Beyond the least, which all pixels get.
    const auto more = [](const Scene& scene) {
        const auto spp = channel_values(render(scene, filtered(2)).image, "spp");
        double sum = 0;
        for (double n : spp) sum += n - 16;
        return sum / double(spp.size());
    };
    const double by_one = more(one), by_four = more(four);
    CHECK(by_one > 10);
    CHECK(by_four < by_one);
    CHECK(by_four > 0.7 * by_one);  // 0.84; 0.56 were the noise of one of them counted
}

// docs/cli.md, at --spp.
TEST_CASE("most_samples_are_powers_of_two_that_rise_with_mu") {
    const Scene scene = make_room(0);
    const auto most = [&](float mu, std::optional<int> samples = {}) {
        RenderOptions options = filtered(mu);
        options.samples_per_pixel = samples;
        return rendering::make_filter_settings(scene, options, mu).max_samples;
    };
    CHECK(most(0.25f) == 128);
    CHECK(most(1) == 128);
    CHECK(most(2) == 256);
    CHECK(most(3) == 512);  // nearest in the logarithm
    CHECK(most(8) == 1024);
    CHECK(most(8, 100) == 100);
}

}  // namespace
}  // namespace wedge::test
