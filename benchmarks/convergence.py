#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors against exact solutions on finer and finer meshes.

usage: convergence.py [--build FOLDER] [--results FOLDER] [--quick]

The manufactured solution of tests/support/manufactured.py, full slip and then full stick;
Hertz's line and point contact and Cattaneo-Mindlin's partial slip, cut out of half
spaces (tests/support/half_space.py). Relative errors; the last line of each table holds the
orders observed between its two finest meshes. Writes convergence.png.
"""
import argparse
import os
import shutil
from pathlib import Path

from measure import TOP, finish_panel, table  # first: it knows the way to tests/support
from support import half_space
from support.checks import Laws, orders
from support.manufactured import solution_errors

SIZES = {"manufactured": {2: (8, 16, 32, 64, 128), 3: (4, 8, 16)},
         "hertz": {2: (8, 16, 32, 64), 3: (4, 8, 16)},
         "partial slip": {2: (8, 16, 32, 64), 3: (4, 8, 16)}}
GRADING = 2
NAMES = [f"{what}, {state}" for state in ("slip", "stick") for what in ("displacement", "energy", "reactions")]


def manufactured(laws, dim, n):
    return dict(zip(NAMES, solution_errors(laws, dim, n)))


def hertz(laws, dim, n):
    return half_space.hertz_errors(laws.run(half_space.hertz(dim, n, GRADING)), n)


def partial_slip(laws, dim, n):
    errors = half_space.partial_slip_errors(laws.run(half_space.partial_slip(dim, n, GRADING)), n)
    errors.popitem()  # not relative
    return errors


STUDIES = {"manufactured": (manufactured, "cells a side"), "hertz": (hertz, "cells a half width"),
           "partial slip": (partial_slip, "cells a half width")}


def draw(studies, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, 3, figsize=(13, 8), constrained_layout=True)
    for axis, ((name, dim), (sizes, errors)) in zip(axes.T.flat, studies.items()):
        for what in errors[0]:
            axis.loglog([1 / n for n in sizes], [e[what] for e in errors], "o-", markersize=4, label=what)
        finish_panel(axis, title=f"{name}, {'plane' if dim == 2 else 'space'}", xlabel="h", ylabel="relative error")
        axis.legend(fontsize=7)
    figure.savefig(file, dpi=110)


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--results", type=Path, default=TOP / "benchmarks/results")
    parser.add_argument("--quick", action="store_true", help="the two coarsest meshes only")
    return parser.parse_args()


def main():
    options = parse()
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    laws, studies = Laws(options.build / "conetact"), {}
    for name, (study, unit) in STUDIES.items():
        for dim, sizes in SIZES[name].items():
            sizes = sizes[:2] if options.quick else sizes
            errors = [study(laws, dim, n) for n in sizes]
            studies[name, dim] = sizes, errors
            rows = [(n, *(f"{x:.2g}" for x in e.values())) for n, e in zip(sizes, errors)]
            rows.append(("order", *(f"{x:.2f}" for x in orders(sizes, [list(e.values()) for e in errors]))))
            print(f"{name}, {dim}D\n\n" + table((unit, *errors[0]), rows) + "\n", flush=True)
    shutil.rmtree(laws.folder)
    options.results.mkdir(parents=True, exist_ok=True)
    draw(studies, options.results / "convergence.png")


if __name__ == "__main__":
    main()
