#include "host/scene/default_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "host/scene/lit_view.hpp"
#include "host/scene/probe.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::scene {
namespace {

constexpr int kProbeRays = 64;
/// Larger models are not probed: it would take seconds, and they are scans of objects.
constexpr std::size_t kMostProbedTriangles = 3'000'000;

/// Larger ones are not searched for lit sides: it takes many more rays.
constexpr std::size_t kMostLitTriangles = 500'000;

constexpr float kObjectFov_rad = 0.7f;
constexpr float kInteriorFov_rad = 1.05f;
constexpr float kMargin = 1.1f;  ///< room left around a framed model
/// Mean irradiance on the model's box, by its own emission, below which it gets a light.
constexpr double kDim = 0.1;
/// What a made-up light gives at the place it is meant for: white paper then sends out about 1.
constexpr float kIrradiance = kPi;
constexpr float kBackground = 0.25f;
/// Irradiance by a model's own lamps below which it is shown brighter.
constexpr float kDimIrradiance = 0.25f;

bool hit(const ProbeHit& h) {
    return std::isfinite(h.distance);
}

/// Distance along `direction` at which a ray leaves the box.
float exit_distance(const Bounds& box, const Vec3& origin, const Vec3& direction) {
    float nearest = INFINITY;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) continue;
        const float wall = direction[axis] > 0 ? box.upper[axis] : box.lower[axis];
        nearest = std::min(nearest, (wall - origin[axis]) / direction[axis]);
    }
    return nearest;
}

/// Whether rays from all around meet mostly backs: a room without an outside.
bool shows_backs_outside(const Mesh& mesh, const Bounds& box) {
    const float radius = glm::length(box.extent());
    int hits = 0, backs = 0;
    for (const Vec3& direction : sphere_directions(kProbeRays)) {
        const ProbeHit h = probe(mesh, box.center() + radius * direction, {-direction})[0];
        hits += hit(h);
        backs += hit(h) && !h.front;
    }
    return 2 * backs > hits;
}

/// Whether three of four rays meet fronts. Closed objects show their backs from inside.
bool is_enclosed(const std::vector<ProbeHit>& hits) {
    const auto fronts =
        std::count_if(hits.begin(), hits.end(), [](const ProbeHit& h) { return h.front; });
    return 4 * fronts >= 3 * std::ptrdiff_t(hits.size());
}

/// Whether half of the steep rays down meet a level floor, and half of the flat ones upright walls.
/// Hollow objects (a pot, a car) have neither.
bool has_floor_and_walls(const std::vector<Vec3>& directions, const std::vector<ProbeHit>& hits) {
    constexpr float kSteep = 0.7f, kFlat = 0.3f, kTilt = 0.05f;
    int steep = 0, level = 0, flat = 0, upright = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const float tilt = std::abs(hits[i].normal.y);
        if (directions[i].y < -kSteep) {
            ++steep;
            level += hit(hits[i]) && tilt > 1 - kTilt;
        } else if (std::abs(directions[i].y) < kFlat) {
            ++flat;
            upright += hit(hits[i]) && tilt < kTilt;
        }
    }
    return 2 * level >= steep && 2 * upright >= flat;
}

/// The place to stand, of three heights the one with most free way in half of the directions.
std::optional<Vec3> find_interior(const Mesh& mesh, const Bounds& box) {
    std::optional<Vec3> best;
    if (mesh.triangles.size() > kMostProbedTriangles) return best;
    const std::vector<Vec3> directions = sphere_directions(kProbeRays);
    const bool room_for_sure = shows_backs_outside(mesh, box);
    float most_free = 0;
    for (const float height : {0.25f, 0.35f, 0.5f}) {
        Vec3 anchor = box.center();
        anchor.y = box.lower.y + height * box.extent().y;
        const std::vector<ProbeHit> hits = probe(mesh, anchor, directions);
        if (!is_enclosed(hits)) continue;
        if (!room_for_sure && !has_floor_and_walls(directions, hits)) continue;
        std::vector<float> free;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const float exit = exit_distance(box, anchor, directions[i]);
            free.push_back(std::min(hits[i].distance, exit) / exit);
        }
        std::nth_element(free.begin(), free.begin() + kProbeRays / 2, free.end());
        if (free[kProbeRays / 2] <= most_free) continue;
        most_free = free[kProbeRays / 2];
        best = anchor;
    }
    return best;
}

/// Distance from the middle of the box at which all its corners are in the picture.
float framing_distance(const Bounds& box, const Vec3& towards_camera, float fov_rad, float aspect) {
    const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), towards_camera));
    const Vec3 up = glm::cross(towards_camera, right);
    const float tan_y = std::tan(0.5f * fov_rad) / kMargin, tan_x = tan_y * aspect;
    float distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 side(corner & 1 ? 0.5f : -0.5f, corner & 2 ? 0.5f : -0.5f,
                        corner & 4 ? 0.5f : -0.5f);
        const Vec3 p = side * box.extent();
        const float wide =
            std::max(std::abs(glm::dot(p, right)) / tan_x, std::abs(glm::dot(p, up)) / tan_y);
        distance = std::max(distance, wide + glm::dot(p, towards_camera));
    }
    return distance;
}

Camera looking_from(const Bounds& box, const Vec3& towards_camera, float fov_rad,
                    const Film& film) {
    const float aspect = float(film.width) / float(film.height);
    Camera camera;
    camera.vertical_fov_rad = fov_rad;
    camera.target = box.center();
    camera.position =
        camera.target + towards_camera * framing_distance(box, towards_camera, fov_rad, aspect);
    return camera;
}

/// In front of an open side if there is one (a stage), else at the far end of the longest way.
Camera interior_camera(const Mesh& mesh, const Bounds& box, const Vec3& anchor, const Film& film) {
    const std::array<Vec3, 4> sides{Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 0, -1), Vec3(-1, 0, 0)};
    for (const Vec3& side : sides)
        if (!hit(probe(mesh, anchor, {side})[0]))
            return looking_from(box, side, kObjectFov_rad, film);

    std::vector<Vec3> ways;
    for (int i = 0; i < 16; ++i) {
        const float angle = float(i) * kPi / 8;
        ways.emplace_back(std::cos(angle), 0, std::sin(angle));
    }
    const std::vector<ProbeHit> hits = probe(mesh, anchor, ways);
    std::size_t longest = 0;
    for (std::size_t i = 1; i < hits.size(); ++i)
        if (hits[i].distance > hits[longest].distance) longest = i;
    Camera camera;
    camera.vertical_fov_rad = kInteriorFov_rad;
    camera.target = anchor;
    camera.position = anchor + 0.9f * hits[longest].distance * ways[longest];
    return camera;
}

/// Square of the given side that faces `target`, bright enough to give `irradiance` there: that of
/// a disc of the same area, E = L pi A / (A + pi d^2).
RectLight light_towards(const Vec3& target, const Vec3& center, float side, float irradiance) {
    const Vec3 away = center - target;
    const float distance2 = glm::dot(away, away), area = side * side;
    const Vec3 normal = glm::normalize(-away);
    const Vec3 helper = std::abs(normal.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
    RectLight light;
    light.center = center;
    const Vec3 u = glm::normalize(glm::cross(helper, normal));
    light.edge_u = side * u;
    light.edge_v = side * glm::cross(normal, u);
    light.radiance = Vec3(irradiance * (area + kPi * distance2) / (kPi * area));
    return light;
}

RectLight object_light(const Bounds& box, const Camera& camera) {
    // Above, and to the left of the camera, so that forms show.
    const float radius = 0.5f * glm::length(box.extent());
    const Vec3 back = glm::normalize(camera.position - camera.target);
    const Vec3 left = glm::normalize(glm::cross(back, camera.up));
    const Vec3 direction = glm::normalize(Vec3(0, 1, 0) + 0.5f * back + 0.5f * left);
    return light_towards(box.center(), box.center() + 3 * radius * direction, radius, kIrradiance);
}

RectLight interior_light(const Mesh& mesh, const Bounds& box, const Vec3& anchor) {
    // Under the ceiling; where there is none, above the roof. Walls are far off and oblique: twice
    // the light.
    const ProbeHit above = probe(mesh, anchor, {Vec3(0, 1, 0)})[0];
    Vec3 center = anchor;
    center.y = hit(above) ? center.y + 0.9f * above.distance : box.upper.y + 0.05f * box.extent().y;
    const float width = std::min(box.extent().x, box.extent().z);
    return light_towards(anchor, center, (hit(above) ? 0.25f : 0.5f) * width, 2 * kIrradiance);
}

/// Irradiance on the model's box if all its emitted power fell on it evenly.
double own_irradiance(const Scene& scene, const Bounds& box) {
    const Mesh& mesh = scene.meshes[0];
    double power = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Vec3 emission = scene.materials[mesh.material_of[i]].emission;
        if (emission == Vec3(0)) continue;
        const UVec3& t = mesh.triangles[i];
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        if (std::isfinite(area)) power += kPi * area * (emission.x + emission.y + emission.z) / 3;
    }
    const glm::dvec3 e(box.extent());
    return power / (2 * (e.x * e.y + e.y * e.z + e.z * e.x));
}

/// From the front and right, a little above; where that shows hardly anything lit though the model
/// has lamps (the back of a backdrop, most often), from another side.
Camera object_camera(const Scene& scene, const Bounds& box, bool has_light) {
    const std::array<Vec3, 4> sides{Vec3(0.55f, 0.4f, 1), Vec3(-0.55f, 0.4f, 1),
                                    Vec3(0.55f, 0.4f, -1), Vec3(-0.55f, 0.4f, -1)};
    Camera best;
    int most_lit = -1;
    for (const Vec3& side : sides) {
        const Camera camera = looking_from(box, glm::normalize(side), kObjectFov_rad, scene.film);
        if (!has_light) return camera;
        const ViewLight view = look_for_light(scene, camera);
        const int lit = view.lit + view.shining;
        // The usual side stays unless another shows twice as much.
        if (most_lit >= 0 && lit <= 2 * most_lit) continue;
        best = camera;
        most_lit = lit;
    }
    return best;
}

std::string shown(const Vec3& v) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z);
}

/// Lamps of a model are as bright as their author's program showed them; ours shows what they give.
void expose_dim_light(Scene& scene, const ViewLight& view) {
    if (!(view.irradiance > 0) || view.irradiance >= kDimIrradiance) return;
    constexpr float kMostStops = 10;
    scene.defaults.exposure = std::min(kMostStops, std::round(-std::log2(view.irradiance)));
    log_info(fmt::format("{}: its light is dim; images for the eye are exposed by {:+} stops",
                         scene.name, scene.defaults.exposure));
}

}  // namespace

void add_default_view(Scene& scene) {
    const Mesh& mesh = scene.meshes[0];
    const Bounds box = scene_bounds(scene);
    if (box.empty() || !(glm::length(box.extent()) > 0))
        throw Error(ErrorKind::bad_input,
                    scene.name + ".obj: empty mesh: no triangle with finite vertices and an area");

    const std::optional<Vec3> interior = find_interior(mesh, box);
    const bool bright = own_irradiance(scene, box) >= kDim;
    const bool can_look = bright && mesh.triangles.size() <= kMostLitTriangles;
    scene.camera = interior ? interior_camera(mesh, box, *interior, scene.film)
                            : object_camera(scene, box, can_look);
    log_info(fmt::format("{}: no camera given; seen {} from {} towards {}", scene.name,
                         interior ? "as an interior" : "as an object", shown(scene.camera.position),
                         shown(scene.camera.target)));

    // Lamps may be there and yet hide from this view, or turn their backs.
    const ViewLight view = can_look ? look_for_light(scene, scene.camera) : ViewLight{};
    if (bright && 4 * (view.lit + view.shining) >= view.seen) return expose_dim_light(scene, view);
    scene.rect_lights.push_back(interior ? interior_light(mesh, box, *interior)
                                         : object_light(box, scene.camera));
    scene.background = Vec3(kBackground);
    const RectLight& light = scene.rect_lights.back();
    log_info(fmt::format(
        "{}: {}; added a square of side {:.4g} at {}, radiance "
        "{:.4g}, and a background of {}",
        scene.name, bright ? "its light does not reach what is seen" : "no light to speak of",
        glm::length(light.edge_u), shown(light.center), light.radiance.x, kBackground));
}

}  // namespace wedge::scene
