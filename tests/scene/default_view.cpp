// A model without a scene: the camera must see it, the light must reach it, at any scale.
#include <glm/gtc/matrix_transform.hpp>

#include "host/scene/lights.hpp"
#include "host/scene/probe.hpp"
#include "tests/scene/support.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

/// A box as OBJ; inward: a room.
std::string box_obj(const Vec3& lower, const Vec3& upper, bool inward, bool open_front = false) {
    std::string obj;
    for (int i = 0; i < 8; ++i) {
        char line[100];
        std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", i & 1 ? upper.x : lower.x,
                      i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z);
        obj += line;
    }
    // Outward: x-, x+, y-, y+, z-, z+.
    const int faces[6][4] = {{1, 5, 7, 3}, {2, 4, 8, 6}, {1, 2, 6, 5},
                             {3, 7, 8, 4}, {1, 3, 4, 2}, {5, 6, 8, 7}};
    for (int face = 0; face < (open_front ? 5 : 6); ++face) {
        obj += "f";
        for (int i = 0; i < 4; ++i)
            obj.append(" ").append(std::to_string(faces[face][inward ? 3 - i : i]));
        obj += "\n";
    }
    return obj;
}

Scene load(const std::string& obj) {
    TempFolder folder;
    LogCapture log;
    const Scene scene = load_scene(folder.write("m.obj", obj));
    CHECK(!log.infos.empty());  // what is made up is said
    return scene;
}

/// Position in the image, each axis from -1 to 1 inside it.
Vec2 projected(const Scene& scene, const Vec3& point) {
    const Camera& camera = scene.camera;
    const Mat4 view = glm::lookAt(camera.position, camera.target, camera.up);
    const Mat4 projection = glm::perspective(
        camera.vertical_fov_rad, float(scene.film.width) / float(scene.film.height), 0.1f, 10.0f);
    const Vec4 clip = projection * view * Vec4(point, 1);
    CHECK(clip.w > 0);  // before the camera
    return Vec2(clip) / clip.w;
}

}  // namespace

TEST_CASE("objects_are_framed_lit_and_not_lost_at_any_scale") {
    for (const Vec3& size : {Vec3(1), Vec3(1, 10, 1), Vec3(10, 0.1f, 3)})
        for (const float scale : {1e-4f, 1.0f, 1e5f}) {
            const Vec3 lower = scale * Vec3(7, -3, 2), upper = lower + scale * size;
            const Scene scene = load(box_obj(lower, upper, false));
            float widest = 0;
            for (int i = 0; i < 8; ++i) {
                const Vec2 p =
                    projected(scene, {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y,
                                      i & 4 ? upper.z : lower.z});
                widest = std::max({widest, std::abs(p.x), std::abs(p.y)});
            }
            CHECK(widest < 1);
            CHECK(widest > 0.7f);                                       // and it fills the image
            CHECK(scene.camera.position.y > upper.y - scale * size.y);  // from above, not below

            REQUIRE(scene.rect_lights.size() == 1);
            const RectLight& light = scene.rect_lights[0];
            CHECK(light.center.y > upper.y);
            const Vec3 center = 0.5f * (lower + upper);
            CHECK(glm::dot(glm::cross(light.edge_u, light.edge_v), center - light.center) > 0);
        }
}

TEST_CASE("made_up_radiance_does_not_depend_on_scale") {
    const auto radiance = [](float scale) {
        return load(box_obj(Vec3(0), Vec3(scale), false)).rect_lights.at(0).radiance.x;
    };
    CHECK(radiance(1e-4f) == doctest::Approx(radiance(1)).epsilon(1e-3));
    CHECK(radiance(1e5f) == doctest::Approx(radiance(1)).epsilon(1e-3));
}

TEST_CASE("rooms_are_seen_from_inside") {
    for (const float scale : {1e-4f, 1.0f, 1e5f}) {
        const Vec3 lower = scale * Vec3(-4, 0, -2), upper = scale * Vec3(4, 3, 2);
        const Scene scene = load(box_obj(lower, upper, true));
        const Vec3 places[2] = {scene.camera.position, scene.rect_lights.at(0).center};
        for (const Vec3& p : places)
            for (int axis = 0; axis < 3; ++axis) {
                CHECK(p[axis] > lower[axis]);
                CHECK(p[axis] < upper[axis]);
            }
        // Along the long way, and the light looks down.
        const Vec3 view = glm::normalize(scene.camera.target - scene.camera.position);
        CHECK(std::abs(view.x) > 0.8f);
        CHECK(glm::cross(scene.rect_lights[0].edge_u, scene.rect_lights[0].edge_v).y < 0);
    }
}

TEST_CASE("stages_are_seen_through_their_open_side") {
    const Scene scene = load(box_obj(Vec3(-1), Vec3(1), true, true));
    CHECK(scene.camera.position.z > 1);
    const Vec3 view = glm::normalize(scene.camera.target - scene.camera.position);
    CHECK(view.z == doctest::Approx(-1));
}

TEST_CASE("models_that_shine_get_no_light") {
    TempFolder folder;
    folder.write("m.mtl", "newmtl a\nKe 5 5 5\n");
    const Scene scene = load_scene(
        folder.write("m.obj", "mtllib m.mtl\nusemtl a\n" + box_obj(Vec3(0), Vec3(1), false)));
    CHECK(scene.rect_lights.empty());
    CHECK(scene.background == Vec3(0));
}

TEST_CASE("flat_models_are_framed_too") {
    const Scene scene = load(kTriangleObj);
    CHECK(std::isfinite(scene.camera.position.x));
    CHECK(scene.camera.position != scene.camera.target);
}
