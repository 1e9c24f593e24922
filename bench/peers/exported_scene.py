"""Reads what Wedge exports for other renderers: scene.json and meshes/*.ply (docs/peers.md).

Needs nothing but Python.
"""

import json
import math
import os
import struct


def read(folder):
    with open(os.path.join(folder, "scene.json")) as file:
        return json.load(file)


def require_lambert(exported, renderer):
    """Renderers that have neither Wedge's lobes nor its rules for interpolated normals must not guess."""
    faults = [m["name"] + ": has a " + m["model"] + " lobe" for m in exported["materials"] if m["model"] != "lambert"]
    faults += [
        "%s: has interpolated normals (%s)" % (exported["materials"][m["material"]]["name"], m["file"])
        for m in exported["meshes"]
        if m["smooth"]
    ]
    if faults:
        raise ValueError("%s has no counterpart of: %s" % (renderer, "; ".join(faults)))


def read_ply(path):
    """Positions and texture coordinates of vertices, and vertex indices of triangles; v = 0 is the bottom row."""
    with open(path, "rb") as file:
        header, counts = b"", {}
        while not header.endswith(b"end_header\n"):
            line = file.readline()
            if not line:
                raise ValueError(path + ": has no end_header")
            header += line
            words = line.split()
            if words[:1] == [b"element"]:
                counts[words[1]] = int(words[2])
        row = struct.Struct("<8f" if b"property float nx\n" in header else "<5f")
        vertices = list(row.iter_unpack(file.read(row.size * counts[b"vertex"])))
        face = struct.Struct("<B3i")
        faces = [f[1:] for f in face.iter_unpack(file.read(face.size * counts[b"face"]))]
    return [v[:3] for v in vertices], [v[-2:] for v in vertices], faces


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def camera_axes(camera):
    """Unit vectors of the world: right, up and backwards."""
    back = unit([p - t for p, t in zip(camera["position"], camera["target"])])
    right = unit(cross(camera["up"], back))
    return right, cross(back, right), back


def rect_corners(rect):
    """Counter-clockwise seen from where it shines, from texture coordinates (0, 0) to (0, 1)."""
    corner = lambda a, b: tuple(c + a * u + b * v for c, u, v in zip(rect["center"], rect["u"], rect["v"]))
    return [corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)]


def rect_surface(rect):
    """A light as a black material like those of meshes."""
    surface = {"kd": [0, 0, 0], "emission": rect["radiance"]}
    if rect.get("image"):
        surface["emission_image"] = {"file": rect["image"], "scale": [1, 1], "offset": [0, 0], "clamp": True}
    return surface


def surfaces(exported, folder):
    """Name, material, positions, texture coordinates and triangles of each mesh, and of each rectangular light."""
    for i, mesh in enumerate(exported["meshes"]):
        positions, uvs, triangles = read_ply(os.path.join(folder, mesh["file"]))
        yield "mesh%d" % i, exported["materials"][mesh["material"]], positions, uvs, triangles
    for i, rect in enumerate(exported["rects"]):
        uvs = [(0, 0), (1, 0), (1, 1), (0, 1)]
        yield "light%d" % i, rect_surface(rect), rect_corners(rect), uvs, [(0, 1, 2), (0, 2, 3)]


def farthest(exported):
    """From the camera to any point of the scene, at most."""
    camera, bounds = exported["camera"], exported["bounds"]
    corner = [
        max(abs(p - low), abs(p - high))
        for p, low, high in zip(camera["position"], bounds["lower"], bounds["upper"])
    ]
    return math.sqrt(sum(x * x for x in corner))
