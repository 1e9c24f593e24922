// Layers that tell what the camera sees.
#include <doctest/doctest.h>

#include <cmath>

#include "test_scenes.hpp"

namespace wedge::test {
namespace {

constexpr float kDepth = 3, kAlbedo = 0.25f;
constexpr int kWidth = 32, kHeight = 24;

/// Looks along -z at a wall that ends in the middle of the picture.
Scene half_a_wall() {
    Scene scene = make_scene({make_quad({-50, -50, -kDepth}, {50, 0, 0}, {0, 100, 0}, 0)},
                             {lambert(kAlbedo)});
    scene.camera = {.position = {0, 0, 0}, .target = {0, 0, -1}};
    scene.film = {kWidth, kHeight};
    scene.point_lights = {{.position = {1, 1, 0}, .intensity = {1, 1, 1}}};
    return scene;
}

TEST_CASE("what_the_camera_sees_of_a_wall_is_told") {
    for (const Method method : {Method::mc, Method::aaf}) {
        RenderOptions options = quick(64, 0);
        options.method = method;
        const Scene scene = half_a_wall();
        const Image image = render(scene, options).image;
        const double pixel =
            2 * std::tan(0.5 * double(scene.camera.vertical_fov_rad)) * double(kDepth) / kHeight;
        const auto value = [&](const char* channel, int x, int y) {
            return channel_values(image, channel)[std::size_t(y * kWidth + x)];
        };
        for (int y = 0; y < kHeight; y += 5)
            for (int x = 0; x < kWidth; x += 3) {
                const bool hit = x < kWidth / 2;
                CHECK(value("A", x, y) == (hit ? 1 : 0));
                // The same however far from the middle it is seen.
                CHECK(value("Z", x, y) == doctest::Approx(hit ? kDepth : 0).epsilon(1e-5));
                CHECK(value("N.Z", x, y) == (hit ? 1 : 0));
                CHECK(value("albedo.G", x, y) == (hit ? double(kAlbedo) : 0));
                if (!hit) continue;
                CHECK(std::abs(value("P.X", x, y) - (x + 0.5 - kWidth / 2) * pixel) < 0.1 * pixel);
                CHECK(std::abs(value("P.Y", x, y) - (kHeight / 2 - y - 0.5) * pixel) < 0.1 * pixel);
                CHECK(value("P.Z", x, y) == doctest::Approx(-kDepth).epsilon(1e-5));
            }
    }
}

}  // namespace
}  // namespace wedge::test
