#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What it saves to condense only the contact nodes that touch.

usage: working_set.py BUILD [RUNS]

Runs parameter-files/sphere-on-layer.prm with Solver/Working set = automatic and = all in turn,
no drawings, and compares CPU seconds of whole processes on one core and the reactions.
"""
import csv
import statistics
import sys
import tempfile
from pathlib import Path

from measure import TOP, cpu_seconds, table

SCENE = TOP / "parameter-files/sphere-on-layer.prm"
FORCES = ("r_n", "r_t1", "r_t2")


def rows(folder):
    with open(folder / "reactions.csv") as file:
        return list(csv.DictReader(file))


def forces(folder):
    return [[float(row[column]) for column in FORCES] for row in rows(folder)]


def difference(a, b):
    largest = max(abs(x) for row in a for x in row)
    return max(abs(x - y) for one, other in zip(a, b) for x, y in zip(one, other)) / largest


def main(build, runs=3):
    with tempfile.TemporaryDirectory() as scratch:
        folders = {word: Path(scratch, word) for word in ("automatic", "all")}
        seconds = {word: [] for word in folders}
        for _ in range(int(runs)):
            for word, folder in folders.items():
                seconds[word].append(cpu_seconds([Path(build, "conetact"), SCENE, "--quiet", "-o", folder, "-s",
                                                  "Output/VTU=0", "-s", f"Solver/Working set={word}"]))
        found = rows(folders["all"])
        last = [row["state"] for row in found if row["increment"] == found[-1]["increment"]]
        part, whole = (statistics.median(seconds[word]) for word in folders)
        touching = sum(state != "open" for state in last)
        print(table(("candidates", "touch at the end", "working set [CPU s]", "all nodes [CPU s]", "ratio",
                     "largest difference of forces"),
                    [(len(last), f"{touching} ({100 * touching / len(last):.1f} %)", f"{part:.2f}", f"{whole:.2f}",
                      f"{whole / part:.1f}",
                      f"{difference(*map(forces, folders.values())):.0e}")]))


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(*sys.argv[1:])
