#!/usr/bin/env python3
"""Writes the scenes of this folder: places where filters are known to go wrong (docs/stability.md).

    python3 scenes/stability/make.py

The files are committed; this is how they were made. Lengths are in world units, y is up, and films are small,
because every scene is rendered many times.
"""
import json
import math
import pathlib
import struct
import zlib

HERE = pathlib.Path(__file__).parent


def rect(center, u, v, radiance, **more):
    return {"type": "rect", "center": center, "u": u, "v": v, "radiance": [radiance] * 3, **more}


def lamp(height, side, radiance, x=0.0, z=0.0):
    """A square that looks down."""
    return rect([x, height, z], [side, 0, 0], [0, 0, side], radiance)


def at(mesh, translate=(0, 0, 0), scale=1, material=None, **more):
    transform = {"scale": scale, **more, "translate": list(translate)}
    if scale == 1:
        del transform["scale"]
    if transform == {"translate": [0, 0, 0]}:
        return {"mesh": mesh, **({"material": material} if material else {})}
    item = {"mesh": mesh, "transform": transform}
    if material:
        item["material"] = material
    return item


def write(name, why, camera, meshes, lights, instances=None, film=(96, 72), bounces=0, **more):
    scene = {"name": name, "camera": camera, "film": {"width": film[0], "height": film[1]},
             "render": {"bounces": bounces, "spp": 64}, **more, "meshes": meshes}
    if instances:
        scene["instances"] = instances
    scene["lights"] = lights
    lines = []
    for key, value in scene.items():
        inner = "".join(f",\n        {json.dumps(item)}" for item in value)[1:] if isinstance(value, list) and value else ""
        if isinstance(value, dict) and key in ("meshes", "materials"):
            inner = "".join(f",\n        {json.dumps(k)}: {json.dumps(v)}" for k, v in value.items())[1:]
            lines.append(f'    "{key}": {{{inner}\n    }}')
        elif inner and not isinstance(value[0], (int, float)):
            lines.append(f'    "{key}": [{inner}\n    ]')
        else:
            lines.append(f'    "{key}": {json.dumps(value)}')
    (HERE / (name + ".json")).write_text("// " + why + "\n{\n" + ",\n".join(lines) + "\n}\n")


def view(position, target, fov=40):
    return {"position": position, "target": target, "vertical_fov_deg": fov}


PLANE = {"generate": "plane", "width": 20, "depth": 20}
BOX = {"generate": "box"}
BALL = {"generate": "sphere", "detail": 32}
FLAT = {"kd": 0.7}


def png(name, width, height, rgb):
    """Eight bits, RGB, rows from the top; `rgb(x, y)` gives bytes."""
    rows = b"".join(b"\0" + bytes(c for x in range(width) for c in rgb(x, y)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    (HERE / name).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                              + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def shadows():
    write("contact", "Two boxes under a large lamp: one rests on the ground, one hangs a pixel above it.",
          view([0, 2.2, 5], [0, 0.3, 0]), {"plane": PLANE, "box": BOX},
          [lamp(4, 2, 9)],
          [at("plane"), at("box", [-0.8, 0.5, 0]), at("box", [0.8, 0.535, 0])])
    wires = {f"wires{i}": {"generate": "wires", "count": 7, "radius": r, "height": 0.6, "ground": 1e-3, "seed": i}
             for i, r in ((1, 0.001), (2, 0.005), (3, 0.025))}
    write("wires", "Wires of 0.2, 1 and 5 % of the lamp's side: few rays meet them.",
          view([0, 5, 3], [0, 0, 0.2], 42), {"plane": PLANE, **wires}, [lamp(4, 1, 20)])
    write("two-depths", "A leaf close to the ground and a beam close to the lamp: one range of distances covers both.",
          view([0, 3.2, 4], [0, 0, 0.1], 42), {"plane": PLANE, "box": BOX}, [lamp(4, 2, 9)],
          [at("plane"), at("box", [-0.3, 0.12, 0.2], [0.7, 0.01, 0.7], rotate_deg=25),
           at("box", [0.4, 3.1, 0], [0.35, 0.02, 4])])
    write("wide-gap", "A lattice right above the ground seen far away, and the lamp close to it: slopes over two decades.",
          view([0, 2.6, 4.2], [0, 0.1, 0.2], 42), {"grids": {"generate": "grids", "layers": 2, "bars": 8, "side": 2.6, "height": 0.06,
                                                         "spacing": 1.9, "thickness": 0.02, "ground": 20}},
          [lamp(2.4, 1.2, 8)])
    write("grazing-view", "The ground seen at two degrees: pixels are thirty times longer than wide.",
          view([0, 0.35, 9], [0, 0.02, 0], 12), {"plane": {"generate": "plane", "width": 40, "depth": 40}, "box": BOX},
          [lamp(4, 1.5, 14)], [at("plane"), at("box", [-0.6, 0.1, 0.6], 0.2), at("box", [0.3, 0.1, -1], 0.2),
                                at("box", [0.8, 0.1, 2.5], 0.2)])
    write("grazing-light", "A lamp at the horizon: shadows thirty times as long as high.",
          view([0, 3.2, 4], [0, 0, 0.1], 42), {"plane": PLANE, "box": BOX},
          [rect([-8, 0.4, 0], [0, 0.5, 0], [0, 0, 0.5], 600)],
          [at("plane"), at("box", [-0.8, 0.03, 0.1], [0.06, 0.06, 0.6]), at("box", [0.3, 0.015, -0.5], 0.03),
           at("box", [0.6, 0.03, 0.7], [0.3, 0.06, 0.06])])
    write("coplanar", "A lamp that lies in the wall behind, one that stands on the ground, one that touches both.",
          view([0.6, 1.6, 4], [0, 0.6, 0], 46), {"plane": PLANE, "box": BOX},
          [rect([0.9, 1.1, -1], [0.6, 0, 0], [0, 0.6, 0], 6),
           rect([-1.2, 0.25, 0.3], [0, 0.5, 0], [0, 0, 0.5], 8),
           rect([-0.4, 0.3, -0.999], [0.4, 0, 0], [0, 0.6, 0], 4)],
          [at("plane"), at("plane", [0, 0, -1], rotate_deg=90, axis=[1, 0, 0]), at("box", [0.3, 0.2, 0.4], 0.4)],
          bounces=1)
    write("empty", "Nothing between lamp and ground: no distance to take a width from.",
          view([0, 3.2, 4], [0, 0, 0.1], 42), {"plane": PLANE}, [lamp(4, 2, 9)])
    write("umbra", "A roof right under the lamp: no light in the middle, where nothing is to be filtered, and a wide penumbra around.",
          view([0, 3.2, 4], [0, 0, 0.1], 42), {"plane": PLANE, "box": BOX}, [lamp(4.2, 0.5, 90)],
          [at("plane"), at("box", [0, 3.6, 0], [0.8, 0.01, 0.8])])
    write("border", "A box in the way that all four borders of the image cut.",
          view([0, 3.4, 0.01], [0, 0, 0], 46), {"plane": PLANE, "box": BOX}, [lamp(4, 1.5, 14)],
          [at("plane")] + [at("box", [x, 0.5, z], s, rotate_deg=r) for x, z, s, r in
                           ((-1.55, 0.3, [0.3, 0.02, 1.5], 20), (1.5, -0.4, [0.3, 0.02, 1.5], -15),
                            (0.2, 1.15, [1.8, 0.02, 0.25], 8), (-0.1, -1.15, [1.8, 0.02, 0.25], -12))])
    write("odd-size", "A film whose sides are prime.", view([0, 3.6, 4.6], [0, 0.3, 0.1], 42),
          {"grids": {"generate": "grids", "layers": 2, "ground": 40}}, [lamp(5, 1.2, 25)], film=(97, 61))


def many():
    lights = []
    for i in range(64):
        x, z = i % 8 - 3.5, i // 8 - 3.5
        side = 0.05 * 20 ** ((i * 37 % 64) / 64)
        power = 10 ** (1.5 * (i * 23 % 64) / 64)
        color = [1, 0.6 + 0.4 * ((i * 7) % 5) / 4, 0.4 + 0.6 * ((i * 3) % 4) / 3]
        lights.append({"type": "rect", "center": [x * 0.9, 2.2 + 0.2 * (i % 3), z * 0.9], "u": [round(side, 4), 0, 0],
                       "v": [0, 0, round(side, 4)], "power": [round(0.35 * power * c, 4) for c in color]})
    boxes = [at("plane")] + [at("box", [1.3 * i, 0.3, 1.2 * j], 0.6, rotate_deg=20 * i + 35 * j)
                             for i in (-1, 0, 1) for j in (-1, 0, 1)]
    write("many-lights", "64 squares of sides over a factor of twenty and powers over one of thirty.",
          view([0, 3.4, 4.4], [0, 0.1, 0], 46), {"plane": PLANE, "box": BOX}, lights, boxes)
    write("shining-mesh", "A ball and a strip that shine, in sight, and no other light.",
          view([0, 2, 4.4], [0, 0.5, 0], 42), {"plane": PLANE, "box": BOX, "ball": {"generate": "sphere", "detail": 12}}, [],
          [at("plane"), at("ball", [-0.9, 1.2, 0], 0.25, "ball"), at("box", [0.9, 1.3, 0], [1, 0.03, 0.03], "strip"),
           at("box", [0, 0.2, 0.4], 0.4, rotate_deg=30)],
          bounces=1, materials={"ball": {"kd": 0, "emission": 12}, "strip": {"kd": 0, "emission": [30, 60, 40]}})


def indirect():
    corner = [at("plane"), at("plane", [0, 0, -1.5], rotate_deg=90, axis=[1, 0, 0]),
              at("plane", [-1.5, 0, 0], rotate_deg=-90, axis=[0, 0, 1])]
    write("corner", "A white corner lit from one side: what it sees is as near as one likes.",
          view([2.2, 2, 2.6], [-0.9, 0.5, -0.9], 40), {"plane": PLANE}, [lamp(3.5, 0.6, 40, 1, 1)], corner, bounces=2,
          materials={"plane/surface": {"kd": 0.8}})
    balls = [at("ball", [-1.6 + 3.2 * i / 7, r, 0.5 * (-1) ** i], r) for i, r in
             enumerate((0.9 * 0.62 ** k for k in range(8)))]
    write("curved", "Balls from half of the image to two pixels: no two neighbours share a plane.",
          view([0.2, 1.6, 4.4], [0, 0.35, 0], 36), {"plane": PLANE, "ball": BALL}, [lamp(4, 1.5, 14)],
          [at("plane")] + balls, bounces=1)
    write("silhouettes", "Columns at two heights, about two pixels wide: edges everywhere.",
          view([0, 5, 3.4], [0, 0.3, 0], 34), {"plane": PLANE, "box": BOX},
          [lamp(5, 1.5, 16, 1)],
          [at("plane")] + [at("box", [-1.5 + 0.13 * i, 0.25, -1.2 + 0.2 * j], [0.065, 0.5, 0.1])
                           for j in range(13) for i in range(24) if (i + j) % 2], bounces=1)
    write("normal-map", "Normals that change from texel to texel, two pixels apart, on flat ground.",
          view([0, 3.2, 4], [0, 0, 0.1], 42),
          {"plane": {"generate": "plane", "width": 8, "depth": 8, "uv_tiles": 8}, "box": BOX}, [lamp(4, 1.5, 14, -1)],
          [at("plane"), at("box", [0, 0.3, 0], 0.6, rotate_deg=30), at("box", [0.7, 1.2, 0.3], [0.8, 0.05, 0.8])],
          bounces=1, materials={"plane/surface": {"kd": 0.7, "normal_texture": "bumps.png"}})
    write("texture", "Black and white squares of one to two pixels at a low angle, and a black mat.",
          view([0, 1.2, 5], [0, 0, 0.3], 34),
          {"plane": {"generate": "plane", "width": 8, "depth": 8, "uv_tiles": 48}, "box": BOX}, [lamp(4, 1.5, 14, -1)],
          [at("plane"), at("box", [0, 0.3, 0], 0.6, rotate_deg=30), at("box", [-1.1, 0.005, 0.6], [0.9, 0.01, 0.7], "black")],
          bounces=1, materials={"plane/surface": {"kd_texture": "checker.png"}, "black": {"kd": 0}})


def gloss():
    write("near-mirror", "Lobes of exponents 10 to 10^5 beside each other, over a patterned ground.",
          view([0, 2.2, 4.4], [0, 0.45, 0], 40),
          {"plane": {"generate": "plane", "width": 8, "depth": 8, "uv_tiles": 8}, "ball": BALL, "box": BOX}, [lamp(4, 1.5, 14)],
          [at("plane")] + [at("box", [-1.35 + 0.9 * i, 0.6, -0.4], [0.8, 1.2, 0.05], f"m{i}", rotate_deg=-20, axis=[1, 0, 0])
                           for i in range(4)] + [at("ball", [-1 + i, 0.2, 0.7], 0.2) for i in range(3)],
          bounces=2, materials={"plane/surface": {"kd": [0.6, 0.5, 0.4], "kd_texture": "checker.png"},
                                **{f"m{i}": {"kd": 0.05, "ks": 0.8, "exponent": e, "model": "phong"}
                                   for i, e in enumerate((10, 100, 3000, 100000))}})
    write("caustic", "A nearly perfect mirror throws the lamp's light on the ground: bright paths that few samples find.",
          view([0.6, 2.6, 4], [-0.3, 0.2, 0], 40), {"plane": PLANE, "box": BOX}, [rect([1.6, 1.2, 0], [0, 0, 0.5], [0, 0.5, 0], 30)],
          [at("plane"), at("box", [-1.2, 0.8, 0], [0.05, 1.6, 2], "mirror"), at("box", [1.9, 1.2, 0], [0.05, 0.8, 0.8])],
          bounces=2, materials={"mirror": {"kd": 0.02, "ks": 0.9, "exponent": 2000, "model": "phong"}})
    write("gloss", "Glossy ground under balls, exponents of 30 and 200.",
          view([0, 2, 4.4], [0, 0.3, 0], 38), {"plane": PLANE, "ball": BALL}, [lamp(4, 1, 24, 1)],
          [at("plane", material="ground"), at("ball", [-0.8, 0.5, 0], 0.5, "red"), at("ball", [0.5, 0.4, 0.4], 0.4, "shiny"),
           at("ball", [0.9, 0.3, -0.8], 0.3)],
          bounces=2, materials={"ground": {"kd": 0.3, "ks": 0.4, "exponent": 200, "model": "phong"},
                                "red": {"kd": [0.7, 0.2, 0.1]}, "shiny": {"kd": 0.2, "ks": 0.6, "exponent": 30, "model": "phong"}})
    write("fireflies", "A small strong lamp that only looks at a wall close by: nearly all light is indirect, with rare bright paths.",
          view([0, 2.2, 4], [0, 0.6, 0], 42), {"plane": PLANE, "box": BOX},
          [rect([-1, 0.8, -1.0], [0.1, 0, 0], [0, -0.1, 0], 4000)],
          [at("plane"), at("plane", [0, 0, -1.1], rotate_deg=90, axis=[1, 0, 0]),
           at("box", [-1, 0.8, -0.98], [0.3, 0.3, 0.01]), at("box", [0.5, 0.3, 0], 0.6, rotate_deg=20)], bounces=2)


def scales():
    def room(name, why, s=1.0, offset=(0.0, 0.0, 0.0), distance=1.0):
        def p(v):
            return [s * a + o for a, o in zip(v, offset)]
        eye, target = [0, 0.3 + 1.9 * distance, 4.4 * distance], [0, 0.3, 0]
        fov = 2 * math.degrees(math.atan(math.tan(math.radians(19)) / distance))
        write(name, why, view(p(eye), p(target), fov), {"plane": PLANE, "box": BOX, "ball": BALL},
              [rect(p([0.5, 3, 0]), [s, 0, 0], [0, 0, s], 20)],
              [at("plane", p([0, 0, 0]), s), at("ball", p([-0.6, 0.5, 0]), 0.5 * s),
               at("box", p([0.7, 0.3, 0.3]), 0.6 * s, rotate_deg=30)], bounces=1)
    room("scale-1", "A ball and a box of about one unit.")
    room("scale-1e-4", "The same in units ten thousand times as long.", 1e-4)
    room("scale-1e5", "The same in units a hundred thousand times as short.", 1e5)
    room("offset", "The same, a thousand units from the origin.", offset=(1000.0, 600.0, -800.0))
    room("far-camera", "The same through a telescope, five hundred times as far away.", distance=500.0)


def energy():
    write("furnace", "A white ball in a white world: it cannot be seen, radiance is 1 everywhere.",
          view([0, 0, 4], [0, 0, 0], 40), {"ball": BALL}, [], bounces=1, background=[1, 1, 1],
          materials={"sphere/surface": {"kd": 1}})
    write("sky", "Boxes on the ground under an even sky: light from everywhere, shadows without edges.",
          view([0, 2.4, 4.4], [0, 0.2, 0], 40), {"plane": PLANE, "box": BOX}, [],
          [at("plane"), at("box", [-0.6, 0.5, 0], 1), at("box", [0.7, 0.25, 0.3], 0.5, rotate_deg=30)],
          bounces=1, background=[0.8, 0.9, 1], materials={"plane/surface": FLAT, "box/surface": FLAT})


def bumps(x, y):
    angle = (x * 7 + y * 13) * 2.399963
    tilt = 0.5 * ((x * 5 + y * 11) % 7) / 6
    n = (tilt * math.cos(angle), tilt * math.sin(angle), math.sqrt(1 - tilt * tilt))
    return [round(127.5 * (c + 1)) for c in n]


if __name__ == "__main__":
    png("checker.png", 2, 2, lambda x, y: [230] * 3 if (x + y) % 2 else [13] * 3)
    png("bumps.png", 16, 16, bumps)
    shadows()
    many()
    indirect()
    gloss()
    scales()
    energy()
