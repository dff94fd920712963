#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run time against error: of the discretisation and of the solvers.

usage: accuracy.py [--build FOLDER] [--results FOLDER] [--quick]

Elements: the manufactured frictional cube of tests/support/manufactured.py, nearly
incompressible, every node slipping; errors of stresses (energy norm) and of contact
reactions. Meshes: partial slip of two bodies in space, tests/support/half_space.py, with
equal cells and with cells refined where they touch; errors of the shear stress.
Solvers: the condensed problem of block-press-shear.prm, pressed and sheared in one
increment, solved from nothing to many tolerances; Siconos beside, where installed.

Times are CPU seconds on one core: of whole processes, start-up included, for elements
and meshes (the grey line is a process that prints its version); of the solve alone
for solvers. Writes run-time-against-error.png, and prints the numbers.
"""
import argparse
import sys
import tempfile
from pathlib import Path

from measure import TOP, cpu_seconds, finish_panel, median_cpu_seconds, table  # first: it knows the way to tests/support
from support import half_space, manufactured
from support.scenes import ELEMENTS, merge, write_scene
from support.tables import Run

sys.path.append(str(TOP / "benchmarks" / "siconos"))
import compare  # noqa: E402

POISSON = .4999
METHODS = ("automatic", "smoothing", "active set", "gauss-seidel")
PEERS = ("NSN_AC", "NSGS", "ADMM")
TOLERANCES = [10.0**-k for k in range(1, 14, 2)]


class Bench:
    """Where things are, and how much of them is run."""

    def __init__(self, build, folder, quick):
        self.build, self.folder, self.quick = build.resolve(), Path(folder), quick
        self.program = self.build / "conetact"

    def timed(self, scene, dim, *arguments):
        """Median CPU seconds without VTU files; the tables, and VTU files too if asked for."""
        file, result = self.folder / "scene.prm", self.folder / "result"
        write_scene(scene, file)
        command = [self.program, file, "-q", "-o", result]
        seconds = median_cpu_seconds([*command, "-s", "Output/VTU=0"], 1 if self.quick else 3)
        if arguments:
            cpu_seconds([*command, *arguments])
        return seconds, Run(result)

    def startup(self):
        return median_cpu_seconds([self.program, "--version"])


def elements(bench):
    """Curves by element: (cells, seconds, energy error, reaction error)."""
    solution, curves = manufactured.Solution(3, POISSON, 1), {}
    for element in ELEMENTS:
        for cells in (4, 8) if bench.quick else (4, 6, 8, 12, 16, 20):
            scene = merge(manufactured.scene(3, cells, POISSON),
                          {"Body block": {"Element": element}, "Time": {"End": 1, "Increments": 1}})
            seconds, run = bench.timed(scene, 3, "-s", "Output/VTU=1")
            file, = run.folder.glob("solution-*0001.vtu")
            energy = manufactured.errors(manufactured.read_displacement(file, 3, cells), solution)[2]
            reactions = manufactured.pressure_error(run.rows, solution, cells)
            curves.setdefault(element, []).append((cells, seconds, energy, reactions))
    return curves


def meshes(bench):
    """Curves by mesh: (cells per half width, seconds, error of force, of shear stress)."""
    kinds = {"equal cells": (0, (2, 3) if bench.quick else (2, 3, 4, 6)),
             "refined at the contact": (2, (4, 8) if bench.quick else (4, 8, 12, 16))}
    curves = {}
    for name, (grading, sizes) in kinds.items():
        for fineness in sizes:
            seconds, run = bench.timed(half_space.partial_slip(3, fineness, grading), 3)
            errors = half_space.partial_slip_errors(run, fineness)
            curves.setdefault(name, []).append((fineness, seconds, errors["force"], errors["shear stress"]))
    return curves


def solvers(bench):
    """Curves by solver: (tolerance, seconds, residual), as far as the residual falls."""
    file = compare.export(bench.build, 8 if bench.quick else 24, bench.folder / "export")
    runs = {name: lambda tolerance, name=name: compare.ours(bench.build, file, tolerance, name) for name in METHODS}
    for peer in compare.installed(PEERS):
        runs[f"Siconos {peer}"] = lambda tolerance, peer=peer: compare.theirs(file, peer, tolerance)
    curves = {}
    for name, solve in runs.items():
        for tolerance in TOLERANCES[::3] if bench.quick else TOLERANCES:
            found = compare.repeated(lambda: solve(tolerance))
            if found is None:
                break
            curves.setdefault(name, []).append((tolerance, *found))
    return curves


def draw(curves_of, startup, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    panels = (("elements", 2, f"sliding cube, nu = {POISSON}", "energy norm of the error, relative"),
              ("elements", 3, f"sliding cube, nu = {POISSON}", "error of reactions, relative"),
              ("meshes", 3, "Cattaneo-Mindlin in space", "error of shear stress, relative"),
              ("solvers", 2, "one condensed problem", "residual, without units"))
    figure, axes = plt.subplots(2, 2, figsize=(9.5, 7.5), constrained_layout=True)
    for axis, (study, column, title, ylabel) in zip(axes.flat, panels):
        for name, points in curves_of[study].items():
            style = "--" if name.startswith("Siconos") else "-"
            axis.loglog([p[1] for p in points], [p[column] for p in points], style, marker="o", markersize=4, label=name)
        if study != "solvers":
            axis.axvline(startup, color="0.7", zorder=0)
        finish_panel(axis, title=title, ylabel=ylabel, xlabel="CPU time, s")
        axis.legend(fontsize=8)
    figure.savefig(file, dpi=130)


COLUMNS = {"elements": ("element", "cells a side", "CPU s", "energy", "reactions"),
           "meshes": ("mesh", "cells a half width", "CPU s", "force", "shear stress"),
           "solvers": ("solver", "tolerance", "CPU s", "residual")}


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--results", type=Path, default=TOP / "benchmarks" / "results")
    parser.add_argument("--quick", action="store_true", help="few sizes, one run each")
    return parser.parse_args()


def main():
    options, curves = parse(), {}
    with tempfile.TemporaryDirectory(prefix="conetact-accuracy-") as folder:
        bench = Bench(options.build, folder, options.quick)
        startup = bench.startup()
        print(f"A process that prints its version: {startup:.2f} s\n")
        for study in (elements, meshes, solvers):
            curves[study.__name__] = found = study(bench)
            rows = [(name, *(f"{x:.3g}" for x in point)) for name, points in found.items() for point in points]
            print(table(COLUMNS[study.__name__], rows) + "\n", flush=True)
    options.results.mkdir(parents=True, exist_ok=True)
    draw(curves, startup, options.results / "run-time-against-error.png")


if __name__ == "__main__":
    main()
