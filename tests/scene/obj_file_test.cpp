// OBJ and MTL files: what they mean, and what they can get wrong.
#include <cmath>

#include "tests/scene/support.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

Scene load_obj_text(const std::string& obj, const std::string& mtl = "") {
    TempFolder folder;
    if (!mtl.empty()) folder.write("m.mtl", mtl);
    return load_scene(folder.write("m.obj", obj));
}

std::string error_of(const std::string& obj) {
    return bad_input([&] { load_obj_text(obj); });
}

/// The only material of a triangle with this MTL.
Material material_of(const std::string& mtl) {
    const Scene scene =
        load_obj_text("mtllib m.mtl\nusemtl a\n" + kTriangleObj, "newmtl a\n" + mtl);
    REQUIRE(scene.materials.size() == 1);
    return scene.materials[0];
}

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("indices_out_of_range_name_line_face_and_index") {
    CHECK(contains(error_of(kTriangleObj + "\nf 1 2 9\n"),
                   "m.obj:6: face 2: vertex index 9 is out of range, the file has 3 vertices"));
    CHECK(contains(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n"),
                   "m.obj:4: face 1: vertex index 0"));
    CHECK(contains(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n"), "vertex index -4"));
    CHECK(contains(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n"), "normal index 1"));
    CHECK(contains(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/2\n"),
                   "texture coordinate index 2"));
    CHECK(contains(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999999999999\n"),
                   "out of range"));
    CHECK(contains(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n"), "\"x\" is no vertex index"));
    // Quads and longer polygons are checked alike.
    CHECK(contains(error_of(kSquare + "f 1 2 3 5\n"), "vertex index 5"));
    CHECK(contains(error_of(kSquare + "f 1 2 3 4 7\n"), "vertex index 7"));
}

TEST_CASE("indices_may_look_ahead_and_back") {
    const Scene scene = load_obj_text("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n");
    REQUIRE(scene.meshes[0].triangles.size() == 2);
    CHECK(scene.meshes[0].triangles[0] == scene.meshes[0].triangles[1]);
}

TEST_CASE("meshes_without_faces_are_refused") {
    CHECK(contains(error_of(""), "m.obj: empty mesh"));
    CHECK(contains(error_of("v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "empty mesh"));
    CHECK(contains(error_of("v 0 0 0\nv 1 0 0\nf 1 2\n"), "empty mesh"));
    CHECK(contains(error_of(std::string("\x7f\x45LF\0\1\2\xff\n\xfe", 10)), "empty mesh"));
    CHECK(contains(error_of("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 1\n"), "empty mesh"));
}

TEST_CASE("polygons_of_more_corners_than_can_be_counted_are_refused") {
    std::string obj, face = "f";
    for (int i = 0; i < 300; ++i) {
        obj.append("v ")
            .append(std::to_string(std::cos(i * 0.02)))
            .append(" ")
            .append(std::to_string(std::sin(i * 0.02)))
            .append(" 0\n");
        face.append(" ").append(std::to_string(i + 1));
    }
    CHECK(contains(error_of(obj + face + "\n"), "m.obj:301: face 1: has 300 corners"));
}

TEST_CASE("vertices_that_are_no_numbers_are_kept_and_counted") {
    LogCapture log;
    const Scene scene = load_obj_text(
        kTriangleObj + "v nan 0 0\nv 0 inf 0\nv 0 0 1e99\nv 0 0 1\nf 4 5 6\nf 1 2 7\n");
    CHECK(log.count("3 vertices are not finite") == 1);
    const Mesh& mesh = scene.meshes[0];
    REQUIRE(mesh.triangles.size() == 3);
    CHECK(!std::isfinite(mesh.positions[mesh.triangles[1].x].x));
    CHECK(!std::isfinite(mesh.positions[mesh.triangles[1].y].y));
    CHECK(!std::isfinite(mesh.positions[mesh.triangles[1].z].z));
    const Bounds bounds = scene_bounds({.meshes = {mesh}, .instances = {{}}});
    CHECK(bounds.lower == Vec3(0));
    CHECK(bounds.upper == Vec3(1));
}

TEST_CASE("vertices_are_shared_exactly_where_all_indices_agree") {
    const std::string points = kSquare + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nvn 0 1 1\n";
    const Scene shared = load_obj_text(points + "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n");
    CHECK(shared.meshes[0].positions.size() == 4);
    const Scene split_uv = load_obj_text(points + "f 1/1/1 2/2/1 3/3/1\nf 1/2/1 3/3/1 4/4/1\n");
    CHECK(split_uv.meshes[0].positions.size() == 5);
    const Scene split_normal = load_obj_text(points + "f 1/1/1 2/2/1 3/3/1\nf 1/1/2 3/3/2 4/4/2\n");
    const Mesh& mesh = split_normal.meshes[0];
    CHECK(mesh.positions.size() == 6);
    CHECK(mesh.uvs.at(mesh.triangles[0].y) == Vec2(1, 0));
    CHECK(mesh.normals.at(mesh.triangles[0].x) == Vec3(0, 0, 1));
    CHECK(glm::length(mesh.normals.at(mesh.triangles[1].x)) ==
          doctest::Approx(1));  // (0, 1, 1) made unit
}

TEST_CASE("normals_worth_nothing_become_zero") {
    const Scene scene = load_obj_text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn 1e99 0 0\nvn 0 0 2\nf 1//1 2//2 3//3\nf 1 2 3\n");
    const Mesh& mesh = scene.meshes[0];
    CHECK(mesh.normals.at(mesh.triangles[0].x) == Vec3(0));
    CHECK(mesh.normals.at(mesh.triangles[0].y) == Vec3(0));
    CHECK(mesh.normals.at(mesh.triangles[0].z) == Vec3(0, 0, 1));
    CHECK(mesh.normals.at(mesh.triangles[1].z) == Vec3(0));  // a face without normals among others
    CHECK(load_obj_text(kTriangleObj).meshes[0].normals.empty());
}

TEST_CASE("missing_libraries_and_materials_are_grey") {
    LogCapture log;
    const Scene scene = load_obj_text("mtllib none.mtl\nusemtl a\n" + kTriangleObj);
    CHECK(log.count("\"none.mtl\" is not beside it") == 1);
    REQUIRE(scene.materials.size() == 1);
    CHECK(scene.materials[0].name == "default");
    CHECK(scene.materials[0].diffuse == Vec3(0.5f));
    CHECK(scene.meshes[0].material_of.at(0) == 0);
}

TEST_CASE("byte_order_marks_are_passed_over") {
    const std::string mark = "\xEF\xBB\xBF";
    const Scene scene = load_obj_text(mark + "mtllib m.mtl\nusemtl a\n" + kTriangleObj,
                                      mark + "newmtl a\nKd 0.1 0.2 0.3\n");
    CHECK(scene.materials.at(0).diffuse == Vec3(0.1f, 0.2f, 0.3f));
    CHECK(load_obj_text(mark + kTriangleObj).meshes.at(0).positions.size() == 3);
}

TEST_CASE("libraries_are_found_whatever_their_case_blanks_and_separators") {
    for (const char* name :
         {"my colours.mtl", "MY Colours.MTL", ".\\my colours.mtl", "C:\\old\\my colours.mtl"}) {
        TempFolder folder;
        folder.write("my colours.mtl", "newmtl a\nKd 0.1 0.2 0.3\n");
        const Scene scene = load_scene(
            folder.write("m.obj", "mtllib " + std::string(name) + "\nusemtl a\n" + kTriangleObj));
        CHECK(scene.materials.at(0).diffuse == Vec3(0.1f, 0.2f, 0.3f));
    }
}

TEST_CASE("faces_keep_their_materials") {
    const Scene scene = load_obj_text(
        "mtllib m.mtl\n" + kTriangleObj + "usemtl b\nf 1 2 3\ng x\nusemtl a\nf 1 2 3\n",
        "newmtl a\nKd 0.1 0 0\nnewmtl b\nKd 0 0.2 0\n");
    const auto name = [&](int face) {
        return scene.materials.at(scene.meshes[0].material_of.at(face)).name;
    };
    CHECK(name(0) == "default");
    CHECK(name(1) == "b");
    CHECK(name(2) == "a");
}

TEST_CASE("illumination_models_decide_the_highlight") {
    CHECK(material_of("Kd 0.5 0.5 0.5\nKs 0.3 0.3 0.3\nNs 40\nillum 2\n").model ==
          SpecularModel::blinn_phong);
    CHECK(material_of("Kd 0.5 0.5 0.5\nKs 0.3 0.3 0.3\nNs 40\nillum 2\n").exponent == 40);
    CHECK(material_of("Kd 0.5 0.5 0.5\nKs 0.3 0.3 0.3\nillum 1\n").model == SpecularModel::none);
    CHECK(material_of("Kd 0.5 0.5 0.5\nKs 0.3 0.3 0.3\nillum 1\n").specular == Vec3(0));
    CHECK(material_of("Kd 0.5 0.5 0.5\nKs 0 0 0\nillum 2\n").model == SpecularModel::none);
    CHECK(material_of("Kd 0.5 0.5 0.5\nKs 0.1 0.1 0.1\nNs 1e9\nillum 2\n").exponent == 1e6f);
    CHECK(material_of("Kd -1 0.5 0.5\nKe 1 2 3\n").diffuse == Vec3(0, 0.5f, 0.5f));
    CHECK(material_of("Kd 0.5 0.5 0.5\nKe 1 2 3\n").emission == Vec3(1, 2, 3));
}

TEST_CASE("transparent_materials_are_opaque_and_said_so_once") {
    LogCapture log;
    load_obj_text("mtllib m.mtl\nusemtl a\n" + kTriangleObj,
                  "newmtl a\nd 0.5\nnewmtl b\nillum 7\nnewmtl c\nd 1\nillum 2\n");
    CHECK(log.count("2 transparent material(s) are rendered opaque: \"a\", \"b\"") == 1);
}

TEST_CASE("continued_lines_are_joined") {
    const Scene scene = load_obj_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n 3\n");
    CHECK(scene.meshes[0].triangles.size() == 1);
}
