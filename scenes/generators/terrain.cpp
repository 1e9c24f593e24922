// terrain: a fractal height field, for large triangle counts: fractional Brownian motion of
// gradient noise (Perlin 2002, "Improving noise": quintic interpolation). resolution = 1582
// gives 5.0 M triangles, 2237 gives 10.0 M.
//
// 2 resolution^2 triangles, open. Smooth, with texture coordinates in [0, 1]. Material:
// terrain/ground.
#include <cmath>

#include "scenes/generators/kind.hpp"
#include "scenes/generators/random.hpp"

namespace wedge::scenes {
namespace {

/// Dot product of the lattice point's gradient (one of eight directions) with the offset from it.
float corner(uint32_t seed, int x, int y, float dx, float dy) {
    constexpr float kDiagonal = 0.70710678f;
    const uint32_t h = hash(seed, uint32_t(x), uint32_t(y)) >> 29;
    const float a = h & 1 ? -dx : dx, b = h & 2 ? -dy : dy;
    if (h & 4) return kDiagonal * (a + b);
    return h & 1 ? b : a;
}

float quintic(float t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

float gradient_noise(uint32_t seed, float x, float y) {
    const float fx = std::floor(x), fy = std::floor(y);
    const int ix = int(fx), iy = int(fy);
    const float dx = x - fx, dy = y - fy, u = quintic(dx), v = quintic(dy);
    const float near =
        glm::mix(corner(seed, ix, iy, dx, dy), corner(seed, ix + 1, iy, dx - 1, dy), u);
    const float far = glm::mix(corner(seed, ix, iy + 1, dx, dy - 1),
                               corner(seed, ix + 1, iy + 1, dx - 1, dy - 1), u);
    return glm::mix(near, far, v);
}

struct Field {
    uint32_t seed;
    int octaves;
    float roughness;  ///< amplitude of an octave over that of the one before
    float hills;      ///< across the side, in the first octave

    /// About [-1, 1]; `x`, `y` in [0, 1] over the field.
    float operator()(float x, float y) const {
        float sum = 0, amplitude = 1, frequency = hills;
        for (int octave = 0; octave < octaves; ++octave) {
            sum += amplitude *
                   gradient_noise(hash(seed, uint32_t(octave)), x * frequency, y * frequency);
            amplitude *= roughness;
            frequency *= 2;
        }
        return sum;
    }
};

void build(const Values& values, MeshBuilder& builder) {
    const int n = values.integer("resolution");
    const float side = values.real("side"), height = values.real("height");
    const Field field{values.seed(), values.integer("octaves"), values.real("roughness"),
                      values.real("hills")};
    // One sample more on every side, for the slopes at the border.
    const int stride = n + 3;
    std::vector<float> heights(std::size_t(stride) * stride);
    for (int j = 0; j < stride; ++j)
        for (int i = 0; i < stride; ++i)
            heights[std::size_t(j) * stride + i] =
                height * field(float(i - 1) / float(n), float(j - 1) / float(n));

    Mesh& mesh = builder.mesh();
    const std::size_t vertices = std::size_t(n + 1) * (n + 1);
    mesh.positions.reserve(vertices);
    mesh.normals.reserve(vertices);
    mesh.uvs.reserve(vertices);
    const float step = side / float(n);
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const float* h = &heights[std::size_t(j + 1) * stride + i + 1];
            const Vec3 normal(h[-1] - h[1], 2 * step, h[-stride] - h[stride]);
            const Vec2 uv(float(i) / float(n), float(j) / float(n));
            builder.vertex({side * (uv.x - 0.5f), *h, side * (uv.y - 0.5f)}, glm::normalize(normal),
                           {uv.x, 1 - uv.y});
        }

    const uint32_t ground = builder.material("terrain/ground", {0.45f, 0.42f, 0.36f});
    mesh.triangles.reserve(2 * std::size_t(n) * n);
    mesh.material_of.reserve(2 * std::size_t(n) * n);
    const auto at = [&](int j, int i) { return uint32_t(j) * uint32_t(n + 1) + uint32_t(i); };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            builder.quad(at(j, i), at(j + 1, i), at(j + 1, i + 1), at(j, i + 1), ground);
}

}  // namespace

Kind terrain_kind() {
    return {"terrain",
            Shading::smooth,
            {{"resolution", 256, 1, 8000, "cells along a side", kInteger},
             {"side", 10, kShortest, kLongest, "of the square it covers, world units"},
             {"height", 1.5, 0, kLongest, "of the largest hills, world units"},
             {"hills", 4, 0.1, 1000, "hills along a side"},
             {"octaves", 9, 1, 16, "sizes of detail, each half the one before", kInteger},
             {"roughness", 0.5, 0, 1, "height of a detail over that of the next larger one"},
             {"seed", 1, 0, kLargestSeed, "another seed, another scene", kInteger}},
            build};
}

}  // namespace wedge::scenes
