// Vectors and matrices: GLM's, under the names the rest of the code uses.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace wedge {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Mat4 = glm::mat4;
using UVec3 = glm::uvec3;

inline constexpr float kPi = 3.14159265358979323846f;

/// Axis-aligned box. A default box is empty and grows with `include`.
struct Bounds {
    Vec3 lower{INFINITY};
    Vec3 upper{-INFINITY};

    void include(const Vec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    void include(const Bounds& b) {
        lower = glm::min(lower, b.lower);
        upper = glm::max(upper, b.upper);
    }
    bool empty() const { return lower.x > upper.x; }
    Vec3 extent() const { return empty() ? Vec3(0) : upper - lower; }
    Vec3 center() const { return 0.5f * (lower + upper); }
};

}  // namespace wedge
