"""Writes an exported scene (scene.json beside meshes/ and textures/) as LuxCore properties.

    python3 luxcore_properties.py EXPORT      # prints them: the scene's, then the render's

Needs nothing but Python. docs/peers.md lists all conventions.
"""

import math
import os
import sys

import exported_scene


def numbers(values):
    return [float(v) for v in values]


def add_image(out, name, image, folder):
    """Texels are linear; LuxCore's v = 0 is the top row, Wedge's the bottom row."""
    key = "scene.textures." + name
    (su, sv), (ou, ov) = image["scale"], image["offset"]
    out[key + ".type"] = "imagemap"
    out[key + ".file"] = os.path.join(folder, image["file"])
    out[key + ".gamma"] = 1.0
    out[key + ".storage"] = "float"
    out[key + ".wrap"] = "clamp" if image["clamp"] else "repeat"
    out[key + ".mapping.type"] = "uvmapping2d"
    out[key + ".mapping.uvscale"] = [float(su), -float(sv)]
    out[key + ".mapping.uvdelta"] = [float(ou), 1.0 - float(ov)]


def add_value(out, name, key, constant, image, folder):
    if image:
        add_image(out, name, image, folder)
        out[key] = name
    else:
        out[key] = numbers(constant)


def add_material(out, name, surface, folder):
    key = "scene.materials." + name
    out[key + ".type"] = "matte"
    add_value(out, name + "_kd", key + ".kd", surface["kd"], surface.get("kd_image"), folder)
    if any(surface["emission"]):
        image = surface.get("emission_image")
        add_value(out, name + "_emission", key + ".emission", surface["emission"], image, folder)
        out[key + ".emission.gain"] = [1.0, 1.0, 1.0]
        out[key + ".emission.theta"] = 90.0


def field_of_view_deg(exported):
    """LuxCore's is that of the shorter side."""
    vertical = exported["camera"]["vertical_fov_rad"]
    width, height = exported["film"]["width"], exported["film"]["height"]
    return math.degrees(2 * math.atan(math.tan(vertical / 2) * min(1, width / height)))


def screen_window(film):
    """LuxCore's: the shorter side reaches from -1 to 1. Its row 0 is a pixel off (film y is turned to height - 1 - y
    where it is continuous, too), which moving the window by a pixel makes good."""
    width, height = film["width"], film["height"]
    x, y = max(1, width / height), max(1, height / width)
    pixel = 2 * y / height
    return [-x, x, -y - pixel, y - pixel]


def scene_properties(exported, folder):
    """All but the shapes, which are called mesh0, … and light0, … as their materials are."""
    out, camera = {}, exported["camera"]
    out["scene.camera.type"] = "perspective"
    out["scene.camera.lookat.orig"] = numbers(camera["position"])
    out["scene.camera.lookat.target"] = numbers(camera["target"])
    out["scene.camera.up"] = numbers(camera["up"])
    out["scene.camera.fieldofview"] = field_of_view_deg(exported)
    out["scene.camera.screenwindow"] = screen_window(exported["film"])
    out["scene.camera.autofocus.enable"] = False
    for name, surface, *_ in exported_scene.surfaces(exported, folder):
        add_material(out, name, surface, folder)
        out["scene.objects.%s.shape" % name] = name
        out["scene.objects.%s.material" % name] = name
    for i, point in enumerate(exported["points"]):
        key = "scene.lights.point%d" % i
        out[key + ".type"] = "point"
        out[key + ".position"] = numbers(point["position"])
        out[key + ".color"] = numbers(point["intensity"])
        out[key + ".gain"] = [1.0, 1.0, 1.0]
    if any(exported["background"]):
        out["scene.lights.sky.type"] = "constantinfinite"
        out["scene.lights.sky.color"] = numbers(exported["background"])
        out["scene.lights.sky.gain"] = [1.0, 1.0, 1.0]
    return out


def render_properties(exported):
    """LuxCore counts the edges of a path, as Mitsuba does; no clamping, filter or tone map."""
    depth = exported["bounces"] + 2
    return {
        "renderengine.type": "PATHCPU",
        "path.pathdepth.total": depth,
        "path.pathdepth.diffuse": depth,
        "path.pathdepth.glossy": depth,
        "path.pathdepth.specular": depth,
        "path.clamping.variance.maxvalue": 0.0,
        "path.forceblackbackground.enable": False,
        "lightstrategy.type": "LOG_POWER",
        "sampler.type": "SOBOL",
        "sampler.sobol.adaptive.strength": 0.0,
        "film.width": exported["film"]["width"],
        "film.height": exported["film"]["height"],
        "film.filter.type": "NONE",
        "film.noiseestimation.warmup": 0,
        "film.outputs.0.type": "RGB",
        "film.outputs.0.filename": "image.exr",
        "film.imagepipelines.0.0.type": "NOP",
    }


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    exported = exported_scene.read(sys.argv[1])
    exported_scene.require_lambert(exported, "LuxCore")
    for properties in (scene_properties(exported, sys.argv[1]), render_properties(exported)):
        for name, value in properties.items():
            values = value if isinstance(value, list) else [value]
            print(name, "=", *['"%s"' % v if isinstance(v, str) else int(v) if isinstance(v, bool) else v for v in values])
