// Triangulation, smooth normals, and words that are near each other.
#include "host/base/edit_distance.hpp"
#include "host/scene/normals.hpp"
#include "host/scene/probe.hpp"
#include "host/scene/triangulate.hpp"
#include "tests/scene/support.hpp"

using namespace wedge;
using namespace wedge::scene;

namespace {

Vec3 vector_area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5f * glm::cross(b - a, c - a);
}

/// Every triangle must have the winding of the polygon, and the areas must add up to its own:
/// together this means that they cover it without overlap.
void check_cover(const std::vector<Vec3>& polygon) {
    Vec3 whole(0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        whole += vector_area(polygon[0], polygon[i], polygon[i + 1]);
    const auto triangles = triangulate(polygon);
    CHECK(triangles.size() == polygon.size() - 2);
    float sum = 0;
    for (const auto& [a, b, c] : triangles) {
        const Vec3 area = vector_area(polygon[a], polygon[b], polygon[c]);
        CHECK(glm::dot(area, whole) >= 0);
        sum += glm::length(area);
    }
    CHECK(sum == doctest::Approx(glm::length(whole)).epsilon(1e-4));
}

/// In a plane that is parallel to no axis, of the given scale, far from the origin.
std::vector<Vec3> placed(const std::vector<Vec2>& polygon, float scale) {
    std::vector<Vec3> result;
    for (const Vec2& p : polygon)
        result.push_back(
            scale * (p.x * Vec3(0.8f, 0.36f, 0.48f) + p.y * Vec3(-0.6f, 0.48f, 0.64f) + Vec3(5)));
    return result;
}

}  // namespace

TEST_CASE("triangles_cover_the_polygon") {
    const std::vector<std::vector<Vec2>> polygons{
        {{0, 0}, {1, 0}, {0, 1}},
        {{0, 0}, {2, 0}, {2, 1}, {0, 1}},
        {{0, 0}, {4, 0}, {1, 1}, {0, 4}},          // an arrow: one diagonal is outside
        {{0, 0}, {1, 1}, {4, 0}, {1, 4}},          // reflex corner second
        {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}},  // a corner on a side
        {{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},  // a U
        {{0, 3}, {1, 1}, {-2, 1}, {1, 0}, {0, -3}, {3, 0}, {5, 4}, {2, 1}},
    };
    for (const auto& polygon : polygons)
        for (const float scale : {1e-3f, 1.0f, 1e4f}) {
            check_cover(placed(polygon, scale));
            check_cover(placed({polygon.rbegin(), polygon.rend()}, scale));
        }
}

TEST_CASE("quads_are_cut_along_the_shorter_diagonal") {
    const auto cut = triangulate({{0, 0, 0}, {3, 0, 0}, {4, 1, 0}, {1, 1, 0}});
    // Corners 1 and 3 are nearer to each other than 0 and 2: both triangles have them.
    for (const auto& triangle : cut)
        for (const uint32_t corner : {1u, 3u})
            CHECK(std::count(triangle.begin(), triangle.end(), corner) == 1);
}

TEST_CASE("polygons_without_area_still_give_triangles") {
    CHECK(triangulate({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).size() == 3);
    CHECK(triangulate(std::vector<Vec3>(6, Vec3(1))).size() == 4);
    CHECK(triangulate({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).size() == 2);  // a bow tie
    CHECK(triangulate(std::vector<Vec3>(5, Vec3(NAN))).size() == 3);
    CHECK(triangulate({{0, 0, 0}, {1, 1, 0}}).empty());
}

TEST_CASE("smooth_normals_of_a_cube_are_its_diagonals") {
    // Cut into triangles, some corners have one, some two triangles of a side: weights by area or
    // by count would lean. No vertex is shared between sides, so positions must be merged.
    Mesh cube;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            const uint32_t first = uint32_t(cube.positions.size());
            for (const Vec2& p : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
                Vec3 position;
                position[axis] = side;
                position[(axis + 1) % 3] = p.x * side;
                position[(axis + 2) % 3] = p.y;
                cube.positions.push_back(position);
            }
            // Another diagonal on two sides, or the counts at each corner would agree.
            const uint32_t shift = axis == 0 ? 1 : 0;
            cube.triangles.emplace_back(first + shift, first + 1 + shift, first + 2 + shift);
            cube.triangles.emplace_back(first + shift, first + 2 + shift, first + (3 + shift) % 4);
        }
    for (const float scale : {1.0f, 1e-4f, 1e5f}) {
        Mesh scaled = cube;
        for (Vec3& p : scaled.positions) p *= scale;
        make_smooth_normals(scaled);
        for (std::size_t i = 0; i < cube.positions.size(); ++i)
            CHECK(glm::length(scaled.normals[i] - glm::normalize(cube.positions[i])) < 1e-5f);
    }
}

TEST_CASE("smooth_normals_are_zero_where_there_is_no_face") {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {2, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 4}};  // the second has no area
    make_smooth_normals(mesh);
    CHECK(mesh.normals[0] == Vec3(0, 0, 1));
    CHECK(mesh.normals[3] == Vec3(0));
    CHECK(mesh.normals[4] == Vec3(0));
}

TEST_CASE("probe_finds_the_nearest_hit_and_its_side") {
    Mesh mesh;
    mesh.positions = {{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}, {-1, -1, 1}, {0, 1, 1}, {1, -1, 1}};
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};  // the near one shows its front to the origin
    const auto hits = probe(mesh, Vec3(0), {{0, 0, 1}, {0, 0, -1}, {0, 0.7f, 1}, {0.9f, 0.7f, 1}});
    CHECK(hits[0].distance == doctest::Approx(1));
    CHECK(hits[0].front);
    CHECK(hits[0].normal == Vec3(0, 0, -1));
    CHECK(std::isinf(hits[1].distance));
    CHECK(hits[2].distance == doctest::Approx(1));
    CHECK(std::isinf(hits[3].distance));
    CHECK(probe(mesh, Vec3(0, 0, 3), {{0, 0, -1}})[0].front);
}

TEST_CASE("edit_distance_counts_edits") {
    CHECK(edit_distance("", "") == 0);
    CHECK(edit_distance("abc", "") == 3);
    CHECK(edit_distance("kitten", "sitting") == 3);
    CHECK(edit_distance("lihgt", "light") == 1);  // a swap is one slip
    CHECK(edit_distance("flaw", "lawn") == 2);
    CHECK(edit_distance(std::string(1 << 20, 'a'), std::string(1 << 20, 'b')) == 256);
}
