"""Renders McGuire's Cornell box with Mitsuba 3, for comparison with Wedge.

    pip install mitsuba numpy
    python3 bench/peers/cornell_mitsuba.py path/to/CornellBox-Original.obj mitsuba.exr [samples]
    wedge render scenes/cornell-original.json --size 128x128 --bounces 3 --spp 2048 --sampler hash -o wedge.exr
    wedge compare wedge.exr mitsuba.exr

The scene is that of scenes/cornell-original.json. Mitsuba counts path vertices where Wedge counts
indirect bounces, so its depth is two more; it has no Russian roulette here.
"""

import os
import sys
import tempfile

import mitsuba as mi

mi.set_variant("scalar_rgb")

INDIRECT_BOUNCES = 3


def read_obj(path):
    """Vertices, and for each material its triangles as vertex indices."""
    vertices, triangles, material = [], {}, None
    for line in open(path):
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append([float(x) for x in words[1:4]])
        elif words[0] == "usemtl":
            material = words[1]
        elif words[0] == "f":
            corners = [int(word.split("/")[0]) for word in words[1:]]
            corners = [i - 1 if i > 0 else len(vertices) + i for i in corners]
            for k in range(2, len(corners)):
                triangles.setdefault(material, []).append((corners[0], corners[k - 1], corners[k]))
    return vertices, triangles


def read_mtl(path):
    """Diffuse colour and emission of each material."""
    materials, current = {}, None
    for line in open(path):
        words = line.split()
        if not words:
            continue
        if words[0] == "newmtl":
            current = materials[words[1]] = {"Kd": [0, 0, 0], "Ke": [0, 0, 0]}
        elif words[0] in ("Kd", "Ke"):
            current[words[0]] = [float(x) for x in words[1:4]]
    return materials


def make_shape(folder, name, vertices, triangles, material):
    """One mesh file a material: Mitsuba's OBJ reader takes no MTL."""
    path = os.path.join(folder, name + ".obj")
    with open(path, "w") as file:
        for v in vertices:
            file.write("v %r %r %r\n" % tuple(v))
        for t in triangles:
            file.write("f %d %d %d\n" % tuple(i + 1 for i in t))
    reflectance = {"type": "rgb", "value": material["Kd"]}
    shape = {
        "type": "obj",
        "filename": path,
        "face_normals": True,
        "bsdf": {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": reflectance}},
    }
    if any(material["Ke"]):
        shape["emitter"] = {"type": "area", "radiance": {"type": "rgb", "value": material["Ke"]}}
    return shape


def main():
    obj, out = sys.argv[1], sys.argv[2]
    samples = int(sys.argv[3]) if len(sys.argv) > 3 else 2048
    vertices, triangles = read_obj(obj)
    materials = read_mtl(os.path.splitext(obj)[0] + ".mtl")
    look = mi.ScalarTransform4f().look_at(origin=[0, 1, 3.9], target=[0, 1, 0], up=[0, 1, 0])
    film = {
        "type": "hdrfilm",
        "width": 128,
        "height": 128,
        "rfilter": {"type": "box"},
        "pixel_format": "rgb",
        "component_format": "float32",
    }
    scene = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": INDIRECT_BOUNCES + 2, "rr_depth": 1000},
        "sensor": {
            "type": "perspective",
            "fov": 39.3,
            "fov_axis": "y",
            "to_world": look,
            "film": film,
            "sampler": {"type": "independent", "sample_count": samples},
        },
    }
    with tempfile.TemporaryDirectory() as folder:
        for name, list_of_triangles in triangles.items():
            scene[name] = make_shape(folder, name, vertices, list_of_triangles, materials[name])
        image = mi.render(mi.load_dict(scene), seed=1)
    mi.Bitmap(image).write(out)


if __name__ == "__main__":
    main()
