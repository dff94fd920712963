#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program beside CalculiX (Debian: calculix-ccx) on the same meshes.

usage: calculix_compare.py [--build FOLDER] [--results FOLDER] [N...]      (default: N = 8)

block-press-shear.prm with N^3 elements: CPU seconds of whole processes pinned to one core, and the
largest error of the contact forces of all increments over the largest force. CalculiX: C3D8,
linear, penalty contact face to face with several stiffnesses (in E over element size), stick stiffness
a tenth; the forces of the exact cone are ours.
"""
import argparse
import csv
import itertools
import shutil
import statistics
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from measure import TOP, cpu_seconds, resources  # noqa: E402

PENALTIES = (10, 100, 1000)
INCREMENTS = 11
COLUMNS = ("scene", "penalty", "ours s", "CalculiX s", "ratio", "force error")


def node(n, i, j, k):
    return 1 + i + (n + 1) * (j + (n + 1) * k)


def mesh(n):
    """The block, and below it one fixed element that is the floor."""
    cells = list(itertools.product(range(n), repeat=3))
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    floor = (n + 1)**3
    yield "*NODE"
    for k, j, i in itertools.product(range(n + 1), repeat=3):
        yield f"{node(n, i, j, k)}, {i / n!r}, {j / n!r}, {k / n!r}"
    for m, (z, (x, y)) in enumerate(itertools.product((-1, 0), corners), 1):
        yield f"{floor + m}, {3 * x - 1}, {3 * y - 1}, {z}"
    yield "*ELEMENT, TYPE=C3D8, ELSET=ALL"
    for e, (k, j, i) in enumerate(cells, 1):
        yield f"{e}, " + ", ".join(str(node(n, i + x, j + y, k + z)) for z in (0, 1) for x, y in corners)
    yield f"{n**3 + 1}, " + ", ".join(str(floor + m) for m in range(1, 9))
    yield "*NSET, NSET=TOP"
    yield from (f"{node(n, i, j, n)}," for i in range(n + 1) for j in range(n + 1))
    yield "*NSET, NSET=FLOOR"
    yield from (f"{floor + m}," for m in range(1, 9))
    yield "*SURFACE, NAME=BOTTOM"
    yield from (f"{e}, S1" for e in range(1, n * n + 1))
    yield f"*SURFACE, NAME=GROUND\n{n**3 + 1}, S2"


def model(n, penalty):
    yield from mesh(n)
    stiffness = penalty * n
    yield f"""*MATERIAL, NAME=M
*ELASTIC
1., .3
*SOLID SECTION, ELSET=ALL, MATERIAL=M
*SURFACE INTERACTION, NAME=I
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
{stiffness}
*FRICTION
.3, {stiffness / 10}
*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE
BOTTOM, GROUND
*BOUNDARY
FLOOR, 1, 3"""
    for step in range(1, INCREMENTS + 1):
        yield f"""*STEP, INC=1000
*STATIC
1., 1.
*BOUNDARY
TOP, 1, 1, {.002 * (step - 1)}
TOP, 2, 2, 0.
TOP, 3, 3, -.01
*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=1000
RF
*END STEP"""


def peer_forces(folder):
    """Contact forces on the block: those of the top with the other sign."""
    lines = (folder / "scene.dat").read_text().splitlines()
    return [[-float(x) for x in lines[i + 2].split()] for i, line in enumerate(lines) if "total force" in line]


def run_peer(n, penalty):
    """CPU seconds and forces; no seconds if it did not finish."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "scene.inp").write_text("\n".join(model(n, penalty)) + "\n")
        used = resources([shutil.which("ccx"), "scene"], folder=folder)
        forces = peer_forces(Path(folder)) if (Path(folder) / "scene.dat").exists() else []
    return (used[0] if used and len(forces) == INCREMENTS else None), forces


def run_own(build, n):
    with tempfile.TemporaryDirectory() as folder:
        command = [str(build / "conetact"), str(TOP / "parameter-files/block-press-shear.prm"), "-q", "-o", "result",
                   "-s", "Output/VTU=0", "-s", f"Body block/Mesh/Arguments={n}, {n}, {n} : 0, 0, 0 : 1, 1, 1 : true"]
        seconds = [cpu_seconds(command, folder=folder) for _ in range(3)]
        with open(Path(folder) / "result/increments.csv", newline="") as table:
            forces = [[float(row[f"bottom_f_{d}"]) for d in "xyz"] for row in csv.DictReader(table)]
    return statistics.median(seconds), forces


def compare(build, n):
    ours, forces = run_own(build, n)
    largest = max(abs(f) for row in forces for f in row)
    for penalty in PENALTIES:
        theirs, found = run_peer(n, penalty)
        scene = (f"block-press-shear, {n}^3", penalty, f"{ours:.2f}")
        if theirs is None:
            yield (*scene, f"stopped after {len(found)} of {INCREMENTS} increments", "", "")
            continue
        error = max(abs(a - b) for row, other in zip(forces, found) for a, b in zip(row, other)) / largest
        yield (*scene, f"{theirs:.3g}", f"{theirs / ours:.3g}", f"{error:.1e}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--results", type=Path, default=TOP / "benchmarks/results")
    parser.add_argument("sizes", type=int, nargs="*", metavar="N")
    options = parser.parse_args()
    if shutil.which("ccx") is None:
        print("Skipped: CalculiX is not installed (Debian: calculix-ccx).")
        return 0
    options.results.mkdir(parents=True, exist_ok=True)
    print("|", " | ".join(COLUMNS), "|\n|" + "---|" * len(COLUMNS))
    with open(options.results / "calculix.csv", "w", newline="") as stream:
        table = csv.writer(stream)
        table.writerow(COLUMNS)
        for n in options.sizes or [8]:
            for row in compare(options.build.resolve(), n):
                table.writerow(row)
                print("|", " | ".join(map(str, row)), "|", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
