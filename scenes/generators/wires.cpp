// wires: straight thin cylinders in random directions over a plane. Far thinner than a pixel if
// wanted: what few probe rays miss, and slivers for the acceleration structure.
//
// 2 + count * 4 sides triangles. Wires closed, plane open. Smooth. Materials: wires/plane,
// wires/wire.
#include <cmath>

#include "scenes/generators/kind.hpp"
#include "scenes/generators/random.hpp"

namespace wedge::scenes {
namespace {

void build(const Values& values, MeshBuilder& builder) {
    add_ground(builder, values.real("ground"), 0, builder.material("wires/plane", Vec3(0.75f)));
    const uint32_t wire = builder.material("wires/wire", {0.3f, 0.3f, 0.32f});
    const float side = values.real("side"), height = values.real("height");
    const float length = values.real("length"), radius = values.real("radius");
    for (int i = 0; i < values.integer("count"); ++i) {
        Random random(values.seed(), uint32_t(i));
        const float azimuth = random.uniform(0, 2 * kPi);
        const Vec3 middle =
            random.uniform({-side / 2, height, -side / 2}, {side / 2, 2 * height, side / 2});
        // Slanted so little that no end reaches down to the plane.
        const float rise = std::min(1.0f, height / length) * random.uniform(-1, 1);
        const float run = std::sqrt(1 - rise * rise);
        const Vec3 half =
            0.5f * length * Vec3(run * std::cos(azimuth), rise, run * std::sin(azimuth));
        add_tube(builder, {middle - half, middle + half}, {radius, radius}, values.integer("sides"),
                 wire);
    }
}

}  // namespace

Kind wires_kind() {
    return {"wires",
            Shading::smooth,
            {{"count", 60, 1, 1000000, "wires", kInteger},
             {"sides", 8, 3, 200, "around a wire", kInteger},
             {"length", 4, kShortest, kLongest, "of a wire, world units"},
             {"radius", 0.01, kShortest, kLongest, "of a wire, world units"},
             {"side", 3, kShortest, kLongest, "of the square above which they lie, world units"},
             {"height", 1, kShortest, kLongest, "they lie from this to twice this, world units"},
             {"ground", 14, kShortest, kLongest, "side of the plane, world units"},
             {"seed", 1, 0, kLargestSeed, "another seed, another scene", kInteger}},
            build};
}

}  // namespace wedge::scenes
