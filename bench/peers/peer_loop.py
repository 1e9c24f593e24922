"""How `wedge bench peers` talks with a renderer: one JSON object a line, on stdin and stdout.

    {"do": "load", "folder": EXPORT, "method": NAME}
        -> {"load_s": 1.2, "version": "Mitsuba 3.9.1", "device": "CPU"}
    {"do": "render", "spp": 64, "seed": 0, "pixels": "out.bin"}
        -> {"render_s": 0.5, "compile_s": 0.1, "width": 8, "height": 6, "samples": 3072}
                                                one image of 64 samples a pixel: R, G, B
    {"do": "render", "spp": 64, "seed": 0, "parts": 16, "pixels": "out.bin"}
        -> as 16 independent images of 4 samples: R, G, B of their mean, and the three variances of the mean

An answer {"error": text} says that it could not be done. The end of stdin ends the program. Whatever a renderer
prints goes to stderr, from the moment this module is imported: some print while they are imported, so this one
comes first.
"""

import json
import os
import sys
import traceback

import numpy as np

ANSWERS = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)


def split(total, largest):
    """Whole parts of nearly the same size, none above `largest`."""
    count = -(-total // largest)
    return [total // count + (i < total % count) for i in range(count)]


def seed_of(seed, part):
    """32 bits, other ones for each pair."""
    return (seed * 0x9E3779B1 + part * 0x85EBCA6B + 1) & 0xFFFFFFFF


def write_pixels(path, channels):
    """Little-endian float32, row 0 at the top, channels interleaved; the other side makes EXR of it."""
    with open(path, "wb") as file:
        file.write(np.stack(channels, axis=-1).astype("<f4").tobytes())


def render(peer, request):
    parts = request.get("parts", 1)
    spp = request["spp"] // parts
    total, squares, answer = 0.0, 0.0, {}
    for part in range(parts):
        image, times = peer.render(spp, seed_of(request["seed"], part) if parts > 1 else request["seed"])
        image = image.astype(np.float64)
        total, squares = total + image, squares + image * image
        for name, seconds in times.items():
            answer[name] = answer.get(name, 0) + seconds
    mean = total / parts
    channels = [mean[..., i] for i in range(3)]
    if parts > 1:
        variance = np.maximum(squares - parts * mean * mean, 0) / (parts - 1) / parts
        channels += [variance[..., i] for i in range(3)]
    write_pixels(request["pixels"], channels)
    return dict(answer, height=mean.shape[0], width=mean.shape[1], samples=spp * parts * mean[..., 0].size)


def serve(peer):
    for line in sys.stdin:
        try:
            request = json.loads(line)
            if request["do"] == "load":
                answer = dict(peer.load(request["folder"], request["method"]), **peer.describe())
            else:
                answer = render(peer, request)
        except Exception as error:
            traceback.print_exc()
            answer = {"error": "%s: %s" % (type(error).__name__, error)}
        ANSWERS.write(json.dumps(answer) + "\n")
        ANSWERS.flush()
