// Lamps in the plane of a wall: what is met there is the lamp.
#include <doctest/doctest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "host/render/flatten.hpp"
#include "test_scenes.hpp"
#include "wedge/render.hpp"

namespace wedge::test {
namespace {

constexpr float kRadiance = 5;

RectLight lamp_at(const Vec3& center) {
    return {.center = center,
            .edge_u = {0.6f, 0, 0},
            .edge_v = {0, 0.6f, 0},
            .radiance = Vec3(kRadiance)};
}

Mesh wall(const Vec3& corner, float width, float height, uint32_t material) {
    return make_quad(corner, {width, 0, 0}, {0, height, 0}, material);
}

/// White ground in front of a black wall, z = -1; a lamp in that.
Scene lamp_in_wall() {
    Scene scene =
        make_scene({make_quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 0), wall({-4, 0, -1}, 8, 4, 1)},
                   {lambert(1), lambert(0)});
    scene.rect_lights = {lamp_at({0.4f, 0.5f, -1})};
    scene.camera = {.position = {0.3f, 1.2f, 3}, .target = {0.4f, 0.3f, -0.6f}};
    scene.film = {32, 24};
    return scene;
}

/// Turned, moved and enlarged as a whole, so that no plane is along an axis.
void place(Scene& scene, const Mat4& placement) {
    const auto turn = [&](Vec3& v, float w) { v = Vec3(placement * Vec4(v, w)); };
    for (Instance& i : scene.instances) i.transform = placement * i.transform;
    for (RectLight& l : scene.rect_lights) turn(l.center, 1), turn(l.edge_u, 0), turn(l.edge_v, 0);
    turn(scene.camera.position, 1), turn(scene.camera.target, 1), turn(scene.camera.up, 0);
}

Mat4 some_placement() {
    const Mat4 turned = glm::rotate(Mat4(1), 0.7f, glm::normalize(Vec3(1, 2, -0.5f)));
    return glm::scale(glm::translate(Mat4(1), Vec3(3, -2, 5)), Vec3(1.7f)) * turned;
}

Vec3 origin_of(const rendering::FlatScene& flat) {
    const shared::float4& o = flat.lights[0].origin;
    return {o.x, o.y, o.z};
}

/// How far a scene's one lamp was moved along its normal, as a share of its side.
float lift_of(const Scene& scene) {
    const RectLight& lamp = scene.rect_lights[0];
    const Vec3 before = lamp.center - 0.5f * (lamp.edge_u + lamp.edge_v);
    const Vec3 by = origin_of(rendering::flatten(scene)) - before;
    const Vec3 normal = glm::normalize(glm::cross(lamp.edge_u, lamp.edge_v));
    CHECK(glm::length(by - normal * glm::dot(by, normal)) < 1e-6f);
    return glm::dot(by, normal) / glm::length(lamp.edge_u);
}

TEST_CASE("lamps_that_lie_in_a_wall_are_moved_in_front_of_it") {
    Scene scene = lamp_in_wall();
    CHECK(lift_of(scene) > 1e-6f);
    CHECK(lift_of(scene) < 1e-4f);
    place(scene, some_placement());
    CHECK(lift_of(scene) > 1e-6f);
    CHECK(lift_of(scene) < 1e-4f);

    Scene behind = lamp_in_wall();  // by a rounding error
    behind.rect_lights[0].center.z -= 5e-6f;
    CHECK(rendering::flatten(behind).lights[0].origin.z > -1 + 5e-6f);

    Scene huge = lamp_in_wall();  // coordinates as large as a kilometre, and a lamp of 60 cm
    place(huge, glm::translate(Mat4(1), Vec3(0, 0, 1000)));
    CHECK(lift_of(huge) > 1e-4f);
    CHECK(lift_of(huge) < 3e-3f);
}

/// How far in front of the wall, the scene's second mesh, a corner of the lamp is, along the normal
/// of the larger of both.
double height_over_wall(const Scene& scene, bool is_wall_larger) {
    const auto flat = rendering::flatten(scene);
    const UVec3 t = flat.triangles[2];
    const glm::dvec3 a(flat.positions[t.x]), b(flat.positions[t.y]), c(flat.positions[t.z]);
    const shared::float4& n = flat.lights[0].normal;
    const glm::dvec3 normal =
        is_wall_larger ? glm::normalize(glm::cross(b - a, c - a)) : glm::dvec3(n.x, n.y, n.z);
    return glm::dot(glm::dvec3(origin_of(flat)) - a, normal);
}

TEST_CASE("walls_much_larger_or_smaller_than_a_lamp_count") {
    // A plane is not known well far away from the small triangle, or the small lamp, that it is of.
    for (float size : {0.001f, 300.0f}) {
        Scene scene = lamp_in_wall();
        const Vec3 center = scene.rect_lights[0].center;
        scene.meshes[1] = wall(center - Vec3(0.4f, 0.3f, 0) * size, size, size, 1);
        scene.rect_lights.clear();
        scene.materials.push_back({.name = "lamp", .diffuse = Vec3(0), .emission = Vec3(1)});
        const float side = size < 1 ? 0.6f : 0.06f;
        scene.meshes.push_back(wall(center - Vec3(side, side, 0) / 2.0f, side, side, 2));
        scene.instances.push_back({.mesh = 2});
        for (int turns = 0; turns < 4; ++turns) {
            place(scene, some_placement());
            CAPTURE(size);
            CAPTURE(turns);
            CHECK(height_over_wall(scene, size > 1) > 1e-5);
            CHECK(height_over_wall(scene, size > 1) < 2e-3);
        }
    }
}

TEST_CASE("lamps_that_are_clear_of_walls_stay") {
    const Scene lies = lamp_in_wall();
    Scene before = lies, through = lies, beside = lies, across = lies;
    before.rect_lights[0].center.z = -0.999f;
    through.meshes[1] = make_quad({-4, 0.5f, -4}, {8, 0, 0}, {0, 0, 8}, 1);
    beside.meshes[1] = wall({0.7f, 0, -1}, 3, 4, 1);  // has a side in common
    // The box around this has the lamp in it, but it has not.
    across.meshes[1].positions = {{1.4f, 0, -1}, {4, 0, -1}, {4, 4, -1}, {-2.02f, 4, -1}};
    across.meshes[1].triangles = {{0, 1, 2}, {0, 2, 3}};
    int number = 0;
    for (const Scene& scene : {before, through, beside, across}) {
        CAPTURE(number);
        CHECK(lift_of(scene) == 0.0f);
        ++number;
    }

    Scene panel = lies;  // what shines is no wall
    panel.materials[1].emission = Vec3(1);
    const auto flat = rendering::flatten(panel);
    for (const shared::Light& light : flat.lights) CHECK(light.origin.z == -1.0f);
}

TEST_CASE("a_shining_quad_that_shares_the_walls_vertices_leaves_it") {
    Scene scene = lamp_in_wall();
    scene.rect_lights.clear();
    scene.materials.push_back({.name = "lamp", .diffuse = Vec3(0), .emission = Vec3(kRadiance)});
    Mesh& mesh = scene.meshes[1];
    mesh.triangles.insert(mesh.triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
    mesh.material_of = {1, 1, 2, 2};
    const auto flat = rendering::flatten(scene);
    REQUIRE(flat.lights.size() == 1);
    CHECK(flat.lights[0].origin.z > -1.0f);
    for (std::size_t i = 0; i < flat.triangles.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const float z = flat.positions[flat.triangles[i][k]].z;
            const auto& vertex = flat.vertices[flat.triangles[i][k]];
            CHECK(vertex.pz == z);
            if (i >= 2) CHECK(z == (flat.shading[i].light < 0 ? -1.0f : flat.lights[0].origin.z));
        }
}

TEST_CASE("light_of_a_lamp_in_a_wall_is_all_there") {
    // A black wall behind it changes nothing in front: neither to the eye, nor by any way of
    // sampling. Without clearance half of what scattered rays should find was missing, 3 % near the
    // lamp.
    for (bool placed : {false, true}) {
        Scene with = lamp_in_wall();
        if (placed) place(with, some_placement());
        Scene without = with;
        without.instances.pop_back();
        for (Method method : {Method::mc, Method::aaf}) {
            RenderOptions options = quick(256, 1);
            options.method = method;
            const Image a = render(with, options).image, b = render(without, options).image;
            CAPTURE(placed);
            CAPTURE(int(method));
            CHECK(channel_mean(a, "emission.R") ==
                  doctest::Approx(channel_mean(b, "emission.R")).epsilon(1e-3).scale(1e-9));
            CHECK(channel_mean(a, "direct.R") ==
                  doctest::Approx(channel_mean(b, "direct.R")).epsilon(1e-3).scale(1e-9));
        }
    }
}

}  // namespace
}  // namespace wedge::test
