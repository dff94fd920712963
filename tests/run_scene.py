#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs scenes, each in its own empty folder, and compares their tables.

usage: run_scene.py [--refresh | --no-golden] PROGRAM FOLDER SCENE.prm...

FOLDER/NAME/result receives what the scene NAME.prm writes. Its reactions.csv
and increments.csv are compared with those of NAME.table/ next to the scene:
numbers to a tolerance relative to the largest of their column, texts exactly,
rows matched by increment, contact and place. How well and how fast a solver did
is bounded instead. --refresh writes NAME.table/; --no-golden only runs the
scene and checks the bounds. The head of a scene may say
(of a scene that differs from a right one in a line or two, see run_errors.py)
  # expect error: exit=1 part of the message
  # compare: tolerance=1e-6 bound=1e-8     (defaults 1e-8 and 1e-10)
  # arguments: -s Section/Entry=value
  # scene: ../../parameter-files/NAME.prm      (run that one instead)
  # golden: OTHER.table                        (compare with that one)
"""
import csv
import itertools
import math
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

TABLES = ("reactions.csv", "increments.csv")
TEXTS = ("contact", "state", "solver", "determinate")
NOT_COMPARED = ("node", "err1", "err2")
BOUNDED = ("residual", "equilibrium", "balance")
COUNTED = ("iterations", "substeps")
# Columns of one kind, and what is noise among them (relative to the largest).
GROUPS = ((r"(d?u_|gap)", 1e-12), (r"r_", 2e-9), (r"pressure|traction_", 2e-9), (r"foot_|acts_", 1e-12),
          (r".*_[fm]_.$", 2e-9),
          (r"strain_energy|external_work|dissipation|contact_work_normal", 2e-9), (r"", 0))


def read(file):
    with open(file, newline="") as stream:
        reader = csv.DictReader(stream)
        return reader.fieldnames, list(reader)


def group(column):
    return next(g for g in GROUPS if re.match(g[0], column))


def largest(rows, column):
    return max((abs(float(row[column])) for row in rows), default=0.0)


class Place:
    """Keys of rows: increment, contact and undeformed position."""

    def __init__(self, rows):
        self.axes = [a for a in "xyz" if rows and a in rows[0]]
        self.step = 1e-6 * max((largest(rows, a) for a in self.axes), default=0)
        self.rows = {}
        for row in rows:
            self.rows.setdefault(self.key(row), row)

    def key(self, row, shift=(0, 0, 0)):
        at = (round(float(row[a]) / (self.step or 1)) + s for a, s in zip(self.axes, shift))
        return (row["increment"], row.get("contact"), *at)

    def find(self, row):  # rounding may have put it into the next step
        for shift in itertools.product((0, 1, -1), repeat=3):
            if self.key(row, shift) in self.rows:
                return self.rows[self.key(row, shift)]
        return None


def compare(name, old, new, tolerance):
    """Differences between a golden table and a new one, as sentences."""
    (columns, old_rows), (new_columns, new_rows) = old, new
    lost = [c for c in columns if c not in new_columns]  # those that came later are not compared
    if lost:
        return [f"{name}: there are no columns {lost}"]
    if len(old_rows) != len(new_rows):
        return [f"{name}: {len(new_rows)} rows instead of {len(old_rows)}"]
    place = Place(new_rows)
    pairs = [(row, place.find(row)) for row in old_rows]
    lost = [row for row, other in pairs if other is None]
    if lost or len(place.rows) != len(new_rows):
        return [f"{name}: rows cannot be matched, such as {dict(list((lost or new_rows)[0].items())[:7])}"]

    numbers = [c for c in columns if c not in TEXTS + NOT_COMPARED + COUNTED and not is_bounded(c)]
    scale = {c: largest(old_rows, c) for c in numbers}
    faults = []
    for column in columns:
        if column in TEXTS:
            bad = [(a, b) for a, b in pairs if a[column] != b[column]]
        elif column in COUNTED:
            bad = [(a, b) for a, b in pairs if not float(b[column]) <= 2 * float(a[column]) + 5]
        elif column in numbers:
            kind, noise = group(column)
            of_kind = max(scale[c] for c in numbers if group(c)[0] == kind)
            limit = max(tolerance * scale[column], min(noise, tolerance) * of_kind)
            # so that nan differs from everything
            bad = [(a, b) for a, b in pairs if not abs(float(a[column]) - float(b[column])) <= limit]
        else:
            continue
        if bad:
            a, b = bad[0]
            faults.append(f"{name}: {column} differs in {len(bad)} rows, first in increment {a['increment']}"
                          f" at {[a.get(x) for x in 'xyz']}: {b[column]} instead of {a[column]}")
    return faults


def is_bounded(column):
    return column in BOUNDED or column.startswith("balance_")


def check_bounds(rows, bound):
    faults = [f"increment {row['increment']}: {c} = {row[c]} > {bound}"
              for row in rows for c in row if is_bounded(c) and not float(row[c]) <= bound]
    return faults + [f"increment {row['increment']}: {c} = {row[c]}"
                     for row in rows for c in ("err1", "err2") if not math.isfinite(float(row[c]))]


def check_error(run, result, code, fragment):
    lines = [line for line in run.stderr.splitlines() if line.strip()]
    faults = []
    if run.returncode != code:
        faults.append(f"exit code {run.returncode} instead of {code}")
    if len(lines) != 1 or re.search(r"dealii::|[Ss]tack ?trace|terminate called|Exc[A-Z]", run.stderr):
        faults.append("the message is not one plain sentence")
    if fragment not in run.stderr:
        faults.append(f"the message does not say: {fragment}")
    if code == 1 and result.exists():
        faults.append("something was written: " + ", ".join(p.name for p in result.iterdir()))
    return faults


def process(program, folder):
    """Starts the program in a folder."""
    return lambda *words: subprocess.run([program, *words], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                         errors="replace")


def execute(start, work, file, arguments):
    """Runs a scene into an empty folder: the process, the folder of its results, and what is wrong so far."""
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    result = work / "result"
    run = start(file, "-o", result, "--quiet", *arguments)
    print(run.stdout + run.stderr, end="")
    left = [p.name for p in work.iterdir() if p != result]
    return run, result, [f"files beside the result: {left}"] if left else []


def run_scene(program, folder, scene, mode):
    head = scene.read_text()
    expect = re.search(r"^# expect error: exit=(\d+) (.*\S)", head, re.M)
    options = dict(re.findall(r"(\w+)=(\S+)", (re.search(r"^# compare: (.*)", head, re.M) or [""])[0]))
    arguments = shlex.split((re.search(r"^# arguments: (.*)", head, re.M) or ["", ""])[1])
    other = re.search(r"^# scene: (\S+)", head, re.M)
    same = re.search(r"^# golden: (\S+)", head, re.M)
    if mode == "--refresh" and (expect or same):
        return []

    golden = scene.parent / same[1] if same else scene.with_suffix(".table")
    file = (scene.parent / other[1]).resolve() if other else scene
    run, result, faults = execute(process(program, folder / scene.stem), folder / scene.stem, file, arguments)
    if expect:
        return faults + check_error(run, result, int(expect[1]), expect[2])
    if run.returncode != 0:
        return faults + [f"exit code {run.returncode}"]

    tables = {name: read(result / name) for name in TABLES}
    faults += check_bounds(tables["increments.csv"][1], float(options.get("bound", 1e-10)))
    if mode == "--refresh" and not faults:
        golden.mkdir(exist_ok=True)
        for name in TABLES:
            shutil.copy(result / name, golden / name)
    elif mode == "compare" and not golden.is_dir():
        faults.append(f"there is no {golden} yet: ./test --refresh writes it")
    elif mode == "compare":
        for name in TABLES:
            faults += compare(name, read(golden / name), tables[name], float(options.get("tolerance", 1e-8)))
    return faults


def main(arguments):
    mode = arguments.pop(0) if arguments[0].startswith("--") else "compare"
    program, folder = (Path(a).resolve() for a in arguments[:2])
    failed = False
    for scene in arguments[2:]:
        for fault in run_scene(program, folder, Path(scene).resolve(), mode):
            print(f"{Path(scene).name}: {fault}")
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
