"""Checks what the exporters for Cycles and LuxCore make of the scenes of peers_test.cpp, without these renderers.

    python3 exporters_check.py PEERS LAMBERT GLOSSY      # folders: of the scripts, of two exported scenes
"""

import math
import sys

peers, lambert, glossy = sys.argv[1:]
sys.path.insert(0, peers)

import exported_scene
import luxcore_properties


def close(a, b):
    return all(abs(x - y) < 1e-6 for x, y in zip(a, b)) and len(a) == len(b)


def check_surfaces(exported):
    floor, light = exported_scene.surfaces(exported, lambert)
    name, surface, positions, uvs, triangles = floor
    assert name == "mesh0" and surface["name"] == "floor"
    assert positions == [(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)], positions
    assert uvs == [(0, 0), (1, 0), (1, 1), (0, 1), (1, 1), (0, 1)], uvs
    assert triangles == [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 5)], triangles
    name, surface, positions, uvs, triangles = light
    assert name == "light0" and surface["kd"] == [0, 0, 0]
    assert surface["emission_image"]["file"] == "textures/light0.exr"
    # Edges x and z: it shines along their cross product, which looks down.
    a, b, c = (positions[i] for i in triangles[0])
    sides = [[q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]]
    assert close(exported_scene.unit(exported_scene.cross(*sides)), [0, -1, 0])


def check_camera(exported):
    right, up, back = exported_scene.camera_axes(exported["camera"])
    h = math.sqrt(10)
    assert close(right, [1, 0, 0]) and close(up, [0, 3 / h, -1 / h]) and close(back, [0, 1 / h, 3 / h])
    # A film as wide as high or wider: the vertical angle. One that is narrower: the horizontal.
    assert abs(luxcore_properties.field_of_view_deg(exported) - math.degrees(0.8)) < 1e-4
    tall = dict(exported, film={"width": 6, "height": 12})
    expected = math.degrees(2 * math.atan(math.tan(0.4) / 2))
    assert abs(luxcore_properties.field_of_view_deg(tall) - expected) < 1e-4


def check_luxcore(exported):
    scene = luxcore_properties.scene_properties(exported, lambert)
    assert scene["scene.materials.mesh0.kd"] == "mesh0_kd"
    assert scene["scene.textures.mesh0_kd.gamma"] == 1
    assert scene["scene.textures.mesh0_kd.mapping.uvscale"] == [1, -1]
    assert scene["scene.textures.mesh0_kd.mapping.uvdelta"] == [0, 1]
    # 16 x 12 px: one pixel of the height, which is 2, further down.
    assert close(scene["scene.camera.screenwindow"], [-4 / 3, 4 / 3, -1 - 1 / 6, 1 - 1 / 6])
    assert "scene.materials.mesh0.emission" not in scene
    assert scene["scene.materials.light0.emission"] == "light0_emission"
    assert close(scene["scene.lights.sky.color"], [0.2, 0.1, 0.4])
    render = luxcore_properties.render_properties(exported)
    assert render["path.pathdepth.total"] == 3  # one indirect bounce


def check_refusal():
    exported_scene.require_lambert(exported_scene.read(lambert), "X")
    try:
        exported_scene.require_lambert(exported_scene.read(glossy), "X")
    except ValueError as error:
        assert "floor: has a blinn_phong lobe" in str(error), error
        assert "floor: has interpolated normals" in str(error), error
        return
    raise AssertionError("a lobe is not refused")


exported = exported_scene.read(lambert)
check_surfaces(exported)
check_camera(exported)
check_luxcore(exported)
check_refusal()
