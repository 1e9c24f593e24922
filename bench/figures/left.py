#!/usr/bin/env python3
"""The second picture of docs/results.md: what is left of the error where targets are missed.

    pip install matplotlib numpy OpenEXR
    python3 bench/figures/left.py build/release/wedge docs/images/left.png REFERENCES...

REFERENCES: folders of that name that `wedge bench converge` and `wedge bench stability` have written; of several that
have a scene the first counts.
"""
import glob
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from equal_time import read, render, rgb, show, tone

# Scene and mu.
ROWS = [("grids", 0.5), ("stability/wires", 4)]
SEEDS = 8
BLOCK = 16


def find_reference(scene, folders):
    name = scene.split("/")[-1]
    for folder in folders:
        found = glob.glob(f"{folder}/{name}-[0-9a-f]*-lattice-*.exr")
        if found:
            return read(found[0])
    sys.exit(f"no reference of {name} in {' '.join(folders)}")


def images(program, scene, size, folder, *options):
    """Of all seeds, and the time that one takes."""
    runs = [render(program, scene, size, folder, "--seed", str(seed), *options) for seed in range(SEEDS)]
    return np.stack([rgb(layers) for layers, _ in runs]), np.median([stats["render_s"] for _, stats in runs])


def block_means(values):
    height, width = values.shape
    return np.array([[values[y:y + BLOCK, x:x + BLOCK].mean() for x in range(0, width, BLOCK)]
                     for y in range(0, height, BLOCK)])


def draw_row(axes, program, folders, temporary, scene, mu):
    reference = find_reference(scene, folders)
    height, width = reference["R"].shape
    size = f"{width}x{height}"
    truth = rgb(reference)
    filtered, seconds = images(program, scene, size, temporary, "--mu", str(mu))
    _, stats = render(program, scene, size, temporary, "--method", "mc", "--time", f"{seconds:.3f}")
    samples = round(stats["samples"] / (width * height))
    plain, _ = images(program, scene, size, temporary, "--method", "mc", "--spp", str(samples))

    rmse = np.sqrt(((filtered - truth) ** 2).mean())
    bias = (filtered.mean(0) - truth).mean(-1)
    noise = filtered.std(0, ddof=1).mean(-1)
    exposure = 0.2 / np.median(truth[truth > 0])
    show(axes[0], tone(exposure * filtered[0]), f"{scene.split('/')[-1]}, mu = {mu:g}, {seconds:.1f} s")
    bar = dict(shrink=0.8, format="%.0e")
    plt.colorbar(show(axes[1], bias, f"mean error of {SEEDS} renders", cmap="RdBu", vmin=-4 * rmse, vmax=4 * rmse),
                 ax=axes[1], **bar)
    plt.colorbar(show(axes[2], noise, "standard deviation", vmin=0, vmax=4 * rmse), ax=axes[2], **bar)
    errors = [block_means(((x - truth) ** 2).mean((0, -1))) for x in (filtered, plain)]
    ratio = np.sqrt(errors[0] / np.maximum(errors[1], 1e-30))
    plt.colorbar(show(axes[3], ratio, f"blocks, over path tracing with {samples} samples", cmap="RdBu_r", vmin=0, vmax=2),
                 ax=axes[3], shrink=0.8)


def main(program, out, *folders):
    figure, axes = plt.subplots(len(ROWS), 4, figsize=(13, 5), layout="constrained")
    with tempfile.TemporaryDirectory() as temporary:
        for row, (scene, mu) in zip(axes, ROWS):
            draw_row(row, program, folders, temporary, scene, mu)
    figure.savefig(out, dpi=100)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
