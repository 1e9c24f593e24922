#include "host/scene/materials.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/base/edit_distance.hpp"
#include "wedge/log.hpp"

namespace wedge::scene {
namespace {

SpecularModel read_model(const JsonView& view) {
    const std::string name = view.string();
    if (name == "lambert") return SpecularModel::none;
    if (name == "phong") return SpecularModel::phong;
    if (name == "blinn_phong") return SpecularModel::blinn_phong;
    view.fail("unknown model \"" + name + "\"" +
              suggestion(name, {"lambert", "phong", "blinn_phong"}));
}

bool bends_normals(TextureRole role) {
    return role == TextureRole::normal || role == TextureRole::height;
}

TextureEdit read_texture(const JsonView& view, TextureRole role) {
    if (view.is_null()) return {};
    TextureUse use;
    use.role = role;
    use.is_color = !bends_normals(role);
    if (view.is_string()) {
        use.file = view.string();
    } else {
        view.allow_only({"file", "scale", "offset", "gain", "base", "clamp", "color"});
        use.file = view.require("file").string();
        if (const auto scale = view.find("scale"))
            use.scale = scale->is_number() ? Vec2(scale->number()) : scale->vec2();
        if (const auto offset = view.find("offset")) use.offset = offset->vec2();
        if (const auto gain = view.find("gain"))
            use.gain = gain->number(bends_normals(role) ? kAnyNumber : kNotNegative);
        if (const auto base = view.find("base")) use.base = base->number(kNotNegative);
        if (const auto clamp = view.find("clamp")) use.clamp = clamp->boolean();
        if (const auto color = view.find("color")) use.is_color = color->boolean();
    }
    if (use.file.empty()) view.fail("names no file; null stands for no texture");
    return {use};
}

MaterialEdit read_material(const JsonView& view) {
    view.allow_only({"kd", "ks", "exponent", "model", "kd_texture", "ks_texture", "emission",
                     "emission_texture", "normal_texture", "bump_texture"});
    MaterialEdit edit;
    if (const auto kd = view.find("kd")) edit.diffuse = kd->color(kUnit);
    if (const auto ks = view.find("ks")) edit.specular = ks->color(kUnit);
    if (const auto emission = view.find("emission")) edit.emission = emission->radiance();
    if (const auto m = view.find("exponent")) edit.exponent = m->number({0, kLargestExponent});
    if (const auto model = view.find("model")) edit.model = read_model(*model);
    const auto texture = [&](const char* key, TextureRole role, std::optional<TextureEdit>& out) {
        if (const auto member = view.find(key)) out = read_texture(*member, role);
    };
    texture("kd_texture", TextureRole::reflectance, edit.diffuse_texture);
    texture("ks_texture", TextureRole::reflectance, edit.specular_texture);
    texture("emission_texture", TextureRole::emission, edit.emission_texture);
    texture("normal_texture", TextureRole::normal, edit.normal_texture);
    texture("bump_texture", TextureRole::height, edit.bump_texture);

    const bool shines = edit.specular && *edit.specular != Vec3(0);
    if (edit.model == SpecularModel::none && shines)
        view.fail("the model \"lambert\" has no \"ks\"; choose \"phong\" or \"blinn_phong\"");
    return edit;
}

}  // namespace

MaterialEdits read_materials(const JsonView& materials) {
    MaterialEdits edits;
    for (const auto& [name, view] : materials.members()) edits.emplace(name, read_material(view));
    return edits;
}

void apply(const MaterialEdit& edit, Material& material, TextureSet& textures,
           const std::filesystem::path& scene_file) {
    const auto texture = [&](const std::optional<TextureEdit>& change, int& index) {
        if (change) index = change->use ? textures.add(*change->use, scene_file) : -1;
    };
    texture(edit.diffuse_texture, material.diffuse_texture);
    texture(edit.specular_texture, material.specular_texture);
    texture(edit.emission_texture, material.emission_texture);
    texture(edit.normal_texture, material.normal_texture);
    texture(edit.bump_texture, material.bump_texture);

    // A texture multiplies a constant: where only the texture is given, the constant is 1.
    const auto constant = [](const std::optional<Vec3>& given, int new_texture,
                             bool has_new_texture, Vec3& value) {
        if (given)
            value = *given;
        else if (has_new_texture && new_texture >= 0)
            value = Vec3(1);
    };
    const auto is_new = [](const std::optional<TextureEdit>& change) {
        return change && change->use;
    };
    constant(edit.diffuse, material.diffuse_texture, is_new(edit.diffuse_texture),
             material.diffuse);
    constant(edit.emission, material.emission_texture, is_new(edit.emission_texture),
             material.emission);
    if (edit.specular) material.specular = *edit.specular;

    const bool shines = material.specular != Vec3(0);
    if (edit.exponent) material.exponent = *edit.exponent;
    if (edit.model)
        material.model = *edit.model;
    else if (shines && material.model == SpecularModel::none)
        material.model = SpecularModel::blinn_phong;
    if (!shines || material.model == SpecularModel::none) {
        material.model = SpecularModel::none;
        material.specular = Vec3(0);
        material.specular_texture = -1;
    } else if (!edit.exponent && material.exponent == 0) {
        material.exponent = kDefaultExponent;
    }
}

std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t kMostListed = 6;
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), kMostListed); ++i)
        list += (i ? ", \"" : "\"") + names[i] + "\"";
    if (names.size() > kMostListed) list += fmt::format(" and {} more", names.size() - kMostListed);
    return list;
}

void conserve_energy(std::vector<Material>& materials, const std::string& file) {
    // A sum that is 1 but for rounding is left as written.
    constexpr float kRounding = 1e-5f;
    std::vector<std::string> scaled;
    for (Material& material : materials) {
        bool too_bright = false;
        for (int channel = 0; channel < 3; ++channel) {
            const float sum = material.diffuse[channel] + material.specular[channel];
            if (sum <= 1) continue;
            too_bright |= sum > 1 + kRounding;
            material.diffuse[channel] /= sum;
            material.specular[channel] /= sum;
        }
        if (too_bright) scaled.push_back(material.name);
    }
    if (!scaled.empty())
        log_warning(
            fmt::format("{}: {} material(s) reflect more than they receive (kd + ks > 1); both "
                        "are scaled down to a sum of 1: {}",
                        file, scaled.size(), listed(scaled)));
}

}  // namespace wedge::scene
