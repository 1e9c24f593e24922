"""A scene by chance, from a number: furniture, fences, wires, slats and balls of any size on ground and walls, under
lamps, points, shining boxes and skies. Nothing in it is meant to be easy or hard."""
import json

import numpy as np
from PIL import Image


class Model:
    """Faces with materials, as they go to an OBJ file."""

    def __init__(self):
        self.corners, self.places, self.faces = [], [], []

    def quad(self, origin, u, v, material):
        o, u, v = map(np.array, (origin, u, v))
        first = len(self.corners) + 1
        self.corners += [o, o + u, o + u + v, o + v]
        self.places += [(0, 0), (1, 0), (1, 1), (0, 1)]
        self.faces += [(material, (first, first + 1, first + 2)), (material, (first, first + 2, first + 3))]

    def box(self, middle, size, material, turn=0.0):
        a = np.array([np.cos(turn), 0, np.sin(turn)]) * size[0]
        b = np.array([0, size[1], 0])
        c = np.array([-np.sin(turn), 0, np.cos(turn)]) * size[2]
        o = np.array(middle) - (a + b + c) / 2
        for origin, u, v in ((o, a, c), (o + b, c, a), (o, b, a), (o + c, a, b), (o, c, b), (o + a, b, c)):
            self.quad(origin, u, v, material)

    def ball(self, middle, radius, material, steps=12):
        def place(i, j):
            up, around = np.pi * i / steps, np.pi * j / steps
            return np.array(middle) + radius * np.array(
                [np.sin(up) * np.cos(around), np.cos(up), np.sin(up) * np.sin(around)])

        for i in range(steps):
            for j in range(2 * steps):
                k = len(self.corners) + 1
                self.corners += [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)]
                self.places += [(0, 0)] * 4
                self.faces += [(material, (k + 3, k + 1, k)), (material, (k + 3, k + 2, k + 1))]

    def write(self, path):
        with open(path, "w") as file:
            file.write("mtllib scene.mtl\n")
            file.writelines("v %.6g %.6g %.6g\n" % tuple(c) for c in self.corners)
            file.writelines("vt %g %g\n" % p for p in self.places)
            for material, corners in sorted(self.faces, key=lambda face: face[0]):
                file.write(f"usemtl {material}\nf " + " ".join(f"{i}/{i}" for i in corners) + "\n")


def make_material(random, name, folder):
    """Lines of an MTL file: black, dull, glossy, a mirror's, or of squares of any colour."""
    kind = random.random()
    if kind < 0.15:
        return ["Kd 0 0 0"]
    if kind < 0.55:
        return ["Kd %.3f %.3f %.3f" % tuple(0.8 * random.random(3))]
    if kind < 0.75:
        kd, ks, exponent = 0.5 * random.random(), 0.4 * random.random(), int(10 ** (3 * random.random()))
        return [f"Kd {kd:.3f} {kd:.3f} {kd:.3f}", f"Ks {ks:.2f} {ks:.2f} {ks:.2f}", f"Ns {exponent}", "illum 2"]
    if kind < 0.85:
        return ["Kd 0 0 0", "Ks 0.7 0.7 0.7", f"Ns {int(10 ** (0.5 + 2 * random.random()))}", "illum 2"]
    squares = (255 * random.random((int(random.choice([2, 8, 64])),) * 2 + (3,)) ** 3).astype(np.uint8)
    Image.fromarray(squares).save(folder / f"{name}.png")
    return ["Kd 1 1 1", f"map_Kd {name}.png"]


def add_thing(random, model, material):
    kind = random.random()
    x, z = random.uniform(-1.5, 1.5, 2)
    if kind < 0.4:
        size = 10 ** random.uniform(-1.2, 0, 3)
        lifted = random.random() if random.random() < 0.3 else 0.0
        model.box([x, size[1] / 2 + lifted, z], size, material, 3 * random.random())
    elif kind < 0.6:
        count, width, step = int(random.integers(3, 30)), 10 ** random.uniform(-3, -1), 10 ** random.uniform(-1.5, -0.5)
        for k in range(count):
            model.box([x + (k - count / 2) * step, 0.4, z], [width, 0.8, width], material)
    elif kind < 0.75:
        for _ in range(int(random.integers(1, 8))):
            start, along = random.uniform(-1.5, 1.5, 3), random.uniform(-1, 1, 3)
            start[1] = abs(start[1])
            side = np.cross(along, [0, 0, 1])
            side *= 10 ** random.uniform(-3.3, -1.8) / np.linalg.norm(side)
            model.quad(start, along, side, material)
    elif kind < 0.9:
        count, step, height = int(random.integers(3, 20)), random.uniform(0.05, 0.4), random.uniform(0.1, 1.5)
        for k in range(count):
            width = step * random.uniform(0.2, 0.8)
            model.quad([x + (k - count / 2) * step, height, z + 1], [0, 0, -2], [width, 0, 0], material)
    else:
        radius = 10 ** random.uniform(-1.3, -0.2)
        model.ball([x, radius * (2 if random.random() < 0.3 else 1), z], radius, material)


def make_lights(random):
    lights = []
    for _ in range(int(random.choice([0, 1, 1, 1, 2, 3, 6]))):
        side, tilt = 10 ** random.uniform(-1.3, 0.3), random.uniform(-0.6, 0.6)
        light = {"type": "rect", "center": list(random.uniform([-2, 2, -1], [2, 4, 3])),
                 "u": [side * np.cos(tilt), side * np.sin(tilt), 0], "v": [0, 0, side * random.uniform(0.5, 1.5)],
                 "power": list(np.round(10 ** random.uniform(1, 2) * random.uniform(0.5, 1, 3), 2))}
        if random.random() < 0.3:
            light |= {"profile": "gaussian", "sigma": 0.25 * side}
        lights.append(light)
    if random.random() < 0.2:
        lights.append({"type": "point", "position": [random.uniform(-2, 2), 3, 2],
                       "intensity": 10 ** random.uniform(0, 1.5)})
    return lights


def make_scene(number, folder):
    """Writes scene.json and what it needs to a folder; the file's path."""
    random = np.random.default_rng(number)
    names = [f"m{k}" for k in range(int(random.integers(2, 6)))]
    materials = {name: make_material(random, name, folder) for name in names}
    model = Model()
    if random.random() < 0.8:
        model.quad([-4, 0, 4], [8, 0, 0], [0, 0, -8], random.choice(names))
    if random.random() < 0.4:
        model.quad([-4, 0, -2], [8, 0, 0], [0, 5, 0], random.choice(names))
    if random.random() < 0.3:
        model.quad([-2.5, 0, 4], [0, 0, -8], [0, 5, 0], random.choice(names))
    for _ in range(int(random.integers(1, 7))):
        add_thing(random, model, random.choice(names))
    shines = random.random() < 0.25
    if shines:
        emission = 10 ** random.uniform(0, 1.7) * random.uniform(0.3, 1, 3)
        materials["shining"] = ["Kd 0 0 0", "Ke %.2f %.2f %.2f" % tuple(emission)]
        side = 10 ** random.uniform(-1.5, -0.5)
        model.box(random.uniform([-1, 0.3, -1], [1, 2, 1]), [side] * 3, "shining")
    model.write(folder / "scene.obj")
    lines = [line for name, material in materials.items() for line in [f"newmtl {name}", *material]]
    (folder / "scene.mtl").write_text("\n".join(lines) + "\n")

    lights = make_lights(random)
    scene = {"camera": {"position": list(random.uniform([-2, 0.5, 4.5], [2, 4, 4.5])), "target": [0, 0.5, 0],
                        "vertical_fov_deg": random.uniform(20, 50)},
             "film": {"width": 64, "height": 48}, "render": {"bounces": int(random.choice([0, 0, 1, 2]))},
             "meshes": {"model": {"obj": "scene.obj"}}, "lights": lights}
    if random.random() < 0.3 or not (lights or shines):
        scene["background"] = list(np.round(random.uniform(0.1, 1, 3), 2))
    path = folder / "scene.json"
    path.write_text(json.dumps(scene, indent=1))
    return path
