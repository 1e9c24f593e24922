// tentacles: thin tubes that grow out of a wavy ground, curl and taper to a point: thin curved
// occluders on a curved receiver. Defaults give 146048 triangles, near the 145 K of the scene of
// this name in Mehta et al. 2012.
//
// count * 2 sides segments + 2 ground_detail^2 triangles. Tentacles closed, ground open. Smooth.
// Materials: tentacles/ground, tentacles/skin.
#include <cmath>

#include "scenes/generators/kind.hpp"
#include "scenes/generators/random.hpp"

namespace wedge::scenes {
namespace {

/// Height of the ground and its two slopes: two crossed waves, four periods over the side.
struct Ground {
    float side, wave_height;

    float phase(float x) const { return 8 * kPi * x / side; }
    float height(float x, float z) const {
        return 0.5f * wave_height * (std::sin(phase(x)) + std::sin(phase(z)));
    }
    Vec3 normal(float x, float z) const {
        const float slope = 0.5f * wave_height * 8 * kPi / side;
        return glm::normalize(Vec3(-slope * std::cos(phase(x)), 1, -slope * std::cos(phase(z))));
    }
};

void add_wavy_ground(MeshBuilder& builder, const Ground& ground, int cells, uint32_t material) {
    const auto first = uint32_t(builder.mesh().positions.size());
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const float x = ground.side * (float(i) / float(cells) - 0.5f);
            const float z = ground.side * (float(j) / float(cells) - 0.5f);
            builder.vertex({x, ground.height(x, z), z}, ground.normal(x, z));
        }
    const auto at = [&](int j, int i) { return first + uint32_t(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i)
            builder.quad(at(j, i), at(j + 1, i), at(j + 1, i + 1), at(j, i + 1), material);
}

/// The line of one tentacle: it starts upright, leans over as it grows and swings sideways on the
/// way.
std::vector<Vec3> grow(const Vec3& root, float length, int segments, float curl, Random& random) {
    const float swing = random.uniform(0.5f, 1.5f);
    const float start_phase = random.uniform(0, 2 * kPi);
    const float heading = random.uniform(0, 2 * kPi);
    const float lean = curl * random.uniform(0.6f, 1.4f);
    std::vector<Vec3> points{root};
    for (int i = 0; i < segments; ++i) {
        const float t = (float(i) + 0.5f) / float(segments);
        const float tilt = lean * t * t + 0.15f * curl * std::sin(3 * kPi * t + start_phase);
        const float azimuth = heading + swing * curl * t;
        const Vec3 step(std::sin(tilt) * std::cos(azimuth), std::cos(tilt),
                        std::sin(tilt) * std::sin(azimuth));
        points.push_back(points.back() + length / float(segments) * step);
    }
    return points;
}

void build(const Values& values, MeshBuilder& builder) {
    const Ground ground{values.real("ground"), values.real("wave_height")};
    add_wavy_ground(builder, ground, values.integer("ground_detail"),
                    builder.material("tentacles/ground", Vec3(0.75f)));
    const uint32_t skin = builder.material("tentacles/skin", {0.35f, 0.45f, 0.28f});
    const float base = values.real("radius");
    const int segments = values.integer("segments");
    for (int n = 0; n < values.integer("count"); ++n) {
        Random random(values.seed(), uint32_t(n));
        // The golden angle spreads the roots evenly over a disc.
        const float distance =
            values.real("spread") * std::sqrt((float(n) + 0.5f) / float(values.integer("count")));
        const float angle = 2.39996323f * float(n);
        const float x = distance * std::cos(angle), z = distance * std::sin(angle);
        const float length = values.real("length") * random.uniform(0.6f, 1);
        // Rooted two radii deep, so that no gap shows on the slopes.
        const Vec3 root(x, ground.height(x, z) - 2 * base, z);
        const auto points = grow(root, length, segments, values.real("curl"), random);
        std::vector<float> radii;
        for (int i = 0; i <= segments; ++i)
            radii.push_back(i == segments ? 0 : base * (1 - float(i) / float(segments)));
        add_tube(builder, points, radii, values.integer("sides"), skin);
    }
}

}  // namespace

Kind tentacles_kind() {
    return {"tentacles",
            Shading::smooth,
            {{"count", 60, 1, 5000, "tentacles", kInteger},
             {"segments", 100, 2, 1000, "along a tentacle", kInteger},
             {"sides", 12, 3, 200, "around a tentacle", kInteger},
             {"length", 3, kShortest, kLongest, "of the longest, world units"},
             {"radius", 0.06, kShortest, kLongest, "at the root, world units"},
             {"curl", 2.2, 0, 10, "how far the tip leans over, radians"},
             {"spread", 2.6, 0, kLongest, "radius of the disc they grow on, world units"},
             {"ground", 16, kShortest, kLongest, "side of the ground, world units"},
             {"wave_height", 0.3, 0, kLongest,
              "of the ground from trough to crest is twice this, world units"},
             {"ground_detail", 32, 1, 2000, "cells along a side of the ground", kInteger},
             {"seed", 1, 0, kLargestSeed, "another seed, another scene", kInteger}},
            build};
}

}  // namespace wedge::scenes
