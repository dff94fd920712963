#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Iterations (linear solves) of the paper's examples, as a Markdown table.

usage: iterations.py [BUILD]

[K] Tables 2 and 4 beside the published, unscaled smoothing method with two sets of
parameters, A and B, fitted to them (the paper does not print its own), run by
conetact-reproductions on the problems of the default method; the scaled form; and
the default method. err1 and err2 are those of the default method.
"""
import csv
import re
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
METHODS = {"scaled": ["Solver/Method=smoothing"], "automatic": []}
PAPER = {"double-layer-grid-04": [10], "double-layer-grid-07": [13], "double-layer-grid-10": [11],
         "double-layer-grid-12": [10], "double-layer-grid-unloading": [8, 7, 7, 7, 9, 13],
         "square-greco": None, "inclined-obstacle": None}


def increments(build, scene, changes):
    """Rows of increments.csv, and lines of the published method with each set on the problems of these."""
    with tempfile.TemporaryDirectory() as folder:
        command = [build / "conetact", TOP / f"parameter-files/{scene}.prm", "-o", folder, "--quiet", "-s", "Output/VTU=0"]
        for change in changes:
            command += ["-s", change]
        subprocess.run(command, capture_output=True, check=False)
        table = Path(folder) / "increments.csv"
        rows = list(csv.DictReader(table.open())) if table.exists() else []
        problems = sorted(Path(folder).glob("problem-*.txt"))
        text = problems and subprocess.run([build / "conetact-reproductions", "smoothing", *problems],
                                           capture_output=True, text=True).stdout
    return rows, {name: re.findall(rf"^({name} .*)$", text or "", re.M) for name in "AB"}


def counts(numbers, expected):
    if len(numbers) < expected:
        return f"stopped after {len(numbers)} of {expected}"
    return " ".join(map(str, numbers)) if len(numbers) < 10 else f"{sum(numbers)} in {len(numbers)}"


def main(build=TOP / "build"):
    build = Path(build)
    print("| scene | paper | A | B | scaled | automatic | err1 | err2 |")
    print("|---|---|---|---|---|---|---|---|")
    for scene, paper in PAPER.items():
        _, published = increments(build, scene, ["Output/Text increments=all"])
        runs = {name: increments(build, scene, changes)[0] for name, changes in METHODS.items()}
        last = runs["automatic"]
        worst = ["%.0e" % max((abs(float(row[e])) for row in last), default=float("nan")) for e in ("err1", "err2")]
        own = [counts([int(line.split()[1]) for line in lines], len(last)) + any(":" in line for line in lines) * " (gives up)"
               for lines in published.values()]
        print("|", " | ".join([scene, " ".join(map(str, paper)) if paper else "-", *own,
                               *(counts([int(row["iterations"]) for row in rows], len(last)) for rows in runs.values()),
                               *worst]), "|")


if __name__ == "__main__":
    main(*sys.argv[1:])
