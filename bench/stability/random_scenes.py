#!/usr/bin/env python3
"""Filtering beside path tracing of equal time, on scenes by chance: a suite that nobody chose.

    pip install numpy OpenEXR pillow
    python3 bench/stability/random_scenes.py build/release/wedge FIRST END [FOLDER]

For scenes FIRST to END - 1, at mu = 0.5 and 2, three seeds: the error over that of path tracing, RMSE and root of
relMSE; the mean of the image over the truth; the error that is told over the true one. Then their geometric means, and
the worst. The truth is 4096 samples of another sampler, told with its own error. Scenes stay in FOLDER, if given.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import OpenEXR

from random_scene import make_scene

SEEDS = 3
MUS = ["0.5", "2"]


def read(path):
    with OpenEXR.File(str(path)) as file:
        channels = file.channels()
        return np.asarray(channels["RGBA" if "RGBA" in channels else "RGB"].pixels, np.float64)[..., :3]


def render(program, scene, *options):
    out, told = scene.parent / "out.exr", scene.parent / "out.json"
    command = [program, "render", scene, "-o", out, "--stats", told, "--quiet", "--aov", "none", *options]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{scene}: {done.stderr}")
    return read(out), json.loads(told.read_text())


def find_truth(program, scene):
    """The image, and its own root mean square error."""
    halves = [render(program, scene, "--method", "mc", "--sampler", "lattice", "--spp", 2048, "--seed", seed)[0]
              for seed in (901, 902)]
    return sum(halves) / 2, np.sqrt(np.mean((halves[0] - halves[1]) ** 2)) / 2


def errors(images, truth):
    square = np.mean([(image - truth) ** 2 for image in images], axis=(0, 3))
    floor = 0.01 * truth.mean() ** 2
    return np.array([np.sqrt(square.mean()), np.sqrt(np.mean(square / (truth.mean(-1) ** 2 + floor)))])


def compare(program, scene, truth, mu):
    """RMSE, root of relMSE over path tracing's; mean over the truth's; told error over true."""
    filtered = [render(program, scene, "--mu", mu, "--seed", seed) for seed in range(SEEDS)]
    seconds = np.median([told["render_s"] for _, told in filtered])
    probe = min(render(program, scene, "--method", "mc", "--spp", 64)[1]["render_s"] for _ in range(2))
    samples = max(2, round(64 * seconds / probe))
    plain = [render(program, scene, "--method", "mc", "--spp", samples, "--seed", seed)[0] for seed in range(SEEDS)]
    images = [image for image, _ in filtered]
    error = errors(images, truth)
    told = np.mean([told["estimated_rmse"] for _, told in filtered])
    return [*(error / errors(plain, truth)), np.mean(images) / truth.mean(), told / error[0]], samples


def main(program, first, end, folder):
    ratios = []
    for number in range(first, end):
        place = folder / str(number)
        place.mkdir(parents=True, exist_ok=True)
        scene = make_scene(number, place)
        truth, own_error = find_truth(program, scene)
        if not truth.any():
            continue
        line = f"{number:4d}  own error of the truth {own_error / truth.mean():.4f}"
        for mu in MUS:
            found, samples = compare(program, scene, truth, mu)
            ratios.append(found[:2])
            line += "  |  mu {} for {:4d} samples: RMSE {:.2f}, relMSE {:.2f}, mean {:.4f}, told {:.2f}".format(
                mu, samples, *found)
        print(line, flush=True)
    middle, worst = np.exp(np.mean(np.log(ratios), 0)), np.max(ratios, 0)
    print("RMSE {:.2f}, relMSE {:.2f} in the geometric mean; worst {:.2f}, {:.2f}".format(*middle, *worst))


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    with tempfile.TemporaryDirectory() as temporary:
        kept = sys.argv[4] if len(sys.argv) > 4 else temporary
        main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), pathlib.Path(kept))
