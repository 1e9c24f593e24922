// The list of everything that can be sampled as a light.
#pragma once

#include <vector>

#include "wedge/scene.hpp"
#include "wedge/shared/scene.h"

namespace wedge::rendering {

double luminance(const Vec3& colour);

/// Radiant power of a light, by luminance.
double light_power(const RectLight& rect);
double light_power(const PointLight& point);

/// Of something flat that shines to one side.
double light_power(double area, const Vec3& radiance);

class LightList {
  public:
    /// Each returns the index of the new light, or -1 where there is nothing to sample: no power,
    /// no area.
    int add_rect(const RectLight& rect);
    int add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Material& material,
                     uint32_t primitive);
    int add_point(const PointLight& point);

    /// The lights, chosen with probability proportional to their power (by luminance).
    std::vector<shared::Light> take();

  private:
    int add(shared::Light light, double power);

    std::vector<shared::Light> lights_;
    std::vector<double> powers_;
};

}  // namespace wedge::rendering
