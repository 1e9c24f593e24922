// Puts a mesh together from vertices, faces and common solids.
#pragma once

#include <string>
#include <vector>

#include "wedge/scene.hpp"

namespace wedge::scenes {

/// `flat`: faces have their own normals and the mesh has no vertex normals. `smooth`: every vertex
/// has a normal, so flat faces in such a mesh do not share their vertices with their neighbours.
enum class Shading { flat, smooth };

class MeshBuilder {
  public:
    MeshBuilder(Mesh& mesh, std::vector<Material>& materials, Shading shading)
        : mesh_(mesh), materials_(materials), shading_(shading) {}

    /// Index of the material of this name, made if it is not there.
    uint32_t material(const std::string& name, const Vec3& diffuse);
    uint32_t material(const Material& material);

    /// Index of a new vertex. `normal`: unit, left out of flat meshes.
    uint32_t vertex(const Vec3& position, const Vec3& normal);
    uint32_t vertex(const Vec3& position, const Vec3& normal, const Vec2& uv);

    void triangle(uint32_t a, uint32_t b, uint32_t c, uint32_t material);
    /// Corners counter-clockwise seen from the front; split along a-c.
    void quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d, uint32_t material);
    /// A flat quad with vertices of its own.
    void face(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, uint32_t material);

    Mesh& mesh() { return mesh_; }

  private:
    Mesh& mesh_;
    std::vector<Material>& materials_;
    Shading shading_;
};

/// Square of side `side` in the plane y = `height`, centred on the y axis, facing up. 2 triangles.
void add_ground(MeshBuilder& builder, float side, float height, uint32_t material);

/// Box with centre, edges 2 * `half`, turned by `angle` about its vertical axis. 12 triangles,
/// closed.
void add_box(MeshBuilder& builder, const Vec3& center, const Vec3& half, float angle_rad,
             uint32_t material);

/// Sphere of `rings` bands from pole to pole and 2 * `rings` meridians; radius
/// r (1 + bumps sin(t) sin(7 t) cos(5 p)) at polar angle t and azimuth p.
/// 4 rings (rings - 1) triangles, closed, smooth.
void add_sphere(MeshBuilder& builder, const Vec3& center, float radius, int rings, float bumps,
                uint32_t material);

/// Tube about a line of two or more points, with a radius at each (> 0, the last one may be 0: a
/// tip). Flat caps. 2 sides (points - 1) + 2 sides triangles, less 2 sides with a tip; closed,
/// smooth.
void add_tube(MeshBuilder& builder, const std::vector<Vec3>& points,
              const std::vector<float>& radii, int sides, uint32_t material);

}  // namespace wedge::scenes
