// What a scene file can get wrong, and what it is told.
#include <cmath>

#include "tests/scene/support.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

/// The error of a scene in which one thing is wrong.
std::string error_of(const std::string& text) {
    return bad_input([&] { load_text(text); });
}
std::string error_of_camera(const std::string& camera) {
    return error_of(scene_text(camera));
}
std::string error_of_member(const std::string& member) {
    return error_of(scene_text("", member));
}
std::string error_of_light(const std::string& light) {
    return error_of_member("\"lights\": [" + light + "]");
}
std::string error_of_transform(const std::string& transform) {
    return error_of_member("\"instances\": [{\"mesh\": \"t\", \"transform\": " + transform + "}]");
}

}  // namespace

TEST_CASE("missing_files_and_folders_are_named") {
    TempFolder folder;
    CHECK(
        contains(bad_input([&] { load_scene(folder / "none.json"); }), "none.json: no such file"));
    CHECK(contains(bad_input([&] { load_scene(folder / "none.obj"); }), "none.obj: no such file"));
    std::filesystem::create_directory(folder / "folder.json");
    CHECK(contains(bad_input([&] { load_scene(folder / "folder.json"); }), "is a folder"));
    CHECK(contains(bad_input([&] { load_scene(folder.write("a.ply", "")); }), "\".ply\""));
    std::filesystem::create_symlink("/dev/zero", folder / "endless.json");
    CHECK(contains(bad_input([&] { load_scene(folder / "endless.json"); }), "not a regular file"));
}

TEST_CASE("syntax_errors_have_line_and_column") {
    // The second comma is the fault.
    CHECK(contains(error_of("{\n  \"film\": {\"width\": 1,,\n}}"), "scene.json:2:23: "));
    CHECK(contains(error_of("{"), "scene.json:1:"));
    CHECK(contains(error_of(""), "scene.json:1:1: "));
    CHECK(contains(error_of("{\n\n \"background\": 1e999}"), "scene.json:3:"));
    CHECK(contains(error_of("{\"name\": \"\xff\"}"), "scene.json:1:"));
}

TEST_CASE("comments_are_allowed") {
    CHECK_NOTHROW(load_text("// a scene\n/* of one triangle */" + scene_text()));
}

TEST_CASE("hostile_nesting_is_refused") {
    CHECK(contains(error_of(std::string(1000000, '[')), "nested deeper"));
    std::string objects;
    for (int i = 0; i < 100000; ++i) objects += "{\"a\":";
    CHECK(contains(error_of(objects), "nested deeper"));
}

TEST_CASE("keys_given_twice_are_refused") {
    CHECK(contains(error_of("{\"name\": \"a\", \"name\": \"b\"}"),
                   "\"name\" is given twice in one object, at the top"));
    CHECK(contains(error_of("{\"materials\": {\"a\": {}, \"b\": {\"kd\": 1, \"kd\": 0}}}"),
                   "\"kd\" is given twice in one object, in /materials/b"));
    // The same key in two objects is none of that.
    CHECK_NOTHROW(
        load_text(scene_text("", "", R"({"a": {"obj": "t.obj"}, "b": {"obj": "t.obj"}})")));
}

TEST_CASE("unknown_keys_suggest_the_nearest") {
    CHECK(contains(error_of_member(R"("lihgts": [])"),
                   "/lihgts: unknown key; did you mean \"lights\"?"));
    CHECK(
        contains(error_of_camera(R"({"position": [0,0,1], "target": [0,0,0], "vertical_fov": 3})"),
                 "/camera/vertical_fov: unknown key; did you mean \"vertical_fov_deg\"?"));
    CHECK(contains(error_of_member(R"("film": {"width": 1, "height": 1, "zebra": 2})"),
                   "known are \"width\", \"height\""));
}

TEST_CASE("wrong_types_have_a_json_pointer") {
    CHECK(contains(error_of("[]"), "scene.json: /: must be an object"));
    CHECK(contains(error_of_member(R"("film": {"width": "big", "height": 2})"),
                   "/film/width: must be a whole number, got \"big\""));
    CHECK(contains(error_of_member(R"("film": {"width": 1.5, "height": 2})"),
                   "whole number, got 1.5"));
    CHECK(contains(error_of_member(R"("lights": {})"), "/lights: must be an array"));
    CHECK(contains(error_of_member(R"("background": [1, 2])"),
                   "/background: must be a number or an array"));
    CHECK(contains(error_of_member(R"("background": [1, null, 2])"),
                   "/background/1: must be a number"));
    CHECK(contains(error_of_member(R"("name": 3)"), "/name: must be a string, got 3"));
    CHECK(
        contains(error_of_member(R"("materials": {"a/b": {"kd": true}})"), "/materials/a~1b/kd: "));
}

TEST_CASE("missing_members_are_named") {
    CHECK(contains(error_of("{}"), "\"camera\" is missing"));
    CHECK(contains(error_of_camera(R"({"position": [0,0,1]})"), "/camera: \"target\" is missing"));
    CHECK(contains(error_of_member(R"("film": {"width": 3})"), "/film: \"height\" is missing"));
}

TEST_CASE("films_have_sane_sizes") {
    CHECK(contains(error_of_member(R"("film": {"width": 0, "height": 4})"),
                   "between 1 and 65536, got 0"));
    CHECK(contains(error_of_member(R"("film": {"width": 4, "height": -1})"), "/film/height: "));
    CHECK(contains(error_of_member(R"("film": {"width": 65537, "height": 1})"), "got 65537"));
    CHECK(contains(error_of_member(R"("film": {"width": 1e30, "height": 1})"), "/film/width: "));
    CHECK(contains(error_of_member(R"("film": {"width": 65536, "height": 65536})"), "pixels"));
    CHECK(contains(error_of_member(R"("render": {"spp": 0})"), "/render/spp: "));
    CHECK(contains(error_of_member(R"("render": {"bounces": -1})"), "/render/bounces: "));
}

TEST_CASE("cameras_need_a_direction") {
    CHECK(contains(error_of_camera(R"({"position": [1,2,3], "target": [1,2,3]})"), "same point"));
    CHECK(contains(error_of_camera(R"({"position": [0,5,0], "target": [0,0,0]})"), "parallel"));
    CHECK(contains(error_of_camera(R"({"position": [0,0,5], "target": [0,0,0], "up": [0,0,-3]})"),
                   "parallel"));
    CHECK(contains(error_of_camera(R"({"position": [0,0,5], "target": [0,0,0], "up": [0,0,0]})"),
                   "/camera/up: must not be zero"));
    for (const char* fov : {"0", "180", "-10", "1000"})
        CHECK(contains(
            error_of_camera(R"({"position": [0,0,5], "target": [0,0,0], "vertical_fov_deg": )" +
                            std::string(fov) + "}"),
            "/camera/vertical_fov_deg: must be between 0 and 180"));
    CHECK(contains(error_of_camera(R"({"position": [0,0,1e300], "target": [0,0,0]})"),
                   "/camera/position/2: is too large"));
}

TEST_CASE("lights_have_an_area") {
    const auto rect = [](const char* u, const char* v) {
        return std::string(R"({"type": "rect", "center": [0,1,0], "radiance": 1, "u": )") + u +
               ", \"v\": " + v + "}";
    };
    CHECK(contains(error_of_light(rect("[0,0,0]", "[0,0,1]")), "/lights/0: zero-area light"));
    CHECK(contains(error_of_light(rect("[1,0,0]", "[2,0,0]")), "/lights/0: zero-area light"));
    CHECK(contains(error_of_light(rect("[1,0,0]", "[1,0,1]")), "perpendicular"));
    CHECK(contains(error_of_light(rect("[1e-30,0,0]", "[0,0,1e-30]")), "zero-area light"));
    CHECK_NOTHROW(
        load_text(scene_text("", "\"lights\": [" + rect("[1e-4,0,0]", "[0,0,1e-4]") + "]")));
    CHECK_NOTHROW(
        load_text(scene_text("", "\"lights\": [" + rect("[1e5,0,0]", "[0,0,1e5]") + "]")));
}

TEST_CASE("light_members_fit_together") {
    CHECK(contains(error_of_light(R"({"type": "rekt"})"),
                   "/lights/0/type: unknown type \"rekt\"; did you mean \"rect\"?"));
    const std::string start = R"({"type": "rect", "center": [0,1,0], "u": [1,0,0], "v": [0,0,1])";
    CHECK(contains(error_of_light(start + "}"), "either \"radiance\" or \"power\""));
    CHECK(contains(error_of_light(start + R"(, "radiance": 1, "power": 1})"), "either"));
    CHECK(contains(error_of_light(start + R"(, "radiance": 1e16})"),
                   "/lights/0/radiance: is more than a film can sum, 2.2518e+15"));
    CHECK(contains(error_of_light(start + R"(, "power": 1e17})"), "/lights/0/power: is too much"));
    CHECK(contains(error_of_member(R"("background": [0, 1e30, 0])"),
                   "/background: is more than a film can sum"));
    CHECK(contains(error_of_light(start + R"(, "radiance": -1})"),
                   "/lights/0/radiance: must not be negative, got -1"));
    CHECK(contains(error_of_light(start + R"(, "radiance": 1, "profile": "gauss"})"),
                   "/lights/0/profile"));
    CHECK(contains(error_of_light(start + R"(, "radiance": 1, "profile": "gaussian"})"),
                   "\"sigma\" is missing"));
    CHECK(
        contains(error_of_light(start + R"(, "radiance": 1, "profile": "gaussian", "sigma": -1})"),
                 "/lights/0/sigma: must be positive, got -1"));
    CHECK(contains(error_of_light(start + R"(, "radiance": 1, "sigma": 1})"), "gaussian"));
    CHECK(contains(error_of_light(R"({"type": "point", "position": [0,1,0]})"),
                   "\"intensity\" is missing"));
}

TEST_CASE("transforms_can_be_inverted") {
    CHECK(contains(error_of_transform(R"({"scale": 0})"),
                   "/instances/0/transform: cannot be inverted"));
    CHECK(contains(error_of_transform(R"({"scale": [1, 0, 1]})"), "cannot be inverted"));
    CHECK(
        contains(error_of_transform("[1,0,0,0, 1,0,0,0, 0,0,1,0, 0,0,0,1]"), "cannot be inverted"));
    CHECK(contains(error_of_transform("[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,1]"), "last row"));
    CHECK(contains(error_of_transform("[1,2,3]"), "16 numbers"));
    CHECK(contains(error_of_transform(R"({"rotate_deg": 3, "axis": [0,0,0]})"),
                   "/axis: must not be zero"));
    CHECK(contains(error_of_transform(R"({"axis": [0,1,0]})"), "rotate_deg"));
    CHECK(contains(error_of_transform(R"([{"scale": 1e30}, {"scale": 1e30}])"), "overflows"));
    // Small and mirrored is not flat.
    CHECK_NOTHROW(load_text(scene_text(
        "", R"("instances": [{"mesh": "t", "transform": {"scale": [-1e-4, 1e-4, 1e-4]}}])")));
}

TEST_CASE("gaussians_too_narrow_for_single_precision_are_refused") {
    const auto light = [](const std::string& sigma) {
        return R"({"type": "rect", "center": [0,0,0], "u": [1,0,0], "v": [0,0,1], "radiance": 1,
                   "profile": "gaussian", "sigma": )" +
               sigma + "}";
    };
    CHECK(contains(error_of_light(light("1e-30")), "/lights/0/sigma: is less than 1e-9"));
    CHECK_NOTHROW(load_text(scene_text("", "\"lights\": [" + light("1e-8") + "]")));
}

TEST_CASE("unknown_references_suggest_the_nearest") {
    CHECK(contains(error_of_member(R"("instances": [{"mesh": "tt"}])"),
                   "/instances/0/mesh: unknown mesh \"tt\"; did you mean \"t\"?"));
    CHECK(contains(
        error_of_member(
            R"("materials": {"floor": {}}, "instances": [{"mesh": "t", "material": "flor"}])"),
        "/instances/0/material: unknown material \"flor\"; did you mean \"floor\"?"));
    CHECK(contains(error_of_member(R"("instances": [])"), "/instances: is empty"));
}

TEST_CASE("meshes_say_where_they_are_from") {
    CHECK(contains(error_of(scene_text("", "", R"({"m": {}})")), "/meshes/m: needs either"));
    CHECK(contains(error_of(scene_text("", "", R"({"m": {"obj": "t.obj", "generate": "box"}})")),
                   "either"));
    CHECK(contains(error_of(scene_text("", "", R"({"m": {"obj": "u.obj"}})")),
                   "/meshes/m/obj: \"u.obj\" is not beside"));
    CHECK(contains(error_of(scene_text("", "", R"({"m": {"obj": "."}})")), "is not beside"));
    CHECK(contains(error_of(scene_text("", "", R"({"m": {"obj": "t.obj", "normals": "smoth"}})")),
                   "did you mean \"smooth\"?"));
    CHECK(contains(error_of(scene_text("", "", R"({"m": {"generate": "no such kind"}})")),
                   "scene.json: /meshes/m: "));
    CHECK(contains(
        error_of(scene_text("", "", R"({"m": {"generate": "box", "no_such_parameter": 1}})")),
        "/meshes/m"));
    CHECK(contains(error_of(scene_text("", "", "{}")), "/meshes: is empty"));
}

TEST_CASE("material_members_are_checked") {
    const auto material = [](const std::string& members) {
        return error_of_member("\"materials\": {\"m\": {" + members + "}}");
    };
    CHECK(contains(material("\"kd\": 1.5"), "/materials/m/kd: must be between 0 and 1, got 1.5"));
    CHECK(contains(material("\"kd\": [0, 0, -0.1]"), "/materials/m/kd/2: "));
    CHECK(contains(material("\"exponent\": -1"), "/materials/m/exponent: "));
    CHECK(contains(material("\"model\": \"fong\""), "did you mean \"phong\"?"));
    CHECK(contains(material("\"model\": \"lambert\", \"ks\": 0.5"), "has no \"ks\""));
    CHECK(contains(material("\"kd_texture\": \"\""), "names no file"));
    CHECK(contains(material("\"kd_texture\": {\"file\": \"a\", \"scael\": 2}"),
                   "did you mean \"scale\"?"));
}
