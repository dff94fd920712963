#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Aggregation of this program and that of Trilinos (ML) as preconditioners, on the cases of robustness.py.

usage: preconditioners.py [--build FOLDER] [--cells N]      (default: 16 cells along an edge)

Backend = iterative with both, one run after the other: the largest difference of nodal reactions over the
largest one, nodes whose states differ, Newton steps and linear iterations an increment, CPU seconds and
memory of whole processes.
"""
import argparse
import sys
import tempfile
from pathlib import Path

from measure import TOP, table
from robustness import Ended, agreement, cases

KINDS = ("aggregation", "trilinos ml")
COLUMNS = ("case", "difference of reactions", "other states", *(f"{kind}: {what}" for kind in KINDS for what in
                                                               ("Newton steps, linear iterations", "CPU s, MB")))


def solved_by(end):
    """What one of both needed; or its sentence."""
    if end.code:
        return f"{end.code}: {end.sentence}", f"{end.seconds:.2f}, {end.megabytes}"
    rows = end.run.increments
    then = ", then condensed" if any(row["solver"] != "iterative" for row in rows) else ""
    return (f"{sum(row['iterations'] for row in rows) / len(rows):.1f}, {end.linear / len(rows):.0f}{then}",
            f"{end.seconds:.2f}, {end.megabytes}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--cells", type=int, default=16)
    options = parser.parse_args()
    missed = 0
    print(table(COLUMNS, []))
    with tempfile.TemporaryDirectory(prefix="conetact-preconditioners-") as folder:
        for i, (name, scene) in enumerate(cases(options.cells)):
            ends = [Ended(options.build.resolve(), scene, "iterative", Path(folder) / f"{i}-{k}", f"Solver/Preconditioner={kind}")
                    for k, kind in enumerate(KINDS)]
            missed += ends[0].code != ends[1].code
            difference, states = agreement(*(end.run for end in ends)) if not any(end.code for end in ends) else (0.0, 0)
            print("| " + " | ".join([name, f"{difference:.0e}", str(states), *(text for end in ends for text in solved_by(end))]) + " |",
                  flush=True)
    print(f"\n{missed} cases end otherwise with the other preconditioner.")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
