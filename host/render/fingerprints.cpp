#include "host/render/fingerprints.hpp"

#include <string_view>
#include <type_traits>

#include "host/base/sha256.hpp"

namespace wedge::rendering {
namespace {

/// Takes what a part consists of, piece by piece.
class Hash {
  public:
    template <typename T>
    Hash& add(const T& value) requires std::is_trivially_copyable_v<T> {
        hash_.update(&value, sizeof(value));
        return *this;
    }
    template <typename T>
    Hash& add(const std::vector<T>& values) {
        add(values.size());
        hash_.update(values.data(), values.size() * sizeof(T));
        return *this;
    }
    Hash& add(std::string_view text) {
        add(text.size());
        hash_.update(text);
        return *this;
    }
    std::string hex() { return to_hex(hash_.digest()); }

  private:
    Sha256 hash_;
};

void add_camera(Hash& print, const Scene& scene) {
    const Camera& c = scene.camera;
    print.add(c.position).add(c.target).add(c.up).add(c.vertical_fov_rad);
    print.add(scene.film.width).add(scene.film.height).add(scene.background);
}

void add_materials(Hash& print, const Scene& scene) {
    for (const Material& m : scene.materials) {
        print.add(m.diffuse).add(m.specular).add(m.exponent).add(m.model).add(m.emission);
        print.add(m.diffuse_texture).add(m.specular_texture).add(m.emission_texture);
        print.add(m.normal_texture).add(m.bump_texture);
    }
    for (const Texture& t : scene.textures) {
        print.add(t.image.width).add(t.image.height).add(t.image.format).add(t.image.texels);
        print.add(t.scale).add(t.offset).add(t.value_gain).add(t.value_base).add(t.clamp);
    }
}

void add_geometry(Hash& print, const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        print.add(mesh.positions)
            .add(mesh.normals)
            .add(mesh.uvs)
            .add(mesh.triangles)
            .add(mesh.material_of);
    for (const Instance& i : scene.instances)
        print.add(i.mesh).add(i.transform).add(i.material.value_or(~0u));
}

void add_lights(Hash& print, const Scene& scene) {
    for (const RectLight& l : scene.rect_lights)
        print.add(l.center).add(l.edge_u).add(l.edge_v).add(l.radiance).add(l.profile).add(l.sigma);
    for (const PointLight& l : scene.point_lights) print.add(l.position).add(l.intensity);
}

/// The device belongs to it: others round otherwise, and the bits would be neither's.
void add_program(Hash& print, const RenderOptions& options, const RenderStats& stats) {
    print.add(std::string_view(version()))
        .add(std::string_view(options.kernel_dir))
        .add(std::string_view(stats.device.name))
        .add(std::string_view(stats.device.driver));
}

void add_crop(Hash& print, const Rect& crop) {
    print.add(crop.x).add(crop.y).add(crop.width).add(crop.height);
}

void add_samples(Hash& print, const RenderOptions& options, const PathSettings& settings) {
    print.add(options.seed).add(options.sample_offset).add(settings.sampler).add(settings.strata);
}

}  // namespace

std::vector<Fingerprint> fingerprints_of(const Scene& scene, const RenderOptions& options,
                                         const PathSettings& settings, const RenderStats& stats) {
    std::vector<Fingerprint> prints;
    const auto take = [&](const char* part, const auto& add) {
        Hash print;
        add(print);
        prints.push_back({part, print.hex()});
    };
    take("version, kernels or device", [&](Hash& p) { add_program(p, options, stats); });
    take("camera, film or background", [&](Hash& p) { add_camera(p, scene); });
    take("materials or images", [&](Hash& p) { add_materials(p, scene); });
    take("geometry", [&](Hash& p) { add_geometry(p, scene); });
    take("lights", [&](Hash& p) { add_lights(p, scene); });
    take("crop", [&](Hash& p) { add_crop(p, settings.crop); });
    take("seed, sampler or first sample", [&](Hash& p) { add_samples(p, options, settings); });
    take("bounces", [&](Hash& p) { p.add(settings.bounces); });
    return prints;
}

}  // namespace wedge::rendering
