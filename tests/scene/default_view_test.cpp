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

namespace {

/// A floor of side 2, an upright sheet behind it (at `sheet_z`, as high as the floor is wide), and
/// a lamp of half the floor's side that hangs over it and shines down with the given radiance.
Scene stage(float sheet_z, float radiance) {
    TempFolder folder;
    LogCapture log;
    char sheet[200];
    std::snprintf(sheet, sizeof sheet, "v -1 0 %g\nv 1 0 %g\nv 1 2 %g\nv -1 2 %g\n", sheet_z,
                  sheet_z, sheet_z, sheet_z);
    folder.write("m.mtl", "newmtl grey\nKd 0.6 0.6 0.6\nnewmtl lamp\nKd 0 0 0\nKe " +
                              std::to_string(radiance) + " " + std::to_string(radiance) + " " +
                              std::to_string(radiance) + "\n");
    return load_scene(folder.write(
        "m.obj", "mtllib m.mtl\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\n" + std::string(sheet) +
                     "v -0.5 2 -0.5\nv 0.5 2 -0.5\nv 0.5 2 0.5\nv -0.5 2 0.5\n"
                     "usemtl grey\nf 1 2 3 4\nf 5 6 7 8\nusemtl lamp\nf 9 10 11 12\n"));
}

}  // namespace

TEST_CASE("a_backdrop_is_seen_from_the_side_that_its_lamp_shines_upon") {
    const Scene open_front = stage(-1, 10), open_back = stage(1, 10);
    CHECK(open_front.rect_lights.empty());
    CHECK(open_back.rect_lights.empty());
    CHECK(open_front.camera.position.z > 0);
    CHECK(open_back.camera.position.z < 0);
    CHECK(open_front.defaults.exposure == 0);
}

TEST_CASE("dim_lamps_are_shown_brighter_by_what_they_lack") {
    // The lamp, taken for a point, gives the middle of the floor 0.8 / 2^2, its corners a quarter
    // of that.
    const float stops = stage(-1, 0.8f).defaults.exposure;
    CHECK(stops >= 2);  // 1 / 0.2 is 2.3 stops, 1 / 0.05 is 4.3
    CHECK(stops <= 4);
}

TEST_CASE("lamps_that_shine_away_from_all_that_is_seen_get_help") {
    // The lamp's front is up: nothing below it is lit.
    TempFolder folder;
    LogCapture log;
    folder.write("m.mtl", "newmtl grey\nKd 0.6 0.6 0.6\nnewmtl lamp\nKd 0 0 0\nKe 99 99 99\n");
    const Scene scene = load_scene(
        folder.write("m.obj",
                     "mtllib m.mtl\nv -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nv -0.5 2 -0.5\nv 0.5 2 "
                     "-0.5\nv 0.5 2 "
                     "0.5\nv -0.5 2 0.5\nusemtl grey\nf 1 2 3 4\nusemtl lamp\nf 8 7 6 5\n"));
    CHECK(scene.rect_lights.size() == 1);
}
