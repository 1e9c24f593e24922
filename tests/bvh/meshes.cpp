#include "meshes.hpp"

namespace wedge::test {
namespace {

/// Two triangles a cell of a grid of (rows + 1) x (columns + 1) vertices, row by row.
void add_grid(Triangles& to, uint32_t first_vertex, uint32_t rows, uint32_t columns) {
    for (uint32_t r = 0; r < rows; ++r)
        for (uint32_t c = 0; c < columns; ++c) {
            const uint32_t a = first_vertex + r * (columns + 1) + c;
            const uint32_t b = a + columns + 1;
            to.indices.push_back({a, b, b + 1});
            to.indices.push_back({a, b + 1, a + 1});
        }
}

}  // namespace

void Triangles::add(const Vec3& v0, const Vec3& v1, const Vec3& v2) {
    const uint32_t first = uint32_t(positions.size());
    positions.insert(positions.end(), {v0, v1, v2});
    indices.push_back({first, first + 1, first + 2});
}

// Made from the engine's bits, because the standard distributions differ between libraries.
float uniform(Random& random, float lower, float upper) {
    return lower + (upper - lower) * (float(random() >> 8) * 0x1p-24f);
}

Vec3 uniform_in_box(Random& random, float half_side) {
    const float x = uniform(random, -half_side, half_side);
    const float y = uniform(random, -half_side, half_side);
    return {x, y, uniform(random, -half_side, half_side)};
}

Vec3 uniform_direction(Random& random) {
    for (;;) {
        const Vec3 v = uniform_in_box(random, 1);
        const float square = glm::dot(v, v);
        if (square > 0.01f && square <= 1) return v / std::sqrt(square);
    }
}

Triangles make_soup(int count, uint32_t seed) {
    Random random(seed);
    Triangles soup;
    for (int i = 0; i < count; ++i) {
        const float size = std::exp2(uniform(random, -7, 0));
        const Vec3 centre = uniform_in_box(random, 1);
        const Vec3 v0 = centre + uniform_in_box(random, size);
        const Vec3 v1 = centre + uniform_in_box(random, size);
        soup.add(v0, v1, centre + uniform_in_box(random, size));
    }
    return soup;
}

Triangles make_sphere(int rings, float bump) {
    Triangles sphere;
    const uint32_t columns = 2 * rings;
    // Both poles and the first and last column are the same vertices, so that the mesh is closed.
    const auto vertex = [&](int ring, uint32_t column) -> uint32_t {
        if (ring == 0) return 0;
        if (ring == rings) return 1;
        return 2 + (ring - 1) * columns + column % columns;
    };
    sphere.positions = {{0, 1, 0}, {0, -1, 0}};
    for (int ring = 1; ring < rings; ++ring)
        for (uint32_t column = 0; column < columns; ++column) {
            const float theta = kPi * ring / rings, phi = 2 * kPi * column / columns;
            const float radius = 1 + bump * std::sin(7 * theta) * std::cos(5 * phi);
            sphere.positions.push_back(radius * Vec3(std::sin(theta) * std::cos(phi),
                                                     std::cos(theta),
                                                     std::sin(theta) * std::sin(phi)));
        }
    for (int ring = 0; ring < rings; ++ring)
        for (uint32_t column = 0; column < columns; ++column) {
            const uint32_t a = vertex(ring, column), b = vertex(ring, column + 1);
            const uint32_t c = vertex(ring + 1, column + 1), d = vertex(ring + 1, column);
            if (ring > 0) sphere.indices.push_back({a, b, c});
            if (ring + 1 < rings) sphere.indices.push_back({a, c, d});
        }
    return sphere;
}

Triangles make_cube(int n) {
    Triangles cube;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = -1; side <= 1; side += 2) {
            const uint32_t first = uint32_t(cube.positions.size());
            for (int row = 0; row <= n; ++row)
                for (int column = 0; column <= n; ++column) {
                    Vec3 p;
                    p[axis] = float(side);
                    p[(axis + 1) % 3] = 2.0f * row / n - 1;
                    p[(axis + 2) % 3] = 2.0f * column / n - 1;
                    cube.positions.push_back(p);
                }
            add_grid(cube, first, n, n);
        }
    return cube;
}

Triangles make_terrain(int n, float height) {
    Triangles terrain;
    for (int row = 0; row <= n; ++row)
        for (int column = 0; column <= n; ++column) {
            const float x = 2.0f * column / n - 1, z = 2.0f * row / n - 1;
            terrain.positions.push_back({x, height * std::sin(9 * x) * std::cos(7 * z + x), z});
        }
    add_grid(terrain, 0, n, n);
    return terrain;
}

Triangles make_slivers(int count, uint32_t seed) {
    Random random(seed);
    Triangles slivers;
    for (int i = 0; i < count; ++i) {
        const Vec3 along = uniform_direction(random);
        const Vec3 across = uniform_direction(random) * std::pow(10.0f, uniform(random, -6, -3));
        const Vec3 start = uniform_in_box(random, 0.05f) - along;
        slivers.add(start, start + 2.0f * along, start + along + across);
    }
    return slivers;
}

Triangles transformed(Triangles triangles, float scale, const Vec3& shift) {
    for (Vec3& p : triangles.positions) p = p * scale + shift;
    return triangles;
}

}  // namespace wedge::test
