#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs shipped scenes of frames with other values and checks closed forms.

usage: check_frames.py PROGRAM

The bar on a rigid base with 4 to 160 nodes, the beam on three supports under
other loads, and double-layer grids whose load nothing can hold.
"""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

SCENES = Path(__file__).resolve().parent.parent / "parameter-files"


def run(program, scene, **overrides):
    """Exit code, message and rows of the last increment on disk."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program, SCENES / f"{scene}.prm", "-o", folder, "--quiet", "-s", "Output/VTU=0"]
        for entry, value in overrides.items():
            command += ["-s", f"{entry}={value}"]
        done = subprocess.run(command, capture_output=True, text=True)
        table = Path(folder) / "reactions.csv"
        rows = []
        if table.exists():
            with open(table, newline="") as stream:
                rows = list(csv.DictReader(stream))
        last = max((int(row["increment"]) for row in rows), default=0)
        return done.returncode, done.stderr, [row for row in rows if int(row["increment"]) == last]


def bar_on_rigid_base(program):
    """u_i = mu q/(2 E A) ((x_i - l_c)^2 - (x_j - l_c)^2), see the scene."""
    length, q, mu, force, stiffness = 260, 3975, 0.3, 243750, 1.95e9 * 0.09361946107697598
    start = length - force / (mu * q)
    for n in (4, 5, 6, 10, 11, 20, 40, 80, 160):
        h = length / (n - 1)
        x = [i * h for i in range(1, n)]
        x_j = max(x_i for x_i in [0] + x if x_i <= start + h / 2)
        exact = [mu * q / (2 * stiffness) * ((x_i - start) ** 2 - (x_j - start) ** 2) if x_i > x_j else 0 for x_i in x]
        code, message, rows = run(program, "bar-on-rigid-base",
                                  **{"Body bar/Frame/Arguments": f"0, 0 : {length}, 0 : {n - 1}"})
        rows.sort(key=lambda row: float(row["x"]))
        found = [float(row["u_t1"]) for row in rows]
        error = max((abs(a - b) for a, b in zip(exact, found)), default=1) / exact[-1]
        print(f"bar of {n} nodes: exit code {code}, error {error:.2g}")
        yield code == 0 and len(rows) == n - 1 and error <= 1e-10, f"bar of {n} nodes: {message}"


def beam_three_supports(program):
    for p in (1e-6, 1, 40):
        code, message, rows = run(program, "beam-three-supports", **{"Load force/Value": f"0 ; -{p}*t", "Contact supports/Kinematics": "small"})
        found = [float(row[c]) / p for row in rows for c in ("gap", "r_n", "r_t1")]
        error = max((abs(a - b) for a, b in zip([.5, 0, 0, 0, .5, 0, 0, .5, 0], found)), default=1)
        print(f"beam with p = {p}: exit code {code}, error {error:.2g}")
        yield code == 0 and len(found) == 9 and error <= 1e-12, f"beam with p = {p}: {message}"


def limits_of_grids(program):
    mu, load = "Contact feet/Friction coefficient", "Load weight/Value"
    slides = run(program, "double-layer-grid-10", **{mu: 1.118})
    holds = run(program, "double-layer-grid-10", **{mu: 1.119})
    print(f"10 x 10 grid, mu = 1.118 and 1.119: exit codes {slides[0]}, {holds[0]}")
    yield slides[0] == 2 and "slides" in slides[1], f"mu = 1.118: {slides}"
    yield holds[0] == 0, f"mu = 1.119: {holds[1]}"
    lifted = run(program, "double-layer-grid-unloading",
                 **{"Time/Times": "1, 2, 3, 4, 5, 6, 7", "Time/End": 7,
                    load: "0 ; 0 ; -5e-4/6 * if(t < 1, 5 * t, if(t < 6.5, 5 - 0.95 * (t - 1), -0.1))"})
    print(f"relieved grid that is pulled up: exit code {lifted[0]}")
    yield lifted[0] == 2 and "no equilibrium" in lifted[1], f"gamma = -0.1: {lifted}"
    yield lifted[2] and lifted[2][0]["increment"] == "6", "gamma = -0.1: increment 6 is not on disk"


def main(program):
    checks = [*bar_on_rigid_base(program), *beam_three_supports(program), *limits_of_grids(program)]
    faults = [fault for passed, fault in checks if not passed]
    print("\n".join(faults) or "all is well")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
