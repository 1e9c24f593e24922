#include "bench/peers/ply_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <string>

#include "host/base/atomic_file.hpp"

namespace wedge::peers {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as memory is");

template <typename T>
void append(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

std::string header(const PlyMesh& mesh) {
    std::string text = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n",
                                   mesh.positions.size());
    const auto properties = [&](std::initializer_list<const char*> names) {
        for (const char* name : names) text += fmt::format("property float {}\n", name);
    };
    properties({"x", "y", "z"});
    if (!mesh.normals.empty()) properties({"nx", "ny", "nz"});
    properties({"u", "v"});
    return text + fmt::format(
                      "element face {}\nproperty list uchar int vertex_indices\n"
                      "end_header\n",
                      mesh.triangles.size());
}

}  // namespace

void write_ply(const std::filesystem::path& file, const PlyMesh& mesh) {
    std::string bytes = header(mesh);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (int c = 0; c < 3; ++c) append(bytes, mesh.positions[i][c]);
        if (!mesh.normals.empty())
            for (int c = 0; c < 3; ++c) append(bytes, mesh.normals[i][c]);
        for (int c = 0; c < 2; ++c) append(bytes, mesh.uvs[i][c]);
    }
    for (const UVec3& t : mesh.triangles) {
        append(bytes, (unsigned char)3);
        for (int c = 0; c < 3; ++c) append(bytes, int32_t(t[c]));
    }
    write_file_atomically(file, bytes);
}

}  // namespace wedge::peers
