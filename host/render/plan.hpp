// What a frame consists of, decided from the scene before anything is allocated or compiled.
#pragma once

#include "host/device/program.hpp"
#include "wedge/scene.hpp"

namespace wedge::rendering {

/// Effects the scene has. Nothing is compiled or stored for those it has not.
struct Plan {
    bool specular = false;  ///< any visible material has a Phong or Blinn-Phong lobe
    bool textures = false;  ///< any visible material has an image
    device::ProgramRequest path_program;
};

Plan make_plan(const Scene& scene);

}  // namespace wedge::rendering
