// Many lights at once against each alone: light adds up.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "statistics.hpp"
#include "test_scenes.hpp"

namespace wedge::test {
namespace {

constexpr int kLights = 64;

/// A floor of side 8 with a few boxes on it, seen from above, without light.
Scene make_floor() {
    Scene scene = make_scene({make_quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 0),
                              make_box({-2, 0, -2}, {-1, 1, 1}, false, 0),
                              make_box({1, 0, -1}, {2.5f, 0.5f, 0}, false, 0)},
                             {lambert(0.6f)});
    scene.film = {16, 16};
    scene.camera = {.position = {0, 9, 3}, .target = {0, 0, 0}, .vertical_fov_rad = 0.8f};
    return scene;
}

/// On a grid over the floor, facing down; sizes over a decade and powers over three.
std::vector<RectLight> mixed_lights() {
    std::vector<RectLight> lights;
    for (int i = 0; i < kLights; ++i) {
        const float x = float(i % 8) - 3.5f, z = float(i / 8) - 3.5f;
        const float side = 0.03f * std::pow(10.0f, float(i * 37 % 64) / 64);
        const float power = std::pow(10.0f, 3 * float(i * 23 % 64) / 64 - 1);
        const float radiance = power / (kPi * side * side);
        RectLight light{.center = {x, 2 + 0.5f * float(i % 3), z},
                        .edge_u = {side, 0, 0},
                        .edge_v = {0, 0, side},
                        .radiance = radiance * Vec3(1, 0.8f, float(i % 4) / 3)};
        if (i % 5 == 0) {
            light.profile = LightProfile::gaussian;
            light.sigma = 0.3f * side;
        }
        lights.push_back(light);
    }
    return lights;
}

/// The same lights as two triangles each, of a mesh that shines.
void add_as_meshes(Scene& scene, const std::vector<RectLight>& lights) {
    for (const RectLight& light : lights) {
        Material lamp = lambert(0);
        lamp.emission = light.radiance;
        scene.materials.push_back(lamp);
        const Vec3 corner = light.center - 0.5f * (light.edge_u + light.edge_v);
        scene.meshes.push_back(
            make_quad(corner, light.edge_u, light.edge_v, uint32_t(scene.materials.size() - 1)));
        scene.instances.push_back({.mesh = uint32_t(scene.meshes.size() - 1)});
    }
}

glm::dvec3 mean_direct(const Scene& scene, int samples, uint32_t seed) {
    const Image image = render(scene, quick(samples, 0, Sampler::sobol, seed)).image;
    return {channel_mean(image, "direct.R"), channel_mean(image, "direct.G"),
            channel_mean(image, "direct.B")};
}

void check_close(const glm::dvec3& found, const glm::dvec3& truth) {
    for (int channel = 0; channel < 3; ++channel)
        CHECK(found[channel] == doctest::Approx(truth[channel]).epsilon(0.01).scale(1e-9));
}

/// Means over the image of one light at a time, all lights still there to cast shadows of theirs.
glm::dvec3 sum_of_singles(const std::vector<RectLight>& lights) {
    glm::dvec3 sum(0);
    for (int i = 0; i < kLights; ++i) {
        Scene scene = make_floor();
        scene.rect_lights = lights;
        for (int j = 0; j < kLights; ++j)
            if (j != i) scene.rect_lights[std::size_t(j)].radiance = Vec3(0);
        sum += mean_direct(scene, 64, uint32_t(i));
    }
    return sum;
}

}  // namespace

TEST_CASE("many_lights_give_the_sum_of_each_alone") {
    const std::vector<RectLight> lights = mixed_lights();
    Scene all = make_floor();
    all.rect_lights = lights;
    // Blue is not what lights are chosen by: a fourth of them have none.
    check_close(mean_direct(all, 1024, 7), sum_of_singles(lights));
}

TEST_CASE("shining_meshes_light_as_rectangles_do") {
    std::vector<RectLight> lights = mixed_lights();
    for (RectLight& light : lights) light.profile = LightProfile::uniform;
    Scene rects = make_floor(), meshes = make_floor();
    rects.rect_lights = lights;
    add_as_meshes(meshes, lights);
    check_close(mean_direct(meshes, 1024, 1), mean_direct(rects, 1024, 2));
}

TEST_CASE("a_faint_light_among_strong_ones_is_not_lost") {
    // One light of a hundred-thousandth of the power shines alone into a corner that no other
    // reaches.
    Scene scene = make_floor();
    scene.rect_lights = mixed_lights();
    const Vec3 corner(20, 0, 0);
    scene.meshes.push_back(make_box(corner - Vec3(0.5f), corner + Vec3(0.5f), true, 0));
    scene.instances.push_back({.mesh = uint32_t(scene.meshes.size() - 1)});
    scene.rect_lights.push_back({.center = corner + Vec3(0, 0.49f, 0),
                                 .edge_u = {0.05f, 0, 0},
                                 .edge_v = {0, 0, 0.05f},
                                 .radiance = Vec3(0.3f)});
    scene.camera = {.position = corner + Vec3(0.45f, 0, 0),
                    .target = corner - Vec3(0, 0.3f, 0),
                    .vertical_fov_rad = 0.5f};
    Scene alone = scene;
    alone.rect_lights = {scene.rect_lights.back()};
    const double truth = mean_direct(alone, 64, 1).y;
    REQUIRE(truth > 0);
    const Frame frame = render(scene, quick(16384, 0, Sampler::hash, 3));
    const MeanAndError found = mean_and_error(channel_values(frame.image, "direct.G"));
    const double noise = std::sqrt(channel_mean(frame.image, "variance.G") / (16.0 * 16.0));
    INFO(fmt::format("found {} +- {}, truth {}", found.mean, noise, truth));
    CHECK(std::abs(found.mean - truth) < 4.5 * noise);
    CHECK(found.mean > 0);
}

}  // namespace wedge::test
