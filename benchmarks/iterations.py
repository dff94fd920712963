#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Iterations (linear solves) of the paper's examples, as a Markdown table.

usage: iterations.py [PROGRAM]

[K] Tables 2 and 4 beside the published, unscaled smoothing method with two sets of
parameters, A and B, fitted to them (the paper does not print its own); the scaled
form; and the default method. err1 and err2 are those of the default method.
"""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
PUBLISHED = ["Solver/Method=smoothing", "Solver/Scaling=none", "Solver/Tolerance=1e-8",
             "Solver/Smoothing/kappa=1", "Solver/Smoothing/kappahat=1", "Solver/Smoothing/rho=0.5",
             "Solver/Smoothing/sigma=1e-4"]


def smoothing(eta, etabar, m0, beta0):
    return PUBLISHED + [f"Solver/Smoothing/eta={eta}", f"Solver/Smoothing/etabar={etabar}",
                        f"Solver/Smoothing/m0={m0}", f"Solver/Smoothing/eps0={m0}", f"Solver/Smoothing/beta0={beta0}"]


METHODS = {"A": smoothing(.9, .5, 1e-3, 1), "B": smoothing(.5, .1, .1, 100),
           "scaled": ["Solver/Method=smoothing"], "automatic": []}
PAPER = {"double-layer-grid-04": [10], "double-layer-grid-07": [13], "double-layer-grid-10": [11],
         "double-layer-grid-12": [10], "double-layer-grid-unloading": [8, 7, 7, 7, 9, 13],
         "square-greco": None, "inclined-obstacle": None}


def increments(program, scene, changes):
    with tempfile.TemporaryDirectory() as folder:
        command = [program, TOP / f"parameter-files/{scene}.prm", "-o", folder, "--quiet", "-s", "Output/VTU=0"]
        for change in changes:
            command += ["-s", change]
        subprocess.run(command, capture_output=True, check=False)
        table = Path(folder) / "increments.csv"
        return list(csv.DictReader(table.open())) if table.exists() else []


def counts(rows, expected):
    numbers = [int(row["iterations"]) for row in rows]
    if len(numbers) < expected:
        return f"stopped after {len(numbers)} of {expected}"
    return " ".join(map(str, numbers)) if len(numbers) < 10 else f"{sum(numbers)} in {len(numbers)}"


def main(program=TOP / "build/conetact"):
    print("| scene | paper | A | B | scaled | automatic | err1 | err2 |")
    print("|---|---|---|---|---|---|---|---|")
    for scene, paper in PAPER.items():
        runs = {name: increments(program, scene, changes) for name, changes in METHODS.items()}
        last = runs["automatic"]
        worst = ["%.0e" % max((abs(float(row[e])) for row in last), default=float("nan")) for e in ("err1", "err2")]
        print("|", " | ".join([scene, " ".join(map(str, paper)) if paper else "-",
                               *(counts(rows, len(last)) for rows in runs.values()), *worst]), "|")


if __name__ == "__main__":
    main(*sys.argv[1:])
