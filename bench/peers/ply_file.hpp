// Triangles as binary PLY, which every renderer reads.
#pragma once

#include <filesystem>
#include <vector>

#include "wedge/math.hpp"

namespace wedge::peers {

/// One list per attribute, indexed by `triangles`. Coordinates of textures are as in OBJ: v = 0 is
/// the bottom row.
struct PlyMesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  ///< as many as positions, or none: faces are flat
    std::vector<Vec2> uvs;      ///< as many as positions
    std::vector<UVec3> triangles;
};

/// Little-endian, float32; vertices have x, y, z, [nx, ny, nz,] u, v. Throws Error(output).
void write_ply(const std::filesystem::path& file, const PlyMesh& mesh);

}  // namespace wedge::peers
