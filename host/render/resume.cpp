#include "host/render/resume.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>

#include "host/base/atomic_file.hpp"
#include "host/base/sha256.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::rendering {
namespace {

constexpr std::string_view kMagic = "wedge state 1\n";
constexpr std::size_t kHexDigits = 64;
/// Saving takes no more than about this share of the time.
constexpr double kMostTimeSaving = 0.05;

/// What the image depends on, piece by piece.
class Fingerprint {
  public:
    template <typename T>
    Fingerprint& add(const T& value) requires std::is_trivially_copyable_v<T> {
        hash_.update(&value, sizeof(value));
        return *this;
    }
    template <typename T>
    Fingerprint& add(const std::vector<T>& values) {
        add(values.size());
        hash_.update(values.data(), values.size() * sizeof(T));
        return *this;
    }
    Fingerprint& add(std::string_view text) {
        add(text.size());
        hash_.update(text);
        return *this;
    }
    std::string hex() { return to_hex(hash_.digest()); }

  private:
    Sha256 hash_;
};

void add_camera(Fingerprint& print, const Scene& scene) {
    const Camera& c = scene.camera;
    print.add(c.position).add(c.target).add(c.up).add(c.vertical_fov_rad);
    print.add(scene.film.width).add(scene.film.height).add(scene.background);
}

void add_materials(Fingerprint& print, const Scene& scene) {
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

void add_geometry(Fingerprint& print, const Scene& scene) {
    for (const Mesh& mesh : scene.meshes)
        print.add(mesh.positions)
            .add(mesh.normals)
            .add(mesh.uvs)
            .add(mesh.triangles)
            .add(mesh.material_of);
    for (const Instance& i : scene.instances)
        print.add(i.mesh).add(i.transform).add(i.material.value_or(~0u));
}

void add_lights(Fingerprint& print, const Scene& scene) {
    for (const RectLight& l : scene.rect_lights)
        print.add(l.center).add(l.edge_u).add(l.edge_v).add(l.radiance).add(l.profile).add(l.sigma);
    for (const PointLight& l : scene.point_lights) print.add(l.position).add(l.intensity);
}

/// The device belongs to it: others round otherwise, and the bits would be neither's.
std::string fingerprint_of(const Scene& scene, const RenderOptions& options,
                           const PathSettings& settings, const RenderStats& stats) {
    Fingerprint print;
    print.add(std::string_view(version()))
        .add(std::string_view(options.kernel_dir))
        .add(std::string_view(stats.device.name))
        .add(std::string_view(stats.device.driver));
    add_camera(print, scene);
    add_materials(print, scene);
    add_geometry(print, scene);
    add_lights(print, scene);
    const Rect& crop = settings.crop;
    print.add(crop.x).add(crop.y).add(crop.width).add(crop.height);
    print.add(options.seed).add(options.sample_offset).add(settings.sampler);
    print.add(settings.strata).add(settings.bounces);
    return print.hex();
}

std::string_view bytes_of(const Position& position) {
    return {reinterpret_cast<const char*>(&position), sizeof(position)};
}

}  // namespace

StateFile::StateFile(const Scene& scene, const RenderOptions& options, const PathSettings& settings,
                     const RenderStats& stats)
    : file_(options.resume_file),
      fingerprint_(fingerprint_of(scene, options, settings, stats)),
      pixels_(uint64_t(settings.crop.width) * uint64_t(settings.crop.height)) {}

std::optional<RenderState> StateFile::read() const {
    const auto fail = [&](const std::string& what) {
        throw Error(
            ErrorKind::bad_input,
            fmt::format("{}: {}; remove it, or name another with --resume", file_.string(), what));
    };
    if (!std::filesystem::exists(file_)) return std::nullopt;
    std::ifstream stream(file_, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(stream), {});
    const std::size_t film_bytes = pixels_ * sizeof(shared::FilmPixel);
    const std::size_t header = kMagic.size() + kHexDigits;
    if (!text.starts_with(kMagic) || text.size() < header + kHexDigits)
        fail("is no state of a render");
    const std::string_view body(text.data(), text.size() - kHexDigits);
    if (text.substr(body.size()) != to_hex(sha256(body))) fail("is damaged");
    if (body.substr(kMagic.size(), kHexDigits) != fingerprint_ ||
        body.size() != header + sizeof(Position) + film_bytes)
        fail("is the state of another render: of another scene, device, version or other options");
    RenderState state;
    state.film.resize(pixels_);
    std::memcpy(&state.position, body.data() + header, sizeof(Position));
    std::memcpy(state.film.data(), body.data() + header + sizeof(Position), film_bytes);
    return state;
}

void StateFile::write(const RenderState& state) const {
    std::string text(kMagic);
    text += fingerprint_;
    text += bytes_of(state.position);
    text.append(reinterpret_cast<const char*>(state.film.data()),
                state.film.size() * sizeof(shared::FilmPixel));
    text += to_hex(sha256(text));
    write_file_atomically(file_, text);
}

Checkpoints::Checkpoints(const Scene& scene, const RenderOptions& options,
                         const PathSettings& settings, const RenderStats& stats, PathTracer& tracer)
    : tracer_(tracer),
      file_(scene, options, settings, stats),
      interval_s_(options.checkpoint_interval_s) {
    if (options.method != Method::mc)
        throw Error(ErrorKind::usage, "only plain Monte Carlo renders (method mc) can be resumed");
    const std::optional<RenderState> state = file_.read();
    if (!state) return;
    tracer_.write_film(state->film);
    start_ = state->position;
    log_info(fmt::format("{}: goes on after {} samples a pixel", options.resume_file,
                         start_->sample - options.sample_offset));
}

uint64_t Checkpoints::begin(Schedule& schedule, uint32_t first) const {
    if (!start_) return 0;
    schedule.go_on_from(*start_);
    return uint64_t(start_->sample - first) * tracer_.pixel_count() +
           uint64_t(start_->pixel) * start_->pass_samples;
}

void Checkpoints::between_launches(const Position& position) {
    if (since_save_.total() >= interval_s_) save(position);
}

void Checkpoints::save(const Position& position) {
    const Stopwatch watch;
    try {
        file_.write({position, tracer_.read_film()});
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::output) throw;
        log_warning(error.what());
    }
    interval_s_ = std::max(interval_s_, watch.total() / kMostTimeSaving);
    since_save_ = Stopwatch();
}

}  // namespace wedge::rendering
