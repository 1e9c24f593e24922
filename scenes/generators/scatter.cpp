#include "scenes/generators/scatter.hpp"

#include <algorithm>

namespace wedge::scenes {
namespace {

constexpr int kTriesPerRadius = 30;
constexpr float kShrink = 0.8f;

bool is_free(const std::vector<Ball>& balls, const Ball& candidate) {
    return std::none_of(balls.begin(), balls.end(), [&](const Ball& ball) {
        return glm::distance(ball.center, candidate.center) < ball.radius + candidate.radius;
    });
}

}  // namespace

Ball place_ball(std::vector<Ball>& balls, const Bounds& region, float radius, Random& random) {
    const Vec3 extent = region.extent();
    radius = std::min(radius, 0.5f * std::min({extent.x, extent.y, extent.z}));
    // Ends: a small enough ball fits wherever its centre is not inside another ball.
    for (int tries = 0;; ++tries) {
        if (tries > 0 && tries % kTriesPerRadius == 0) radius *= kShrink;
        const Ball ball{random.uniform(region.lower + radius, region.upper - radius), radius};
        if (!is_free(balls, ball)) continue;
        balls.push_back(ball);
        return ball;
    }
}

}  // namespace wedge::scenes
