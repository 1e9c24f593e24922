// Sizes, exponents, angles and values at the ends of their ranges, and numbers that are none.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "statistics.hpp"
#include "test_scenes.hpp"
#include "wedge/error.hpp"

namespace wedge::test {
namespace {

constexpr double kPi_d = 3.14159265358979;

void check_all_finite(const Frame& frame) {
    CHECK(frame.stats.non_finite_samples == 0);
    for (float value : frame.image.pixels) {
        if (std::isfinite(value)) continue;
        FAIL_CHECK("a pixel is not finite");
        return;
    }
}

/// Radiance of a small Lambertian square of albedo 1 at the origin, facing up, times pi:
/// irradiance.
double irradiance(Scene scene, int samples, float scale = 1) {
    const float size = 1e-4f * scale;
    scene.meshes = {make_quad({-size, 0, -size}, {0, 0, 2 * size}, {2 * size, 0, 0}, 0)};
    scene.instances = {{.mesh = 0}};
    scene.materials = {lambert(1.0f)};
    scene.film = {8, 8};
    scene.camera = {
        .position = scale * Vec3(0.3f, 0.1f, 0), .target = {0, 0, 0}, .vertical_fov_rad = 2e-4f};
    const Frame frame = render(scene, quick(samples, 0));
    check_all_finite(frame);
    return kPi_d * channel_mean(frame.image, "direct.G");
}

Scene under_square(float side, float distance, float radiance) {
    Scene scene;
    scene.rect_lights = {{.center = {0, distance, 0},
                          .edge_u = {side, 0, 0},
                          .edge_v = {0, 0, side},
                          .radiance = Vec3(radiance)}};
    return scene;
}

/// Irradiance straight under the middle of a square of radiance 1: four times that of a quarter
/// seen from its corner, (2 a / pi) atan(a) L pi with a = s / sqrt(d^2 + s^2), s half of the side
/// (e.g. Howell, B-3).
double square_irradiance(double side, double distance) {
    const double s = 0.5 * side, a = s / std::hypot(distance, s);
    return 4 * a * std::atan(a);
}

}  // namespace

TEST_CASE("square_lights_from_a_millionth_to_a_million_give_their_irradiance") {
    for (double side : {1e-6, 1e-3, 1.0, 1e3, 1e6}) {
        CAPTURE(side);
        const double expected = square_irradiance(side, 1);
        const auto radiance = float(1 / expected);
        CHECK(irradiance(under_square(float(side), 1, radiance), 256) ==
              doctest::Approx(double(radiance) * expected).epsilon(0.01).scale(1e-9));
    }
    // The same at other scales: a light of 1e-6 m seen from 1e-5 m, one of 1e6 m from 1e5 m.
    CHECK(irradiance(under_square(1e-6f, 1e-5f, 1), 256, 1e-5f) ==
          doctest::Approx(square_irradiance(0.1, 1)).epsilon(0.01).scale(1e-9));
    CHECK(irradiance(under_square(1e6f, 1e5f, 1), 256, 1e5f) ==
          doctest::Approx(square_irradiance(10, 1)).epsilon(0.01).scale(1e-9));
}

TEST_CASE("planes_from_a_millionth_to_a_million_do_not_shade_themselves") {
    // White under a white sky is white, however large and however tilted.
    for (float half : {1e-6f, 1.0f, 1e3f, 1e6f})
        for (const Vec3 normal : {Vec3(0, 1, 0), Vec3(0.3f, 0.8f, -0.5f), Vec3(1, 0.01f, 0.02f)}) {
            CAPTURE(half);
            const Vec3 n = glm::normalize(normal);
            const Vec3 u = half * glm::normalize(glm::cross(n, Vec3(0, 0, 1)));
            const Vec3 v = half * glm::normalize(glm::cross(u, n));
            // Off centre, so that no coordinate is zero.
            Scene scene =
                make_scene({make_quad(0.3f * v - u - v + 0.1f * half * n, 2.0f * v, 2.0f * u, 0)},
                           {lambert(1.0f)});
            scene.background = Vec3(1);
            const Vec3 eye = 0.3f * v + 0.1f * half * n + std::min(half, 1.0f) * n;
            scene.camera = {
                .position = eye, .target = eye - n, .up = u / half, .vertical_fov_rad = 1.5f};
            const Frame frame = render(scene, quick(16, 1));
            check_all_finite(frame);
            CHECK(channel_mean(frame.image, "A") == 1);
            CHECK(channel_mean(frame.image, "G") == doctest::Approx(1).epsilon(1e-3).scale(1e-9));
        }
}

TEST_CASE("gaussian_lights_become_point_lights_as_sigma_vanishes") {
    for (double sigma : {1e-2, 1e-4, 1e-6, 1e-8}) {
        CAPTURE(sigma);
        Scene scene = under_square(1, 1, float(1 / (2 * kPi_d * sigma * sigma)));
        scene.rect_lights[0].profile = LightProfile::gaussian;
        scene.rect_lights[0].sigma = float(sigma);
        // Radiance integrates to 1 over the light, straight above at distance 1.
        CHECK(irradiance(scene, 64) == doctest::Approx(1).epsilon(2e-3).scale(1e-9));
    }
}

TEST_CASE("fields_of_view_from_a_thousandth_to_179_degrees_look_where_they_should") {
    for (double fov_deg : {1e-3, 0.1, 90.0, 179.0}) {
        CAPTURE(fov_deg);
        // A wall at distance 1: the outermost pixel's middle lies at tan(fov / 2) (1 - 1 / height).
        const double half = std::tan(fov_deg * kPi_d / 360);
        const auto reach = float(2 * half);
        Scene scene =
            make_scene({make_quad({-reach, -reach, 0}, {2 * reach, 0, 0}, {0, 2 * reach, 0}, 0)},
                       {lambert(0.5f)});
        scene.background = Vec3(1);
        scene.film = {3, 3};
        scene.camera = {.position = {0, 0, 1},
                        .target = {0, 0, 0},
                        .vertical_fov_rad = float(fov_deg * kPi_d / 180)};
        const Frame frame = render(scene, quick(1024, 0, Sampler::hash));
        check_all_finite(frame);
        CHECK(channel_mean(frame.image, "A") == 1);
        const double x = frame.image.at(2, 1, frame.image.channel("P.X"));
        const double y = frame.image.at(1, 0, frame.image.channel("P.Y"));
        CHECK(x == doctest::Approx(half * 2 / 3).epsilon(0.05).scale(1e-9));
        CHECK(y == doctest::Approx(half * 2 / 3).epsilon(0.05).scale(1e-9));
    }
}

TEST_CASE("films_of_any_shape_are_filled") {
    for (const Film film : {Film{1, 1}, Film{3, 7}, Film{1920, 1}, Film{1, 257}})
        for (Method method : {Method::mc, Method::aaf}) {
            CAPTURE(film.width);
            CAPTURE(film.height);
            Scene scene = make_room(0);
            scene.film = film;
            RenderOptions options = quick(8, 1);
            options.method = method;
            if (method == Method::aaf) options.samples_per_pixel = 16;
            const Frame frame = render(scene, options);
            check_all_finite(frame);
            REQUIRE(frame.image.width == film.width);
            REQUIRE(frame.image.height == film.height);
            // In a closed room every ray meets something.
            for (double alpha : channel_values(frame.image, "A")) CHECK(alpha == 1);
            CHECK(channel_mean(frame.image, "G") > 0);
        }
}

TEST_CASE("lobes_of_any_exponent_reflect_at_most_what_they_receive") {
    for (SpecularModel model : {SpecularModel::phong, SpecularModel::blinn_phong})
        for (float exponent : {0.0f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
            CAPTURE(exponent);
            Material shiny = lambert(0.0f);
            shiny.specular = Vec3(1);
            shiny.exponent = exponent;
            shiny.model = model;
            Scene scene = make_scene({make_quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, 0)}, {shiny});
            scene.background = Vec3(1);
            scene.camera = {.position = {0, 1, 0},
                            .target = {0, 0, 0},
                            .up = {0, 0, 1},
                            .vertical_fov_rad = 0.1f};
            const Frame frame = render(scene, quick(256, 1));
            check_all_finite(frame);
            const MeanAndError g = mean_and_error(channel_values(frame.image, "G"));
            CHECK(g.mean <= 1 + 4 * g.standard_error + 1e-4);
            // Nearly a mirror, seen from nearly above: nothing goes below the horizon.
            if (exponent >= 1e3f) CHECK(g.mean == doctest::Approx(1).epsilon(0.01).scale(1e-9));
        }
}

TEST_CASE("albedos_of_0_and_1_are_exact") {
    Scene scene = make_scene({make_sphere(Vec3(0), 1, 16, false, 0)}, {lambert(0.0f)});
    scene.background = Vec3(1);
    scene.camera = {.position = {0, 0, 3}, .vertical_fov_rad = 0.3f};
    for (double g : channel_values(render(scene, quick(8, 4)).image, "G")) CHECK(g == 0);
    scene.materials[0].diffuse = Vec3(1);
    for (double g : channel_values(render(scene, quick(8, 4)).image, "G"))
        CHECK(g == doctest::Approx(1).epsilon(1e-4).scale(1e-9));
}

TEST_CASE("reflectance_textures_beyond_1_or_below_0_are_cut") {
    for (float value : {-3.0f, 4.0f}) {
        Scene scene = make_scene({make_sphere(Vec3(0), 1, 16, false, 0)}, {lambert(1.0f)});
        scene.background = Vec3(1);
        scene.camera = {.position = {0, 0, 3}, .vertical_fov_rad = 0.3f};
        Texture texture;
        texture.image = {1, 1, TextureFormat::linear8, {255, 255, 255, 255}};
        texture.value_gain = value;
        scene.textures = {texture};
        scene.materials[0].diffuse_texture = 0;
        const double expected = value > 0 ? 1 : 0;
        CHECK(channel_mean(render(scene, quick(8, 2)).image, "G") ==
              doctest::Approx(expected).epsilon(1e-4).scale(1e-9));
    }
}

TEST_CASE("bad_texels_and_vertices_spoil_nothing_beside_them") {
    Scene scene = make_room(0);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    scene.meshes.push_back(make_quad({kNan, 0, 0}, {1, 0, 0}, {0, INFINITY, 0}, 0));
    scene.instances.push_back({.mesh = uint32_t(scene.meshes.size() - 1)});
    Texture texture;
    texture.image = {2, 1, TextureFormat::float32, std::vector<unsigned char>(32)};
    const float texels[8] = {kNan, kNan, kNan, 1, -INFINITY, 0.5f, 0.5f, 1};
    std::copy_n(reinterpret_cast<const unsigned char*>(texels), 32, texture.image.texels.begin());
    scene.textures = {texture};
    scene.materials[2].diffuse_texture = 0;  // the sphere's
    const Frame frame = render(scene, quick(16, 3));
    CHECK(frame.stats.non_finite_triangles == 2);
    check_all_finite(frame);
    CHECK(channel_mean(frame.image, "G") > 0);
}

TEST_CASE("coordinates_near_the_ends_of_single_precision_are_survived") {
    for (float scale : {1e-38f, 1e-30f, 1e-18f, 1e17f, 1e30f, 1e37f}) {
        CAPTURE(scale);
        Scene scene = make_room(0);
        for (Mesh& mesh : scene.meshes)
            for (Vec3& p : mesh.positions) p *= scale;
        for (RectLight& light : scene.rect_lights) {
            light.center *= scale;
            light.edge_u *= scale;
            light.edge_v *= scale;
        }
        scene.camera.position *= scale;
        scene.camera.target *= scale;
        // What cannot be computed is dropped and counted, and nothing else comes of it.
        const Frame frame = render(scene, quick(4, 2));
        for (float value : frame.image.pixels) REQUIRE(std::isfinite(value));
    }
}

// Squares of samples are summed in single precision: light of 1e20 is finite, its square is not.
TEST_CASE("light_beyond_what_a_film_can_sum_is_dropped_and_counted") {
    for (float intensity : {1e20f, 3e38f}) {
        CAPTURE(intensity);
        Scene scene = make_room(20);
        scene.rect_lights.clear();
        scene.point_lights = {{Vec3(0, 0.9f, 0), Vec3(intensity)}};
        for (Method method : {Method::mc, Method::aaf}) {
            RenderOptions options = quick(16, 1);
            options.method = method;
            const Frame frame = render(scene, options);
            CHECK(frame.stats.non_finite_samples > 0);
            for (float value : frame.image.pixels) REQUIRE(std::isfinite(value));
        }
    }
}

TEST_CASE("scenes_with_lights_that_are_no_numbers_are_refused") {
    Scene scene = make_room(0);
    scene.rect_lights[0].radiance.y = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS(render(scene, quick(4, 0)), Error);
    scene = make_room(0);
    scene.meshes[0].triangles[0].x = 1'000'000;
    CHECK_THROWS_AS(render(scene, quick(4, 0)), Error);
}

TEST_CASE("every_bit_of_the_seed_counts") {
    const Scene scene = make_room(0);
    const auto pixels = [&](uint64_t seed) {
        RenderOptions options = quick(4, 0);
        options.seed = seed;
        return render(scene, options).image.pixels;
    };
    const std::vector<float> first = pixels(1);
    CHECK(pixels(1) == first);
    for (int bit = 1; bit < 64; bit += 7) CHECK(pixels(1 + (uint64_t(1) << bit)) != first);
}

}  // namespace wedge::test
