"""Renders exported scenes with LuxCore, for `wedge bench peers` (see peer_loop.py for how it is told what to do).

    pip install pyluxcore numpy

Its path tracer on the CPU (PATHCPU), Sobol sampler. Lambert surfaces with textures, meshes and rectangles that
shine on their front, points, a sky of one colour; luxcore_properties.py says how they are written.

The wheel for Linux brings an allocator (TBB's) that has to be there before the program starts: where Python
imports it later, starting to render ends with "double free or corruption" (pyluxcore 2.11.2). So this program
starts itself again with the allocator loaded first.
"""

import glob
import importlib.util
import os
import sys


def preload_allocator():
    package = importlib.util.find_spec("pyluxcore")
    if package is None or "WEDGE_LUXCORE_PRELOADED" in os.environ:
        return
    libraries = os.path.join(os.path.dirname(os.path.dirname(package.origin)), "pyluxcore.libs")
    found = glob.glob(libraries + "/libtbbmalloc_proxy*.so*") + glob.glob(libraries + "/libtbbmalloc-*.so*")
    before = os.environ.get("LD_PRELOAD", "").split(":")
    os.environ["LD_PRELOAD"] = ":".join(filter(None, found + before))
    os.environ["WEDGE_LUXCORE_PRELOADED"] = "1"
    os.execv(sys.executable, [sys.executable, "-u", *sys.argv])


if __name__ == "__main__":
    preload_allocator()

import peer_loop  # before pyluxcore, which prints

import time

import numpy as np
import pyluxcore

import exported_scene
import luxcore_properties

POLL_S = 0.005


def to_properties(values):
    properties = pyluxcore.Properties()
    for name, value in values.items():
        properties.Set(pyluxcore.Property(name, value))
    return properties


class LuxCorePeer:
    def load(self, folder, method):
        start = time.perf_counter()
        pyluxcore.Init()
        self.exported = exported_scene.read(folder)
        exported_scene.require_lambert(self.exported, "LuxCore")
        self.scene = pyluxcore.Scene()
        for name, _, positions, uvs, triangles in exported_scene.surfaces(self.exported, folder):
            self.scene.DefineMesh(name, positions, triangles, None, uvs, None, None)
        self.scene.Parse(to_properties(luxcore_properties.scene_properties(self.exported, folder)))
        return {"load_s": time.perf_counter() - start}

    def describe(self):
        return {"version": "LuxCore " + pyluxcore.Version(), "device": "CPU"}

    def render(self, spp, seed):
        values = dict(luxcore_properties.render_properties(self.exported))
        values["batch.haltspp"] = spp
        values["renderengine.seed"] = 1 + seed % 0x7FFFFFFE
        session = pyluxcore.RenderSession(pyluxcore.RenderConfig(to_properties(values), self.scene))
        begin = time.perf_counter()
        session.Start()  # builds the tree
        start = time.perf_counter()
        while not session.HasDone():
            time.sleep(POLL_S)
            session.UpdateStats()  # looks at the samples, too
        seconds = time.perf_counter() - start
        session.Stop()
        film = session.GetFilm()
        width, height = film.GetWidth(), film.GetHeight()
        pixels = np.empty(width * height * 3, dtype=np.float32)
        film.GetOutputFloat(pyluxcore.FilmOutputType.RGB, pixels, 0, True)
        return pixels.reshape(height, width, 3)[::-1], {"render_s": seconds, "compile_s": start - begin}


if __name__ == "__main__":
    peer_loop.serve(LuxCorePeer())
