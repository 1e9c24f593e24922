// Generated geometry: sound meshes, of the documented sizes, the same every time.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <set>
#include <string>

#include "scenes/generators/generators.hpp"
#include "wedge/error.hpp"

using namespace wedge;
using Parameters = std::map<std::string, double>;

namespace {

struct Generated {
    Mesh mesh;
    std::vector<Material> materials;
};

Generated make(const std::string& kind, const Parameters& parameters = {}) {
    Generated result;
    result.mesh = scenes::generate(kind, parameters, result.materials);
    return result;
}

/// Smaller than the defaults, but with every part of the geometry.
Parameters small(const std::string& kind) {
    if (kind == "room") return {{"count", 20}, {"detail", 8}, {"boxes", 5}};
    if (kind == "terrain") return {{"resolution", 20}};
    if (kind == "tentacles") return {{"count", 5}, {"segments", 20}, {"ground_detail", 10}};
    if (kind == "spheres") return {{"count", 10}, {"detail", 10}, {"bumps", 0.1}};
    return {};
}

/// Vertices of equal position are one: closed solids may have two normals at an edge.
std::vector<UVec3> welded_triangles(const Mesh& mesh) {
    std::map<std::array<float, 3>, uint32_t> index_of;
    const auto weld = [&](uint32_t vertex) {
        const Vec3& p = mesh.positions[vertex];
        return index_of.emplace(std::array{p.x, p.y, p.z}, vertex).first->second;
    };
    std::vector<UVec3> result;
    for (const UVec3& t : mesh.triangles) result.push_back({weld(t.x), weld(t.y), weld(t.z)});
    return result;
}

/// Directed edges without exactly one partner in the other direction.
std::size_t open_edge_count(const Mesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, int> uses;
    for (const UVec3& t : welded_triangles(mesh))
        for (int k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
    std::size_t open = 0;
    for (const auto& [edge, count] : uses) {
        const auto partner = uses.find({edge.second, edge.first});
        open += count != 1 || partner == uses.end();
    }
    return open;
}

/// Of the closed surface, by the divergence theorem; positive where faces look outwards.
double signed_volume(const Mesh& mesh) {
    double volume = 0;
    for (const UVec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        volume += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return volume;
}

/// The triangles of materials whose names start so.
Mesh part(const Generated& whole, const std::string& prefix) {
    Mesh result = whole.mesh;
    result.triangles.clear();
    for (std::size_t i = 0; i < whole.mesh.triangles.size(); ++i)
        if (whole.materials[whole.mesh.material_of[i]].name.starts_with(prefix))
            result.triangles.push_back(whole.mesh.triangles[i]);
    return result;
}

template <typename T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same_bits(const Mesh& a, const Mesh& b) {
    return same_bits(a.positions, b.positions) && same_bits(a.normals, b.normals) &&
           same_bits(a.uvs, b.uvs) && same_bits(a.triangles, b.triangles) &&
           same_bits(a.material_of, b.material_of);
}

std::string message_of(const std::string& kind, const Parameters& parameters) {
    try {
        make(kind, parameters);
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::bad_input);
        return error.what();
    }
    return "no error";
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("generated_meshes_are_consistent") {
    for (const auto& kind : scenes::generator_kinds()) {
        CAPTURE(kind);
        const auto [mesh, materials] = make(kind, small(kind));
        const std::size_t vertices = mesh.positions.size();
        CHECK(!mesh.triangles.empty());
        CHECK(mesh.material_of.size() == mesh.triangles.size());
        CHECK((mesh.normals.empty() || mesh.normals.size() == vertices));
        CHECK((mesh.uvs.empty() || mesh.uvs.size() == vertices));

        std::vector<bool> used(vertices, false), material_used(materials.size(), false);
        std::size_t bad_index = 0, bad_normal = 0, without_area = 0, against_normal = 0;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const UVec3 t = mesh.triangles[i];
            if (t.x >= vertices || t.y >= vertices || t.z >= vertices ||
                mesh.material_of[i] >= materials.size()) {
                ++bad_index;
                continue;
            }
            material_used[mesh.material_of[i]] = true;
            const Vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
            const Vec3 area = glm::cross(b - a, c - a);
            without_area += !(glm::length(area) > 0);
            for (int k = 0; k < 3; ++k) {
                used[t[k]] = true;
                if (!mesh.normals.empty())
                    against_normal += !(glm::dot(area, mesh.normals[t[k]]) > 0);
            }
        }
        for (const Vec3& n : mesh.normals) bad_normal += !(std::abs(glm::length(n) - 1) < 1e-5f);
        CHECK(bad_index == 0);
        CHECK(bad_normal == 0);
        CHECK(without_area == 0);
        CHECK(against_normal == 0);
        CHECK(std::count(used.begin(), used.end(), false) == 0);
        CHECK(std::count(material_used.begin(), material_used.end(), false) <=
              (materials.size() > 5 ? 4 : 0));  // a small scene need not use the whole palette

        std::set<std::string> names;
        for (const Material& material : materials) {
            CHECK(material.name.starts_with(kind + "/"));
            CHECK(glm::all(glm::lessThanEqual(material.diffuse + material.specular, Vec3(1))));
            names.insert(material.name);
        }
        CHECK(names.size() == materials.size());
    }
}

TEST_CASE("generated_solids_are_closed_and_face_outwards") {
    // Open edges are those round the ground alone: four sides, of one edge or of `ground_detail`.
    const std::map<std::string, std::size_t> open_edges = {
        {"box", 0},     {"sphere", 0}, {"room", 0},     {"plane", 4},      {"grids", 4},
        {"spheres", 4}, {"wires", 4},  {"terrain", 80}, {"tentacles", 40},
    };
    for (const auto& [kind, expected] : open_edges) {
        CAPTURE(kind);
        CHECK(open_edge_count(make(kind, small(kind)).mesh) == expected);
    }
    for (const auto* prefix :
         {"grids/bars", "spheres/0", "spheres/4", "wires/wire", "tentacles/skin", "box/surface",
          "sphere/surface", "room/0", "room/1"}) {
        CAPTURE(prefix);
        const std::string kind(prefix, std::strchr(prefix, '/'));
        const Mesh solids = part(make(kind, small(kind)), prefix);
        CHECK(open_edge_count(solids) == 0);
        CHECK(signed_volume(solids) > 0);
    }
}

TEST_CASE("volumes_agree_with_closed_forms") {
    CHECK(signed_volume(make("box", {{"width", 2}, {"height", 3}, {"depth", 4}}).mesh) ==
          doctest::Approx(24));
    CHECK(signed_volume(make("sphere", {{"radius", 2}, {"detail", 200}}).mesh) ==
          doctest::Approx(4.0 / 3 * double(kPi) * 8).epsilon(1e-3));
    // A prism over a regular octagon: area 8/2 r^2 sin(45 degrees).
    const Generated wire =
        make("wires", {{"count", 1}, {"sides", 8}, {"radius", 0.1}, {"length", 4}});
    CHECK(signed_volume(part(wire, "wires/wire")) ==
          doctest::Approx(4 * 4 * 0.01 * std::sqrt(0.5)).epsilon(1e-3));
    // One lattice is a square plate less its holes.
    const Generated grid = make("grids", {{"layers", 1}, {"bars", 4}, {"fill", 0.25}, {"side", 4}});
    const double bar = 0.25, hole = (4 - 4 * bar) / 3;
    CHECK(signed_volume(part(grid, "grids/bars")) ==
          doctest::Approx(0.04 * (16 - 9 * hole * hole)).epsilon(1e-4));
}

TEST_CASE("triangle_counts_are_as_documented") {
    const auto count = [](const std::string& kind, const Parameters& parameters = {}) {
        return make(kind, parameters).mesh.triangles.size();
    };
    CHECK(count("box") == 12);
    CHECK(count("plane") == 2);
    CHECK(count("cornell") == 36);
    CHECK(count("sphere", {{"detail", 10}}) == 4 * 10 * 9);
    CHECK(count("grids", {{"bars", 2}}) == 194);
    CHECK(count("spheres") == 72866);
    CHECK(count("tentacles") == 146048);
    CHECK(count("wires") == 2 + 60 * 4 * 8);
    CHECK(count("room") == 608492);
    CHECK(count("room", {{"count", 421}, {"boxes", 0}}) == 639932);
    CHECK(count("terrain", {{"resolution", 1582}}) == 2 * 1582 * 1582);
}

TEST_CASE("the_same_seed_gives_the_same_bits_and_another_seed_does_not") {
    for (const auto& kind : scenes::generator_kinds()) {
        CAPTURE(kind);
        CHECK(same_bits(make(kind, small(kind)).mesh, make(kind, small(kind)).mesh));
    }
    for (const auto* kind : {"room", "spheres", "tentacles", "terrain", "wires"}) {
        CAPTURE(kind);
        Parameters other = small(kind);
        other["seed"] = 2;
        CHECK(!same_bits(make(kind, small(kind)).mesh, make(kind, other).mesh));
    }
}

TEST_CASE("smooth_normals_are_those_of_the_surface") {
    // Against finite differences of the finely tessellated surface: the mean of the adjoining
    // faces, weighted by area, tends to the true normal.
    for (const auto& [kind, parameters] :
         std::map<std::string, Parameters>{{"sphere", {{"detail", 150}, {"bumps", 0.1}}},
                                           {"terrain", {{"resolution", 300}, {"octaves", 3}}}}) {
        CAPTURE(kind);
        const Mesh mesh = make(kind, parameters).mesh;
        std::vector<Vec3> sums(mesh.positions.size(), Vec3(0));
        std::vector<int> faces(mesh.positions.size(), 0);
        for (const UVec3& t : mesh.triangles) {
            const Vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
            for (int k = 0; k < 3; ++k) {
                sums[t[k]] += glm::cross(b - a, c - a);
                ++faces[t[k]];
            }
        }
        float smallest_cosine = 1;
        for (std::size_t i = 0; i < sums.size(); ++i)
            if (faces[i] == 6)
                smallest_cosine =
                    std::min(smallest_cosine, glm::dot(glm::normalize(sums[i]), mesh.normals[i]));
        CHECK(smallest_cosine > std::cos(0.02f));
    }
}

TEST_CASE("spheres_do_not_touch_each_other_or_the_plane") {
    const int count = 40, detail = 6, vertices = 2 + (detail - 1) * 2 * detail;
    const Mesh mesh = make("spheres", {{"count", count}, {"detail", detail}}).mesh;
    std::vector<std::pair<Vec3, float>> spheres;
    for (int i = 0; i < count; ++i) {
        const std::size_t north = 4 + std::size_t(i) * vertices;
        const Vec3 top = mesh.positions[north], bottom = mesh.positions[north + vertices - 1];
        spheres.push_back({0.5f * (top + bottom), 0.5f * (top.y - bottom.y)});
        CHECK(bottom.y >= 0);
    }
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < i; ++j)
            CHECK(glm::distance(spheres[i].first, spheres[j].first) >
                  (spheres[i].second + spheres[j].second) * 0.9999f);
}

TEST_CASE("scale_of_the_parameters_is_the_scale_of_the_mesh") {
    for (const double scale : {1e-4, 1e5}) {
        const Mesh unit = make("grids", {{"bars", 3}}).mesh;
        const Mesh scaled = make("grids", {{"bars", 3},
                                           {"side", 4 * scale},
                                           {"thickness", 0.04 * scale},
                                           {"height", 0.5 * scale},
                                           {"spacing", 0.6 * scale},
                                           {"ground", 14 * scale}})
                                .mesh;
        REQUIRE(unit.positions.size() == scaled.positions.size());
        float largest = 0;
        for (std::size_t i = 0; i < unit.positions.size(); ++i)
            largest = std::max(
                largest, glm::distance(unit.positions[i], scaled.positions[i] / float(scale)));
        CHECK(largest < 1e-5f);
    }
}

TEST_CASE("materials_of_the_same_name_are_used_again") {
    std::vector<Material> materials(1);
    materials[0].name = "sphere/surface";
    materials[0].diffuse = Vec3(0.1f);
    const Mesh mesh = scenes::generate("sphere", {}, materials);
    CHECK(materials.size() == 1);
    CHECK(materials[0].diffuse == Vec3(0.1f));
    CHECK(mesh.material_of.front() == 0);
}

TEST_CASE("cornell_box_has_the_published_corners") {
    const Mesh mesh = make("cornell").mesh;
    const auto has_corner = [&](const Vec3& p) {
        return std::find(mesh.positions.begin(), mesh.positions.end(), p) != mesh.positions.end();
    };
    CHECK(has_corner({552.8f, 0, 0}));
    CHECK(has_corner({549.6f, 0, 559.2f}));
    CHECK(has_corner({556, 548.8f, 559.2f}));
    CHECK(has_corner({213, 548.8f, 332}));
    CHECK(has_corner({290, 165, 114}));
    CHECK(has_corner({472, 330, 406}));
    // Nothing is behind the light, and what is open is the front, that hole and the blocks'
    // bottoms.
    CHECK(mesh.triangles.size() == 36);
}

TEST_CASE("wrong_parameters_name_what_is_known") {
    CHECK(has(message_of("sphear", {}), "sphear"));
    CHECK(has(message_of("sphear", {}), "sphere, spheres, tentacles"));
    CHECK(has(message_of("box", {{"hight", 1}}), "hight"));
    CHECK(has(message_of("box", {{"hight", 1}}), "width, height, depth"));
    CHECK(has(message_of("box", {{"height", 0}}), "height"));
    CHECK(has(message_of("sphere", {{"detail", 2.5}}), "whole number"));
    CHECK(has(message_of("sphere", {{"detail", 1}}), "[2, 2000]"));
    CHECK(has(message_of("sphere", {{"radius", std::nan("")}}), "radius"));
    CHECK(message_of("cornell", {}) == "no error");
}
