#!/usr/bin/env python3
"""The picture of docs/results.md: path tracing and filtering in equal time, their errors, samples, widths.

    pip install matplotlib numpy OpenEXR
    python3 bench/figures/equal_time.py build/release/wedge REFERENCES docs/images/aaf.png

REFERENCES: the folder of that name that `wedge bench converge --config bench/standard.json` has written.
"""
import glob
import json
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import OpenEXR

# Scene, mu, the width that is shown.
ROWS = [("cornell-glossy", 0.5, "indirect"), ("sponza", 0.25, "indirect"), ("grids", 1, "direct")]
GAIN = 20


def read(path):
    with OpenEXR.File(path, separate_channels=True) as exr:
        return {name: c.pixels.astype(np.float64) for name, c in exr.channels().items()}


def rgb(layers, prefix=""):
    return np.stack([layers[prefix + c] for c in "RGB"], -1)


def rmse(image, reference):
    """The reference's own squared error, told by its halves, is taken off."""
    own = 0.25 * (rgb(reference, "a.") - rgb(reference, "b.")) ** 2
    return np.sqrt(max(0.0, ((rgb(image) - rgb(reference)) ** 2 - own).mean()))


def render(program, scene, size, folder, *options):
    """Layers and what --stats says; the second of two renders, for the first one compiles. size: None, the scene's."""
    out = f"{folder}/image.exr"
    for _ in range(2):
        subprocess.run([program, "render", f"scenes/{scene}.json", *(["--size", size] if size else []), "-o", out,
                        "--stats", f"{folder}/stats.json", *options], check=True, capture_output=True)
    with open(f"{folder}/stats.json") as stats:
        return read(out), json.load(stats)


def tone(image):
    return np.clip(image, 0, 1) ** (1 / 2.2)


def show(axes, picture, title, **options):
    drawn = axes.imshow(picture, interpolation="nearest", **options)
    axes.set_title(title, fontsize=8)
    axes.axis("off")
    return drawn


def error_map(image, reference):
    return GAIN * (rgb(image) - rgb(reference)).mean(-1)


def draw_row(axes, program, references, folder, scene, mu, signal):
    reference = read(glob.glob(f"{references}/{scene}-[0-9a-f]*-lattice-*.exr")[0])
    height, width = reference["R"].shape
    size = f"{width}x{height}"
    filtered, stats = render(program, scene, size, folder, "--mu", str(mu))
    seconds = stats["render_s"]
    plain, plain_stats = render(program, scene, size, folder, "--method", "mc", "--time", f"{seconds:.3f}")
    samples = plain_stats["samples"] / (width * height)
    exposure = 0.2 / np.median(rgb(reference)[rgb(reference) > 0])
    show(axes[0], tone(exposure * rgb(plain)), f"path tracing, {samples:.0f} samples")
    show(axes[1], tone(exposure * rgb(filtered)), f"filtered, mu = {mu:g}, {seconds:.1f} s as well")
    for place, image, name in ((axes[2], plain, "path tracing"), (axes[3], filtered, "filtered")):
        show(place, error_map(image, reference), f"error x {GAIN}, {name}:\nRMSE {rmse(image, reference):.4f}",
             cmap="RdBu", vmin=-1, vmax=1)
    plt.colorbar(show(axes[4], filtered["spp"], "samples"), ax=axes[4], shrink=0.7)
    widths = filtered[f"width.{signal}"]
    # Where a pixel's rays have found nothing the width is all but infinite.
    most = np.percentile(widths, 99.9)
    plt.colorbar(show(axes[5], widths, f"width of the filter, px ({signal})", vmax=most), ax=axes[5], shrink=0.7)


def main(program, references, out):
    figure, axes = plt.subplots(len(ROWS), 6, figsize=(13, 6), layout="constrained")
    with tempfile.TemporaryDirectory() as folder:
        for row, (scene, mu, signal) in zip(axes, ROWS):
            draw_row(row, program, references, folder, scene, mu, signal)
    figure.savefig(out, dpi=100)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
