// Light of lamps that nothing hides: where ground is flat integrated over pixels, elsewhere sampled
// well.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "filter_scenes.hpp"

namespace wedge::test {
namespace {

using glm::dvec3;

constexpr float kAlbedo = 0.7f;

/// Nothing but ground, seen from aslant, and a lamp above it.
Scene make_ground(LightProfile profile, float edge, float height) {
    Scene scene = make_scene({make_quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}, 0)},
                             {lambert(kAlbedo), lambert(0.1f)});
    scene.film = {16, 12};
    scene.camera = {.position = {0, 2.5f, 3}, .target = {0, 0, 0}, .vertical_fov_rad = 0.7f};
    scene.rect_lights = {{.center = {0.6f, height, 0.2f},
                          .edge_u = {edge, 0, 0},
                          .edge_v = {0, 0.1f, edge},
                          .radiance = {8, 6, 4},
                          .profile = profile,
                          .sigma = 0.3f * edge}};
    return scene;
}

/// Nodes and weights on [-1/2, 1/2] (Gauss and Legendre).
struct Node {
    double at, weight;
};
constexpr double kAt[] = {0.0917173212, 0.2627662050, 0.3983332387, 0.4801449282};
constexpr double kWeight[] = {0.1813418917, 0.1568533229, 0.1111905172, 0.0506142681};

std::vector<Node> nodes() {
    std::vector<Node> all;
    for (std::size_t i = 0; i < std::size(kAt); ++i) {
        all.push_back({kAt[i], kWeight[i]});
        all.push_back({-kAt[i], kWeight[i]});
    }
    return all;
}

/// Irradiance at a point of the ground for a radiance of 1.
double irradiance(const RectLight& lamp, const dvec3& point) {
    const dvec3 u(lamp.edge_u), v(lamp.edge_v), cross = glm::cross(u, v);
    const double sigma2 = double(lamp.sigma) * double(lamp.sigma);
    double sum = 0;
    for (const Node& a : nodes())
        for (const Node& b : nodes()) {
            const dvec3 place = a.at * u + b.at * v, d = dvec3(lamp.center) + place - point;
            const double profile = lamp.profile == LightProfile::gaussian
                                       ? std::exp(-glm::dot(place, place) / (2 * sigma2))
                                       : 1.0;
            sum += a.weight * b.weight * profile * d.y * -glm::dot(d, cross) /
                   std::pow(glm::dot(d, d), 2);
        }
    return sum;
}

/// Red, the mean over a pixel.
double pixel_radiance(const Scene& scene, int x, int y) {
    const Camera& camera = scene.camera;
    const dvec3 eye(camera.position), forward = glm::normalize(dvec3(camera.target) - eye);
    const dvec3 right = glm::normalize(glm::cross(forward, dvec3(0, 1, 0)));
    const dvec3 down = glm::cross(forward, right);
    const double size = 2 * std::tan(0.5 * double(camera.vertical_fov_rad)) / scene.film.height;
    const RectLight& lamp = scene.rect_lights[0];
    double sum = 0;
    for (const Node& a : nodes())
        for (const Node& b : nodes()) {
            const double px = x + 0.5 + a.at - 0.5 * scene.film.width;
            const double py = y + 0.5 + b.at - 0.5 * scene.film.height;
            const dvec3 ray = forward + size * (px * right + py * down);
            sum += a.weight * b.weight * irradiance(lamp, eye - ray * (eye.y / ray.y));
        }
    return double(kAlbedo) / double(kPi) * double(lamp.radiance.x) * sum;
}

/// Errors of pixels' red, as shares of it.
std::vector<double> errors(const Scene& scene, const RenderOptions& options) {
    auto values = channel_values(render(scene, options).image, "direct.R");
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int width = scene.film.width;
        values[i] = values[i] / pixel_radiance(scene, int(i) % width, int(i) / width) - 1;
    }
    return values;
}

double largest_error(const Scene& scene, const RenderOptions& options) {
    double largest = 0;
    for (double e : errors(scene, options)) largest = std::max(largest, std::abs(e));
    return largest;
}

/// Root mean square difference from path tracing as a share of the mean. No guard, which knows
/// better.
double error_beside_paths(const Scene& scene, int samples) {
    RenderOptions options = filtered(1);
    options.filter = FilterMode::plain;
    options.adaptive = false;
    options.samples_per_pixel = samples;
    const Image truth = render(scene, quick(1 << 14, 0, Sampler::lattice, 9)).image;
    const Image image = render(scene, options).image;
    return channel_rmse(image, truth, "direct.G") / channel_mean(truth, "direct.G");
}

TEST_CASE("light_on_flat_ground_has_no_noise") {
    // Places in eight parts of a pixel alone leave some thousandths.
    for (LightProfile profile : {LightProfile::uniform, LightProfile::gaussian}) {
        CAPTURE(profile == LightProfile::gaussian);
        CHECK(largest_error(make_ground(profile, 0.4f, 3), filtered(0.25f)) < 1e-4);
    }
    CHECK(largest_error(make_ground(LightProfile::uniform, 3, 2), filtered(0.25f)) < 1e-4);
}

TEST_CASE("unshadowed_light_of_a_large_gaussian_lamp_is_sampled_well") {
    // For nodes it is too large. What shadows multiply must not be worse than radiance as it was
    // sampled.
    const Scene scene = make_ground(LightProfile::gaussian, 3, 2);
    double multiplied = 0, sampled = 0;
    for (uint32_t seed = 0; seed < 4; ++seed) {
        RenderOptions options = filtered(1, seed);
        options.adaptive = false;
        options.samples_per_pixel = 64;
        options.filter = FilterMode::plain;
        for (double e : errors(scene, options)) multiplied += e * e;
        options.filter = FilterMode::none;
        for (double e : errors(scene, options)) sampled += e * e;
    }
    CAPTURE(std::sqrt(multiplied / (4 * 16 * 12)));
    CAPTURE(std::sqrt(sampled / (4 * 16 * 12)));
    CHECK(multiplied < sampled);
}

TEST_CASE("a_crop_of_flat_ground_has_the_same_light") {
    const Scene scene = make_ground(LightProfile::gaussian, 0.4f, 3);
    RenderOptions options = filtered(0.25f);
    const auto whole = channel_values(render(scene, options).image, "direct.G");
    options.crop = Rect{5, 4, 7, 6};
    const auto part = channel_values(render(scene, options).image, "direct.G");
    for (int y = 4; y < 10; ++y)
        for (int x = 5; x < 12; ++x) {
            const auto i = std::size_t(y * scene.film.width + x);
            CHECK(part[i] == doctest::Approx(whole[i]).epsilon(1e-5).scale(1e-9));
        }
}

// Large pixels: light changes by much within one, so that only what is flat and of one colour may
// be taken for it.
Scene make_near_ground() {
    Scene scene = make_ground(LightProfile::uniform, 0.3f, 2);
    scene.film = {8, 6};
    return scene;
}

TEST_CASE("colours_in_a_pixel_are_not_taken_for_one") {
    Scene scene = make_near_ground();
    scene.meshes = {make_quad({-50, 0, -50}, {0, 0, 100}, {50.1f, 0, 0}, 0),
                    make_quad({0.1f, 0, -50}, {0, 0, 100}, {50, 0, 0}, 1)};
    scene.instances = {{.mesh = 0}, {.mesh = 1}};
    CHECK(error_beside_paths(scene, 1024) < 2e-3);
}

TEST_CASE("pixels_too_large_for_four_nodes_are_sampled") {
    Scene scene = make_near_ground();
    scene.film = {4, 3};
    scene.rect_lights[0].center.y = 0.8f;
    CHECK(error_beside_paths(scene, 1024) < 2e-3);
}

TEST_CASE("slopes_in_a_pixel_are_not_taken_for_one") {
    // A roof of 24 degrees: one surface as far as a pixel is concerned.
    Scene scene = make_near_ground();
    const float fall = -50 * 0.2126f;
    scene.meshes = {make_quad({-49.9f, fall, -50}, {0, 0, 100}, {50, -fall, 0}, 0),
                    make_quad({0.1f, 0, -50}, {0, 0, 100}, {50, fall, 0}, 0)};
    scene.instances = {{.mesh = 0}, {.mesh = 1}};
    CHECK(error_beside_paths(scene, 1024) < 2e-3);
}

TEST_CASE("a_lamp_that_dips_below_the_horizon_is_cut_off_there") {
    // Below that of the ground, below that of a normal that is bent away from the lamp, and below
    // the ground that its normal is bent towards.
    for (const Vec3 normal : {Vec3(0, 1, 0), Vec3(0.5f, 1, 0), Vec3(-0.5f, 1, 0)}) {
        Scene scene = make_ground(LightProfile::uniform, 1, 3);
        scene.meshes[0].normals.assign(4, glm::normalize(normal));
        scene.rect_lights[0] = {.center = {-4, normal.x > 0 ? 1.5f : 0.2f, 0},
                                .edge_u = {0, 1, 0},
                                .edge_v = {0, 0, 1},
                                .radiance = Vec3(8)};
        CAPTURE(normal.x);
        CHECK(error_beside_paths(scene, 256) < 5e-3);
    }
}

/// Two steps of one colour that face alike, the farther one lower and beyond a lamp that lights the
/// nearer one, seen so flatly that most of both are in the same pixels.
Scene make_steps() {
    Scene scene = make_scene({make_quad({-4, 0.3f, 0}, {0, 0, 2}, {8, 0, 0}, 0),
                              make_quad({-4, 0, -20}, {0, 0, 20}, {8, 0, 0}, 0)},
                             {lambert(kAlbedo)});
    scene.film = {9, 9};
    scene.camera = {.position = {0, 0.6f, 5}, .target = {0, 0.3f, 0}, .vertical_fov_rad = 0.02f};
    scene.rect_lights = {{.center = {0, 1.3f, 0.5f},
                          .edge_u = {0.2f, 0, 0},
                          .edge_v = {0, 0, 0.2f},
                          .radiance = Vec3(50),
                          .profile = LightProfile::uniform}};
    return scene;
}

// An arc could join them, so that they are one surface; but not one plane, and the light where that
// would be is not the mean of theirs.
TEST_CASE("steps_that_face_alike_are_no_flat_ground") {
    const Scene scene = make_steps();
    const auto truth =
        channel_values(render(scene, quick(4096, 0, Sampler::lattice, 9)).image, "G");
    const auto found = channel_values(render(scene, filtered(4)).image, "G");
    double most = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
        most = std::max(most, std::fabs(found[i] / truth[i] - 1));
    CHECK(most < 0.03);
}

}  // namespace
}  // namespace wedge::test
