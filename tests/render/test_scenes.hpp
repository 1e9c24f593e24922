// Small scenes built in memory, with answers that are known.
#pragma once

#include <vector>

#include "wedge/render.hpp"
#include "wedge/scene.hpp"

namespace wedge::test {

/// Quadrilateral corner, corner + u, corner + u + v, corner + v; front on the side of cross(u, v).
Mesh make_quad(const Vec3& corner, const Vec3& u, const Vec3& v, uint32_t material);

/// Unit-radius sphere scaled and moved; normals (and front) outwards, or inwards.
Mesh make_sphere(const Vec3& center, float radius, int rings, bool inwards, uint32_t material);

/// Axis-parallel box; front outwards, or inwards.
Mesh make_box(const Vec3& lower, const Vec3& upper, bool inwards, uint32_t material);

/// Every mesh placed once, materials as given.
Scene make_scene(std::vector<Mesh> meshes, std::vector<Material> materials);

Material lambert(float albedo);

/// A 2 x 2 x 2 room, a light at its ceiling, two objects; `gloss` > 0 makes one of them shine.
Scene make_room(float gloss);

RenderOptions quick(int samples, int bounces, Sampler sampler = Sampler::sobol, uint32_t seed = 0);

/// One channel of an image, in doubles.
std::vector<double> channel_values(const Image& image, const char* channel);
double channel_mean(const Image& image, const char* channel);

}  // namespace wedge::test
