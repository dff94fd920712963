#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Time and memory against size, one thread, one process for each size.

usage: scaling.py [--build FOLDER] [--results FOLDER] [--blocks N...] [--squares N...]

Blocks are block-press-shear.prm with N^3 elements (11 increments), squares are
inclined-obstacle.prm with N^2 elements and 20 increments; nothing is drawn. Time is CPU of the
whole process; `condensation` (assembly, order, factor, Schur complement) and `ratio`, all
that follows the start of the process over it, are clock times of log.txt. Memory is the
peak of the process. The last row are exponents fitted over the number of dofs. Writes scaling.csv and
scaling.png (where matplotlib is there) to FOLDER. 40^3 needs 6 GB, 50^3 13 GB, 1000^2 8 GB.
"""
import argparse
import csv
import math
import re
import sys
import tempfile
from pathlib import Path

from measure import TOP, checked_resources

COLUMNS = ("elements", "dofs", "contact nodes", "CPU s", "condensation s", "ratio", "peak MB", "factor MB", "K MB")
SCENES = {
    "block": ("block-press-shear", lambda n: [f"Body block/Mesh/Arguments={n}, {n}, {n} : 0, 0, 0 : 1, 1, 1 : true"]),
    "square": ("inclined-obstacle", lambda n: [f"Body block/Mesh/Arguments={n}, {n} : 0, 0 : 80, 80 : true",
                                               "Time/End=20", "Time/Increments=20"]),
}


def run(build, kind, n, folder):
    """CPU seconds and peak memory [MB] of one process."""
    scene, changes = SCENES[kind]
    command = [str(build / "conetact"), str(TOP / f"parameter-files/{scene}.prm"), "-q", "-o", str(folder)]
    for change in [*changes(n), "Output/VTU=0"]:
        command += ["-s", change]
    return checked_resources(command)


def measure(build, kind, n):
    with tempfile.TemporaryDirectory() as folder:
        seconds, memory = run(build, kind, n, folder)
        log = (Path(folder) / "log.txt").read_text()
    times = [(float(time), what) for time, what in re.findall(r"^ *(\d+\.\d+) s  (.*)$", log, re.M)]
    condensation = sum(time for time, what in times if what.startswith("condensation"))
    contact, unknowns = map(int, re.search(r"(\d+) contact nodes with (\d+) unknowns", log).groups())
    nodes = int(re.search(r"(\d+) nodes$", log, re.M)[1])
    return dict(zip(COLUMNS, (f"{n}^{3 if kind == 'block' else 2}", nodes * (3 if kind == "block" else 2), contact, seconds,
                              condensation, sum(time for time, _ in times) / condensation, memory,
                              float(re.search(r"factor of (\S+) MB", log)[1]), 8e-6 * unknowns**2)))


def exponent(rows, column):
    """Of the column over the number of dofs, least squares of logarithms."""
    points = [(math.log(row["dofs"]), math.log(row[column])) for row in rows]
    x0, y0 = (sum(p[i] for p in points) / len(points) for i in (0, 1))
    return sum((x - x0) * (y - y0) for x, y in points) / sum((x - x0)**2 for x, _ in points)


def show(rows):
    print("|", " | ".join(COLUMNS), "|\n|" + "---|" * len(COLUMNS))
    for row in rows:
        cells = (row[c] if isinstance(row[c], (str, int)) else f"{row[c]:.3g}" for c in COLUMNS)
        print("|", " | ".join(map(str, cells)), "|")
    if len(rows) > 1:
        fitted = ("CPU s", "condensation s", "peak MB", "factor MB", "K MB")
        print("|", " | ".join(f"{exponent(rows, c):.2f}" if c in fitted else "exponent" if c == "elements" else ""
                              for c in COLUMNS), "|")
    print(flush=True)


def draw(tables, file):
    try:
        import matplotlib
    except ImportError:
        return print("matplotlib is not installed (Debian: python3-matplotlib): no picture")
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, 2, figsize=(9, 4), constrained_layout=True)
    for axis, column in zip(axes, ("CPU s", "peak MB")):
        for kind, rows in tables.items():
            axis.loglog([row["dofs"] for row in rows], [row[column] for row in rows], "o-", label=f"{kind}s")
        axis.set(xlabel="degrees of freedom", ylabel=column)
        axis.legend()
    figure.savefig(file, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--results", type=Path, default=TOP / "benchmarks/results")
    parser.add_argument("--blocks", type=int, nargs="*", default=[8, 12, 16, 24, 32], metavar="N")
    parser.add_argument("--squares", type=int, nargs="*", default=[100, 200, 400], metavar="N")
    options = parser.parse_args()
    options.results.mkdir(parents=True, exist_ok=True)
    tables = {}
    for kind, sizes in (("block", options.blocks), ("square", options.squares)):
        if sizes:
            tables[kind] = [measure(options.build.resolve(), kind, n) for n in sizes]
            show(tables[kind])
    with open(options.results / "scaling.csv", "w", newline="") as stream:
        table = csv.DictWriter(stream, COLUMNS)
        table.writeheader()
        table.writerows(row for rows in tables.values() for row in rows)
    draw(tables, options.results / "scaling.png")


if __name__ == "__main__":
    sys.exit(main())
