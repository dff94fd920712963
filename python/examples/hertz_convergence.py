#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pressure between a cylinder and a plane on finer and finer meshes against Hertz's closed form.

usage: hertz_convergence.py [--output CURVE.png]      (default: hertz-convergence.png)

The scene is parameter-files/cylinder-on-plane.prm. Hertz: half width of contact
a = sqrt(4 P R (1 - nu^2)/(pi E)), pressure p0 sqrt(1 - x^2/a^2), p0 = 2 P/(pi a).
K. L. Johnson, Contact Mechanics, 1985, section 4.2.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

TOP = Path(__file__).resolve().parents[2]
sys.path.append(str(TOP / "python"))
import conetact  # noqa: E402

SCENE = TOP / "parameter-files" / "cylinder-on-plane.prm"
LEVELS = "Body cylinder/Mesh/Global refinements"
RADIUS, FORCE, YOUNG, POISSON = 10.0, 10.0, 1000.0, .3
WIDTH = np.sqrt(4 * FORCE * RADIUS * (1 - POISSON**2) / (np.pi * YOUNG))
PEAK = 2 * FORCE / (np.pi * WIDTH)


def hertz(x):
    return PEAK * np.sqrt(np.maximum(1 - (x / WIDTH)**2, 0))


def error(reactions):
    """Of the pressure in the mean square over nodes, relative; and the cell size where they touch."""
    rows = np.sort(reactions, order="x")
    near = np.abs(rows["x"]) < 2 * WIDTH
    difference = rows["pressure"][near] - hertz(rows["x"][near])
    area = rows["area"][near]
    return np.diff(rows["x"][near]).min(), np.sqrt((area * difference**2).sum() / (area * hertz(rows["x"][near])**2).sum())


def draw(results, sizes, errors, file):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4), layout="constrained")
    x = np.linspace(-1.3 * WIDTH, 1.3 * WIDTH, 400)
    left.plot(x, hertz(x), color="black", linewidth=1, label="Hertz")
    for result, size in zip(results, sizes):
        rows = np.sort(result.reactions, order="x")
        rows = rows[np.abs(rows["x"]) < 1.3 * WIDTH]
        left.plot(rows["x"], rows["pressure"], ".-", linewidth=.6, label=f"h = {size:.3f} mm")
    left.set(xlabel="x [mm]", ylabel="pressure [MPa]")
    left.legend(frameon=False)
    right.loglog(sizes / WIDTH, errors, "s-")
    right.set_xticks(sizes / WIDTH, [f"{size / WIDTH:.2f}" for size in sizes])
    right.set_xticks([], minor=True)
    right.set(xlabel="cell size over half width of contact", ylabel="relative error of the pressure")
    figure.savefig(file, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, default=Path("hertz-convergence.png"))
    args = parser.parse_args()

    results = conetact.sweep(SCENE, {LEVELS: [3, 4, 5, 6]}, {"Output/VTU": 0})
    for result in results:
        if result.error:
            raise result.error
    sizes, errors = map(np.array, zip(*(error(result.reactions) for result in results)))
    orders = [np.nan, *(np.log(errors[:-1] / errors[1:]) / np.log(sizes[:-1] / sizes[1:]))]
    for result, size, e, order in zip(results, sizes, errors, orders):
        peak = result.reactions["pressure"].max()
        print(f"h = {size:.4f}: error {e:.3f}{'' if np.isnan(order) else f' (order {order:.1f})'}, largest pressure {peak:.2f} of {PEAK:.2f}")
    draw(results, sizes, errors, args.output)

    assert (np.diff(errors) < 0).all() and errors[-1] < .05
    assert abs(results[-1].reactions["pressure"].max() / PEAK - 1) < .01


if __name__ == "__main__":
    main()
