// cornell: the Cornell box as it was measured: coordinates in millimetres as published by the
// Cornell Program of Computer Graphics (www.graphics.cornell.edu/online/box/data.html), walls not
// quite square included. Camera there: (278, 273, -800), looking along +z, 39.3 degrees. One thing
// differs: the ceiling has a hole where the light is, because the light of the data lies in the
// ceiling's own plane. Set a light into it: x 213 to 343, z 227 to 332, at y = 548.8.
//
// Reflectances: linear RGB of the measured spectra as given with the box by McGuire, Computer
// Graphics Archive 2017 (originally by Cardenas and McGuire, 2011).
//
// 36 triangles: 16 of the walls, 20 of the blocks. No parameters. Flat. Blocks without bottoms,
// front of the box open. Materials: cornell/white, cornell/red, cornell/green, cornell/short,
// cornell/tall.
#include "scenes/generators/kind.hpp"

namespace wedge::scenes {
namespace {

constexpr float kCeiling_mm = 548.8f;
constexpr float kDepth_mm = 559.2f;

void add_ceiling(MeshBuilder& builder, uint32_t white) {
    const float y = kCeiling_mm;
    const Vec3 outer[] = {{556, y, 0}, {556, y, kDepth_mm}, {0, y, kDepth_mm}, {0, y, 0}};
    const Vec3 inner[] = {{343, y, 227}, {343, y, 332}, {213, y, 332}, {213, y, 227}};
    uint32_t o[4], i[4];
    for (int k = 0; k < 4; ++k) o[k] = builder.vertex(outer[k], Vec3(0));
    for (int k = 0; k < 4; ++k) i[k] = builder.vertex(inner[k], Vec3(0));
    for (int k = 0; k < 4; ++k) {
        const int next = (k + 1) % 4;
        builder.quad(o[k], o[next], i[next], i[k], white);
    }
}

/// Four corners of the top, counter-clockwise seen from above.
void add_block(MeshBuilder& builder, const Vec2 (&xz)[4], float height_mm, uint32_t material) {
    uint32_t low[4], high[4];
    for (int k = 0; k < 4; ++k) low[k] = builder.vertex({xz[k].x, 0, xz[k].y}, Vec3(0));
    for (int k = 0; k < 4; ++k) high[k] = builder.vertex({xz[k].x, height_mm, xz[k].y}, Vec3(0));
    builder.quad(high[0], high[1], high[2], high[3], material);
    for (int k = 0; k < 4; ++k) {
        const int next = (k + 1) % 4;
        builder.quad(low[k], low[next], high[next], high[k], material);
    }
}

void build(const Values&, MeshBuilder& builder) {
    const Vec3 white_rgb(0.725f, 0.71f, 0.68f);
    const uint32_t white = builder.material("cornell/white", white_rgb);
    const uint32_t red = builder.material("cornell/red", {0.63f, 0.065f, 0.05f});
    const uint32_t green = builder.material("cornell/green", {0.14f, 0.45f, 0.091f});
    const float y = kCeiling_mm, z = kDepth_mm;

    builder.face({552.8f, 0, 0}, {0, 0, 0}, {0, 0, z}, {549.6f, 0, z}, white);
    add_ceiling(builder, white);
    builder.face({549.6f, 0, z}, {0, 0, z}, {0, y, z}, {556, y, z}, white);
    builder.face({0, 0, z}, {0, 0, 0}, {0, y, 0}, {0, y, z}, green);
    builder.face({552.8f, 0, 0}, {549.6f, 0, z}, {556, y, z}, {556, y, 0}, red);

    add_block(builder, {{130, 65}, {82, 225}, {240, 272}, {290, 114}}, 165,
              builder.material("cornell/short", white_rgb));
    add_block(builder, {{423, 247}, {265, 296}, {314, 456}, {472, 406}}, 330,
              builder.material("cornell/tall", white_rgb));
}

}  // namespace

Kind cornell_kind() {
    return {"cornell", Shading::flat, {}, build};
}

}  // namespace wedge::scenes
