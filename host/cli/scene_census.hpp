// Counts of what a scene holds, and of what in it cannot be rendered.
#pragma once

#include <cstddef>

#include "wedge/scene.hpp"

namespace wedge::cli {

struct SceneCensus {
    std::size_t meshes = 0, mesh_triangles = 0, vertices = 0;
    std::size_t instances = 0, placed_triangles = 0;  ///< placed: once for every instance
    std::size_t degenerate_triangles = 0;             ///< placed, corners equal or in one line
    std::size_t non_finite_triangles = 0;             ///< placed, a corner is NaN or infinite
    std::size_t lambert = 0, phong = 0, blinn_phong = 0, emitting = 0;  ///< materials
    std::size_t emitting_triangles = 0;                                 ///< placed
    std::size_t gaussian_lights = 0;
    std::size_t texture_bytes = 0;
    Bounds bounds;  ///< world space, lights included
};

SceneCensus take_census(const Scene& scene);

/// "8-bit sRGB", "8-bit linear", "float"
const char* format_name(TextureFormat format);

}  // namespace wedge::cli
