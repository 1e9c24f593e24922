// grids: flat lattices of thin bars, stacked over a plane. The light comes from above, so that
// every lattice throws its shadow through the next, at several distances from the receiver: slopes
// of the occlusion spectrum from near to far in one picture. The scene is that of Egan et al. 2011
// ("Frequency analysis and sheared filtering for shadow light fields of complex occluders") and of
// Mehta et al. 2012
// ("Axis-aligned filtering for interactive sampled soft shadows"); they tell its look and its size
// (0.2 K triangles), not its measures, which are chosen here. With bars = 2 there are 194
// triangles.
//
// 2 + layers * 2 (2 solid + 4 (bars - 1)^2 + 4 (2 bars - 1)) triangles, solid = (2 bars - 1)^2 -
// (bars - 1)^2. Each lattice is one closed surface; the plane is open. Flat. Materials:
// grids/plane, grids/bars.
#include <cmath>

#include "scenes/generators/kind.hpp"

namespace wedge::scenes {
namespace {

struct Lattice {
    float side;       ///< outer measure
    int bars;         ///< in each direction
    float bar_width;  ///< across a bar, in the plane
    float thickness;
    float center_height;
    float angle_rad;  ///< about the vertical axis
};

/// Edges of bars and gaps across the lattice: 2 bars numbers, from -side / 2 to side / 2.
std::vector<float> cuts(const Lattice& lattice) {
    std::vector<float> result;
    const float step = (lattice.side - lattice.bar_width) / float(lattice.bars - 1);
    for (int i = 0; i < lattice.bars; ++i) {
        const float left = -lattice.side / 2 + step * float(i);
        result.push_back(left);
        result.push_back(left + lattice.bar_width);
    }
    return result;
}

/// One lattice as a closed surface over the cells between the cuts. A cell is solid where either of
/// its indices is even: a bar runs there.
void add_lattice(MeshBuilder& builder, const Lattice& lattice, uint32_t material) {
    const std::vector<float> cut = cuts(lattice);
    const int n = int(cut.size());
    const float c = std::cos(lattice.angle_rad), s = std::sin(lattice.angle_rad);
    const auto first = uint32_t(builder.mesh().positions.size());
    for (const float half : {-0.5f, 0.5f})
        for (const float z : cut)
            for (const float x : cut)
                builder.vertex({c * x + s * z, lattice.center_height + half * lattice.thickness,
                                c * z - s * x},
                               Vec3(0));

    const auto at = [&](int top, int z, int x) { return first + uint32_t((top * n + z) * n + x); };
    const auto solid = [&](int z, int x) {
        return z >= 0 && x >= 0 && z < n - 1 && x < n - 1 && (z % 2 == 0 || x % 2 == 0);
    };
    for (int z = 0; z + 1 < n; ++z)
        for (int x = 0; x + 1 < n; ++x) {
            if (!solid(z, x)) continue;
            builder.quad(at(1, z, x), at(1, z + 1, x), at(1, z + 1, x + 1), at(1, z, x + 1),
                         material);
            builder.quad(at(0, z, x), at(0, z, x + 1), at(0, z + 1, x + 1), at(0, z + 1, x),
                         material);
            const auto side = [&](int z0, int x0, int z1, int x1) {
                builder.quad(at(0, z0, x0), at(0, z1, x1), at(1, z1, x1), at(1, z0, x0), material);
            };
            if (!solid(z - 1, x)) side(z, x + 1, z, x);
            if (!solid(z + 1, x)) side(z + 1, x, z + 1, x + 1);
            if (!solid(z, x - 1)) side(z, x, z + 1, x);
            if (!solid(z, x + 1)) side(z + 1, x + 1, z, x + 1);
        }
}

void build(const Values& values, MeshBuilder& builder) {
    add_ground(builder, values.real("ground"), 0, builder.material("grids/plane", Vec3(0.75f)));
    const uint32_t bars = builder.material("grids/bars", {0.55f, 0.32f, 0.18f});
    for (int layer = 0; layer < values.integer("layers"); ++layer) {
        Lattice lattice;
        lattice.side = values.real("side");
        lattice.bars = values.integer("bars");
        // A bar may fill at most half of its spacing, whatever the numbers: gaps never close.
        lattice.bar_width = values.real("fill") * lattice.side / float(lattice.bars);
        lattice.thickness = values.real("thickness");
        lattice.center_height = values.real("height") + float(layer) * values.real("spacing");
        lattice.angle_rad = float(layer) * values.real("twist_deg") * kPi / 180;
        add_lattice(builder, lattice, bars);
    }
}

}  // namespace

Kind grids_kind() {
    return {
        "grids",
        Shading::flat,
        {{"layers", 3, 1, 100, "lattices, one above the other", kInteger},
         {"bars", 6, 2, 500, "bars of a lattice in each direction", kInteger},
         {"side", 4, kShortest, kLongest, "outer measure of a lattice, world units"},
         {"fill", 0.18, 0.001, 0.5, "width of a bar as a fraction of side / bars"},
         {"thickness", 0.04, kShortest, kLongest, "vertical measure of a bar, world units"},
         {"height", 0.5, kShortest, kLongest, "of the lowest lattice over the plane, world units"},
         {"spacing", 0.6, kShortest, kLongest, "from lattice to lattice, world units"},
         {"twist_deg", 25, -360, 360, "turn from lattice to lattice, degrees"},
         {"ground", 14, kShortest, kLongest, "side of the plane, world units"}},
        build};
}

}  // namespace wedge::scenes
