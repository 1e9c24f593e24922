// What a frame consists of, decided from the scene before anything is allocated or compiled.
#pragma once

#include <vector>

#include "host/device/program.hpp"
#include "wedge/render.hpp"
#include "wedge/scene.hpp"

namespace wedge::rendering {

/// Effects the scene has. Nothing is compiled or stored for those it has not.
struct Plan {
    bool specular = false;      ///< any visible material has a Phong or Blinn-Phong lobe
    bool textures = false;      ///< any visible material has an image
    bool normal_maps = false;   ///< any visible material bends its normal by an image
    int shadow_lights = 0;      ///< rectangles whose shadows are filtered, each by itself
    bool shadow_hues = false;   ///< which may vary with hue inside a pixel: materials differ in it
    bool other_lights = false;  ///< light straight from other rectangles and meshes is filtered
    bool point_lights_alone = false;  ///< not filtered, and the only lights beside shadow_lights
    bool hemisphere = false;          ///< indirect light and that of the background is filtered
    int light_rays = 1;      ///< that the first hit of a path sends to each light it looks at
    int direct_signals = 0;  ///< shadow_lights, and one for other_lights
    int signals = 0;  ///< that are filtered, for each surface of a pixel; 0: plain Monte Carlo
    device::ProgramRequest path_program;
    std::vector<device::ProgramRequest> filter_programs;  ///< if signals > 0
};

/// Light that reaches surfaces otherwise than straight from a light.
bool has_hemisphere_light(const Scene& scene, int bounces);

Plan make_plan(const Scene& scene, Method method, int bounces);

}  // namespace wedge::rendering
