// Lamps modelled as two triangles become rectangles.
#include <doctest/doctest.h>

#include "host/render/flatten.hpp"
#include "host/render/shining_rects.hpp"
#include "test_scenes.hpp"
#include "wedge/shared/scene.h"

namespace wedge::test {
namespace {

Material shining() {
    Material lamp = lambert(0);
    lamp.emission = {3, 2, 1};
    return lamp;
}

TEST_CASE("two_shining_triangles_make_a_rectangle") {
    for (bool mirrored : {false, true}) {
        Scene scene = make_scene({make_quad({1, 2, 3}, {0, 0, 2}, {0.5f, 0, 0}, 0)}, {shining()});
        if (mirrored) scene.instances[0].transform[1][1] = -1;
        const auto found = rendering::find_shining_rects(scene);
        REQUIRE(found.size() == 1);
        const RectLight& light = found[0].light;
        const float y = mirrored ? -2.0f : 2.0f;
        CHECK(glm::length(light.center - Vec3(1.25f, y, 4)) < 1e-6f);
        CHECK(glm::length(glm::cross(light.edge_u, light.edge_v)) == doctest::Approx(1));
        // It shines to the side its triangles face.
        const auto flat = rendering::flatten(scene);
        const UVec3 t = flat.triangles[0];
        const Vec3 face = glm::cross(flat.positions[t.y] - flat.positions[t.x],
                                     flat.positions[t.z] - flat.positions[t.x]);
        CHECK(glm::dot(glm::cross(light.edge_u, light.edge_v), face) > 0);
        REQUIRE(flat.lights.size() == 1);
        CHECK(flat.lights[0].kind == WEDGE_LIGHT_RECT);
        CHECK(flat.shading[0].light == 0);
        CHECK(flat.shading[1].light == 0);
    }
}

TEST_CASE("shining_triangles_that_make_no_rectangle_stay_triangles") {
    Material dark = lambert(0.5f);
    Scene skewed = make_scene({make_quad({0, 0, 0}, {1, 0, 0}, {0.3f, 1, 0}, 0)}, {shining()});
    Scene bent = make_scene({make_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0)}, {shining()});
    bent.meshes[0].positions[3].z = 0.1f;
    Scene half = make_scene({make_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0)}, {shining(), dark});
    half.meshes[0].material_of[1] = 1;
    Scene textured = make_scene({make_quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0)}, {shining()});
    textured.materials[0].emission_texture = 0;
    for (const Scene& scene : {skewed, bent, half, textured})
        CHECK(rendering::find_shining_rects(scene).empty());
}

TEST_CASE("a_lamp_of_triangles_lights_like_a_rectangle") {
    // The same lamp once as a light, once as a mesh, with shadows and bounces.
    Scene as_light = make_room(0), as_mesh = make_room(0);
    const RectLight lamp = as_light.rect_lights[0];
    as_mesh.rect_lights.clear();
    as_mesh.materials.push_back({.name = "lamp", .diffuse = Vec3(0), .emission = lamp.radiance});
    as_mesh.meshes.push_back(
        make_quad(lamp.center - 0.5f * (lamp.edge_u + lamp.edge_v), lamp.edge_u, lamp.edge_v, 3));
    as_mesh.instances.push_back({.mesh = uint32_t(as_mesh.meshes.size() - 1)});
    const Image a = render(as_light, quick(256, 2)).image, b = render(as_mesh, quick(256, 2)).image;
    for (const char* channel : {"emission.R", "direct.G", "indirect.B"})
        CHECK(channel_mean(a, channel) ==
              doctest::Approx(channel_mean(b, channel)).epsilon(0.005).scale(1e-9));
}

TEST_CASE("the_back_of_a_lamp_stays_dark") {
    // It reflects, but nothing else shines. Coordinates and tilts that round.
    for (const Vec3& v : {Vec3(0, 0, 0.38f), Vec3(0, 0.1f, 0.37f), Vec3(0.05f, -0.2f, 0.3f)})
        for (float scale : {1e-3f, 1.0f, 1e4f}) {
            const Vec3 corner = scale * Vec3(0.23f, 1.58f, -0.22f),
                       u = scale * Vec3(0.47f, 0.01f, 0);
            Material lamp = shining();
            lamp.diffuse = Vec3(0.78f);
            Scene scene = make_scene({make_quad(corner, u, scale * v, 0)}, {lamp});
            const Vec3 middle = corner + 0.5f * (u + scale * v);
            const Vec3 front = glm::normalize(glm::cross(u, v));
            scene.camera = {middle - scale * (2.0f * front + Vec3(0.3f, 0, 0.1f)), middle,
                            Vec3(0, 0.3f, 1), 0.3f};
            scene.film = {32, 32};
            for (Method method : {Method::mc, Method::aaf}) {
                RenderOptions options = quick(32, 1);
                options.method = method;
                const Image image = render(scene, options).image;
                CHECK(channel_mean(image, "albedo.R") > 0.1);  // it is in view
                CHECK(channel_mean(image, "R") == 0);
            }
        }
}

}  // namespace
}  // namespace wedge::test
