#include "host/render/plan.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "host/render/lights.hpp"
#include "host/render/shining_rects.hpp"
#include "wedge/shared/filter.h"

namespace wedge::rendering {
namespace {

std::vector<bool> used_materials(const Scene& scene) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const Instance& instance : scene.instances) {
        if (instance.material) {
            used[*instance.material] = true;
            continue;
        }
        const std::vector<uint32_t>& materials = scene.meshes[instance.mesh].material_of;
        if (materials.empty() && !used.empty()) used[0] = true;
        for (uint32_t material : materials) used[material] = true;
    }
    return used;
}

/// With less than this share of the power of all lights, filters have little to do, and to sample
/// those lights one by one costs more than it gains.
constexpr double kLeastFilteredPower = 0.5;

/// Filters the shadows of the most powerful rectangles, each by itself, unless most light comes
/// from elsewhere; and all light of other flat lights at once.
void choose_filtered_lights(const Scene& scene, Plan& plan) {
    std::vector<double> powers;
    for (const RectLight& rect : scene.rect_lights) powers.push_back(light_power(rect));
    double flat = shining_power(scene), points = 0;
    for (const double power : powers) flat += power;
    for (const PointLight& point : scene.point_lights) points += light_power(point);
    for (const ShiningRect& rect : find_shining_rects(scene))
        powers.push_back(light_power(rect.light));
    const double all = flat + points;
    std::sort(powers.rbegin(), powers.rend());
    int count = 0;
    double filtered = 0;
    while (count < std::min(int(powers.size()), WEDGE_MAX_SHADOW_LIGHTS) &&
           powers[std::size_t(count)] > 0)
        filtered += powers[std::size_t(count++)];
    if (filtered < kLeastFilteredPower * all) {
        count = 0;
        filtered = 0;
    }
    plan.shadow_lights = count;
    plan.other_lights = filtered < flat - kNegligiblePower * all;
    plan.point_lights_alone = !plan.other_lights && points > kNegligiblePower * all;
}

/// Whether visible materials differ in the hue of what they reflect in all directions, by more
/// than rounding. Images may.
bool differ_in_hue(const Scene& scene, const std::vector<bool>& used) {
    constexpr float kSameHue = 1e-4f;
    std::optional<Vec3> first;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        const float most = std::max({m.diffuse.x, m.diffuse.y, m.diffuse.z});
        if (!used[i] || !(most > 0)) continue;
        if (m.diffuse_texture >= 0) return true;
        const Vec3 hue = m.diffuse / most;
        if (first && glm::length(hue - *first) > kSameHue) return true;
        first = first.value_or(hue);
    }
    return false;
}

/// What remains of a path that ends at its first hit is to look at lights, which costs less than to
/// get there. Not so where it goes on: for bounces, a lobe, or light that must be searched for.
constexpr int kLightRaysAtEnds = 4;

int light_rays(const Scene& scene, const Plan& plan, int bounces) {
    if (shines_beside_rects(scene) || plan.specular || has_hemisphere_light(scene, bounces))
        return 1;
    const bool any = !scene.rect_lights.empty() || shining_power(scene) > 0;
    return any ? kLightRaysAtEnds : 1;
}

}  // namespace

bool has_hemisphere_light(const Scene& scene, int bounces) {
    return bounces > 0 || scene.background != Vec3(0);
}

Plan make_plan(const Scene& scene, Method method, int bounces) {
    Plan plan;
    const std::vector<bool> used = used_materials(scene);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& m = scene.materials[i];
        if (!used[i]) continue;
        plan.specular |= m.model != SpecularModel::none && m.specular != Vec3(0);
        plan.textures |=
            m.diffuse_texture >= 0 || m.specular_texture >= 0 || m.emission_texture >= 0;
        plan.normal_maps |= m.normal_texture >= 0 || m.bump_texture >= 0;
    }
    plan.path_program.file = "kernels/path.cl";
    plan.path_program.defines = {"WEDGE_SAMPLE_BATCH=" + std::to_string(kSampleBatch)};
    if (plan.specular) plan.path_program.defines.push_back("WEDGE_SPECULAR=1");
    if (plan.textures) plan.path_program.defines.push_back("WEDGE_TEXTURES=1");
    if (plan.normal_maps) plan.path_program.defines.push_back("WEDGE_NORMAL_MAPS=1");
    plan.light_rays = light_rays(scene, plan, bounces);
    if (plan.light_rays > 1)
        plan.path_program.defines.push_back("WEDGE_LIGHT_RAYS=" + std::to_string(plan.light_rays));
    if (method == Method::aaf) {
        choose_filtered_lights(scene, plan);
        plan.shadow_hues = plan.shadow_lights > 0 && differ_in_hue(scene, used);
        plan.hemisphere = has_hemisphere_light(scene, bounces);
    }
    plan.direct_signals = plan.shadow_lights + plan.other_lights;
    plan.signals = plan.direct_signals + (plan.hemisphere ? 1 + plan.specular : 0);
    if (plan.signals > 0) {
        auto& defines = plan.path_program.defines;
        defines.push_back("WEDGE_SHADOW_LIGHTS=" + std::to_string(plan.shadow_lights));
        if (plan.shadow_hues) defines.push_back("WEDGE_SHADOW_HUES=1");
        if (plan.hemisphere) defines.push_back("WEDGE_FILTER_HEMISPHERE=1");
        if (plan.other_lights) defines.push_back("WEDGE_FILTER_OTHER_LIGHTS=1");
        if (plan.point_lights_alone) defines.push_back("WEDGE_POINT_LIGHTS_ALONE=1");
        plan.filter_programs = {{"kernels/distances.cl", defines},
                                {"kernels/bandwidth.cl", defines},
                                {"kernels/filter.cl", defines},
                                {"kernels/guard.cl", defines}};
    }
    return plan;
}

}  // namespace wedge::rendering
