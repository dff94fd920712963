#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hard cases: what is solved, what is rightly refused, what is not.

Runs all families of families.py and 1000 random condensed problems, and each
method by itself on the examples of [K], the 3D block and 100 random definite
problems. With --family statics, or one of them, those whose answers follow from statics
(STATICS below), judged by statics.py from the tables alone. Prints tables in Markdown and the list of all failures, each with
the command that repeats it. Exit code 1 if there are any.

    cmake --build build --target conetact random-problems
    /usr/bin/python3 benchmarks/stability/stability.py
    /usr/bin/python3 benchmarks/stability/stability.py --family stiff-on-soft --case 17
"""
import argparse
import csv
import os
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from families import BLOCK, FAMILIES, INCLINED, SQUARE, block_cells
from program import Case, Result, run
from static_cases import header, line, run_static  # first: it knows the way to tests/support
from families_apart import no_touch
from families_cycles import through_zero
from families_overhang import overhang
from families_pressed import pressed_and_pushed
from families_rollers import roller_box
from families_statics import balanced, joints, stiff_on_soft
from families_weight import own_weight

ROOT = Path(__file__).resolve().parents[2]
METHODS = ("automatic", "active set", "smoothing", "gauss-seidel")
RANDOM, DEFINITE = 1000, 100
AGREEMENT = 1e-9
# title, the case of a number, how many there are, those of the quick part
STATICS = {
    "stiff-on-soft": ("stiff block on soft mat", stiff_on_soft, 1400,
                      (*range(0, 1000, 50), *range(1000, 1200, 50), *range(1200, 1400, 33))),
    "own-weight": ("steel under its own weight", own_weight, 200, range(28)),
    "no-touch": ("bodies that touch nowhere", no_touch, 200, range(12)),
    "joints": ("joints wider and narrower than their master", joints, 100, range(20)),
    "roller-box": ("boxes on rollers", roller_box, 20, range(20)),
    "pressed": ("free blocks, pressed and pushed in many increments", pressed_and_pushed, 200, (1, 3, 6, 20, 56)),
    "through-zero": ("cycles through zero load", through_zero, 200, (1, 5, 6, 7, 8, 9, 10)),
    "overhang": ("overhangs of random blocks", overhang, 200, range(10)),
    "balanced-frictionless": ("balanced loads on frictionless floors", balanced, 60, range(24)),
}


class Setup:
    """Where things are and how much of them is run."""

    def __init__(self, options):
        self.program = options.conetact.resolve()
        self.random = options.random_problems or self.program.parent / "random-problems"
        self.quick, self.cases = options.quick, options.case
        self.keep = bool(options.case)
        self.folder = Path(tempfile.mkdtemp(prefix="conetact-stability-"))
        self.block = block_cells(6) if options.quick else {}
        self.pool = ThreadPoolExecutor(options.jobs)

    def some(self, things, n):
        """All, or n of them from the first to the last when quick."""
        if not self.quick or len(things) <= n:
            return things
        return [things[round(i * (len(things) - 1) / (n - 1))] for i in range(n)]

    def run_all(self, cases, name):
        folders = [self.folder / name / str(i) for i in range(len(cases))]
        return list(self.pool.map(lambda case, folder: self.run_one(case, folder), cases, folders))

    def run_one(self, case, folder):
        try:
            return run(self.program, case, folder)
        finally:
            shutil.rmtree(folder, ignore_errors=True)

    def run_random(self, what, n):
        """Rows of random-problems, in slices that run side by side."""
        size = max(1, n // 16)
        slices = [(first, min(first + size, n)) for first in range(0, n, size)]
        return [row for rows in self.pool.map(lambda s: self.run_slice(what, *s), slices) for row in rows]

    def run_slice(self, what, first, last):
        command = [str(self.random), what, str(first), str(last)]
        text = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        names = ("number", "description", "method", "good", "outcome", "residual", "iterations", "difference")
        return list(csv.DictReader(text.splitlines(), names))


def compare_iterations(results):
    """Cases of one group must take the same iterations in every increment."""
    expected = {}
    for result in results:
        group = result.case.group
        if group and not result.failure and expected.setdefault(group, result.history) != result.history:
            result.failure = f"iterations {result.history} instead of {expected[group]}"


def random_result(row):
    case = Case(f"problem {row['number']}: {row['description']}", Path(), refused=None)
    case.command = lambda: f"random-problems existence {row['number']} {int(row['number']) + 1}"
    failure = "" if row["good"] == "1" else row["outcome"]
    return Result(case, failure, float(row["residual"]), int(row["iterations"]))


def random_family(setup):
    return [random_result(row) for row in setup.run_random("existence", 40 if setup.quick else RANDOM)]


def family_results(setup, name):
    if name == "random":
        return random_family(setup)
    cases = setup.some(FAMILIES[name][1](setup), 4)
    results = setup.run_all(cases, name)
    compare_iterations(results)
    return results


def family_line(title, results):
    good = [result for result in results if not result.failure]
    worst = max((r.residual for r in good), default=0)
    iterations = max((r.iterations for r in good), default=0)
    parts = sum(r.parts > 1 for r in good)
    return f"| {title} | {len(results)} | {len(good)} | {parts} | {worst:.1e} | {iterations} |"


def families_table(setup, names):
    lines = ["| family | cases | solved or rightly refused | of these in parts | worst residual | most iterations |",
             "|---|---|---|---|---|---|"]
    failures = []
    for name in names:
        results = family_results(setup, name)
        if not results:
            continue
        lines.append(family_line(FAMILIES[name][0] if name in FAMILIES else "random condensed problems", results))
        print(lines[-1], file=sys.stderr, flush=True)
        failures += [(name, result) for result in results if result.failure]
    return lines, failures


# ---------------------------------------------------------------- methods

def method_cases(setup, method):
    chosen = {"Solver/Method": method}
    return [Case(f"{method} on 5.1", SQUARE, chosen), Case(f"{method} on 5.2", INCLINED, chosen),
            Case(f"{method} on the 3D block", BLOCK, {**setup.block, **chosen})]


def difference(a, b):
    if a.reactions is None or b.reactions is None:
        return 0.0
    return float(np.abs(a.reactions - b.reactions).max() / np.abs(a.reactions).max())


def method_line(method, results, reference, rows):
    cells = [f"{sum(r.history)}" if not r.failure else "fails" for r in results]
    solved = sum(row["good"] == "1" for row in rows)
    scenes = max(difference(a, b) for a, b in zip(reference, results))
    unique = max((float(row["difference"]) for row in rows), default=0)
    return f"| {method} | {' | '.join(cells)} | {solved} of {len(rows)} | {scenes:.1e} | {unique:.1e} |", \
        max(scenes, unique)


def methods_table(setup):
    lines = ["| method | 5.1 | 5.2 | 3D block | random definite | difference on scenes | difference where unique |",
             "|---|---|---|---|---|---|---|"]
    rows = setup.run_random("methods", 6 if setup.quick else DEFINITE)
    every = [case for method in METHODS for case in method_cases(setup, method)]
    results = setup.run_all(every, "methods")
    failures = [("methods", result) for result in results if result.failure]
    for i, method in enumerate(METHODS):
        own = [row for row in rows if row["method"] == method]
        line, worst = method_line(method, results[3 * i:3 * i + 3], results[:3], own)
        lines.append(line)
        if worst > AGREEMENT or sum(row["good"] == "1" for row in own) < .8 * len(own):
            failures.append(("methods", Result(Case(method, Path()), f"too few solved or a difference of {worst:.1e}")))
    return lines, failures


# ---------------------------------------------------------------- statics

def numbers_of(setup, name):
    """Of the cases that are run."""
    _, _, count, quick = STATICS[name]
    return setup.cases or (list(quick) if setup.quick else range(count))


def static_case(setup, name, number):
    folder = setup.folder / f"{name}-{number}"
    try:
        return run_static(setup.program, number, STATICS[name][1](number), folder)
    finally:
        if not setup.keep:
            shutil.rmtree(folder, ignore_errors=True)


def statics_table(setup, names):
    lines, failures = header(), []
    for name in names:
        numbers = numbers_of(setup, name)
        verdicts = list(setup.pool.map(lambda number, name=name: static_case(setup, name, number), numbers))
        lines.append(line(STATICS[name][0], verdicts))
        print(lines[-1], file=sys.stderr, flush=True)
        for v in verdicts:
            v.case.command = lambda name=name, v=v: f"stability.py --family {name} --case {v.number}"
            v.failure = f"{v.outcome}: {v.text}"
            if setup.cases:
                print(f"{name} {v.number}, {v.case.name}: {v.failure}\n{setup.folder}/{name}-{v.number}")
        failures += [(f"{name} {v.number}", v) for v in verdicts if not v.good]
    return lines, failures


# ---------------------------------------------------------------- report

def report(sections, failures):
    text = "\n\n".join("\n".join(lines) for lines in sections if lines)
    listed = [f"* {name}, {result.case.name}: {result.failure}\n  `{result.case.command()}`"
              for name, result in failures]
    return text + "\n\n" + ("\n".join(["Not reached:", *listed]) if listed else "Nothing failed.") + "\n"


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--family", action="append", choices=[*FAMILIES, "random", "methods", *STATICS, "statics"],
                        help="only this one (may be repeated); statics: all that are judged by statics")
    extent = parser.add_mutually_exclusive_group()
    extent.add_argument("--quick", action="store_true", help="a few cases of each family, smaller meshes")
    extent.add_argument("--full", action="store_true", help="all of them (the default)")
    parser.add_argument("--case", type=int, action="append",
                        help="only this number of a family judged by statics (may be repeated); keeps its folder")
    parser.add_argument("--conetact", type=Path, default=ROOT / "build" / "conetact")
    parser.add_argument("--random-problems", type=Path, help="default: beside conetact")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--table", type=Path, default=ROOT / "output" / "stability.md")
    return parser.parse_args()


def main():
    options = parse()
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    setup = Setup(options)
    names = options.family or [*FAMILIES, "random", "methods"]
    names = [part for name in names for part in (STATICS if name == "statics" else [name])]
    sections, failures = [], []
    try:
        lines, failures = families_table(setup, [name for name in names if name != "methods" and name not in STATICS])
        sections.append(lines if len(lines) > 2 else [])
        if "methods" in names:
            lines, more = methods_table(setup)
            sections.append(lines)
            failures += more
        if statics := [name for name in names if name in STATICS]:
            lines, more = statics_table(setup, statics)
            sections.append(lines)
            failures += more
    finally:
        if not setup.keep:
            shutil.rmtree(setup.folder, ignore_errors=True)
    text = report(sections, failures)
    options.table.parent.mkdir(parents=True, exist_ok=True)
    options.table.write_text(text)
    print("\n" + text)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
