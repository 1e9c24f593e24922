// box, plane, sphere: one solid each, centred on the origin.
#include "scenes/generators/kind.hpp"

namespace wedge::scenes {
namespace {

const Vec3 kGrey(0.6f);

void build_box(const Values& values, MeshBuilder& builder) {
    const Vec3 edges(values.real("width"), values.real("height"), values.real("depth"));
    add_box(builder, Vec3(0), 0.5f * edges, 0, builder.material("box/surface", kGrey));
}

void build_plane(const Values& values, MeshBuilder& builder) {
    const float x = values.real("width") / 2, z = values.real("depth") / 2;
    const float tiles = values.real("uv_tiles");
    const uint32_t material = builder.material("plane/surface", kGrey);
    const Vec3 up(0, 1, 0);
    const uint32_t a = builder.vertex({-x, 0, -z}, up, {0, tiles});
    const uint32_t b = builder.vertex({-x, 0, z}, up, {0, 0});
    const uint32_t c = builder.vertex({x, 0, z}, up, {tiles, 0});
    const uint32_t d = builder.vertex({x, 0, -z}, up, {tiles, tiles});
    builder.quad(a, b, c, d, material);
}

void build_sphere(const Values& values, MeshBuilder& builder) {
    add_sphere(builder, Vec3(0), values.real("radius"), values.integer("detail"),
               values.real("bumps"), builder.material("sphere/surface", kGrey));
}

}  // namespace

/// Closed, flat, 12 triangles. Material: box/surface.
Kind box_kind() {
    return {"box",
            Shading::flat,
            {{"width", 1, kShortest, kLongest, "extent along x, world units"},
             {"height", 1, kShortest, kLongest, "extent along y, world units"},
             {"depth", 1, kShortest, kLongest, "extent along z, world units"}},
            build_box};
}

/// In the plane y = 0, facing up; flat, 2 triangles, with texture coordinates. Material:
/// plane/surface.
Kind plane_kind() {
    return {"plane",
            Shading::flat,
            {{"width", 10, kShortest, kLongest, "extent along x, world units"},
             {"depth", 10, kShortest, kLongest, "extent along z, world units"},
             {"uv_tiles", 1, kShortest, kLongest, "times a texture repeats in each direction"}},
            build_plane};
}

/// Closed, smooth, 4 detail (detail - 1) triangles. Material: sphere/surface.
Kind sphere_kind() {
    return {"sphere",
            Shading::smooth,
            {{"radius", 1, kShortest, kLongest, "world units"},
             {"detail", 32, 2, 2000, "bands from pole to pole", kInteger},
             {"bumps", 0, 0, 0.3, "height of the bumps as a fraction of the radius"}},
            build_sphere};
}

}  // namespace wedge::scenes
