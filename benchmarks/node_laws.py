#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What laws of contact nodes cost beside a constant coefficient of friction, and how they depend on increments.

usage: node_laws.py [--build FOLDER] [--repeats N] [--finest N]

A block is pressed, and sheared until all of it slips (8 increments), in the plane and in space. Of each law: linear
solves of contact, and the least CPU of some runs, both over those of Friction coefficient = 0.3, which run in turn.

Then it is sheared to and fro in the plane in 8 to 32 increments, and in many (--finest): errors against these of all
reactions of the last increment, of wear of all depths, over the largest; the order between the last two of them.
"""
import argparse
import csv
import math
import tempfile
from pathlib import Path

from measure import TOP, checked_resources, table  # first: it knows the way to tests
from support.scenes import load, merge, press_and_shear, write_scene
from support.tables import Run

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


ORDERS = {**{name: {"Friction coefficient": name, **law} for name, law in LAWS.items()},
          "0.2 + 0.1*x, of place": {"Friction coefficient": "0.2 + 0.1*x"},
          "0.2 + 0.1*t, of time": {"Friction coefficient": "0.2 + 0.1*t"},
          "0.2 + 0.001*T, of temperature": {"Friction coefficient": "0.2 + 0.001*T"},
          "0.3, Shear compliance 1e-4": {"Friction coefficient": .3, "Shear compliance": 1e-4},
          "0.3, Compliance of a table": {"Friction coefficient": .3, "Compliance": "table(p; 0 : 2e-4; 20 : 1e-4)"},
          "0.3, Cohesion 0.5 lost by slip": {"Friction coefficient": .3, "Cohesion": .5, "Cohesion lost": "slip"},
          "0.3, Wear coefficient 1e-3, explicit": {"Friction coefficient": .3, "Wear coefficient": 1e-3}}


def to_and_fro(program, law, n):
    """Rows of the last increment, solves of all."""
    scene = merge(press_and_shear(2, mu=.3), {
        "Contact bottom": law, "Load heat": load("temperature", "100*(t - 1)"),
        "Body block": {"Material": {"Expansion coefficient": 1e-9}},
        "Support top": {"Displacement": "0.012*sin(pi*max(t - 1, 0)) ; -0.01*min(t, 1)"}})
    scene["Time"] = {"Stages": f"1 : 1, 2 : {n}"}
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.prm"
        write_scene(scene, file)
        checked_resources([program, file, "-o", Path(folder) / "out", "--quiet"])
        run = Run(Path(folder) / "out")
        return run.last(), sum(row["iterations"] for row in run.increments)


def difference(rows, finest):
    columns = ("wear",) if "wear" in rows[0] else ("r_n", "r_t1")
    largest = max(abs(row[c]) for row in finest for c in columns)
    return max(abs(a[c] - b[c]) for a, b in zip(rows, finest) for c in columns) / largest


def order(errors):
    """Where anything is left to speak of."""
    return f"{math.log2(errors[-2] / errors[-1]):.2f}" if errors[-1] > 1e-9 else "exact"


def orders_of_increments(program, most):
    solves, rows = {}, []
    for name, law in ORDERS.items():
        finest, _ = to_and_fro(program, law, most)
        found = [to_and_fro(program, law, n) for n in (8, 16, 32)]
        solves[name] = found[-1][1]
        errors = [difference(last, finest) for last, _ in found]
        rows.append((name, *(f"{error:.1e}" for error in errors), order(errors), f"{solves[name] / solves['0.3']:.2f}"))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--repeats", type=int, default=4)
    parser.add_argument("--finest", type=int, default=256)
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
    print()
    print(table(("law", "8", "16", "32 increments", "order", "solves over constant"),
                orders_of_increments(options.build / "conetact", options.finest)))


if __name__ == "__main__":
    main()
