#include "host/render/flatten.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "host/base/parallel.hpp"
#include "host/render/lamp_clearance.hpp"
#include "host/render/lights.hpp"
#include "host/render/shining_rects.hpp"
#include "wedge/error.hpp"

namespace wedge::rendering {
namespace {

constexpr std::size_t kGrain = 1 << 14;  // vertices or triangles a task

shared::float4 to_float4(const Vec3& v, float w = 0) {
    return {v.x, v.y, v.z, w};
}

shared::SurfaceMaterial to_device(const Material& m) {
    shared::SurfaceMaterial out{};
    const bool shines = m.model != SpecularModel::none && m.specular != Vec3(0);
    out.diffuse = to_float4(m.diffuse);
    out.specular = shines ? to_float4(m.specular, m.exponent) : shared::float4{};
    out.diffuse_texture = m.diffuse_texture;
    out.specular_texture = m.specular_texture;
    out.emission_texture = m.emission_texture;
    out.bump_texture = m.bump_texture;
    out.normal_texture = m.bump_texture < 0 ? m.normal_texture : -1;
    out.model = !shines                           ? WEDGE_MODEL_LAMBERT
                : m.model == SpecularModel::phong ? WEDGE_MODEL_PHONG
                                                  : WEDGE_MODEL_BLINN_PHONG;
    return out;
}

shared::ShadingVertex make_vertex(const Vec3& p, const Vec3& n, const Vec2& uv) {
    return {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y};
}

void append_vertices(FlatScene& flat, const Mesh& mesh, const Mat4& transform) {
    const glm::mat3 normal_transform = glm::transpose(glm::inverse(glm::mat3(transform)));
    const std::size_t base = flat.positions.size(), count = mesh.positions.size();
    flat.positions.resize(base + count);
    flat.vertices.resize(base + count);
    parallel_ranges(count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3 p = Vec3(transform * Vec4(mesh.positions[i], 1));
            Vec3 n(0);
            if (!mesh.normals.empty()) {
                const Vec3 turned = normal_transform * mesh.normals[i];
                const float length = glm::length(turned);
                if (length > 0 && std::isfinite(length)) n = turned / length;
            }
            const Vec2 uv = mesh.uvs.empty() ? Vec2(0) : mesh.uvs[i];
            flat.positions[base + i] = p;
            flat.vertices[base + i] = make_vertex(p, n, uv);
        }
    });
}

void append_triangle(FlatScene& flat, const UVec3& t, uint32_t material, int light) {
    flat.triangles.push_back(t);
    flat.shading.push_back({t.x, t.y, t.z, material, light});
}

/// Lights of those triangles of an instance that make rectangles, in order.
using TriangleLights = std::vector<std::pair<std::size_t, int>>;

/// Makes lights of the shining ones among the last `count` triangles, in their order.
void add_mesh_lights(FlatScene& flat, const Scene& scene, std::size_t count,
                     const TriangleLights& rects, LightList& lights) {
    const std::size_t first = flat.triangles.size() - count;
    auto next_rect = rects.begin();
    for (std::size_t i = first; i < flat.triangles.size(); ++i) {
        const Material& m = scene.materials[flat.shading[i].material];
        if (m.emission == Vec3(0)) continue;
        if (next_rect != rects.end() && next_rect->first == i - first) {
            flat.shading[i].light = (next_rect++)->second;
            continue;
        }
        const UVec3 t = flat.triangles[i];
        flat.shading[i].light = lights.add_triangle(flat.positions[t.x], flat.positions[t.y],
                                                    flat.positions[t.z], m, uint32_t(i));
    }
}

void append_instance(FlatScene& flat, const Scene& scene, const Instance& instance,
                     const TriangleLights& rects, LightList& lights) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    const auto base = uint32_t(flat.positions.size());
    append_vertices(flat, mesh, instance.transform);
    // A mirrored instance would turn its triangles inside out.
    const bool mirrored = glm::determinant(glm::mat3(instance.transform)) < 0;
    const std::size_t first = flat.triangles.size(), count = mesh.triangles.size();
    flat.triangles.resize(first + count);
    flat.shading.resize(first + count);
    parallel_ranges(count, kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            UVec3 t = mesh.triangles[i] + base;
            if (mirrored) std::swap(t.y, t.z);
            const uint32_t material = instance.material
                                          ? *instance.material
                                          : (mesh.material_of.empty() ? 0u : mesh.material_of[i]);
            flat.triangles[first + i] = t;
            flat.shading[first + i] = {t.x, t.y, t.z, material, -1};
        }
    });
    const auto shines = [](const Material& m) { return m.emission != Vec3(0); };
    if (std::any_of(scene.materials.begin(), scene.materials.end(), shines))
        add_mesh_lights(flat, scene, count, rects, lights);
}

void append_rect(FlatScene& flat, const RectLight& rect, uint32_t material, int light) {
    const auto base = uint32_t(flat.positions.size());
    const Vec3 corner = rect.center - 0.5f * (rect.edge_u + rect.edge_v);
    for (const Vec3& p :
         {corner, corner + rect.edge_u, corner + rect.edge_u + rect.edge_v, corner + rect.edge_v}) {
        flat.positions.push_back(p);
        flat.vertices.push_back(make_vertex(p, Vec3(0), Vec2(0)));
    }
    append_triangle(flat, {base, base + 1, base + 2}, material, light);
    append_triangle(flat, {base, base + 2, base + 3}, material, light);
}

/// Also makes room for all, but for shining pairs of triangles that are moved.
void check_counts(const Scene& scene, FlatScene& flat) {
    // Two triangles; vertices of their own where they are moved.
    uint64_t vertices = 10 * scene.rect_lights.size(), triangles = 2 * scene.rect_lights.size();
    for (const Instance& instance : scene.instances) {
        vertices += scene.meshes[instance.mesh].positions.size();
        triangles += scene.meshes[instance.mesh].triangles.size();
    }
    constexpr uint64_t kLimit = 0x7fffffff;
    if (vertices > kLimit || triangles > kLimit)
        throw Error(
            ErrorKind::bad_input,
            fmt::format("the scene has {} triangles and {} vertices with all instances laid "
                        "out; at most {} of each can be indexed. Use fewer instances.",
                        triangles, vertices, kLimit));
    flat.positions.reserve(vertices);
    flat.vertices.reserve(vertices);
    flat.triangles.reserve(triangles);
    flat.shading.reserve(triangles);
}

}  // namespace

FlatScene flatten(const Scene& scene) {
    FlatScene flat;
    check_counts(scene, flat);
    LightList lights;
    for (const Material& m : scene.materials) flat.materials.push_back(to_device(m));
    // First and by power: the first rectangles are those whose shadows can be filtered.
    const std::vector<ShiningRect> shining = find_shining_rects(scene);
    std::vector<RectLight> rects = scene.rect_lights;
    for (const ShiningRect& rect : shining) rects.push_back(rect.light);
    std::vector<std::size_t> order(rects.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return light_power(rects[a]) > light_power(rects[b]);
    });
    std::vector<int> rect_lights(rects.size());
    for (std::size_t i : order) rect_lights[i] = lights.add_rect(rects[i]);

    std::vector<TriangleLights> triangle_lights(scene.instances.size());
    for (std::size_t i = 0; i < shining.size(); ++i)
        for (std::size_t k : {0, 1})
            triangle_lights[shining[i].instance].emplace_back(
                shining[i].triangle + k, rect_lights[scene.rect_lights.size() + i]);
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        append_instance(flat, scene, scene.instances[i], triangle_lights[i], lights);

    const auto black = uint32_t(flat.materials.size());
    flat.materials.push_back(to_device(Material{.diffuse = Vec3(0)}));
    for (std::size_t i = 0; i < scene.rect_lights.size(); ++i)
        append_rect(flat, rects[i], black, rect_lights[i]);
    for (const PointLight& point : scene.point_lights) lights.add_point(point);
    flat.lights = lights.take();
    clear_lamps(flat, scene.camera.position);
    return flat;
}

}  // namespace wedge::rendering
