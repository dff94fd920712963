#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a scene does not need is not done: numbers of log.txt, never seconds.

usage: check_skips.py PROGRAM
"""
import re
import shutil
import sys

import laws as scenes


def log_of(run):
    return (run.folder / "log.txt").read_text()


def work_of(run):
    """Counts of the last line of a log by what they count."""
    last = log_of(run).splitlines()[-1]
    if not last.startswith("work: "):
        raise RuntimeError(f"the log does not end with its work but with: {last}")
    return {what: int(count) for count, what in re.findall(r"(\d+) ([^,]+)", last)}


def demand_work(laws, name, run, expected):
    found = work_of(run)
    differ = {what: found.get(what) for what, count in expected.items() if found.get(what) != count}
    laws.demand(f"{name}: " + ", ".join(f"{count} {what}" for what, count in expected.items())
                + (f"; found {differ}" if differ else ""), not differ)


def factor_once(laws):
    """One factorisation and one condensation, however many increments and different loads."""
    for dim in (2, 3):
        scene = scenes.press_and_shear(dim, increments=20)
        demand_work(laws, f"{dim}D, 20 increments", laws.run(scene),
                    {"factorisations of the elastic system": 1, "condensations": 1, "reductions of loads": 2,
                     "recoveries of displacements": 20})


def frictionless(laws):
    """Tangential displacements of nodes without friction are condensed with the rest."""
    for dim in (2, 3):
        run = laws.run(scenes.press_and_shear(dim, mu=0.0))
        n = len(run.last())
        laws.demand(f"{dim}D: {n} nodes without friction, as many unknowns",
                    f"{n} contact nodes with {n} unknowns" in log_of(run)
                    and f"skipped: friction cones of {n} contact nodes" in log_of(run))


CHECKS = (factor_once, frictionless)


def main(program):
    laws = scenes.Laws(program)
    for check in CHECKS:
        print(check.__name__)
        try:
            check(laws)
        except RuntimeError as error:
            laws.demand(str(error).strip(), False)
    shutil.rmtree(laws.folder)
    return 1 if laws.failed else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) == 2 else __doc__)
