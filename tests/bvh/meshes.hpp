// Triangle sets that the tests make up.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "wedge/math.hpp"

namespace wedge::test {

struct Triangles {
    std::vector<Vec3> positions;
    std::vector<UVec3> indices;

    void add(const Vec3& v0, const Vec3& v1, const Vec3& v2);
};

using Random = std::mt19937;

float uniform(Random& random, float lower, float upper);
Vec3 uniform_in_box(Random& random, float half_side);
Vec3 uniform_direction(Random& random);

/// Unrelated triangles of all sizes in the box [-1, 1]^3.
Triangles make_soup(int count, uint32_t seed);

/// Closed sphere of radius 1 whose radius varies by `bump`; quads of latitude and longitude, shared
/// vertices.
Triangles make_sphere(int rings, float bump);

/// Closed cube [-1, 1]^3, each face a grid of n x n quads: edges and vertices on the axes' planes.
Triangles make_cube(int n);

/// Height field over [-1, 1]^2.
Triangles make_terrain(int n, float height);

/// Triangles a thousand to a million times longer than wide, about a common point.
Triangles make_slivers(int count, uint32_t seed);

/// p * scale + shift, in float.
Triangles transformed(Triangles triangles, float scale, const Vec3& shift);

}  // namespace wedge::test
