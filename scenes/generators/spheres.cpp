// spheres: spheres of many sizes in the air over a plane, none touching another: curved occluders
// on curved receivers. Defaults give 72866 triangles, the size of the scene of this name in Mehta
// et al. 2012.
//
// 2 + count * 4 detail (detail - 1) triangles. Spheres closed, plane open. Smooth.
// Materials: spheres/plane, spheres/0 … spheres/4.
#include "scenes/generators/kind.hpp"
#include "scenes/generators/palette.hpp"
#include "scenes/generators/scatter.hpp"

namespace wedge::scenes {
namespace {

void build(const Values& values, MeshBuilder& builder) {
    add_ground(builder, values.real("ground"), 0, builder.material("spheres/plane", Vec3(0.75f)));
    const std::vector<uint32_t> colours = add_palette(builder, "spheres/");
    const float side = values.real("side"), largest = values.real("largest");
    const float smallest = values.real("smallest") * largest;
    Bounds region;
    region.include(Vec3(-side / 2, 0, -side / 2));
    region.include(Vec3(side / 2, values.real("height"), side / 2));

    std::vector<Ball> balls;
    const int count = values.integer("count");
    for (int i = 0; i < count; ++i) {
        Random random(values.seed(), uint32_t(i));
        // Large ones first, while there is room.
        const float radius = largest + (smallest - largest) * float(i) / float(count);
        const Ball ball = place_ball(balls, region, radius, random);
        add_sphere(builder, ball.center, ball.radius, values.integer("detail"),
                   values.real("bumps"), colours[random.next() % colours.size()]);
    }
}

}  // namespace

Kind spheres_kind() {
    return {"spheres",
            Shading::smooth,
            {{"count", 33, 1, 5000, "spheres", kInteger},
             {"detail", 24, 2, 500, "bands of a sphere from pole to pole", kInteger},
             {"largest", 0.7, kShortest, kLongest, "largest radius, world units"},
             {"smallest", 0.2, 0.01, 1, "smallest radius as a fraction of the largest"},
             {"bumps", 0, 0, 0.3, "height of bumps as a fraction of the radius"},
             {"side", 6, kShortest, kLongest, "of the square that holds them, world units"},
             {"height", 2.5, kShortest, kLongest, "of the space that holds them, world units"},
             {"ground", 20, kShortest, kLongest, "side of the plane, world units"},
             {"seed", 1, 0, kLargestSeed, "another seed, another scene", kInteger}},
            build};
}

}  // namespace wedge::scenes
