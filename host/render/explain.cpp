// The plan of a frame in words.
#include <fmt/format.h>

#include <algorithm>

#include "host/render/flatten.hpp"
#include "host/render/lights.hpp"
#include "host/render/long_triangles.hpp"
#include "host/render/plan.hpp"
#include "host/render/render_settings.hpp"
#include "host/render/shining_rects.hpp"
#include "host/render/signal_filter.hpp"
#include "wedge/render.hpp"

namespace wedge {
namespace {

using namespace rendering;

struct Line {
    std::string what, how, why;
};

std::string table(const std::vector<Line>& lines) {
    std::size_t what = 0, how = 0;
    for (const Line& line : lines) {
        what = std::max(what, line.what.size());
        how = std::max(how, line.how.size());
    }
    std::string text;
    for (const Line& line : lines) {
        std::string row =
            fmt::format("  {:<{}}  {:<{}}  {}", line.what, what, line.how, how, line.why);
        row.erase(row.find_last_not_of(' ') + 1);
        text += row + "\n";
    }
    return text;
}

Line shadows(const Scene& scene, const Plan& plan) {
    const std::size_t rects = scene.rect_lights.size() + find_shining_rects(scene).size();
    if (rects == 0) return {"soft shadows", "none", "no rectangle shines"};
    if (plan.signals == 0) return {"soft shadows", "Monte Carlo", "the method filters nothing"};
    if (plan.shadow_lights == 0)
        return {"soft shadows", plan.other_lights ? "as other lamps" : "Monte Carlo",
                rects > WEDGE_MAX_SHADOW_LIGHTS
                    ? fmt::format("most light is not of the {} most powerful of {} rectangles",
                                  WEDGE_MAX_SHADOW_LIGHTS, rects)
                    : "most light is not of rectangles"};
    std::string why = fmt::format("on diffuse surfaces seen directly; {} of {} shining rectangles",
                                  plan.shadow_lights, rects);
    if (std::size_t(plan.shadow_lights) < rects) why += ", the most powerful";
    return {"soft shadows", "filtered", why};
}

Line hues(const Plan& plan) {
    if (plan.shadow_lights == 0) return {"hues in shadows", "none", "no shadow is filtered"};
    return {"hues in shadows", plan.shadow_hues ? "yes" : "none",
            plan.shadow_hues ? "visible materials differ in hue, or have images"
                             : "visible materials have one hue"};
}

Line other_lamps(const Scene& scene, const Plan& plan) {
    const char* name = "other lamps";
    if (plan.other_lights)
        return {name, "filtered", "all at once, on diffuse surfaces seen directly"};
    const bool any = plan.signals == 0 && shines_beside_rects(scene);
    return {name, any ? "Monte Carlo" : "none",
            any ? "the method filters nothing" : "nothing shines but what is above"};
}

Line hemisphere(const char* name, bool is_there, const char* missing, bool filtered,
                const std::string& why) {
    if (!is_there) return {name, "none", missing};
    return {name, filtered ? "filtered" : "Monte Carlo", why};
}

Line thin_things(const Scene& scene, const Plan& plan) {
    const char* name = "thin things";
    if (plan.signals == 0) return {name, "Monte Carlo", "the method looks for nothing"};
    const FlatScene flat = flatten(scene);
    const std::size_t count = find_long_triangles(flat).size();
    if (count == 0) return {name, "none", "no triangle is four times as long as wide"};
    return {name, "looked for",
            fmt::format("{} of {} triangles are four times as long as wide", count,
                        flat.triangles.size())};
}

std::vector<Line> effects(const Scene& scene, const Plan& plan, int bounces) {
    std::vector<Line> lines{shadows(scene, plan), hues(plan), other_lamps(scene, plan)};
    const bool sky = scene.background != Vec3(0);
    const std::string from =
        bounces > 0 ? fmt::format("{} bounces{}", bounces, sky ? " and the background" : "")
                    : std::string("the background");
    const char* dark = "no bounces and no background";
    lines.push_back(
        hemisphere("indirect, diffuse", bounces > 0 || sky, dark, plan.hemisphere, from));
    lines.push_back(hemisphere("indirect, gloss", (bounces > 0 || sky) && plan.specular,
                               plan.specular ? dark : "no visible material has a lobe",
                               plan.hemisphere, from));
    lines.push_back({"highlights", plan.specular ? "Monte Carlo" : "none",
                     plan.specular ? "the theory has no filter for lobes under lights"
                                   : "no visible material has a lobe"});
    const bool points = !scene.point_lights.empty();
    lines.push_back(
        {"hard shadows", points ? "Monte Carlo" : "none",
         points ? fmt::format("{} point lights: nothing to filter", scene.point_lights.size())
                : "no point lights"});
    if (plan.light_rays > 1)
        lines.push_back({"light rays", fmt::format("{} a sample", plan.light_rays),
                         "paths end at the first hit, and to get there costs most"});
    lines.push_back(
        {"textures", plan.textures ? "yes" : "none",
         plan.textures ? "multiplied after filters" : "no visible material has an image"});
    lines.push_back({"normal maps", plan.normal_maps ? "yes" : "none",
                     plan.normal_maps ? "surfaces whose normals differ are filtered apart"
                                      : "no visible material bends its normal"});
    lines.push_back(thin_things(scene, plan));
    return lines;
}

std::vector<Line> programs(const Plan& plan) {
    std::vector<device::ProgramRequest> requests{plan.path_program};
    requests.insert(requests.end(), plan.filter_programs.begin(), plan.filter_programs.end());
    std::vector<Line> lines;
    for (const device::ProgramRequest& request : requests)
        lines.push_back({request.file, fmt::format("{}", fmt::join(request.defines, " ")), ""});
    return lines;
}

std::vector<Line> buffers(const Plan& plan, const Rect& crop) {
    const uint64_t pixels = uint64_t(crop.width) * uint64_t(crop.height);
    std::vector<Line> lines;
    const auto add = [&](std::string_view name, uint64_t bytes) {
        lines.push_back(
            {std::string(name), fmt::format("{:.1f} MiB", double(bytes) / (1 << 20)), ""});
    };
    add("film", pixels * sizeof(shared::FilmPixel));
    const std::vector<FilterBuffer> of_filters = filter_buffers(plan, pixels);
    for (std::size_t i = 0; i < of_filters.size();) {
        const std::string_view name = of_filters[i].name;
        uint64_t bytes = 0;
        for (; i < of_filters.size() && of_filters[i].name == name; ++i)
            bytes += of_filters[i].bytes;
        add(name, bytes);
    }
    return lines;
}

}  // namespace

std::string explain(const Scene& scene, const RenderOptions& options) {
    const PathSettings settings = make_path_settings(scene, options);
    const Plan plan = make_plan(scene, options.method, settings.bounces);
    std::string text =
        options.method == Method::aaf
            ? fmt::format("method: aaf, mu {:g}{}\n", options.mu.value_or(kDefaultMu),
                          plan.signals > 0 ? "" : "; nothing to filter, so plain Monte Carlo")
            : std::string("method: mc, plain Monte Carlo\n");
    text += "effects\n" + table(effects(scene, plan, settings.bounces));
    text += "kernels\n" + table(programs(plan));
    text += "buffers, beside the scene\n" + table(buffers(plan, settings.crop));
    return text;
}

}  // namespace wedge
