// wedge info: what is in a scene, counted; nothing is rendered and no device is needed.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "host/cli/asset_paths.hpp"
#include "host/cli/commands.hpp"
#include "host/cli/scene_census.hpp"
#include "host/cli/text.hpp"

namespace wedge::cli {
namespace {

using nlohmann::ordered_json;

struct InfoArguments {
    std::string scene;
    std::vector<std::string> asset_paths;
    bool as_json = false;
};

std::string text_of_vector(const Vec3& v) {
    return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z);
}

void print_line(const char* label, const std::string& text) {
    fmt::print("{:<12}{}\n", label, text);
}

void print_geometry(const SceneCensus& c) {
    print_line("meshes", fmt::format("{}: {} triangles, {} vertices", c.meshes,
                                     text_of_number(c.mesh_triangles), text_of_number(c.vertices)));
    print_line("instances", fmt::format("{}: {} triangles when placed", c.instances,
                                        text_of_number(c.placed_triangles)));
    print_line("unusable", fmt::format("{} degenerate, {} non-finite triangles, dropped by the "
                                       "renderer",
                                       text_of_number(c.degenerate_triangles),
                                       text_of_number(c.non_finite_triangles)));
    if (c.bounds.empty())
        print_line("bounds", "empty");
    else
        print_line("bounds",
                   fmt::format("{} to {}, extent {}", text_of_vector(c.bounds.lower),
                               text_of_vector(c.bounds.upper), text_of_vector(c.bounds.extent())));
}

void print_surfaces(const SceneCensus& c, const Scene& scene) {
    print_line("materials",
               fmt::format("{}: {} Lambert, {} Phong, {} Blinn-Phong; {} emit",
                           scene.materials.size(), c.lambert, c.phong, c.blinn_phong, c.emitting));
    print_line("textures",
               fmt::format("{}: {}", scene.textures.size(), text_of_bytes(c.texture_bytes)));
    for (const Texture& texture : scene.textures)
        print_line("", fmt::format("{}x{} {} {}", texture.image.width, texture.image.height,
                                   format_name(texture.image.format), texture.name));
}

void print_table(const SceneCensus& c, const Scene& scene) {
    print_line("scene", scene.name);
    print_geometry(c);
    print_surfaces(c, scene);
    print_line("lights",
               fmt::format("{} rectangles ({} gaussian), {} points, {} emitting triangles",
                           scene.rect_lights.size(), c.gaussian_lights, scene.point_lights.size(),
                           text_of_number(c.emitting_triangles)));
    print_line("background", text_of_vector(scene.background));
    print_line("camera", fmt::format("at {} towards {}, vertical field of view {:.4g} degrees",
                                     text_of_vector(scene.camera.position),
                                     text_of_vector(scene.camera.target),
                                     scene.camera.vertical_fov_rad * 180 / kPi));
    print_line("film",
               fmt::format("{}x{} px, {} samples per pixel, {} bounces, exposure {:g}",
                           scene.film.width, scene.film.height, scene.defaults.samples_per_pixel,
                           scene.defaults.bounces, scene.defaults.exposure));
}

ordered_json json_of(const Vec3& v) {
    return {v.x, v.y, v.z};
}

ordered_json json_of(const SceneCensus& c, const Scene& scene) {
    ordered_json json{{"scene", scene.name},
                      {"meshes", c.meshes},
                      {"mesh_triangles", c.mesh_triangles},
                      {"vertices", c.vertices},
                      {"instances", c.instances},
                      {"placed_triangles", c.placed_triangles},
                      {"degenerate_triangles", c.degenerate_triangles},
                      {"non_finite_triangles", c.non_finite_triangles},
                      {"materials",
                       {{"lambert", c.lambert},
                        {"phong", c.phong},
                        {"blinn_phong", c.blinn_phong},
                        {"emitting", c.emitting}}},
                      {"texture_bytes", c.texture_bytes},
                      {"textures", ordered_json::array()},
                      {"rect_lights", scene.rect_lights.size()},
                      {"gaussian_lights", c.gaussian_lights},
                      {"point_lights", scene.point_lights.size()},
                      {"emitting_triangles", c.emitting_triangles},
                      {"width", scene.film.width},
                      {"height", scene.film.height}};
    for (const Texture& texture : scene.textures)
        json["textures"].push_back({{"name", texture.name},
                                    {"width", texture.image.width},
                                    {"height", texture.image.height},
                                    {"format", format_name(texture.image.format)}});
    if (!c.bounds.empty())
        json["bounds"] = {{"lower", json_of(c.bounds.lower)}, {"upper", json_of(c.bounds.upper)}};
    return json;
}

void run(const InfoArguments& arguments) {
    const Scene scene = load_scene(arguments.scene, load_options(arguments.asset_paths));
    const SceneCensus census = take_census(scene);
    if (arguments.as_json)
        fmt::print(
            "{}\n",
            json_of(census, scene).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
    else
        print_table(census, scene);
    std::fflush(stdout);
}

}  // namespace

void register_info(CLI::App& app) {
    CLI::App* command = app.add_subcommand("info", "Count what is in a scene");
    auto arguments = std::make_shared<InfoArguments>();
    command->add_option("scene", arguments->scene, "Scene file (.json) or model (.obj)")
        ->required();
    command->add_option("--asset-path", arguments->asset_paths, kAssetPathHelp)
        ->type_name("DIR")
        ->allow_extra_args(false);
    command->add_flag("--json", arguments->as_json, "Print JSON");
    command->callback([arguments] { run(*arguments); });
}

}  // namespace wedge::cli
