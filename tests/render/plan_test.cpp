// Which effects a scene has, and what they cost.
#include <doctest/doctest.h>

#include "filter_scenes.hpp"
#include "host/render/plan.hpp"
#include "host/render/signal_filter.hpp"
#include "wedge/shared/filter.h"

namespace wedge::test {
namespace {

TEST_CASE("explain_names_what_a_plan_has_and_no_more") {
    const std::string matt = explain(make_room(0), filtered(1));
    CHECK(matt.find("soft shadows       filtered") != std::string::npos);
    CHECK(matt.find("indirect, diffuse  none") != std::string::npos);  // bounces = 0
    CHECK(matt.find("WEDGE_SPECULAR") == std::string::npos);
    RenderOptions bouncing = filtered(1);
    bouncing.bounces = 2;
    const std::string shiny = explain(make_room(20), bouncing);
    CHECK(shiny.find("indirect, gloss    filtered") != std::string::npos);
    CHECK(shiny.find("WEDGE_SPECULAR=1") != std::string::npos);
    CHECK(explain(make_room(0), quick(1, 0)).find("plain Monte Carlo") != std::string::npos);
}

TEST_CASE("explain_gives_the_reason_that_there_is") {
    // Gloss, but nothing that it could show.
    CHECK(explain(make_room(20), filtered(1)).find("none         no bounces and no background") !=
          std::string::npos);
    const std::string shiny = explain(make_room(20), filtered(1));
    CHECK(shiny.find("no visible material has a lobe") == std::string::npos);
    Scene scene = make_penumbra(LightProfile::uniform);
    scene.point_lights = {{.position = {0, 3, 0}, .intensity = Vec3(1e4f)}};
    CHECK(explain(scene, filtered(1)).find("most light is not of rectangles") != std::string::npos);
}

TEST_CASE("shadows_are_filtered_where_most_light_can_be") {
    // Nine equal lamps, of which four can be filtered; then one that outshines the others.
    Scene scene = make_penumbra(LightProfile::uniform);
    scene.rect_lights.resize(9, scene.rect_lights[0]);
    const char* filtering = "soft shadows       filtered";
    CHECK(explain(scene, filtered(1)).find(filtering) == std::string::npos);
    scene.rect_lights[7].radiance *= 20.0f;
    CHECK(explain(scene, filtered(1)).find(filtering) != std::string::npos);
    // A shining mesh counts as well, and a lamp of two triangles as the rectangle that it is.
    scene.rect_lights.resize(1);
    Material lamp = lambert(0);
    lamp.emission = Vec3(1e3f);
    scene.materials.push_back(lamp);
    scene.meshes.push_back(make_sphere({0, 9, 0}, 1, 8, false, 1));
    scene.instances.push_back({.mesh = uint32_t(scene.meshes.size() - 1)});
    CHECK(explain(scene, filtered(1)).find(filtering) == std::string::npos);
    RenderOptions bouncing = filtered(1);
    bouncing.bounces = 1;
    const char* others = "WEDGE_FILTER_OTHER_LIGHTS=1";
    CHECK(explain(scene, bouncing).find(others) != std::string::npos);
    scene.meshes.back() = make_quad({-1, 9, -1}, {2, 0, 0}, {0, 0, 2}, 1);
    CHECK(explain(scene, filtered(1)).find(filtering) != std::string::npos);
    CHECK(explain(scene, bouncing).find(others) == std::string::npos);
}

TEST_CASE("hues_of_shadows_are_kept_where_materials_differ_in_hue") {
    const auto has = [](const Scene& scene, const char* text) {
        return explain(scene, filtered(1)).find(text) != std::string::npos;
    };
    const char *define = "WEDGE_SHADOW_HUES=1", *line = "hues in shadows    yes";
    Scene scene = make_penumbra(LightProfile::uniform);
    scene.materials = {lambert(0.5f), lambert(0.2f), lambert(0)};
    CHECK_FALSE(has(scene, define));
    CHECK(has(scene, "hues in shadows    none"));
    scene.materials[1].diffuse = {0.5f, 0.4f, 0.4f};  // nothing is made of it
    CHECK_FALSE(has(scene, define));
    scene.instances.push_back({.mesh = 0, .material = 2});  // black has no hue
    CHECK_FALSE(has(scene, define));
    scene.instances.push_back({.mesh = 0, .material = 1});
    CHECK(has(scene, define));
    CHECK(has(scene, line));
    scene.rect_lights.clear();
    scene.background = Vec3(1);
    CHECK_FALSE(has(scene, define));
    Scene textured = make_penumbra(LightProfile::uniform);
    textured.textures.push_back({.image = {1, 1, TextureFormat::srgb8, {255, 0, 0, 255}}});
    textured.materials[0].diffuse_texture = 0;
    CHECK(has(textured, define));
    for (Mesh& mesh : textured.meshes) mesh.material_of.clear();  // all of the first material
    CHECK(has(textured, define));
}

TEST_CASE("lights_that_are_not_filtered_one_by_one_are_named") {
    const auto has = [](const Scene& scene, const char* text) {
        return explain(scene, filtered(1)).find(text) != std::string::npos;
    };
    Scene scene = make_penumbra(LightProfile::uniform);
    CHECK(has(scene, "other lamps        none"));
    CHECK_FALSE(has(scene, "WEDGE_POINT_LIGHTS_ALONE"));
    scene.point_lights = {{.position = {0, 2, 0}}};
    CHECK(has(scene, "other lamps        none"));
    CHECK(has(scene, "WEDGE_POINT_LIGHTS_ALONE=1"));
    Scene mesh = scene;
    mesh.materials[0].emission = Vec3(1);  // of two rectangles
    CHECK(explain(mesh, quick(1, 0)).find("other lamps        none") != std::string::npos);
    mesh.meshes[0].triangles.pop_back();
    mesh.meshes[0].material_of.pop_back();
    CHECK(explain(mesh, quick(1, 0)).find("other lamps        Monte Carlo") != std::string::npos);
    scene.rect_lights.resize(5, scene.rect_lights[0]);  // four of which are filtered by themselves
    CHECK(has(scene, "other lamps        filtered"));
    CHECK_FALSE(has(scene, "WEDGE_POINT_LIGHTS_ALONE"));
}

TEST_CASE("scenes_with_nothing_to_filter_are_plain_monte_carlo") {
    // Down to the samples: pixels that all get as many need no sequences of their own for halves.
    Scene scene = make_penumbra(LightProfile::uniform);
    scene.film = {24, 18};
    scene.rect_lights.clear();
    scene.point_lights.resize(9, {.position = {0, 2, 0}});
    RenderOptions options = filtered(1);
    options.samples_per_pixel = 24;
    const Image image = render(scene, options).image, plain = render(scene, quick(24, 0)).image;
    CHECK(channel_values(image, "G") == channel_values(plain, "G"));
}

TEST_CASE("lights_are_looked_at_four_times_where_paths_end") {
    const auto often = [](const Scene& scene, const RenderOptions& options) {
        return explain(scene, options).find("WEDGE_LIGHT_RAYS=4") != std::string::npos;
    };
    Scene scene = make_penumbra(LightProfile::uniform);
    CHECK(often(scene, filtered(1)));
    CHECK(often(scene, quick(1, 0)));
    CHECK_FALSE(often(scene, quick(1, 1)));
    CHECK_FALSE(often(make_room(20), quick(1, 0)));  // lobes look for lights, too
    scene.materials[0].emission = Vec3(1);           // of both rectangles
    CHECK(often(scene, quick(1, 0)));
    scene.meshes[0].triangles.pop_back();  // which is none any more
    scene.meshes[0].material_of.pop_back();
    CHECK_FALSE(often(scene, quick(1, 0)));
    scene = make_penumbra(LightProfile::uniform);
    scene.background = Vec3(1);
    CHECK_FALSE(often(scene, quick(1, 0)));
    scene.background = Vec3(0);
    scene.rect_lights.clear();
    CHECK_FALSE(often(scene, quick(1, 0)));
}

TEST_CASE("scenes_without_gloss_have_no_buffers_for_it") {
    Scene matt = make_room(0), shiny = make_room(20);
    matt.film = shiny.film = {32, 24};
    RenderOptions options = filtered(1);
    options.bounces = 1;
    const uint64_t more =
        render(shiny, options).stats.device_bytes - render(matt, options).stats.device_bytes;
    // One signal: sums, means and filtered means in two halves, distances, width. What distances
    // say of the pixel and of its neighbourhood, and errors, have room in the memory of means.
    const uint64_t entries = 32 * 24 * WEDGE_SURFACES;
    CHECK(more == entries * (32 + 64 + 16 + 4));
}

TEST_CASE("what_has_nothing_to_filter_has_an_error_all_the_same") {
    Scene scene = make_room(0);
    scene.rect_lights.clear();
    scene.point_lights.assign(1, {.position = {0, 0.5f, 0}});
    RenderOptions options = quick(16, 0);
    options.method = Method::aaf;
    options.estimate_error = true;
    REQUIRE(rendering::make_plan(scene, options.method, 0).signals == 0);
    CHECK(render(scene, options).stats.estimated_error);
}

TEST_CASE("memory_that_is_told_is_what_filters_take") {
    Scene scene = make_room(20);
    scene.film = {256, 192};
    for (int bounces : {0, 1}) {
        const auto bytes = [&](Method method) {
            RenderOptions options = quick(4, bounces);
            options.method = method;
            options.adaptive = false;
            return double(render(scene, options).stats.device_bytes);
        };
        double told = 0;
        for (const rendering::FilterBuffer& buffer : rendering::filter_buffers(
                 rendering::make_plan(scene, Method::aaf, bounces), 256 * 192))
            told += double(buffer.bytes);
        CHECK(told == doctest::Approx(bytes(Method::aaf) - bytes(Method::mc)).epsilon(0.01));
    }
}

}  // namespace
}  // namespace wedge::test
