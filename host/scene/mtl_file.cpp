#include "host/scene/mtl_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "host/scene/asset_search.hpp"
#include "host/scene/materials.hpp"
#include "host/scene/mtl_text.hpp"
#include "wedge/log.hpp"
#include "wedge/shared/radiance.h"

namespace wedge::scene {
namespace {

constexpr std::uintmax_t kLargestMtl_bytes = 256u << 20;

/// Colours below 0 and what is no number become 0.
Vec3 color(const tinyobj::real_t (&rgb)[3]) {
    Vec3 result(0);
    for (int channel = 0; channel < 3; ++channel)
        if (std::isfinite(rgb[channel])) result[channel] = std::max(0.0f, float(rgb[channel]));
    return result;
}

float finite(float value, float otherwise) {
    return std::isfinite(value) ? value : otherwise;
}

TextureUse texture_use(const std::string& file, const tinyobj::texture_option_t& options,
                       TextureRole role) {
    TextureUse use;
    use.file = file;
    use.role = role;
    use.scale = {finite(options.scale[0], 1), finite(options.scale[1], 1)};
    use.offset = {finite(options.origin_offset[0], 0), finite(options.origin_offset[1], 0)};
    use.gain = finite(options.contrast, 1);
    use.base = finite(options.brightness, 0);
    use.clamp = options.clamp;
    use.is_color = options.colorspace != "linear";
    if (role == TextureRole::normal || role == TextureRole::height) {
        use.is_color = false;
        use.gain *= finite(options.bump_multiplier, 1);
    }
    return use;
}

/// What stands for a diffuse map that cannot be had, where the constant beside it is black.
constexpr float kNeutral = 0.5f;

Material convert(const tinyobj::material_t& mtl, const std::filesystem::path& file,
                 TextureSet& textures, bool normal_maps) {
    const auto texture = [&](const std::string& name, const tinyobj::texture_option_t& options,
                             TextureRole role = TextureRole::reflectance) {
        return name.empty() ? -1 : textures.add(texture_use(name, options, role), file);
    };
    Material material;
    material.name = mtl.name;
    material.diffuse = color(mtl.diffuse);
    material.diffuse_texture = texture(mtl.diffuse_texname, mtl.diffuse_texopt);
    // Exporters write black beside a map, though the map multiplies the constant.
    if (!mtl.diffuse_texname.empty() && material.diffuse == Vec3(0))
        material.diffuse = Vec3(material.diffuse_texture >= 0 ? 1 : kNeutral);

    material.emission = glm::min(color(mtl.emission), Vec3(WEDGE_LARGEST_RADIANCE));
    material.emission_texture =
        texture(mtl.emissive_texname, mtl.emissive_texopt, TextureRole::emission);
    if (material.emission_texture >= 0 && material.emission == Vec3(0)) material.emission = Vec3(1);

    // Illumination models 0 and 1 have no highlight, all others do.
    const float exponent = std::isfinite(mtl.shininess) ? mtl.shininess : 0;
    material.exponent = std::clamp(exponent, 0.0f, kLargestExponent);
    const Vec3 specular = color(mtl.specular);
    if (mtl.illum >= 2 && specular != Vec3(0)) {
        material.model = SpecularModel::blinn_phong;
        material.specular = specular;
        material.specular_texture = texture(mtl.specular_texname, mtl.specular_texopt);
    }
    if (!normal_maps) return material;
    material.normal_texture = texture(mtl.normal_texname, mtl.normal_texopt, TextureRole::normal);
    const int bump = texture(mtl.bump_texname, mtl.bump_texopt, TextureRole::height);
    // Exporters without a keyword for normal maps put them where heights belong.
    const bool normals = textures.looks_like_normals(bump);
    if (normals && material.normal_texture < 0) material.normal_texture = bump;
    material.bump_texture = normals ? -1 : bump;
    return material;
}

bool is_transparent(const tinyobj::material_t& mtl) {
    // Models with "glass" or "refraction" in their definition.
    const bool refracts = mtl.illum == 4 || mtl.illum == 6 || mtl.illum == 7 || mtl.illum == 9;
    return refracts || mtl.dissolve < 1;
}

}  // namespace

MtlReader::MtlReader(const std::filesystem::path& obj, const LoadOptions& options,
                     std::vector<std::string> mtllib_lines)
    : obj_(obj), options_(options), lines_(std::move(mtllib_lines)) {}

std::vector<std::filesystem::path> MtlReader::find_libraries(const std::string& line) const {
    // One name with blanks in it, or several names: the format does not say.
    const auto folders = search_order(obj_, options_.asset_paths);
    if (const auto whole = find_file(line, folders)) return {*whole};
    std::vector<std::filesystem::path> found;
    std::istringstream words(line);
    for (std::string word; words >> word;)
        if (const auto file = find_file(word, folders)) found.push_back(*file);
    return found;
}

bool MtlReader::operator()(const std::string&, std::vector<tinyobj::material_t>* materials,
                           std::map<std::string, int>* index_of, std::string*, std::string* error) {
    if (done_) return true;
    done_ = true;
    for (const std::string& line : lines_) {
        const auto files = find_libraries(line);
        if (files.empty())
            log_warning(
                fmt::format("{}: material library \"{}\" is not beside it nor in the asset "
                            "paths; its materials are grey",
                            obj_.string(), line));
        for (const auto& file : files) {
            const std::string text = read_text(file, kLargestMtl_bytes);
            const std::string flaws = describe_bad_numbers(text);
            if (!flaws.empty()) log_warning(file.string() + flaws);
            std::istringstream stream(with_white_beside_maps(text));
            std::string remarks;  // about duplicates and the like: nothing to act on
            tinyobj::LoadMtl(index_of, materials, &stream, &remarks, error);
            file_of_.resize(materials->size(), file);
        }
    }
    return true;
}

std::vector<Material> convert_materials(const std::vector<tinyobj::material_t>& materials,
                                        const std::vector<std::filesystem::path>& file_of,
                                        TextureSet& textures, bool normal_maps) {
    std::vector<Material> result;
    std::vector<std::string> transparent;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        result.push_back(convert(materials[i], file_of[i], textures, normal_maps));
        if (is_transparent(materials[i])) transparent.push_back(materials[i].name);
    }
    if (!transparent.empty())
        log_warning(fmt::format("{}: {} transparent material(s) are rendered opaque: {}",
                                file_of[0].string(), transparent.size(), listed(transparent)));
    return result;
}

}  // namespace wedge::scene
