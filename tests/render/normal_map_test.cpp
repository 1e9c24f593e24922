// Normal and bump maps against what tilted planes would show.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "test_scenes.hpp"

namespace wedge::test {
namespace {

constexpr double kInvPi = 0.31830988618379067;

/// `width` x 1 texels, linear floats.
Texture float_map(const std::vector<Vec3>& texels) {
    Texture t;
    t.image = {int(texels.size()), 1, TextureFormat::float32, {}};
    t.clamp = true;
    for (const Vec3& c : texels) {
        const float rgba[4] = {c.x, c.y, c.z, 1};
        const auto* bytes = reinterpret_cast<const unsigned char*>(rgba);
        t.image.texels.insert(t.image.texels.end(), bytes, bytes + sizeof(rgba));
    }
    return t;
}

Texture constant_normal(const Vec3& n) {
    return float_map({0.5f * n + 0.5f});
}

/// A square in the plane y = 0, front up, u along x and v along -z, under a point light, seen from
/// above.
Scene make_plate(const Texture* normals, const Texture* heights) {
    Mesh quad = make_quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 0);
    quad.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    Material grey = lambert(0.5f);
    Scene scene = make_scene({quad}, {grey});
    if (normals) {
        scene.materials[0].normal_texture = 0;
        scene.textures = {*normals};
    }
    if (heights) {
        scene.materials[0].bump_texture = 0;
        scene.textures = {*heights};
    }
    scene.point_lights = {{.position = {30, 80, -20}, .intensity = Vec3(7000)}};
    scene.camera = {
        .position = {0, 5, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .vertical_fov_rad = 0.01f};
    scene.film = {4, 4};
    return scene;
}

/// Radiance of the plate at the origin if its normal were `n`.
double plate_radiance(const Vec3& n) {
    const glm::dvec3 l(30, 80, -20);
    const double d2 = glm::dot(l, l);
    return 0.5 * kInvPi * 7000 / d2 * std::max(0.0, glm::dot(glm::dvec3(n), l) / std::sqrt(d2));
}

void check_plate(const Scene& scene, const Vec3& normal) {
    const Image image = render(scene, quick(4, 0)).image;
    INFO(fmt::format("expected normal {} {} {}", normal.x, normal.y, normal.z));
    CHECK(channel_mean(image, "N.X") ==
          doctest::Approx(normal.x).epsilon(1e-4).scale(1e-9).scale(1));
    CHECK(channel_mean(image, "N.Y") ==
          doctest::Approx(normal.y).epsilon(1e-4).scale(1e-9).scale(1));
    CHECK(channel_mean(image, "N.Z") ==
          doctest::Approx(normal.z).epsilon(1e-4).scale(1e-9).scale(1));
    // The light is far, but not at infinity.
    CHECK(channel_mean(image, "G") ==
          doctest::Approx(plate_radiance(normal)).epsilon(2e-3).scale(1e-9));
}

}  // namespace

TEST_CASE("flat_normal_and_bump_maps_change_nothing") {
    const Vec3 up(0, 1, 0);
    const Texture flat = constant_normal({0, 0, 1}), level = float_map({Vec3(0.3f)});
    check_plate(make_plate(nullptr, nullptr), up);
    check_plate(make_plate(&flat, nullptr), up);
    check_plate(make_plate(nullptr, &level), up);
    Texture bytes;
    bytes.image = {1, 1, TextureFormat::linear8, {128, 128, 255, 255}};
    check_plate(make_plate(&bytes, nullptr), up);
}

TEST_CASE("a_constant_normal_map_shades_as_a_tilted_plane") {
    for (float tilt : {0.1f, 0.7f, 1.2f})
        for (float turn : {0.0f, 2.0f, 4.0f}) {
            // Tangent space: x along u (world x), y along v (world -z), z off the front (world y).
            const Vec3 n(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                         std::cos(tilt));
            const Texture map = constant_normal(n);
            check_plate(make_plate(&map, nullptr), {n.x, n.z, -n.y});

            // Strength scales the slope.
            Texture strong = map;
            strong.value_gain = 2;
            check_plate(make_plate(&strong, nullptr), glm::normalize(Vec3(2 * n.x, n.z, -2 * n.y)));

            // Texture coordinates that run the other way turn the map with them.
            Scene mirrored = make_plate(&map, nullptr);
            for (Vec2& uv : mirrored.meshes[0].uvs) uv.x = 1 - uv.x;
            check_plate(mirrored, {-n.x, n.z, -n.y});
            Texture flipped = map;
            flipped.scale = {-1, 1};
            check_plate(make_plate(&flipped, nullptr), {-n.x, n.z, -n.y});

            // So does an instance, at any scale.
            Scene turned = make_plate(&map, nullptr);
            for (Vec3& p : turned.meshes[0].positions) p = 1e3f * Vec3(p.z, p.y, -p.x);
            turned.instances[0].transform = Mat4(0, 0, 1e-3f, 0, 0, 1e-3f, 0, 0,  //
                                                 -1e-3f, 0, 0, 0, 0, 0, 0, 1);
            // The mesh was turned by 90 degrees about y, the instance turns it back.
            check_plate(turned, {n.x, n.z, -n.y});
        }
}

TEST_CASE("a_bump_map_of_constant_slope_shades_as_a_tilted_plane") {
    for (float slope : {0.05f, 0.5f, -1.5f}) {
        std::vector<Vec3> ramp;
        for (int x = 0; x < 16; ++x) ramp.emplace_back(slope * float(x));
        const Texture heights = float_map(ramp);
        const Vec3 expected = glm::normalize(Vec3(-slope, 1, 0));
        check_plate(make_plate(nullptr, &heights), expected);

        Texture doubled = heights;
        doubled.value_gain = 2;
        check_plate(make_plate(nullptr, &doubled), glm::normalize(Vec3(-2 * slope, 1, 0)));

        // The same ramp along v: its first row is the top, where v is largest.
        Texture upright = heights;
        std::swap(upright.image.width, upright.image.height);
        check_plate(make_plate(nullptr, &upright), glm::normalize(Vec3(0, 1, -slope)));
    }
}

TEST_CASE("a_mapped_normal_that_faces_away_from_the_viewer_is_not_used") {
    const Texture map = constant_normal({std::sin(1.2f), 0, std::cos(1.2f)});
    Scene scene = make_plate(&map, nullptr);
    scene.camera.position = {-5, 0.5f, 0};  // the map bends normals towards +x
    const Image image = render(scene, quick(4, 0)).image;
    CHECK(channel_mean(image, "N.Y") == doctest::Approx(1));
    scene.camera.position = {5, 0.5f, 0};
    CHECK(channel_mean(render(scene, quick(4, 0)).image, "N.Y") ==
          doctest::Approx(std::cos(1.2)).epsilon(1e-4).scale(1e-9));
}

TEST_CASE("seen_from_behind_a_normal_map_is_the_other_side_of_the_same_relief") {
    const Texture map = constant_normal({0.6f, 0, 0.8f});
    Scene scene = make_plate(&map, nullptr);
    scene.camera.position = {0, -5, 0};
    const Image image = render(scene, quick(4, 0)).image;
    CHECK(channel_mean(image, "N.X") == doctest::Approx(-0.6).epsilon(1e-4).scale(1e-9));
    CHECK(channel_mean(image, "N.Y") == doctest::Approx(-0.8).epsilon(1e-4).scale(1e-9));
}

TEST_CASE("normal_maps_make_no_energy") {
    // White under a white sky: whatever the relief, no pixel may send out more than it receives.
    std::vector<Vec3> waves;
    for (int x = 0; x < 32; ++x) waves.emplace_back(3 * std::sin(float(x)));
    Texture heights = float_map(waves);
    heights.clamp = false;
    Scene scene = make_plate(nullptr, &heights);
    scene.materials[0].diffuse = Vec3(1);
    scene.point_lights.clear();
    scene.background = Vec3(1);
    scene.camera.vertical_fov_rad = 0.3f;
    const Image image = render(scene, quick(256, 1)).image;
    for (double g : channel_values(image, "G")) CHECK(g < 1.02);
    CHECK(channel_mean(image, "G") < 1);
}

TEST_CASE("triangles_without_texture_coordinates_stay_smooth") {
    const Texture map = constant_normal({0.6f, 0, 0.8f});
    Scene scene = make_plate(&map, nullptr);
    scene.meshes[0].uvs.clear();
    check_plate(scene, {0, 1, 0});
}

}  // namespace wedge::test
