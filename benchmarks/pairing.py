#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What it costs to find contacts of bodies, against their number.

usage: pairing.py [--build FOLDER] [--sizes N...] [--small N...] [--iterative N...] [--sliding N...]

Two plates of N x N cells, one cell thick, or as many that they are cubes where nothing is condensed; the upper one is
turned by 20 degrees on the lower one, whose cells are
1.5 times as large. First table: one pairing, from CPU seconds of dry runs of scenes in which the same
contact stands once and many times, which cancels all that is not pairing; the last row are exponents over the
number of contact nodes, least squares of logarithms. Second table: what pairings take of an increment: of
the only one of a whole run (`small`; condensed and iterative), and of one of two that
slide by a cell of the master each (`finite sliding`; runs of three increments less runs of one).
Finite sliding keeps all components of both surfaces: N = 50 takes 3 GB.
"""
import argparse
import math
import re
import tempfile
from pathlib import Path

from measure import TOP, checked_resources, cpu_seconds, table  # first: it knows the way to tests/support
from support.scenes import box, joint, support, write_scene

PAIRINGS = ("mortar", "node to face")
COLUMNS = ("contact nodes", *(f"{p}, {unit}" for p in PAIRINGS for unit in ("ms", "us a node")))
SHARES = ("Kinematics", "Backend", "pairing", "contact nodes", "pairings", "one pairing, s", "increment, CPU s", "share", "peak MB")


def plates(n, pairing, increments=1, contacts=1, cubes=False, **entries):
    layers = max(n // 10, 1) if cubes else 1
    scene = {"Dimension": 3, "Body lower": box((n, n, layers), (1.5, 1.5, .1), (-.75, -.75, -.1)),
             "Body upper": box((n, n, layers), (1.0, 1.0, .1), (-.5, -.5, 0.0), Rotation=(0, 0, 1, 20.0)),
             "Support base": support(4, "x, y, z", body="lower"),
             "Support top": support(5, "x, y, z", f"{1.5 / n!r}*max(t - 1, 0) ; 0 ; -1e-3*min(t, 1)", "upper"),
             "Time": {"End": increments, "Increments": increments}, "Output": {"VTU": 0}}
    for i in range(contacts):
        scene[f"Contact joint {i}"] = joint("upper", 4, "lower", 5, Pairing=pairing, **entries)
    return scene


def one_pairing(program, n, pairing, folder, runs):
    """CPU seconds; so many contacts that start-up and noise are small beside them."""
    many = max(3, min(65, 10000 // n**2 + 1))
    spent = []
    for contacts in (1, many):
        write_scene(plates(n, pairing, contacts=contacts), folder / "scene.prm")
        spent.append(min(cpu_seconds([program, folder / "scene.prm", "--dry-run"]) for _ in range(runs)))
    return (spent[1] - spent[0]) / (many - 1)


def exponent(sizes, seconds):
    x, y = ([math.log(v) for v in values] for values in (sizes, seconds))
    x0, y0 = sum(x) / len(x), sum(y) / len(y)
    return sum((a - x0) * (b - y0) for a, b in zip(x, y)) / sum((a - x0)**2 for a in x)


def show_pairings(found):
    """{pairing: {N: seconds}}"""
    sizes = [(n + 1)**2 for n in found["mortar"]]
    rows = [(nodes, *(f"{v:.3g}" for p in PAIRINGS for v in (1e3 * found[p][n], 1e6 * found[p][n] / nodes)))
            for n, nodes in zip(found["mortar"], sizes)]
    if len(sizes) > 1:
        rows.append(("exponent", *(cell for p in PAIRINGS for cell in (f"{exponent(sizes, found[p].values()):.2f}", ""))))
    print(table(COLUMNS, rows) + "\n", flush=True)


def whole_run(program, scene, folder):
    """CPU seconds, MB, and how often contacts were found in each increment."""
    write_scene(scene, folder / "scene.prm")
    used = checked_resources([program, folder / "scene.prm", "-q", "-o", folder / "results"])
    again = re.findall(r"contacts found again (\d+) times", (folder / "results/log.txt").read_text())
    return (*used, list(map(int, again)))


def small_share(program, n, pairing, one, folder, backend):
    scene = plates(n, pairing, cubes=backend == "iterative") | {"Solver": {"Backend": backend}}
    seconds, memory, _ = whole_run(program, scene, folder)
    return ("small", backend, pairing, (n + 1)**2, 1, f"{one:.3g}", f"{seconds:.3g}", f"{one / seconds:.1%}", f"{memory:.0f}")


def sliding_share(program, n, pairing, one, folder):
    """Found before an increment is solved first, and again after each solution."""
    runs = [whole_run(program, plates(n, pairing, k, Kinematics="finite sliding"), folder) for k in (1, 3)]
    seconds = (runs[1][0] - runs[0][0]) / 2
    pairings = 1 + sum(runs[1][2][1:]) / 2
    return ("finite sliding", "condensed", pairing, (n + 1)**2, f"{pairings:g}", f"{one:.3g}", f"{seconds:.3g}",
            f"{pairings * one / seconds:.1%}", f"{runs[1][1]:.0f}")


def shares(program, found, folder, options):
    for p in PAIRINGS:
        for backend, sizes in (("condensed", options.small), ("iterative", options.iterative)):
            for n in sizes:
                yield small_share(program, n, p, found[p][n], folder, backend)
        for n in options.sliding:
            yield sliding_share(program, n, p, found[p][n], folder)


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    for name, default in (("sizes", [10, 20, 35, 50, 71, 100, 141]), ("small", [35, 100]), ("iterative", [35, 100]),
                          ("sliding", [20, 35, 50])):
        parser.add_argument(f"--{name}", type=int, nargs="*", default=default, metavar="N")
    parser.add_argument("--runs", type=int, default=5, help="of which the shortest counts")
    return parser.parse_args()


def main():
    options = parse()
    program = options.build.resolve() / "conetact"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sizes = sorted({*options.sizes, *options.small, *options.iterative, *options.sliding})
        found = {p: {n: one_pairing(program, n, p, folder, options.runs) for n in sizes} for p in PAIRINGS}
        show_pairings(found)
        print(table(SHARES, []), flush=True)
        for row in shares(program, found, folder, options):
            print("| " + " | ".join(map(str, row)) + " |", flush=True)


if __name__ == "__main__":
    main()
