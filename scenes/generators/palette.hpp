// A few colours that go together.
#pragma once

#include <string>
#include <vector>

#include "scenes/generators/mesh_builder.hpp"

namespace wedge::scenes {

/// Five diffuse materials named `prefix`0 … `prefix`4; returns their indices.
inline std::vector<uint32_t> add_palette(MeshBuilder& builder, const std::string& prefix) {
    const Vec3 colours[] = {{0.70f, 0.27f, 0.18f},
                            {0.75f, 0.58f, 0.24f},
                            {0.26f, 0.48f, 0.36f},
                            {0.20f, 0.34f, 0.58f},
                            {0.72f, 0.70f, 0.66f}};
    std::vector<uint32_t> indices;
    for (const Vec3& colour : colours)
        indices.push_back(builder.material(prefix + std::to_string(indices.size()), colour));
    return indices;
}

}  // namespace wedge::scenes
