#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What laws of contact nodes cost beside a constant coefficient of friction.

usage: node_laws.py [--build FOLDER] [--repeats N]

A block is pressed, and sheared until all of it slips (8 increments), in the plane and in space. Of each law: linear
solves of contact, and the least CPU of some runs, both over those of Friction coefficient = 0.3, which run in turn.
"""
import argparse
import csv
import tempfile
from pathlib import Path

from measure import TOP, checked_resources, table  # first: it knows the way to tests
from support.scenes import press_and_shear, write_scene

LAWS = {"0.3": {}, "0.2 + 0.1*exp(-s/0.003)": {}, "if(t < 2.5, 0, 0.3)": {}, "min(0.4, 20/p)": {}, "0.3/(1 + p/50)": {},
        "0.15 + 0.1*exp(-v/0.002)": {}, "0.4, Shear limit 1.5": {"Friction coefficient": .4, "Shear limit": 1.5},
        "0.3, Compliance 1e-4": {"Friction coefficient": .3, "Compliance": 1e-4},
        "0.3, wear, explicit": {"Friction coefficient": .3, "Wear coefficient": 1e-5},
        "0.3, wear, implicit": {"Friction coefficient": .3, "Wear coefficient": 1e-3, "Wear integration": "implicit"},
        "0.3, Cohesion 0.5": {"Friction coefficient": .3, "Cohesion": .5},
        "0.3, Cohesion 0.5 that softens": {"Friction coefficient": .3, "Cohesion": .5, "Tensile strength": .5,
                                           "Cohesion lost": "slip", "Softening length": .02}}


def cost(program, dim, name):
    """Linear solves of contact, CPU seconds."""
    with tempfile.TemporaryDirectory() as folder:
        mu = name.split(", ")[0] if "Friction coefficient" in LAWS[name] else name
        scene = press_and_shear(dim, cells=(80, 40) if dim == 2 else (16, 12, 12), mu=mu, increments=8)
        scene["Contact bottom"].update(LAWS[name])
        file = Path(folder) / "scene.prm"
        write_scene(scene, file)
        seconds = checked_resources([program, file, "-o", Path(folder) / "out", "--quiet"])[0]
        with open(Path(folder) / "out/increments.csv", newline="") as stream:
            return sum(int(row["iterations"]) for row in csv.DictReader(stream)), seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--repeats", type=int, default=4)
    options = parser.parse_args()
    rows = []
    for dim in (2, 3):
        # in turn, for machines have moods
        rounds = [{name: cost(options.build / "conetact", dim, name) for name in LAWS} for _ in range(options.repeats)]
        found = {name: min(of[name] for of in rounds) for name in LAWS}
        for name, (solves, seconds) in found.items():
            rows.append((f"{dim}D", name, solves, f"{solves / found['0.3'][0]:.2f}", f"{seconds:.2f}",
                         f"{seconds / found['0.3'][1]:.2f}"))
    print(table(("", "law", "solves", "over constant", "CPU [s]", "over constant"), rows))


if __name__ == "__main__":
    main()
