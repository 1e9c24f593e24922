#include "bench/rays.hpp"

#include <random>

namespace wedge::bench {
namespace {

// Rays start this far off the surface, relative to the largest coordinate: beyond the rounding of
// the point, for tracers that know no source.
constexpr float kOffset = 1e-5f;

class Random {
  public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    float operator()() { return float(engine_() >> 8) * 0x1p-24f; }

  private:
    std::mt19937 engine_;
};

PackedRay pack(const Vec3& o, const Vec3& d, float t_max, uint32_t source) {
    return {o.x, o.y, o.z, t_max, d.x, d.y, d.z, source};
}

std::vector<PackedRay> camera_rays(const Camera& camera, int width, int height, Random& random) {
    const Vec3 forward = glm::normalize(camera.target - camera.position);
    const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const Vec3 up = glm::cross(right, forward);
    const float half_height = std::tan(0.5f * camera.vertical_fov_rad);
    std::vector<PackedRay> rays;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float sx = (2 * (x + random()) - width) / height,
                        sy = 1 - 2 * (y + random()) / height;
            const Vec3 d = forward + half_height * (sx * right + sy * up);
            rays.push_back(pack(camera.position, glm::normalize(d), INFINITY, WEDGE_NO_PRIMITIVE));
        }
    return rays;
}

struct SurfacePoint {
    Vec3 position;  ///< off the surface, on the side the ray came from
    Vec3 normal;    ///< towards that side
    uint32_t primitive;
};

std::vector<SurfacePoint> surface_points(const rendering::FlatScene& flat,
                                         std::span<const PackedRay> rays,
                                         std::span<const PackedHit> hits) {
    std::vector<SurfacePoint> points;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (hits[i].primitive == WEDGE_NO_PRIMITIVE) continue;
        const UVec3 t = flat.triangles[hits[i].primitive];
        const Vec3 v0 = flat.positions[t.x], v1 = flat.positions[t.y], v2 = flat.positions[t.z];
        Vec3 normal = glm::cross(glm::normalize(v1 - v0), glm::normalize(v2 - v0));
        normal = glm::normalize(normal);
        if (!(glm::dot(normal, normal) > 0.5f)) continue;
        if (glm::dot(normal, Vec3(rays[i].dx, rays[i].dy, rays[i].dz)) > 0) normal = -normal;
        const Vec3 p = (1 - hits[i].u - hits[i].v) * v0 + hits[i].u * v1 + hits[i].v * v2;
        const float size = glm::max(glm::max(std::abs(p.x), std::abs(p.y)), std::abs(p.z));
        points.push_back({p + kOffset * size * normal, normal, hits[i].primitive});
    }
    return points;
}

std::vector<PackedRay> cosine_rays(std::span<const SurfacePoint> points, float t_max,
                                   Random& random) {
    std::vector<PackedRay> rays;
    for (const SurfacePoint& point : points) {
        const float z = 1 - 2 * random(), phi = 2 * kPi * random();
        const float r = std::sqrt(std::max(0.0f, 1 - z * z));
        // A point of the unit sphere about the tip of the normal; short of it, so that the sum is
        // not 0.
        const Vec3 on_sphere(r * std::cos(phi), r * std::sin(phi), z);
        const Vec3 d = glm::normalize(point.normal + 0.999f * on_sphere);
        rays.push_back(pack(point.position, d, t_max, point.primitive));
    }
    return rays;
}

RectLight light_of(const Scene& scene, const Bounds& bounds) {
    if (!scene.rect_lights.empty()) return scene.rect_lights.front();
    RectLight light;
    const Vec3 extent = bounds.extent();
    light.center = bounds.center() + Vec3(0, 0.45f * extent.y, 0);
    light.edge_u = Vec3(0.1f * extent.x, 0, 0);
    light.edge_v = Vec3(0, 0, 0.1f * extent.z);
    return light;
}

std::vector<PackedRay> shadow_rays(std::span<const SurfacePoint> points, const RectLight& light,
                                   Random& random) {
    std::vector<PackedRay> rays;
    for (const SurfacePoint& point : points) {
        const Vec3 target =
            light.center + (random() - 0.5f) * light.edge_u + (random() - 0.5f) * light.edge_v;
        const Vec3 way = target - point.position;
        const float length = glm::length(way);
        if (!(length > 0)) continue;
        // Not up to the light itself, which may be among the triangles.
        rays.push_back(pack(point.position, way / length, 0.999f * length, point.primitive));
    }
    return rays;
}

}  // namespace

std::vector<RaySet> make_ray_sets(const Scene& scene, const rendering::FlatScene& flat,
                                  const Bounds& bounds, int width, int height,
                                  const TraceClosest& trace) {
    Random random(1);
    const RaySet primary{"primary", false, camera_rays(scene.camera, width, height, random)};
    const auto first = surface_points(flat, primary.rays, trace(primary.rays));
    const RaySet bounce1{"bounce 1", false, cosine_rays(first, INFINITY, random)};
    const auto second = surface_points(flat, bounce1.rays, trace(bounce1.rays));
    const RaySet bounce2{"bounce 2", false, cosine_rays(second, INFINITY, random)};
    const RaySet shadow{"shadow", true, shadow_rays(first, light_of(scene, bounds), random)};
    const float reach = 0.1f * glm::length(bounds.extent());
    const RaySet ambient{"ambient", true, cosine_rays(first, reach, random)};
    return {primary, bounce1, bounce2, shadow, ambient};
}

}  // namespace wedge::bench
