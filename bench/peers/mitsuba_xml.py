"""Writes an exported scene (scene.json beside meshes/ and textures/) as Mitsuba 3 XML.

    python3 mitsuba_xml.py EXPORT        # writes EXPORT/mitsuba.xml

Needs nothing but Python. Flat Lambert surfaces become Mitsuba's own `diffuse`; those with a lobe or with
interpolated normals become `wedge_surface`, which mitsuba_surface.py defines: Mitsuba has no Phong or
Blinn-Phong lobe, and other rules for interpolated normals. docs/peers.md lists all conventions.
"""

import json
import math
import os
import sys
import xml.etree.ElementTree as xml

from exported_scene import farthest

# Of the distance from which the whole scene is seen; Mitsuba wants both planes of the view's frustum.
NEAR_SHARE, FAR_SHARE = 1e-4, 4.0


def number(value):
    return repr(float(value))


def numbers(values):
    return ", ".join(number(v) for v in values)


def add(parent, tag, **attributes):
    return xml.SubElement(parent, tag, {k: str(v) for k, v in attributes.items()})


def add_rgb(parent, name, value):
    add(parent, "rgb", name=name, value=numbers(value))


def add_image(parent, name, image):
    """Texels are linear; Mitsuba's v = 0 is the top row, Wedge's the bottom row."""
    texture = add(parent, "texture", type="bitmap", name=name)
    add(texture, "string", name="filename", value=image["file"])
    add(texture, "boolean", name="raw", value="true")
    add(texture, "string", name="format", value="variant")  # float32: half floats have 11 bits
    add(texture, "string", name="wrap_mode", value="clamp" if image["clamp"] else "repeat")
    (su, sv), (ou, ov) = image["scale"], image["offset"]
    to_uv = add(texture, "transform", name="to_uv")
    add(to_uv, "scale", x=number(su), y=number(-sv))
    add(to_uv, "translate", x=number(ou), y=number(1 - ov))


def add_value(parent, name, constant, image):
    if image:
        add_image(parent, name, image)
    else:
        add_rgb(parent, name, constant)


def add_surface(shape, material, smooth):
    if material["model"] == "lambert" and not smooth:
        both = add(shape, "bsdf", type="twosided")
        diffuse = add(both, "bsdf", type="diffuse")
        add_value(diffuse, "reflectance", material["kd"], material.get("kd_image"))
        return
    bsdf = add(shape, "bsdf", type="wedge_surface")
    add_value(bsdf, "kd", material["kd"], material.get("kd_image"))
    add_value(bsdf, "ks", material["ks"], material.get("ks_image"))
    add(bsdf, "float", name="exponent", value=number(material["exponent"]))
    add(bsdf, "string", name="model", value=material["model"])


def add_area_light(shape, radiance, image):
    add_value(add(shape, "emitter", type="area"), "radiance", radiance, image)


def add_meshes(scene, exported):
    for mesh in exported["meshes"]:
        material = exported["materials"][mesh["material"]]
        shape = add(scene, "shape", type="ply")
        add(shape, "string", name="filename", value=mesh["file"])
        if not mesh["smooth"]:
            add(shape, "boolean", name="face_normals", value="true")
        add_surface(shape, material, mesh["smooth"])
        if any(material["emission"]):
            add_area_light(shape, material["emission"], material.get("emission_image"))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add_rects(scene, exported):
    """Mitsuba's rectangle is [-1, 1]^2 and shines along +z; the surface itself is black."""
    for rect in exported["rects"]:
        u = [0.5 * x for x in rect["u"]]
        v = [0.5 * x for x in rect["v"]]
        n = cross(u, v)
        length = math.sqrt(sum(x * x for x in n))
        n = [x / length for x in n]
        rows = [[u[i], v[i], n[i], rect["center"][i]] for i in range(3)] + [[0, 0, 0, 1]]
        shape = add(scene, "shape", type="rectangle")
        to_world = add(shape, "transform", name="to_world")
        add(to_world, "matrix", value=" ".join(number(x) for row in rows for x in row))
        add_rgb(add(shape, "bsdf", type="diffuse"), "reflectance", [0, 0, 0])
        image = rect.get("image")
        if image:
            image = {"file": image, "clamp": True, "scale": [1, 1], "offset": [0, 0]}
        add_area_light(shape, rect["radiance"], image)


def add_other_lights(scene, exported):
    for point in exported["points"]:
        emitter = add(scene, "emitter", type="point")
        add(emitter, "point", name="position", **dict(zip("xyz", map(number, point["position"]))))
        add_rgb(emitter, "intensity", point["intensity"])
    if any(exported["background"]):
        add_rgb(add(scene, "emitter", type="constant"), "radiance", exported["background"])


def add_sensor(scene, exported):
    camera, film_size = exported["camera"], exported["film"]
    sensor = add(scene, "sensor", type="perspective")
    add(sensor, "string", name="fov_axis", value="y")
    add(sensor, "float", name="fov", value=number(math.degrees(camera["vertical_fov_rad"])))
    distance = farthest(exported)
    add(sensor, "float", name="near_clip", value=number(NEAR_SHARE * distance))
    add(sensor, "float", name="far_clip", value=number(FAR_SHARE * distance))
    to_world = add(sensor, "transform", name="to_world")
    add(
        to_world,
        "lookat",
        origin=numbers(camera["position"]),
        target=numbers(camera["target"]),
        up=numbers(camera["up"]),
    )
    film = add(sensor, "film", type="hdrfilm")
    add(film, "integer", name="width", value=film_size["width"])
    add(film, "integer", name="height", value=film_size["height"])
    add(film, "string", name="pixel_format", value="rgb")
    add(film, "string", name="component_format", value="float32")
    add(film, "rfilter", type="box")
    sampler = add(sensor, "sampler", type="$sampler")
    add(sampler, "integer", name="sample_count", value="$spp")


def to_xml(exported):
    """The document. Mitsuba counts the edges of a path: two for direct light, one more each bounce. Russian roulette
    is as Mitsuba has it by default: each renderer ends paths as it finds best."""
    scene = xml.Element("scene", version="3.0.0")
    add(scene, "default", name="spp", value=64)
    add(scene, "default", name="sampler", value="independent")
    depth = exported["bounces"] + 2
    integrator = add(scene, "integrator", type="path")
    add(integrator, "integer", name="max_depth", value=depth)
    add_sensor(scene, exported)
    add_meshes(scene, exported)
    add_rects(scene, exported)
    add_other_lights(scene, exported)
    xml.indent(scene)
    return xml.ElementTree(scene)


def write(folder):
    """Writes folder/mitsuba.xml and returns its path."""
    with open(os.path.join(folder, "scene.json")) as file:
        exported = json.load(file)
    path = os.path.join(folder, "mitsuba.xml")
    to_xml(exported).write(path, encoding="utf-8", xml_declaration=True)
    return path


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print(write(sys.argv[1]))
