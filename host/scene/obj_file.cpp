#include "host/scene/obj_file.hpp"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <limits>
#include <new>
#include <sstream>
#include <stdexcept>

#include "host/scene/asset_search.hpp"
#include "host/scene/mtl_file.hpp"
#include "host/scene/normals.hpp"
#include "host/scene/obj_text.hpp"
#include "host/scene/triangulate.hpp"
#include "wedge/error.hpp"
#include "wedge/log.hpp"

namespace wedge::scene {
namespace {

constexpr std::uintmax_t kLargestObj_bytes = 16ull << 30;

struct ParsedObj {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::vector<std::filesystem::path> mtl_of;  ///< per material
};

bool in_range(int index, std::size_t count, bool may_be_absent) {
    return index < 0 ? may_be_absent && index == -1 : std::size_t(index) < count;
}

/// The parser checks no ranges, and counts corners in 8 bits.
bool is_sound(const ParsedObj& obj) {
    const std::size_t positions = obj.attributes.vertices.size() / 3;
    const std::size_t normals = obj.attributes.normals.size() / 3;
    const std::size_t uvs = obj.attributes.texcoords.size() / 2;
    for (const auto& shape : obj.shapes) {
        std::size_t corners = 0;
        for (const unsigned char n : shape.mesh.num_face_vertices) corners += n;
        if (corners != shape.mesh.indices.size()) return false;
        for (const auto& index : shape.mesh.indices)
            if (!in_range(index.vertex_index, positions, false) ||
                !in_range(index.normal_index, normals, true) ||
                !in_range(index.texcoord_index, uvs, true))
                return false;
    }
    return true;
}

/// Not finite: overflowed, or written as no number.
void warn_of_non_finite(const ParsedObj& obj, const ObjFacts& facts, std::string_view text,
                        const std::filesystem::path& file) {
    std::size_t count = 0, first = 0;
    const auto& v = obj.attributes.vertices;
    for (std::size_t i = 0; i + 2 < v.size(); i += 3) {
        if (std::isfinite(v[i]) && std::isfinite(v[i + 1]) && std::isfinite(v[i + 2])) continue;
        if (count++ == 0) first = i / 3;
    }
    if (count)
        log_warning(
            fmt::format("{}:{}: {} vertices are not finite, this is the first; their triangles are "
                        "not rendered",
                        file.string(), line_of_vertex(text, first), count));
    const auto warn = [&](const BadLines& bad, const char* what, const char* instead) {
        if (bad.count)
            log_warning(fmt::format("{}:{}: {} {} are no numbers, this is the first; {}",
                                    file.string(), bad.first_line, bad.count, what, instead));
    };
    warn(facts.bad_normals, "normals", "the face's own are used");
    warn(facts.bad_uvs, "texture coordinates", "0 is used");
}

/// The parser throws where a file makes it allocate what is not there.
bool parse_text(std::istream& stream, MtlReader& mtl_reader, ParsedObj& obj, std::string& problem) {
    std::string remarks;
    try {
        return tinyobj::LoadObj(&obj.attributes, &obj.shapes, &obj.materials, &remarks, &problem,
                                &stream, &mtl_reader, /*triangulate=*/false,
                                /*default_vcols_fallback=*/false);
    } catch (const std::bad_alloc&) {
        problem = "it needs more memory than there is";
    } catch (const std::length_error&) {
        problem = "it names a size that cannot be";
    }
    return false;
}

ParsedObj parse(const std::filesystem::path& file, const LoadOptions& options) {
    std::string text = read_text(file, kLargestObj_bytes);
    const ObjFacts facts = scan_obj(text);
    MtlReader mtl_reader(file, options, facts.mtllib_lines);

    ParsedObj obj;
    std::istringstream stream(std::move(text));
    std::string problem;
    const bool sound = parse_text(stream, mtl_reader, obj, problem) && is_sound(obj);
    if (!sound || facts.may_overflow) {
        const std::string what = describe_bad_face(stream.view());
        if (!what.empty()) throw Error(ErrorKind::bad_input, file.string() + what);
        if (!sound)
            throw Error(ErrorKind::bad_input,
                        file.string() + ": cannot be read as OBJ: " + problem);
    }
    obj.mtl_of = mtl_reader.file_of();
    for (const BadCoordinate& bad : facts.bad_coordinates) {
        const std::size_t place = 3 * bad.vertex + std::size_t(bad.axis);
        if (place < obj.attributes.vertices.size())
            obj.attributes.vertices[place] = std::numeric_limits<float>::quiet_NaN();
    }
    warn_of_non_finite(obj, facts, stream.view(), file);
    return obj;
}

/// Builds a mesh corner by corner; corners that agree in all three indices share a vertex.
class MeshBuilder {
  public:
    MeshBuilder(const tinyobj::attrib_t& attributes, Mesh& mesh)
        : attributes_(attributes),
          mesh_(mesh),
          first_(attributes.vertices.size() / 3, kNone),
          has_normals_(!attributes.normals.empty()),
          has_uvs_(!attributes.texcoords.empty()) {}

    uint32_t vertex(const tinyobj::index_t& index) {
        uint32_t* link = &first_[std::size_t(index.vertex_index)];
        while (*link != kNone) {
            Split& split = splits_[*link];
            if (split.normal == index.normal_index && split.uv == index.texcoord_index)
                return *link;
            link = &split.next;
        }
        const uint32_t made = *link = uint32_t(splits_.size());
        splits_.push_back({index.normal_index, index.texcoord_index, kNone});
        mesh_.positions.push_back(position(index));
        if (has_normals_) mesh_.normals.push_back(normal(index.normal_index));
        if (has_uvs_) mesh_.uvs.push_back(uv(index.texcoord_index));
        return made;
    }

    Vec3 position(const tinyobj::index_t& index) const {
        const float* p = &attributes_.vertices[3 * std::size_t(index.vertex_index)];
        return {p[0], p[1], p[2]};
    }

  private:
    static constexpr uint32_t kNone = ~0u;
    struct Split {
        int normal, uv;
        uint32_t next;  ///< vertex at the same position
    };

    /// Unit; zero, which means the face's own, where there is none worth its name.
    Vec3 normal(int index) const {
        if (index < 0) return Vec3(0);
        const float* p = &attributes_.normals[3 * std::size_t(index)];
        const glm::dvec3 n(p[0], p[1], p[2]);
        const double length = glm::length(n);
        return std::isfinite(length) && length > 0 ? Vec3(n / length) : Vec3(0);
    }

    Vec2 uv(int index) const {
        if (index < 0) return Vec2(0);
        const float* p = &attributes_.texcoords[2 * std::size_t(index)];
        return std::isfinite(p[0]) && std::isfinite(p[1]) ? Vec2(p[0], p[1]) : Vec2(0);
    }

    const tinyobj::attrib_t& attributes_;
    Mesh& mesh_;
    std::vector<uint32_t> first_;  ///< per position of the file: a vertex, or none
    std::vector<Split> splits_;    ///< per vertex
    bool has_normals_, has_uvs_;
};

void add_face(MeshBuilder& builder, const tinyobj::index_t* corners, std::size_t count,
              uint32_t material, Mesh& mesh) {
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
        mesh.triangles.emplace_back(builder.vertex(corners[a]), builder.vertex(corners[b]),
                                    builder.vertex(corners[c]));
        mesh.material_of.push_back(material);
    };
    if (count == 3) return add(0, 1, 2);
    std::vector<Vec3> positions;
    for (std::size_t i = 0; i < count; ++i) positions.push_back(builder.position(corners[i]));
    for (const auto& [a, b, c] : triangulate(positions)) add(a, b, c);
}

/// Fills triangles and vertices; materials are numbered from `first_material`, and faces without
/// one get the number after the last. Returns whether there are such faces.
bool build(const ParsedObj& obj, uint32_t first_material, Mesh& mesh) {
    const uint32_t no_material = first_material + uint32_t(obj.materials.size());
    bool any_without = false;
    MeshBuilder builder(obj.attributes, mesh);
    for (const auto& shape : obj.shapes) {
        const tinyobj::index_t* corner = shape.mesh.indices.data();
        for (std::size_t face = 0; face < shape.mesh.num_face_vertices.size(); ++face) {
            const std::size_t count = shape.mesh.num_face_vertices[face];
            const int material = shape.mesh.material_ids[face];
            any_without |= material < 0;
            add_face(builder, corner, count,
                     material < 0 ? no_material : first_material + uint32_t(material), mesh);
            corner += count;
        }
    }
    return any_without;
}

}  // namespace

Mesh load_obj(const std::filesystem::path& file, const ObjOptions& how, Scene& scene,
              TextureSet& textures, const LoadOptions& options) {
    ParsedObj obj = parse(file, options);
    if (how.normals != NormalsMode::automatic) {
        // Forgetting the file's normals lets corners that differ in nothing else share a vertex.
        obj.attributes.normals.clear();
        for (auto& shape : obj.shapes)
            for (auto& index : shape.mesh.indices) index.normal_index = -1;
    }

    Mesh mesh;
    mesh.name = file.stem().string();
    const bool any_without_material = build(obj, uint32_t(scene.materials.size()), mesh);
    if (mesh.triangles.empty())
        throw Error(
            ErrorKind::bad_input,
            file.string() + ": empty mesh: the file has no faces (lines that begin with f)");
    if (how.normals == NormalsMode::smooth) make_smooth_normals(mesh);

    for (Material& material :
         convert_materials(obj.materials, obj.mtl_of, textures, how.normal_maps))
        scene.materials.push_back(std::move(material));
    if (any_without_material) {
        Material grey;
        grey.name = "default";
        scene.materials.push_back(grey);
    }
    return mesh;
}

}  // namespace wedge::scene
