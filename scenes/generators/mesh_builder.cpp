#include "scenes/generators/mesh_builder.hpp"

#include <algorithm>

namespace wedge::scenes {

uint32_t MeshBuilder::material(const Material& material) {
    const auto same_name = [&](const Material& other) { return other.name == material.name; };
    const auto found = std::find_if(materials_.begin(), materials_.end(), same_name);
    const auto index = uint32_t(found - materials_.begin());
    if (found == materials_.end()) materials_.push_back(material);
    return index;
}

uint32_t MeshBuilder::material(const std::string& name, const Vec3& diffuse) {
    Material matte;
    matte.name = name;
    matte.diffuse = diffuse;
    return material(matte);
}

uint32_t MeshBuilder::vertex(const Vec3& position, const Vec3& normal) {
    mesh_.positions.push_back(position);
    if (shading_ == Shading::smooth) mesh_.normals.push_back(normal);
    return uint32_t(mesh_.positions.size() - 1);
}

uint32_t MeshBuilder::vertex(const Vec3& position, const Vec3& normal, const Vec2& uv) {
    mesh_.uvs.push_back(uv);
    return vertex(position, normal);
}

void MeshBuilder::triangle(uint32_t a, uint32_t b, uint32_t c, uint32_t material) {
    mesh_.triangles.push_back({a, b, c});
    mesh_.material_of.push_back(material);
}

void MeshBuilder::quad(uint32_t a, uint32_t b, uint32_t c, uint32_t d, uint32_t material) {
    triangle(a, b, c, material);
    triangle(a, c, d, material);
}

void MeshBuilder::face(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                       uint32_t material) {
    const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    const uint32_t i = vertex(a, normal);
    const uint32_t j = vertex(b, normal);
    const uint32_t k = vertex(c, normal);
    const uint32_t l = vertex(d, normal);
    quad(i, j, k, l, material);
}

}  // namespace wedge::scenes
