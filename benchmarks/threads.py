#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What threads gain, and that results do not depend on them.

usage: threads.py [--build FOLDER] [--results FOLDER] [--threads T] [--runs R] [N...]   (default: 4, 3 and N = 30)

block-press-shear.prm with N^3 elements, nothing drawn, with one thread and with T in turn: medians of clock
and CPU seconds of whole processes, and the largest difference of a column of
reactions.csv over its largest value. Wants an idle machine.
"""
import argparse
import csv
import statistics
import sys
import tempfile
import time
from pathlib import Path

from measure import TOP, cpu_seconds

COLUMNS = ("elements", "1 thread: clock s", "CPU s", "T threads: clock s", "CPU s", "clock ratio", "difference")


def run(build, n, threads, folder):
    """Clock and CPU seconds."""
    command = [str(build / "conetact"), str(TOP / "parameter-files/block-press-shear.prm"), "-q", "-o", str(folder),
               "-s", "Output/VTU=0", "-s", f"Solver/Threads={threads}",
               "-s", f"Body block/Mesh/Arguments={n}, {n}, {n} : 0, 0, 0 : 1, 1, 1 : true"]
    start = time.perf_counter()
    seconds = cpu_seconds(command, one_core=False)
    return time.perf_counter() - start, seconds


def reactions(folder):
    with open(Path(folder) / "reactions.csv", newline="") as table:
        return list(csv.DictReader(table))


def difference(one, other):
    """Largest, of numbers over the largest of their column; states must agree."""
    worst = 0.
    for column in one[0]:
        if column in ("contact", "state"):
            if any(a[column] != b[column] for a, b in zip(one, other)):
                return float("inf")
            continue
        pairs = [(float(a[column]), float(b[column])) for a, b in zip(one, other)]
        largest = max(abs(a) for a, _ in pairs)
        if largest > 0:
            worst = max(worst, max(abs(a - b) for a, b in pairs) / largest)
    return worst


def compare(options, n):
    with tempfile.TemporaryDirectory() as folder:
        folders = {threads: Path(folder) / str(threads) for threads in (1, options.threads)}
        runs = {threads: [] for threads in folders}
        for _ in range(options.runs):
            for threads, where in folders.items():
                runs[threads].append(run(options.build.resolve(), n, threads, where))
        tables = [reactions(where) for where in folders.values()]
    medians = [statistics.median(x) for threads in folders for x in zip(*runs[threads])]
    return (f"{n}^3", *(f"{x:.3g}" for x in medians), f"{medians[0] / medians[2]:.2f}", f"{difference(*tables):.1e}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--results", type=Path, default=TOP / "benchmarks/results")
    parser.add_argument("--threads", type=int, default=4, metavar="T")
    parser.add_argument("--runs", type=int, default=3, metavar="R")
    parser.add_argument("sizes", type=int, nargs="*", metavar="N")
    options = parser.parse_args()
    options.results.mkdir(parents=True, exist_ok=True)
    columns = [c.replace("T threads", f"{options.threads} threads") for c in COLUMNS]
    print("|", " | ".join(columns), "|\n|" + "---|" * len(columns))
    with open(options.results / "threads.csv", "w", newline="") as stream:
        table = csv.writer(stream)
        table.writerow(columns)
        for n in options.sizes or [30]:
            row = compare(options, n)
            table.writerow(row)
            print("|", " | ".join(row), "|", flush=True)


if __name__ == "__main__":
    sys.exit(main())
