#include "bench/converge/identity.hpp"

#include <algorithm>
#include <fstream>
#include <span>
#include <vector>

#include "host/base/sha256.hpp"
#include "wedge_commit.hpp"  // written by cmake/Commit.cmake

namespace wedge::converge {
namespace {

namespace fs = std::filesystem;

/// Values one by one, because structures have padding.
class SceneDigest {
  public:
    template <typename T>
    requires std::is_arithmetic_v<T> || std::is_enum_v<T>
    void add(T value) { sha_.update(&value, sizeof(value)); }
    void add(const Vec2& v) { add_all(v.x, v.y); }
    void add(const Vec3& v) { add_all(v.x, v.y, v.z); }
    void add(const UVec3& v) { add_all(v.x, v.y, v.z); }
    template <typename T>
    void add(const std::vector<T>& items) {
        add(items.size());
        for (const T& item : items) add(item);
    }
    void add(const Material& m) {
        add_all(m.diffuse, m.specular, m.exponent, m.model, m.emission, m.diffuse_texture,
                m.specular_texture, m.emission_texture);
    }
    void add(const Mesh& m) { add_all(m.positions, m.normals, m.uvs, m.triangles, m.material_of); }
    void add(const Instance& i) {
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) add(i.transform[c][r]);
        add_all(i.mesh, i.material.has_value(), i.material.value_or(0));
    }
    void add(const RectLight& l) {
        add_all(l.center, l.edge_u, l.edge_v, l.radiance, l.profile, l.sigma);
    }
    void add(const PointLight& l) { add_all(l.position, l.intensity); }
    void add(const Texture& t) {
        add_all(t.image.width, t.image.height, t.image.format, t.scale, t.offset, t.value_gain,
                t.value_base, t.clamp);
        sha_.update(t.image.texels.data(), t.image.texels.size());
    }
    template <typename... Ts>
    void add_all(const Ts&... values) {
        (add(values), ...);
    }
    std::string text() { return to_hex(sha_.digest()).substr(0, 16); }

  private:
    Sha256 sha_;
};

void add_file(Sha256& sha, const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::vector<char> block(1 << 16);
    while (in.read(block.data(), std::streamsize(block.size())) || in.gcount() > 0)
        sha.update(block.data(), std::size_t(in.gcount()));
}

}  // namespace

std::string digest_of(const Scene& s) {
    SceneDigest digest;
    digest.add_all(s.camera.position, s.camera.target, s.camera.up, s.camera.vertical_fov_rad,
                   s.film.width, s.film.height, s.defaults.bounces, s.background, s.meshes,
                   s.instances, s.materials, s.textures, s.rect_lights, s.point_lights);
    return digest.text();
}

std::string program_digest(const std::string& kernel_dir) {
    Sha256 sha;
    add_file(sha, "/proc/self/exe");
    if (!kernel_dir.empty()) {
        std::vector<fs::path> files;
        for (const char* folder : {"kernels", "include/wedge/shared"})
            for (const auto& entry :
                 fs::recursive_directory_iterator(fs::path(kernel_dir) / folder))
                if (entry.is_regular_file()) files.push_back(entry.path());
        std::sort(files.begin(), files.end());
        for (const fs::path& file : files) add_file(sha, file);
    }
    return to_hex(sha.digest()).substr(0, 16);
}

std::string built_from_commit() {
    return WEDGE_COMMIT;
}

}  // namespace wedge::converge
