#include "wedge/scene.hpp"

namespace wedge {

void make_ambient_occlusion(Scene& scene) {
    scene.rect_lights.clear();
    scene.point_lights.clear();
    scene.background = Vec3(1);
    for (Material& m : scene.materials) {
        // Bent normals stay: they are shape, not colour.
        Material white{.name = m.name, .diffuse = Vec3(1)};
        white.bump_texture = m.bump_texture;
        white.normal_texture = m.normal_texture;
        m = std::move(white);
    }
    scene.defaults.bounces = 0;
}

}  // namespace wedge
