"""Renders exported scenes with Mitsuba 3, for `wedge bench peers` (see peer_loop.py for how it is told what to do).

    pip install mitsuba numpy

Uses the variant llvm_ad_rgb, Mitsuba's own vectorised CPU backend with Embree. It needs LLVM's shared library,
of version 17 or later for these kernels (Debian 12: apt install libllvm19); the newest one that is found is
taken, unless DRJIT_LIBLLVM_PATH names one.
"""

import glob
import os
import re
import time


def newest_llvm():
    files = glob.glob("/usr/lib/*/libLLVM*.so*") + glob.glob("/usr/lib/llvm-*/lib/libLLVM*.so*")
    version = lambda path: int((re.findall(r"[-.](\d\d)\b", os.path.basename(path)) or ["0"])[0])
    return max(files, key=version, default=None)


if "DRJIT_LIBLLVM_PATH" not in os.environ and newest_llvm():
    os.environ["DRJIT_LIBLLVM_PATH"] = newest_llvm()

import mitsuba as mi
import numpy as np

import peer_loop

mi.set_variant("llvm_ad_rgb")

import drjit as dr

import mitsuba_surface  # registers the plugin
import mitsuba_xml

LANES = 1 << 23  # paths at once, bounds memory to about 2 GB


class MitsubaPeer:
    samplers = {"mitsuba": "independent", "mitsuba-multijitter": "multijitter"}

    def load(self, folder, method):
        start = time.perf_counter()
        self.scene = mi.load_file(mitsuba_xml.write(folder), sampler=self.samplers[method])
        dr.sync_thread()
        self.warm = set()
        return {"load_s": time.perf_counter() - start}

    def describe(self):
        return {"version": "Mitsuba " + mi.__version__, "device": "CPU, LLVM %s" % mi.variant()}

    def render_once(self, spp, seed):
        """Pixels as a NumPy array, and seconds until they are there."""
        start = time.perf_counter()
        image = mi.render(self.scene, spp=spp, seed=seed)
        dr.eval(image)
        dr.sync_thread()
        return np.array(image), time.perf_counter() - start

    def spp_at_once(self):
        width, height = self.scene.sensors()[0].film().size()
        return max(1, LANES // (width * height))

    def render(self, spp, seed):
        """Mean and seconds. Kernels are traced and compiled by a run that is not counted."""
        parts = peer_loop.split(spp, self.spp_at_once())
        compile_s = 0
        for part in set(parts) - self.warm:
            compile_s += self.render_once(part, 0xFFFF)[1]
            self.warm.add(part)
        image, seconds = 0, 0
        for i, part in enumerate(parts):
            pixels, s = self.render_once(part, peer_loop.seed_of(seed, i))
            image = image + pixels * (part / spp)
            seconds += s
        return image, {"render_s": seconds, "compile_s": max(0, compile_s - seconds)}


if __name__ == "__main__":
    peer_loop.serve(MitsubaPeer())
