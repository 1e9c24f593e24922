"""Puts Intel Open Image Denoise on the chart of `wedge bench converge`.

    pip install pyoidn OpenEXR numpy
    wedge bench converge SCENE --methods mc-sobol,aaf,mc+oidn -o OUT
    python3 bench/peers/oidn.py OUT
    wedge bench converge SCENE --methods mc-sobol,aaf,mc+oidn -o OUT

The first command renders; this script denoises every run of mc-sobol in OUT and adds what it made
to the list of runs; the last command, which finds everything finished, makes the report with them.

Open Image Denoise gets what its documentation asks for: linear radiance (hdr), and albedo and normals
of the first hit, noisy as the colour is. Quality is its default for final frames ("high"). The time
of a run is that of the render and of the filter together: the median of three filterings, after one
that is not counted because it sets the filter up for this size.
"""

import importlib.metadata
import json
import os
import statistics
import sys
import time

import numpy as np
import OpenEXR
import pyoidn

SOURCE = "mc-sobol"
METHOD = "mc+oidn"
REPEATS = 3


def read_records(path):
    records = []
    with open(path) as file:
        for line in file:
            try:
                records.append(json.loads(line))
            except json.JSONDecodeError:
                pass  # cut off when a run was killed; the renderer removes it
    return records


def read_layers(path):
    """Colour, albedo and normals as arrays of height x width x 3."""
    with OpenEXR.File(path, separate_channels=True) as file:
        channels = file.channels()
        stack = lambda names: np.stack([channels[n].pixels for n in names], axis=-1).astype(np.float32)
        layer = lambda name, parts: stack([name + part for part in parts])
        return (
            np.maximum(stack("RGB"), 0),
            np.clip(layer("albedo.", "RGB"), 0, 1),
            np.clip(layer("N.", "XYZ"), -1, 1),
        )


def write_colour(path, image):
    channels = {name: np.ascontiguousarray(image[..., i]) for i, name in enumerate("RGB")}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    temporary = path + ".part.exr"
    with OpenEXR.File(header, channels) as file:
        file.write(temporary)
    os.replace(temporary, path)


def denoise(colour, albedo, normal):
    """The image, and seconds."""
    seconds = []
    for _ in range(1 + REPEATS):
        start = time.perf_counter()
        image = pyoidn.denoise(colour, albedo=albedo, normal=normal, hdr=True, quality="high")
        seconds.append(time.perf_counter() - start)
    return image, statistics.median(seconds[1:])


def denoised_record(record, image, seconds):
    version = importlib.metadata.version("pyoidn")
    made = dict(record)
    made["key"] = record["key"] + "-oidn"
    made["method"] = METHOD
    made["image"] = image
    made["time_s"] = record["time_s"] + seconds
    made["render_s"] = record["render_s"] + seconds
    made["passes"] = record["passes"] + [{"name": "oidn", "device_s": seconds, "launches": 1}]
    made["settings"] = dict(
        record["settings"], filter="Open Image Denoise " + version, layers="albedo, normal", quality="high"
    )
    made["command"] = record["command"] + " # then Open Image Denoise " + version
    return made


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = sys.argv[1]
    runs = os.path.join(folder, "runs.jsonl")
    records = read_records(runs)
    done = {(r["key"], r["program"]) for r in records if r["method"] == METHOD}
    latest = {r["key"]: r for r in records if r["method"] == SOURCE}
    for record in latest.values():
        if (record["key"] + "-oidn", record["program"]) in done:
            continue
        image, seconds = denoise(*read_layers(os.path.join(folder, record["image"])))
        name = record["image"].replace(SOURCE, METHOD)
        write_colour(os.path.join(folder, name), image)
        with open(runs, "a") as file:
            file.write(json.dumps(denoised_record(record, name, seconds)) + "\n")
            file.flush()
            os.fsync(file.fileno())
        print("%s: %.3g s" % (name, seconds))


if __name__ == "__main__":
    main()
