// room: a closed room full of bumpy spheres and boxes that stand on the floor, none touching
// another. For indirect light and for incoherent rays: no ray leaves, and every direction has
// something in its way. The front sixth (low z) stays empty for the camera. Rooms reach from (0, 0,
// 0) to (side, height, side).
//
// 12 + 12 boxes + count * 4 detail (detail - 1) triangles; defaults: 608492 with 400 spheres of
// 1520. The customary measure of 640 K is count = 421, boxes = 0: 639932. Everything closed, walls
// face inwards. Smooth. Materials: room/floor, room/ceiling, room/walls, room/left, room/right,
// room/0 … room/4.
#include <cmath>

#include "scenes/generators/kind.hpp"
#include "scenes/generators/palette.hpp"
#include "scenes/generators/scatter.hpp"

namespace wedge::scenes {
namespace {

void add_walls(MeshBuilder& builder, float side, float height) {
    const uint32_t floor = builder.material("room/floor", {0.6f, 0.55f, 0.5f});
    const uint32_t ceiling = builder.material("room/ceiling", Vec3(0.75f));
    const uint32_t walls = builder.material("room/walls", Vec3(0.7f));
    const uint32_t left = builder.material("room/left", {0.65f, 0.4f, 0.3f});
    const uint32_t right = builder.material("room/right", {0.35f, 0.45f, 0.6f});
    const float s = side, h = height;
    builder.face({0, 0, 0}, {0, 0, s}, {s, 0, s}, {s, 0, 0}, floor);
    builder.face({0, h, 0}, {s, h, 0}, {s, h, s}, {0, h, s}, ceiling);
    builder.face({0, 0, s}, {0, h, s}, {s, h, s}, {s, 0, s}, walls);
    builder.face({0, 0, 0}, {s, 0, 0}, {s, h, 0}, {0, h, 0}, walls);
    // Looking from the front wall along +z, +x is on the left.
    builder.face({s, 0, 0}, {s, 0, s}, {s, h, s}, {s, h, 0}, left);
    builder.face({0, 0, 0}, {0, h, 0}, {0, h, s}, {0, 0, s}, right);
}

/// A box on the floor, in the way of other things as the ball around it.
void add_standing_box(MeshBuilder& builder, std::vector<Ball>& balls, const Bounds& floor_region,
                      float size, const std::vector<uint32_t>& colours, Random& random) {
    const Vec3 half = random.uniform(Vec3(0.3f), Vec3(1)) * size;
    Bounds region = floor_region;
    const float reach = glm::length(half);
    region.lower.y = half.y - reach;
    region.upper.y = half.y + reach;
    const Ball ball = place_ball(balls, region, reach, random);
    const Vec3 fitted = half * (ball.radius / reach);
    const Vec3 center(ball.center.x, fitted.y, ball.center.z);
    add_box(builder, center, fitted, random.uniform(0, kPi),
            colours[random.next() % colours.size()]);
}

void build(const Values& values, MeshBuilder& builder) {
    const float side = values.real("side"), height = values.real("height");
    add_walls(builder, side, height);
    const std::vector<uint32_t> colours = add_palette(builder, "room/");
    Bounds region;
    region.include(Vec3(0, 0, side / 6));
    region.include(Vec3(side, height, side));

    std::vector<Ball> balls;
    const float largest = values.real("largest") * side;
    const int boxes = values.integer("boxes");
    for (int i = 0; i < boxes; ++i) {
        Random random(values.seed(), 2 * uint32_t(i) + 1);
        add_standing_box(builder, balls, region, largest, colours, random);
    }
    for (int i = 0; i < values.integer("count"); ++i) {
        Random random(values.seed(), 2 * uint32_t(i));
        const float radius = random.uniform(0.3f, 1) * largest;
        // Bumps reach beyond the radius.
        const float reach = 1 + values.real("bumps");
        const Ball ball = place_ball(balls, region, radius * reach, random);
        add_sphere(builder, ball.center, ball.radius / reach, values.integer("detail"),
                   values.real("bumps"), colours[random.next() % colours.size()]);
    }
}

}  // namespace

Kind room_kind() {
    return {"room",
            Shading::smooth,
            {{"count", 400, 0, 5000, "spheres", kInteger},
             {"detail", 20, 2, 500, "bands of a sphere from pole to pole", kInteger},
             {"boxes", 40, 0, 1000, "boxes on the floor", kInteger},
             {"bumps", 0.1, 0, 0.3, "height of bumps as a fraction of the radius"},
             {"largest", 0.05, 0.001, 0.2, "largest radius as a fraction of the side"},
             {"side", 10, kShortest, kLongest, "of the square floor, world units"},
             {"height", 10, kShortest, kLongest, "of the room, world units"},
             {"seed", 1, 0, kLargestSeed, "another seed, another scene", kInteger}},
            build};
}

}  // namespace wedge::scenes
