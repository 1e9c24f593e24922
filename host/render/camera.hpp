// A pinhole camera as the rays through its film.
#pragma once

#include "wedge/scene.hpp"
#include "wedge/shared/frame.h"

namespace wedge::rendering {

shared::CameraRays make_camera_rays(const Camera& camera, const Film& film);

}  // namespace wedge::rendering
