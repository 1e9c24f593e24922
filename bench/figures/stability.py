#!/usr/bin/env python3
"""The picture of docs/stability.md: what filters do wrong where their assumptions break, and what the guard leaves of it.

    pip install matplotlib numpy OpenEXR
    python3 bench/figures/stability.py build/release/wedge docs/images/stability.png
"""
import sys
import tempfile

from equal_time import plt, render, rgb, show, tone

ROWS = ["border", "two-depths", "umbra", "silhouettes", "grazing-light"]
REFERENCE = ["--method", "mc", "--sampler", "lattice", "--spp", "4096"]
COLUMNS = [("path tracing, 16 samples", ["--method", "mc", "--spp", "16"]),
           ("no guard, mu = 0.25", ["--filter", "plain", "--mu", "0.25"]), ("guard", ["--mu", "0.25"])]


def draw_row(axes, program, folder, name):
    def image(options):
        return render(program, f"stability/{name}", None, folder, *options)[0]

    reference = image(REFERENCE)
    mean = rgb(reference).mean()
    show(axes[0], tone(0.3 / mean * rgb(reference)), f"{name}: reference")
    for place, (title, options) in zip((1, 2, 4), COLUMNS):
        tried = image(options)
        show(axes[place], tone(0.3 / mean * rgb(tried)), title)
        if place > 1:
            error = (rgb(tried) - rgb(reference)).mean(-1) / mean
            show(axes[place + 1], error, "error", cmap="RdBu_r", vmin=-0.2, vmax=0.2)


def main(program, out):
    figure, axes = plt.subplots(len(ROWS), 6, figsize=(13, 8.5), layout="constrained")
    with tempfile.TemporaryDirectory() as folder:
        for row, name in zip(axes, ROWS):
            draw_row(row, program, folder, name)
    figure.savefig(out, dpi=80)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
