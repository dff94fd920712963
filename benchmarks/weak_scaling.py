#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What grows with the number of processes where each has the same share: counted, not timed.

usage: weak_scaling.py [--build FOLDER] [--results FOLDER] [--cells N] [--processes N...]

Each process has N^3 cells of block-press-shear.prm (N = 12), in blocks of N x N x N side by side. Processes may be more than
cores, as nothing is timed. Messages and bytes an iteration are those of a run with three increments less those of a run with
one, over the iterations between them; cells, nodes of others (ghosts) and memory, without the libraries that a process with
hardly any mesh has, are those of the run with three. Prints a table, and writes weak_scaling.csv and, where matplotlib is
there, weak_scaling.png to FOLDER.
"""
import argparse
import csv
import math
import re
import shutil
import sys
import tempfile
from pathlib import Path

from measure import TOP, checked_resources, table

COLUMNS = ("processes", "dofs", "iterations an increment", "messages", "bytes", "sums", "bytes of sums", "cells", "cells, largest over mean",
           "ghosts", "memory MB")
SHAPES = {1: (1, 1, 1), 2: (2, 1, 1), 4: (2, 2, 1), 8: (2, 2, 2), 16: (4, 2, 2), 32: (4, 4, 2), 64: (4, 4, 4)}


def dofs_of(counts):
    return 3 * math.prod(n + 1 for n in counts)


def shape(processes, cells):
    """Cells along each axis where each process has cells^3."""
    return [cells * n for n in SHAPES[processes]]


def run(build, processes, counts, increments):
    """log.txt of a block of so many equal cubes along each axis, of height 1, and the CPU seconds of all processes."""
    sides = [n / counts[2] for n in counts]
    with tempfile.TemporaryDirectory() as folder:
        changes = ["Solver/Backend=iterative", "Output/VTU=0", f"Time/End={increments}", f"Time/Increments={increments}",
                   "Body block/Mesh/Arguments=" + " : ".join(", ".join(map(str, part)) for part in (counts, (0, 0, 0), sides)) + " : true"]
        command = [shutil.which("mpirun"), "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", "-n", processes] if processes > 1 else []
        command += [build / "conetact", TOP / "parameter-files/block-press-shear.prm", "-q", "-o", folder]
        for change in changes:
            command += ["-s", change]
        seconds = checked_resources(command, one_core=False)[0]
        return (Path(folder) / "log.txt").read_text(), seconds


def numbers(log, name):
    """Those of each process; with one process there is no such line."""
    found = re.search(rf"^ *{name}: (.*)$", log, re.M)
    return [float(part.split()[0]) for part in found[1].split(", ")] if found else []


def megabytes(log):
    """Peak memory of each process."""
    return numbers(log, "memory of processes") or [float(re.search(r"memory: ([\d.]+) MB", log)[1])]


def iterations(log):
    return int(re.search(r"(\d+) linear iterations", log)[1])


def measure(build, processes, cells, libraries):
    first, last = (run(build, processes, shape(processes, cells), n)[0] for n in (1, 3))
    between = iterations(last) - iterations(first)

    def each(name):
        ends = [max(numbers(log, name), default=0) for log in (first, last)]
        return (ends[1] - ends[0]) / between
    seen = numbers(last, "elements seen by processes") or [float(re.search(r"elements seen: (\d+)", last)[1])]
    memory = megabytes(last)
    dofs = dofs_of(shape(processes, cells))
    return dict(zip(COLUMNS, (processes, dofs, iterations(last) / 3, each("messages to neighbours"), each("their bytes"),
                              each("sums and lists of all processes"), each("bytes of their parts"), max(seen),
                              max(seen) * len(seen) / sum(seen), max(numbers(last, "nodes of others in one exchange"), default=0),
                              max(memory) - libraries)))


def draw(rows, file):
    try:
        import matplotlib
    except ImportError:
        return print("matplotlib is not installed (Debian: python3-matplotlib): no picture")
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, 3, figsize=(12, 3.6), constrained_layout=True)
    n = [row["processes"] for row in rows]
    for axis, columns in zip(axes, (("iterations an increment", "messages", "sums"), ("bytes", "bytes of sums"), ("cells", "ghosts", "memory MB"))):
        for column in columns:
            axis.loglog(n, [max(row[column], 1e-2) for row in rows], "o-", label=column)
        axis.set(xlabel="processes", xticks=n, xticklabels=n)
        axis.minorticks_off()
        axis.legend()
    axes[0].set_title("of a process and iteration")
    axes[1].set_title("of a process and iteration")
    axes[2].set_title("of the process that has most")
    figure.savefig(file, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--results", type=Path, default=TOP / "benchmarks/results")
    parser.add_argument("--cells", type=int, default=12, metavar="N")
    parser.add_argument("--processes", type=int, nargs="*", default=[1, 2, 4, 8, 16, 32], choices=sorted(SHAPES), metavar="N")
    options = parser.parse_args()
    options.results.mkdir(parents=True, exist_ok=True)
    build = options.build.resolve()
    small = run(build, 1, (2, 2, 2), 1)[0]
    libraries = megabytes(small)[0]
    processes = sorted({1, *options.processes})  # one process tells how often elements are looked at
    rows = [measure(build, n, options.cells, libraries) for n in processes]
    times_seen = rows[0]["cells"] / options.cells**3
    for row in rows:
        row["cells"] /= times_seen
    print(table(COLUMNS, [[f"{row[c]:.4g}" if row[c] < 1e4 else f"{row[c]:.0f}" for c in COLUMNS] for row in rows]))
    with open(options.results / "weak_scaling.csv", "w", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    draw(rows, options.results / "weak_scaling.png")


if __name__ == "__main__":
    sys.exit(main())
