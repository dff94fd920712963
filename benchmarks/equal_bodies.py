#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What it saves to condense a body once that stands in a scene several times.

usage: equal_bodies.py BUILD [N...]      (default: N = 12 20)

Four blocks of N^3 elements are pressed on a floor and sheared. Beside them: the same with Young's moduli that differ by 1e-9, so that nothing is
shared, and one of the blocks alone. Clock times are those of the condensation in log.txt.
"""
import re
import sys
import tempfile
from pathlib import Path

from measure import cpu_seconds, table  # first: it knows the way to tests/support
from support.scenes import box, contact, floor, support, write_scene

COLUMNS = ("scene", "factorisations", "condensation s", "over one block", "CPU s")


def scene(n, n_bodies, stretch):
    """Blocks beside each other; Young's modulus grows by `stretch` from one to the next."""
    result = {"Dimension": 3, "Obstacle floor": floor(3), "Time": {"End": 4, "Increments": 4}, "Output": {"VTU": 0}}
    for i in range(n_bodies):
        name = f"block {i}"
        result[f"Body {name}"] = box((n, n, n), (1.0, 1.0, 1.0), young=1000.0 * (1 + i * stretch),
                                     Translation=(3.0 * i, 0.0, 0.0))
        result[f"Contact {name}"] = contact(name, 4, mu=.3)
        result[f"Support {name}"] = support(5, "x, y, z", "0.004*max(t - 1, 0) ; 0 ; -0.01*min(t, 1)", name)
    return result


def measure(program, tree, folder):
    """Factorisations, clock seconds of the condensation, CPU seconds of the process."""
    write_scene(tree, folder / "scene.prm")
    seconds = cpu_seconds([program, folder / "scene.prm", "-q", "-o", folder / "results"])
    log = (folder / "results/log.txt").read_text()
    return (int(re.search(r"work: (\d+) factorisations", log)[1]),
            float(re.search(r"(\S+) s  condensation", log)[1]), seconds)


def main(build, *sizes):
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for n in map(int, sizes or (12, 20)):
            cases = (("one block", 1, 0.0), ("four equal", 4, 0.0), ("four different", 4, 1e-9))
            found = [(f"{n}^3, {name}", measure(Path(build).resolve() / "conetact", scene(n, count, stretch), Path(folder)))
                     for name, count, stretch in cases]
            rows += [(name, factors, f"{time:.2f}", f"{time / found[0][1][1]:.1f}", f"{seconds:.2f}")
                     for name, (factors, time, seconds) in found]
    print(table(COLUMNS, rows))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
