// Balls thrown into a box so that none touches another.
#pragma once

#include <vector>

#include "scenes/generators/random.hpp"
#include "wedge/math.hpp"

namespace wedge::scenes {

struct Ball {
    Vec3 center;
    float radius;
};

/// Adds a ball with its whole volume inside `region` and clear of `balls`, of radius `radius` if
/// one fits after a number of tries, else smaller. Returns it.
Ball place_ball(std::vector<Ball>& balls, const Bounds& region, float radius, Random& random);

}  // namespace wedge::scenes
