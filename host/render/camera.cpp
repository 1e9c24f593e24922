#include "host/render/camera.hpp"

#include <algorithm>
#include <cmath>

namespace wedge::rendering {

shared::CameraRays make_camera_rays(const Camera& camera, const Film& film) {
    // Doubles: a narrow field of view far from the origin leaves few bits of a float.
    using DVec3 = glm::dvec3;
    const DVec3 forward = glm::normalize(DVec3(camera.target) - DVec3(camera.position));
    const DVec3 right = glm::normalize(glm::cross(forward, DVec3(camera.up)));
    const DVec3 up = glm::cross(right, forward);
    const double half_height = std::tan(0.5 * double(camera.vertical_fov_rad));
    const double half_width = half_height * film.width / film.height;

    const DVec3 corner = forward - right * half_width + up * half_height;
    const DVec3 step_x = right * (2 * half_width / film.width);
    const DVec3 step_y = up * (-2 * half_height / film.height);
    const auto pack = [](const DVec3& v) {
        return shared::float4{float(v.x), float(v.y), float(v.z), 0};
    };
    shared::CameraRays rays{pack(camera.position), pack(corner), pack(step_x), pack(step_y)};
    rays.position.w = std::max(
        {std::abs(camera.position.x), std::abs(camera.position.y), std::abs(camera.position.z)});
    return rays;
}

}  // namespace wedge::rendering
