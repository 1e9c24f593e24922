#include "test_scenes.hpp"

#include <cmath>

namespace wedge::test {

Mesh make_quad(const Vec3& corner, const Vec3& u, const Vec3& v, uint32_t material) {
    Mesh mesh;
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material_of = {material, material};
    return mesh;
}

Mesh make_sphere(const Vec3& center, float radius, int rings, bool inwards, uint32_t material) {
    Mesh mesh;
    const int sectors = 2 * rings;
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            // Poles are rows of equal points; their degenerate triangles are left out below.
            const double theta = double(kPi) * i / rings, phi = 2 * double(kPi) * j / sectors;
            const double s = i == 0 || i == rings ? 0 : std::sin(theta);
            mesh.positions.push_back(
                center + radius * Vec3(s * std::cos(phi), std::cos(theta), s * std::sin(phi)));
        }
    const auto index = [&](int i, int j) { return uint32_t(i * sectors + j % sectors); };
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
        mesh.triangles.push_back(inwards ? UVec3(a, c, b) : UVec3(a, b, c));
        mesh.material_of.push_back(material);
    };
    for (int i = 0; i < rings; ++i)
        for (int j = 0; j < sectors; ++j) {
            if (i > 0) add(index(i, j), index(i, j + 1), index(i + 1, j));
            if (i + 1 < rings) add(index(i, j + 1), index(i + 1, j + 1), index(i + 1, j));
        }
    return mesh;
}

Mesh make_box(const Vec3& lower, const Vec3& upper, bool inwards, uint32_t material) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(
            {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
    const uint32_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& f : faces) {
        for (UVec3 t : {UVec3(f[0], f[1], f[2]), UVec3(f[0], f[2], f[3])}) {
            if (inwards) std::swap(t.y, t.z);
            mesh.triangles.push_back(t);
            mesh.material_of.push_back(material);
        }
    }
    return mesh;
}

Scene make_scene(std::vector<Mesh> meshes, std::vector<Material> materials) {
    Scene scene;
    scene.name = "test";
    scene.meshes = std::move(meshes);
    scene.materials = std::move(materials);
    for (uint32_t i = 0; i < scene.meshes.size(); ++i) scene.instances.push_back({.mesh = i});
    scene.film = {16, 16};
    return scene;
}

Material lambert(float albedo) {
    return {.name = "lambert", .diffuse = Vec3(albedo)};
}

Scene make_room(float gloss) {
    Material red = lambert(0.6f), shiny = lambert(0.3f);
    red.diffuse = {0.7f, 0.2f, 0.1f};
    if (gloss > 0) {
        shiny.specular = Vec3(0.5f);
        shiny.exponent = gloss;
        shiny.model = SpecularModel::blinn_phong;
    }
    Scene scene = make_scene(
        {make_box(Vec3(-1), Vec3(1), true, 0), make_sphere({-0.4f, -0.6f, 0}, 0.4f, 12, false, 2),
         make_box({0.2f, -1, -0.5f}, {0.7f, 0.1f, 0.1f}, false, 1)},
        {lambert(0.7f), red, shiny});
    scene.rect_lights.push_back({.center = {0, 0.98f, 0},
                                 .edge_u = {0.6f, 0, 0},
                                 .edge_v = {0, 0, 0.6f},
                                 .radiance = {10, 9, 7}});
    scene.camera = {.position = {0, 0, 0.95f}, .target = {0, -0.2f, -1}, .vertical_fov_rad = 1.4f};
    return scene;
}

RenderOptions quick(int samples, int bounces, Sampler sampler, uint32_t seed) {
    RenderOptions options;
    options.samples_per_pixel = samples;
    options.bounces = bounces;
    options.sampler = sampler;
    options.seed = seed;
    return options;
}

std::vector<double> channel_values(const Image& image, const char* channel) {
    const int c = image.channel(channel);
    std::vector<double> values;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) values.push_back(image.at(x, y, c));
    return values;
}

double channel_mean(const Image& image, const char* channel) {
    double sum = 0;
    const std::vector<double> values = channel_values(image, channel);
    for (double v : values) sum += v;
    return sum / double(values.size());
}

}  // namespace wedge::test
