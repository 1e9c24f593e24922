// Rendered scenes whose radiance is known in closed form.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "statistics.hpp"
#include "test_scenes.hpp"

namespace wedge::test {
namespace {

/// The mean of a channel lies within `sigmas` of its own noise, and within `relative`, of the
/// truth.
void check_mean(const Image& image, const char* channel, double truth, double relative,
                double sigmas = 4.5) {
    const MeanAndError found = mean_and_error(channel_values(image, channel));
    const double tolerance = sigmas * found.standard_error + 2e-5 * std::abs(truth);
    INFO(fmt::format("{}: mean {} +- {}, truth {}", channel, found.mean, found.standard_error,
                     truth));
    CHECK(std::abs(found.mean - truth) <= tolerance);
    CHECK(std::abs(found.mean - truth) <= relative * truth);
}

/// A surface of albedo 1 - 1/n that shines so that radiance is 1 after `bounces` indirect bounces:
/// emission * sum of albedo^k for k = 0 .. bounces + 1.
Material enclosure_material(double albedo, int bounces) {
    double series = 0;
    for (int k = 0; k <= bounces + 1; ++k) series += std::pow(albedo, k);
    Material m = lambert(float(albedo));
    m.emission = Vec3(float(1 / series));
    return m;
}

TEST_CASE("closed_diffuse_enclosures_have_radiance_one") {
    for (Sampler sampler : {Sampler::sobol, Sampler::hash})
        for (int bounces : {1, 2, 3, 4})
            for (bool sphere : {true, false}) {
                CAPTURE(bounces);
                CAPTURE(sphere);
                const Mesh mesh = sphere ? make_sphere(Vec3(0), 1, 24, true, 0)
                                         : make_box(Vec3(-1), Vec3(1), true, 0);
                Scene scene = make_scene({mesh}, {enclosure_material(0.5, bounces)});
                scene.camera = {.position = {0.2f, 0.1f, 0}, .target = {1, 0.3f, 0.4f}};
                const Frame frame = render(scene, quick(256, bounces, sampler));
                check_mean(frame.image, "G", 1.0, 0.01);
                CHECK(channel_mean(frame.image, "A") == 1.0);
            }
}

TEST_CASE("a_white_convex_body_in_a_white_world_cannot_be_seen") {
    for (float exponent : {0.0f, 20.0f}) {
        Material white = lambert(1.0f);
        if (exponent > 0) {
            white.diffuse = Vec3(0);
            white.specular = Vec3(1);
            white.exponent = exponent;
            white.model = SpecularModel::phong;
        }
        Scene scene = make_scene({make_sphere(Vec3(0), 1, 24, false, 0)}, {white});
        scene.background = Vec3(1);
        scene.camera = {.position = {0, 0, 3}, .vertical_fov_rad = 0.5f};
        const Frame frame = render(scene, quick(64, 2));
        if (exponent == 0)
            for (double g : channel_values(frame.image, "G"))
                CHECK(g == doctest::Approx(1).epsilon(1e-4).scale(1e-9));
        else  // a lobe loses what would go below the horizon, and gains nothing
            CHECK(channel_mean(frame.image, "G") <= 1.0);
    }
}

/// The part of a polygon above the plane through the origin with normal n (Sutherland & Hodgman
/// 1974).
std::vector<glm::dvec3> above_horizon(const std::vector<glm::dvec3>& corners, const glm::dvec3& n) {
    std::vector<glm::dvec3> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = corners[i], b = corners[(i + 1) % corners.size()];
        const double ha = glm::dot(a, n), hb = glm::dot(b, n);
        if (ha >= 0) kept.push_back(a);
        if ((ha < 0) != (hb < 0)) kept.push_back(a + (b - a) * (ha / (ha - hb)));
    }
    return kept;
}

/// Irradiance at the origin, with normal n, from a polygon of radiance 1: half the sum of its
/// edges' angles times the normals of their planes along n (Lambert 1760; e.g. Arvo 1995, eq. 2.4).
double polygon_irradiance(const std::vector<glm::dvec3>& corners, const glm::dvec3& n) {
    const std::vector<glm::dvec3> clipped = above_horizon(corners, n);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < clipped.size(); ++i) {
        const glm::dvec3 a = glm::normalize(clipped[i]);
        const glm::dvec3 b = glm::normalize(clipped[(i + 1) % clipped.size()]);
        sum += std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b));
    }
    return 0.5 * std::abs(glm::dot(sum, n));
}

TEST_CASE("irradiance_under_a_rectangle_is_that_of_the_closed_form") {
    const RectLight light{.center = {0.3f, 0, -0.2f},
                          .edge_u = {1.2f, 0, 0},
                          .edge_v = {0, 0, 0.8f},
                          .radiance = Vec3(1)};
    for (float distance : {0.25f, 1.0f, 4.0f, 20.0f})
        for (float tilt : {0.0f, 0.3f, 0.7f, 1.2f}) {
            CAPTURE(distance);
            CAPTURE(tilt);
            RectLight lamp = light;
            lamp.center.y = distance;
            // cross(u, v) points down: (1, 0, 0) x (0, 0, 1) = (0, -1, 0).
            const Vec3 n(std::sin(tilt) * 0.2f, std::cos(tilt), std::sin(tilt) * 0.98f);
            const Vec3 normal = glm::normalize(n);
            const Vec3 u = glm::normalize(glm::cross(normal, Vec3(0, 0, 1)));
            const Vec3 v = glm::cross(u, normal);
            const float size = 1e-3f;
            Scene scene = make_scene({make_quad(-0.5f * size * (v + u), size * v, size * u, 0)},
                                     {lambert(0.8f)});
            scene.rect_lights = {lamp};
            scene.camera = {.position = 0.1f * normal + 0.02f * u,
                            .target = {0, 0, 0},
                            .up = v,
                            .vertical_fov_rad = 0.004f};
            const glm::dvec3 c(lamp.center), hu(0.5f * lamp.edge_u), hv(0.5f * lamp.edge_v);
            const double truth =
                0.8 / double(kPi) *
                polygon_irradiance({c - hu - hv, c + hu - hv, c + hu + hv, c - hu + hv}, normal);
            for (Sampler sampler : {Sampler::sobol, Sampler::hash})
                check_mean(render(scene, quick(256, 0, sampler)).image, "direct.G", truth, 0.01);
            // Filtered shadows multiply unshadowed light that is computed, not sampled.
            RenderOptions filtered = quick(16, 0);
            filtered.method = Method::aaf;
            for (double value : channel_values(render(scene, filtered).image, "direct.G"))
                CHECK(value == doctest::Approx(truth).epsilon(2e-3).scale(1e-9));
        }
}

TEST_CASE("light_must_be_above_face_and_shading_normal") {
    // Both cut the lamp: what is left of it gives irradiance by the shading normal.
    const RectLight lamp{.center = {0.3f, 0.5f, -0.2f},
                         .edge_u = {2, 0, 0},
                         .edge_v = {0, 0, 2},
                         .radiance = Vec3(1)};
    const glm::dvec3 face = glm::normalize(glm::dvec3(0.9, 0.3, 0));
    const glm::dvec3 bent = glm::normalize(glm::dvec3(0.8, 0.3, 0.7));
    const Vec3 n(face), u = glm::normalize(glm::cross(n, Vec3(0, 0, 1))), v = glm::cross(u, n);
    const float size = 1e-3f;
    Mesh quad = make_quad(-0.5f * size * (v + u), size * v, size * u, 0);
    quad.normals.assign(quad.positions.size(), Vec3(bent));
    Scene scene = make_scene({quad}, {lambert(0.8f)});
    scene.rect_lights = {lamp};
    scene.film = {8, 8};
    scene.camera = {.position = 0.1f * n, .target = {0, 0, 0}, .up = v, .vertical_fov_rad = 0.004f};
    const glm::dvec3 c(lamp.center), hu(0.5f * lamp.edge_u), hv(0.5f * lamp.edge_v);
    const double truth =
        0.8 / double(kPi) *
        polygon_irradiance(
            above_horizon({c - hu - hv, c + hu - hv, c + hu + hv, c - hu + hv}, face), bent);
    check_mean(render(scene, quick(1024, 0, Sampler::sobol)).image, "direct.G", truth, 0.01);
    RenderOptions filtered = quick(16, 0);
    filtered.method = Method::aaf;
    for (double value : channel_values(render(scene, filtered).image, "direct.G"))
        CHECK(value == doctest::Approx(truth).epsilon(2e-3).scale(1e-9));
}

/// Form factor between two unit squares facing each other at distance 1 (Howell's catalogue, C-11).
double parallel_squares_form_factor(double x) {
    const double x2 = 1 + x * x;
    const double pi = double(kPi);
    return 2 / (pi * x * x) *
           (std::log(std::sqrt(x2 * x2 / (1 + 2 * x * x))) +
            2 * x * std::sqrt(x2) * std::atan(x / std::sqrt(x2)) - 2 * x * std::atan(x));
}

TEST_CASE("parallel_plates_exchange_their_form_factor") {
    CHECK(parallel_squares_form_factor(1.0) == doctest::Approx(0.199825).epsilon(1e-5).scale(1e-9));
    // Seen perpendicularly, a pinhole image of a plane weighs all its points alike.
    Scene scene =
        make_scene({make_quad({-0.5f, 0, -0.5f}, {0, 0, 1}, {1, 0, 0}, 0)}, {lambert(1.0f)});
    scene.rect_lights = {{.center = {0, 1, 0}, .edge_u = {1, 0, 0}, .edge_v = {0, 0, 1}}};
    scene.camera = {.position = {0, 0.9f, 0},
                    .target = {0, 0, 0},
                    .up = {0, 0, 1},
                    .vertical_fov_rad = 2 * std::atan(0.5f / 0.9f)};
    for (Sampler sampler : {Sampler::sobol, Sampler::hash}) {
        const Frame frame = render(scene, quick(256, 0, sampler));
        const double noise = std::sqrt(channel_mean(frame.image, "variance.G") / (16 * 16));
        // pi L F A of flux spread over the plate is radiance F; the spread over pixels is not
        // noise.
        const double mean = channel_mean(frame.image, "direct.G");
        CHECK(std::abs(mean - parallel_squares_form_factor(1.0)) < 4.5 * noise + 1e-5);
        CHECK(mean ==
              doctest::Approx(parallel_squares_form_factor(1.0)).epsilon(0.005).scale(1e-9));
    }
}

TEST_CASE("point_lights_fall_off_with_the_square") {
    for (float distance : {0.5f, 2.0f, 50.0f}) {
        Scene scene = make_scene({make_quad({-5e-4f, 0, -5e-4f}, {0, 0, 1e-3f}, {1e-3f, 0, 0}, 0)},
                                 {lambert(0.5f)});
        const Vec3 toward = glm::normalize(Vec3(0.4f, 1, 0.2f));
        scene.point_lights = {{.position = distance * toward, .intensity = Vec3(3)}};
        scene.camera = {
            .position = {0, 0.1f, 0.02f}, .target = {0, 0, 0}, .vertical_fov_rad = 0.004f};
        const double truth = 0.5 / double(kPi) * 3 * toward.y / (double(distance) * distance);
        CHECK(channel_mean(render(scene, quick(16, 0)).image, "G") ==
              doctest::Approx(truth).epsilon(2e-3).scale(1e-9));
    }
}

TEST_CASE("gaussian_lights_give_their_integral") {
    // Far away, a light is its power: irradiance = cos * integral of radiance over area / d^2.
    const float sigma = 0.15f;
    Scene scene = make_scene({make_quad({-5e-4f, 0, -5e-4f}, {0, 0, 1e-3f}, {1e-3f, 0, 0}, 0)},
                             {lambert(1.0f)});
    scene.rect_lights = {{.center = {0, 100, 0},
                          .edge_u = {1, 0, 0},
                          .edge_v = {0, 0, 0.5f},
                          .radiance = Vec3(1000),
                          .profile = LightProfile::gaussian,
                          .sigma = sigma}};
    scene.camera = {.position = {0, 0.1f, 0.02f}, .target = {0, 0, 0}, .vertical_fov_rad = 0.004f};
    const auto cut = [&](double edge) {
        return sigma * std::sqrt(2 * double(kPi)) * std::erf(0.5 * edge / (sigma * std::sqrt(2.0)));
    };
    const double truth = 1000 * cut(1.0) * cut(0.5) / 1e4 / double(kPi);
    check_mean(render(scene, quick(64, 0)).image, "G", truth, 2e-3, 6);
}

TEST_CASE("light_bounces_between_parallel_plates_as_the_series_says") {
    // Two large plates close together; the lower one shines. Radiosity of the lower seen from
    // between: 1 + a^2 + a^4 + … truncated by the number of bounces, less what leaves at the rim.
    const double albedo = 0.7;
    Material shining = lambert(float(albedo));
    shining.emission = Vec3(1);
    const float half = 500.0f;
    Scene scene = make_scene({make_quad({-half, 0, -half}, {0, 0, 2 * half}, {2 * half, 0, 0}, 0),
                              make_quad({-half, 1, -half}, {2 * half, 0, 0}, {0, 0, 2 * half}, 1)},
                             {shining, lambert(float(albedo))});
    scene.camera = {.position = {0, 0.6f, 0}, .target = {0.1f, 0, 0}, .vertical_fov_rad = 0.2f};
    // Paths of k scatterings reach the lower plate's emission only where k is even.
    const Frame frame = render(scene, quick(64, 3));
    CHECK(channel_mean(frame.image, "emission.G") == doctest::Approx(1.0));
    CHECK(channel_mean(frame.image, "direct.G") == doctest::Approx(0.0).epsilon(1e-6).scale(1e-9));
    check_mean(frame.image, "indirect.G", albedo * albedo + std::pow(albedo, 4), 0.03, 6);
}

}  // namespace
}  // namespace wedge::test
