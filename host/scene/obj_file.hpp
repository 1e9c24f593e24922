// OBJ meshes.
#pragma once

#include <filesystem>

#include "host/scene/texture_set.hpp"
#include "wedge/scene.hpp"

namespace wedge::scene {

enum class NormalsMode {
    automatic,  ///< the file's; the face's where the file has none
    face,       ///< always the face's
    smooth,     ///< always made from the geometry
};

struct ObjOptions {
    NormalsMode normals = NormalsMode::automatic;
    bool normal_maps = true;  ///< false: bump and normal maps of MTL files are left out
};

/// Reads an OBJ file and its material libraries into one mesh, polygons cut into triangles. Appends
/// its materials to Scene::materials; faces without one get a grey material named "default".
/// Vertices that are not finite are kept and warned about. Throws Error(bad_input) with file, line
/// and face for indices out of range, and for a file without faces.
Mesh load_obj(const std::filesystem::path& file, const ObjOptions& how, Scene& scene,
              TextureSet& textures, const LoadOptions& options);

}  // namespace wedge::scene
