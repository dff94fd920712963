#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hard cases with and without condensation.

usage: robustness.py [--build FOLDER] [--cells N]      (default: 16 cells along an edge)

A block of N^3 cells pressed in one increment and sheared in four, unless a case says otherwise: with little
and much friction, nearly incompressible, all of the load at once, mostly open, held by friction only, on a body
that is much harder or softer, with loads beyond what contacts carry. Both backends: the largest difference of
nodal reactions over the largest reaction, nodes whose states differ, Newton steps and linear iterations an
increment of the iterative one, CPU seconds of whole processes on one core; or the sentence that both say.
"""
import argparse
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from measure import TOP, table  # first: it knows the way to tests/support
from support.scenes import box, contact, floor, joint, load, merge, press_and_shear, support, with_element, write_scene
from support.tables import REACTION, Run

COLUMNS = ("case", "open", "difference of reactions", "other states", "Newton steps", "linear iterations",
           "condensed, CPU s", "iterative, CPU s")
INCREMENTS = 5


def block(n, mu=.3, nu=.3, element="Q1"):
    scene = with_element(press_and_shear(3, (n, n, n), mu, INCREMENTS), element)
    return merge(scene, {"Body block": {"Material": {"Poisson ratio": nu}}})


def at_once(scene):
    return merge(scene, {"Time": {"Increments": 1}})


def mostly_open(n):
    """A floor that falls away from one edge."""
    return merge(block(n), {"Obstacle floor": {"Normal": (.05, 0, 1)}})


def held_by_friction(n, part, height=.5):
    """Its weight, then a push at a height by a part of what friction holds."""
    middle = f"{part * .3}*max(t - 1, 0)/{INCREMENTS - 1}"
    scene = merge(block(n), {"Support top": None, "Body block": box((n, n, n), (1.0, 1.0, 1.0)),
                             "Load weight": load("body force", "0 ; 0 ; -min(t, 1)")})
    if height == .5:
        return merge(scene, {"Load push": load("body force", f"{middle} ; 0 ; 0")})
    return merge(scene, {"Contact bottom": {"Friction coefficient": 2},
                         "Load push": load("traction", f"{part * .5}*max(t - 1, 0)/{INCREMENTS - 1} ; 0 ; 0", 5)})


def on_a_body(n, upper, lower, slave="block"):
    """A block on another one of slightly smaller cells, held at the bottom; Young's moduli of both."""
    sides = {"block": 4, "base": 5}
    master = "base" if slave == "block" else "block"
    return merge(block(n), {
        "Obstacle floor": None, "Contact bottom": None, "Body block": {"Material": {"Young modulus": upper}},
        "Body base": box((n + 1, n + 1, n // 2), (1.5, 1.0, .6), (0.0, 0.0, -.6), young=lower),
        "Contact joint": joint(slave, sides[slave], master, sides[master], **{"Friction coefficient": .3}),
        "Support ground": support(4, "x, y, z", body="base")})


def cases(n):
    yield from ((f"mu = {mu}", block(n, mu=mu)) for mu in (.05, .1, .3, 1, 2))
    yield from ((f"nu = {nu}", block(n, nu=nu)) for nu in (.1, .4, .45, .49))
    yield from ((f"nu = {nu}, Q1 B-bar", block(n, nu=nu, element="Q1 B-bar")) for nu in (.49, .499, .4999))
    yield from ((f"mu = {mu}, all load in one increment", at_once(block(n, mu=mu))) for mu in (.05, .3, 2))
    yield "nearly all nodes open", mostly_open(n)
    yield "nearly all nodes open, in one increment", at_once(mostly_open(n))
    yield "held by friction only, 0.8 of its limit", held_by_friction(n, .8)
    yield "the same in one increment", at_once(held_by_friction(n, .8))
    for upper, lower, slave in ((1, 1, "block"), (1, 1000, "block"), (1, 1000000, "block"), (1000, 1, "base"),
                                (1000000, 1, "base"), (1000, 1, "block"), (1000000, 1, "block")):
        what = "" if upper == lower else ", the harder one is the slave" if (upper > lower) == (slave == "block") else ""
        yield f"a block on another, E {upper} on {lower}{what}", on_a_body(n, float(upper), float(lower), slave)
    yield "held by friction only, 1.05 of its limit", held_by_friction(n, 1.05)
    yield "pushed at its top, 1.05 of what tips it", held_by_friction(n, 1.05, 1)


class Ended:
    """A run: CPU seconds, exit code and sentence, tables."""

    def __init__(self, build, scene, backend, folder, *entries):
        folder.mkdir()
        write_scene(scene, folder / "scene.prm")
        command = [build / "conetact", folder / "scene.prm", "-q", "-o", folder / "result", "-s", f"Solver/Backend={backend}"]
        for entry in entries:
            command += ["-s", entry]
        before = os.times()
        done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
        after = os.times()
        self.seconds = (after.children_user - before.children_user) + (after.children_system - before.children_system)
        self.code = done.returncode
        self.sentence = re.sub(r"^conetact: |The increments before it are on disk\.$", "", done.stderr.strip()).strip()
        self.run = Run(folder / "result") if self.code == 0 else None
        log = folder / "result" / "log.txt"
        text = log.read_text() if log.exists() else ""
        self.linear, self.megabytes = (round(float(found[1])) if (found := re.search(pattern, text)) else 0
                                       for pattern in (r"(\d+) linear iterations", r"memory: ([\d.]+) MB"))


def agreement(a, b):
    """Of nodal reactions, and how many states differ."""
    first, second, size = a.at(), b.at(), a.largest(*REACTION)
    worst = max(math.dist(*([row[c] for c in REACTION] for row in (first[key], second[key]))) for key in first)
    return worst / size, sum(first[key]["state"] != second[key]["state"] for key in first)


def row_of(name, condensed, iterative):
    times = (f"{condensed.seconds:.2f}", f"{iterative.seconds:.2f}")
    if condensed.code == iterative.code == 0:
        rows, increments = condensed.run.last(), iterative.run.increments
        n_open = sum(row["state"] == "open" for row in rows)
        difference, states = agreement(condensed.run, iterative.run)
        linear = f"{iterative.linear / len(increments):.0f}"
        if any(row["solver"] != "iterative" for row in increments):
            linear += ", then condensed"
        steps = sum(row["iterations"] for row in increments) / len(increments)
        return (name, f"{100 * n_open / len(rows):.0f} %", f"{difference:.0e}", states, f"{steps:.1f}", linear, *times)
    if (condensed.code, condensed.sentence) == (iterative.code, iterative.sentence):
        return (name, "", f"both: {condensed.sentence}", "", "", "", *times)
    return (name, "", *(f"{end.code}: {end.sentence}" if end.code else "solved" for end in (condensed, iterative)), "", "", *times)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--cells", type=int, default=16)
    options = parser.parse_args()
    missed, print_row = 0, lambda row: print("| " + " | ".join(map(str, row)) + " |", flush=True)
    print(table(COLUMNS, []))
    with tempfile.TemporaryDirectory(prefix="conetact-robustness-") as folder:
        for i, (name, scene) in enumerate(cases(options.cells)):
            ends = [Ended(options.build.resolve(), scene, backend, Path(folder) / f"{i}-{backend}")
                    for backend in ("condensed", "iterative")]
            missed += (ends[0].code, ends[0].sentence) != (ends[1].code, ends[1].sentence)
            print_row(row_of(name, *ends))
    print(f"\n{missed} cases end otherwise with the other backend.")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
