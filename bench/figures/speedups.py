#!/usr/bin/env python3
"""Table of docs/results.md: how many times longer path tracing takes to the error that filtering leaves.

    python3 bench/figures/speedups.py out/standard/results.json

Medians over seeds. Between budgets cost and error are interpolated as powers; a ~ marks what lies beyond them.
"""
import json
import math
import sys

METHOD, RIVALS = "aaf", ("mc-sobol", "mc-stratified")


def curve(method, cost, metric):
    """(error, cost) of each budget, errors falling."""
    points = [(r[metric]["median"], r[cost]["median"]) for r in method["rungs"]]
    return sorted((p for p in points if p[0] > 0), reverse=True)


def cost_at(points, error):
    """Cost of that error, and whether it is beyond what was measured."""
    segment = next((i for i in range(1, len(points)) if points[i][0] <= error), len(points) - 1)
    (e0, c0), (e1, c1) = points[segment - 1], points[segment]
    slope = math.log(c1 / c0) / math.log(e1 / e0)
    return c0 * (error / e0) ** slope, not points[-1][0] <= error <= points[0][0]


def ratio(rung, rival, cost, metric):
    error = rung[metric]["median"]
    if not error > 0:
        return "?"
    needed, beyond = cost_at(curve(rival, cost, metric), error)
    return ("~" if beyond else "") + f"{needed / rung[cost]['median']:.1f}"


def rows(scene):
    methods = {m["method"]: m for m in scene["methods"]}
    sobol, strata = (methods[name] for name in RIVALS)
    for rung in methods[METHOD]["rungs"]:
        yield [scene["name"], f"µ {rung['budget']:g}", f"{rung['time_s']['median']:.2f} s",
               f"{rung['samples_per_pixel']['median']:.1f}",
               ("" if rung["plotted"] else "≈ ") + f"{rung['rmse']['median']:.3g}",
               ratio(rung, sobol, "time_s", "rmse"), ratio(rung, sobol, "time_s", "rel_mse"),
               ratio(rung, strata, "time_s", "rmse"), ratio(rung, strata, "time_s", "rel_mse"),
               ratio(rung, strata, "samples_per_pixel", "rmse")]


def main(results):
    head = ["scene", "mu", "time", "samples", "RMSE", "RMSE, Sobol", "relMSE, Sobol", "RMSE, strata",
            "relMSE, strata", "samples, strata"]
    with open(results) as file:
        scenes = json.load(file)["scenes"]
    for row in [head, ["---"] * len(head)] + [r for scene in scenes for r in rows(scene)]:
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
