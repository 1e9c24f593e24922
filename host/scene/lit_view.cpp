#include "host/scene/lit_view.hpp"

#include <algorithm>

#include "host/scene/probe.hpp"

namespace wedge::scene {
namespace {

constexpr int kGrid = 6;  ///< looks at kGrid^2 points of the film
constexpr std::size_t kMostEmitters = 8;
/// Fraction of a distance that rounding may take or add.
constexpr float kSlack = 1e-3f;

struct Emitter {
    Vec3 center, normal;  ///< normal not unit: its length is twice the area
    float radiance;       ///< mean of the channels
    float power;          ///< up to a common factor
};

/// The strongest triangles, strongest first.
std::vector<Emitter> strongest_emitters(const Scene& scene) {
    const Mesh& mesh = scene.meshes[0];
    std::vector<Emitter> emitters;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Vec3 emission = scene.materials[mesh.material_of[i]].emission;
        if (emission == Vec3(0)) continue;
        const UVec3& t = mesh.triangles[i];
        const Vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
        const Vec3 normal = glm::cross(b - a, c - a);
        const float radiance = (emission.x + emission.y + emission.z) / 3;
        const float power = glm::length(normal) * radiance;
        if (power > 0 && std::isfinite(power))
            emitters.push_back({(a + b + c) / 3.0f, normal, radiance, power});
    }
    const std::size_t kept = std::min(emitters.size(), kMostEmitters);
    std::partial_sort(emitters.begin(), emitters.begin() + std::ptrdiff_t(kept), emitters.end(),
                      [](const Emitter& a, const Emitter& b) { return a.power > b.power; });
    emitters.resize(kept);
    return emitters;
}

/// Towards the middles of a grid of cells of the film.
std::vector<Vec3> view_directions(const Camera& camera, const Film& film) {
    const Vec3 ahead = glm::normalize(camera.target - camera.position);
    const Vec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const Vec3 up = glm::cross(right, ahead);
    const float half = std::tan(0.5f * camera.vertical_fov_rad);
    const float aspect = float(film.width) / float(film.height);
    std::vector<Vec3> directions;
    for (int y = 0; y < kGrid; ++y)
        for (int x = 0; x < kGrid; ++x) {
            const float across = 2 * (float(x) + 0.5f) / kGrid - 1;
            const float upwards = 2 * (float(y) + 0.5f) / kGrid - 1;
            directions.push_back(
                glm::normalize(ahead + half * (aspect * across * right + upwards * up)));
        }
    return directions;
}

/// Irradiance that the point, a little towards the camera, gets on the camera's side from those of
/// the emitters that it sees, each taken for a point: the sum of L A cos cos' / d^2.
float irradiance_at(const Mesh& mesh, const std::vector<Emitter>& emitters, const Vec3& point,
                    const Vec3& normal, const Vec3& to_camera) {
    float sum = 0;
    for (const Emitter& emitter : emitters) {
        const Vec3 way = emitter.center - point;
        const float leaving = -glm::dot(emitter.normal, way), arriving = glm::dot(normal, way);
        if (!(leaving > 0) || !(arriving * glm::dot(normal, to_camera) > 0)) continue;
        // The way itself is the direction, so that its end is at distance 1.
        if (probe(mesh, point, {way})[0].distance < 1 - kSlack) continue;
        const float d2 = glm::dot(way, way);
        sum += emitter.radiance * 0.5f * leaving * std::abs(arriving) / (d2 * d2);
    }
    return sum;
}

}  // namespace

ViewLight look_for_light(const Scene& scene, const Camera& camera) {
    const Mesh& mesh = scene.meshes[0];
    const std::vector<Emitter> emitters = strongest_emitters(scene);
    const std::vector<Vec3> directions = view_directions(camera, scene.film);
    const std::vector<ProbeHit> hits = probe(mesh, camera.position, directions);
    ViewLight view;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (!std::isfinite(hits[i].distance)) continue;
        ++view.seen;
        const uint32_t material = mesh.material_of[hits[i].triangle];
        if (hits[i].front && scene.materials[material].emission != Vec3(0)) {
            ++view.shining;
            continue;
        }
        const Vec3 point = camera.position + (1 - kSlack) * hits[i].distance * directions[i];
        const float irradiance =
            irradiance_at(mesh, emitters, point, hits[i].normal, -directions[i]);
        view.lit += irradiance > 0;
        view.irradiance += irradiance;
    }
    if (view.lit > 0) view.irradiance /= float(view.lit);
    return view;
}

}  // namespace wedge::scene
