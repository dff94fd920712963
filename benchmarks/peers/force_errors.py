#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Errors of forces against run time, beside GetFEM and CalculiX on the same meshes.

usage: force_errors.py [--build FOLDER] [--results FOLDER] [--quick] [PROGRAM...]      (default: all)

Hertz contact in space (a quarter of a block on a rigid parabola, tests/support/half_space.py, cells of equal
size): the force against Hertz. Sliding block (block-press-shear.prm): the forces of all eleven increments, over
the largest, against what those of three meshes of Conetact, each twice as fine, lead to by their observed order.
Conetact with both backends; GetFEM with nodal contact and its exact cone; CalculiX with penalty contact face to
face, penalties in E over cell size. CPU seconds of whole processes pinned to one core. All forces stay in
force-errors.json: programs that are not named are taken from there. Writes force-error-against-time.png.
"""
import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
import calculix_compare  # noqa: E402
from measure import TOP, checked_resources, finish_panel, resources, table  # noqa: E402
from peer_meshes import HERTZ, far_motion, is_candidate  # noqa: E402
from support import half_space  # noqa: E402
from support.scenes import write_scene  # noqa: E402
from support.tables import read  # noqa: E402

COLUMNS = ("scene", "program", "cells along an edge", "CPU s", "error of forces")
HERTZ_SCENE, BLOCK = "Hertz, a ball", "sliding block"
BACKENDS = ("condensed", "iterative")
REFERENCE = "Conetact, reference"
PYTHON = "/usr/bin/python3"


def sizes(quick):
    """Cells along an edge for each program, and of what errors of the sliding block are compared with."""
    if quick:
        return {"condensed": (8, 12), "iterative": (8, 12), "GetFEM": (8,), "CalculiX": (8,), "reference": (4, 8, 16)}
    return {"condensed": (8, 12, 16, 24, 32), "iterative": (8, 12, 16, 24, 32, 40, 48), "GetFEM": (8, 12, 16, 24, 32),
            "CalculiX": (8, 12, 16, 24), "reference": (16, 32, 64)}


# ---------------------------------------------------------------- Conetact

def own(build, folder, backend, scene, *arguments):
    """CPU seconds and forces of the only contact, an increment each."""
    used = checked_resources([build / "conetact", scene, "-q", "-o", folder / "result", "-s", f"Solver/Backend={backend}",
                              "-s", "Output/VTU=0", *arguments])
    return used[0], [[row[f"bottom_f_{d}"] for d in "xyz"] for row in read(folder / "result/increments.csv")]


def own_hertz(build, folder, backend, n):
    write_scene(half_space.hertz(3, n // HERTZ.size, 0), folder / "hertz.prm")
    return own(build, folder, backend, folder / "hertz.prm")


def own_block(build, folder, backend, n):
    return own(build, folder, backend, TOP / "parameter-files/block-press-shear.prm",
               "-s", f"Body block/Mesh/Arguments={n}, {n}, {n} : 0, 0, 0 : 1, 1, 1 : true")


# ---------------------------------------------------------------- GetFEM

def getfem(folder, script, *arguments):
    said = folder / "said"
    used = resources([PYTHON, HERE / script, *arguments], said)
    return used and (used[0], said.read_text().splitlines())


def getfem_hertz(folder, n):
    done = getfem(folder, "getfem_hertz.py", n // HERTZ.size)
    return done and (done[0], [[0.0, 0.0, float(done[1][-1])]])


def getfem_block(folder, n):
    done = getfem(folder, "getfem_scene.py", "block-press-shear", n)
    return done and (done[0], [[float(x) for x in line.split()[1:-1]] for line in done[1] if line[:1].isdigit()])


# ---------------------------------------------------------------- CalculiX

def hertz_model(n, penalty):
    """The block, and below it fixed cells whose upper faces are the parabola."""
    h = HERTZ.size / n
    node = calculix_compare.node
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    places = [(i * h, j * h, k * h) for k in range(n + 1) for j in range(n + 1) for i in range(n + 1)]
    m = next(i for i in range(n + 1) if i * h > 1.25) + 1  # cells below what may touch
    floor = len(places)

    def below(i, j, top):
        return 1 + floor + i + (m + 1) * (j + (m + 1) * top)

    yield "*NODE"
    yield from (f"{e}, " + ", ".join(f"{c:.12e}" for c in place) for e, place in enumerate(places, 1))
    for top in (0, 1):
        for j in range(m + 1):
            for i in range(m + 1):
                gap = ((i * h)**2 + (j * h)**2) / (2 * HERTZ.radius)
                yield f"{below(i, j, top)}, {i * h:.12e}, {j * h:.12e}, {-gap if top else -1 - gap:.12e}"
    yield "*ELEMENT, TYPE=C3D8, ELSET=ALL"
    cells = [(i, j, k) for k in range(n) for j in range(n) for i in range(n)]
    for e, (i, j, k) in enumerate(cells, 1):
        yield f"{e}, " + ", ".join(str(node(n, i + x, j + y, k + z)) for z in (0, 1) for x, y in corners)
    lower = [(i, j) for j in range(m) for i in range(m)]
    for e, (i, j) in enumerate(lower, len(cells) + 1):
        yield f"{e}, " + ", ".join(str(below(i + x, j + y, z)) for z in (0, 1) for x, y in corners)
    yield "*NSET, NSET=FLOOR"
    yield from (f"{1 + floor + i}," for i in range(2 * (m + 1)**2))
    yield "*SURFACE, NAME=BOTTOM"
    yield from (f"{e}, S1" for e, (i, j, k) in enumerate(cells, 1)
                if k == 0 and any(is_candidate(((i + x) * h, (j + y) * h)) for x, y in corners))
    yield "*SURFACE, NAME=GROUND"
    yield from (f"{len(cells) + e}, S2" for e in range(1, len(lower) + 1))
    far = [(e, place) for e, place in enumerate(places, 1) if max(place) > HERTZ.size - h / 2]
    yield "*NSET, NSET=FAR"
    yield from (f"{e}," for e, _ in far)
    yield f"""*MATERIAL, NAME=M
*ELASTIC
1., {HERTZ.poisson}
*SOLID SECTION, ELSET=ALL, MATERIAL=M
*SURFACE INTERACTION, NAME=I
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
{penalty / h}
*CONTACT PAIR, INTERACTION=I, TYPE=SURFACE TO SURFACE
BOTTOM, GROUND
*BOUNDARY
FLOOR, 1, 3"""
    held = {e for e, _ in far}
    yield from (f"{e}, {d}, {d}" for e, place in enumerate(places, 1) if e not in held
                for d in (1, 2) if place[d - 1] == 0)
    yield "*STEP, INC=1000\n*STATIC\n1., 1.\n*BOUNDARY"
    yield from (f"{e}, {d}, {d}, {u:.12e}" for e, place in far for d, u in enumerate(far_motion(place), 1))
    yield "*NODE PRINT, NSET=FLOOR, TOTALS=ONLY, FREQUENCY=1000\nRF\n*END STEP"


def calculix_hertz(folder, n, penalty):
    (folder / "scene.inp").write_text("\n".join(hertz_model(n, penalty)) + "\n")
    used = resources([shutil.which("ccx"), "scene"], folder=folder)
    forces = calculix_compare.peer_forces(folder) if (folder / "scene.dat").exists() else []
    return (used[0], [[0.0, 0.0, abs(forces[-1][2])]]) if used and forces else None


def calculix_block(_, n, penalty):
    seconds, forces = calculix_compare.run_peer(n, penalty)
    return (seconds, forces) if seconds else None


# ---------------------------------------------------------------- all of them

def difference(forces, others):
    if len(forces) != len(others):
        raise SystemExit(f"{len(forces)} of {len(others)} increments")
    return max(abs(a - b) for row, other in zip(forces, others) for a, b in zip(row, other))


def limit(coarse, middle, fine):
    """Of forces on meshes that halve their cells."""
    ratio = difference(fine, middle) / difference(middle, coarse)
    return [[a + (a - b) * ratio / (1 - ratio) for a, b in zip(*rows)] for rows in zip(fine, middle)]


def runs_of_peers():
    """Name, sizes, and what runs the two scenes."""
    if subprocess.run([PYTHON, "-c", "import getfem"], capture_output=True).returncode == 0:
        yield "GetFEM", "GetFEM", getfem_hertz, getfem_block
    if shutil.which("ccx"):
        for penalty in calculix_compare.PENALTIES:
            yield (f"CalculiX, penalty {penalty}", "CalculiX", lambda folder, n, p=penalty: calculix_hertz(folder, n, p),
                   lambda folder, n, p=penalty: calculix_block(folder, n, p))


def measure(options, folder):
    """Scene, program, cells, and what gives seconds and forces, or nothing."""
    of = sizes(options.quick)
    for backend in BACKENDS:
        for n in of[backend]:
            yield HERTZ_SCENE, f"Conetact, {backend}", n, lambda n=n, b=backend: own_hertz(options.build, folder, b, n)
            yield BLOCK, f"Conetact, {backend}", n, lambda n=n, b=backend: own_block(options.build, folder, b, n)
    for n in of["reference"]:
        yield BLOCK, REFERENCE, n, lambda n=n: own_block(options.build, folder, "iterative", n)
    for name, kind, hertz, block in runs_of_peers():
        for n in of[kind]:
            yield HERTZ_SCENE, name, n, lambda n=n, run=hertz: run(folder, n)
            yield BLOCK, name, n, lambda n=n, run=block: run(folder, n)


def rows_of(runs):
    """Of the table: errors in place of forces."""
    reference = limit(*(run["forces"] for run in runs if run["program"] == REFERENCE))
    largest = max(abs(f) for row in reference for f in row)
    for run in runs:
        if run["program"] != REFERENCE:
            wrong = (abs(run["forces"][-1][2] / HERTZ.force - 1) if run["scene"] == HERTZ_SCENE else
                     difference(run["forces"], reference) / largest)
            yield run["scene"], run["program"], str(run["cells"]), f"{run['seconds']:.3g}", f"{wrong:.2e}"


def draw(rows, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(1, 2, figsize=(9.5, 4.2), constrained_layout=True)
    programs = sorted(dict.fromkeys(row[1] for row in rows), key=lambda name: not name.startswith("Conetact"))
    for axis, scene in zip(axes, (HERTZ_SCENE, BLOCK)):
        for program in programs:
            points = [(float(row[3]), float(row[4])) for row in rows if row[:2] == (scene, program)]
            style = "-" if program.startswith("Conetact") else "--"
            axis.loglog(*zip(*points), style, marker="o", markersize=4, label=program)
        finish_panel(axis, title=scene, xlabel="CPU time, s", ylabel="error of forces, relative")
    axes[0].legend(fontsize=7)
    figure.savefig(file, dpi=130)


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--results", type=Path, default=TOP / "benchmarks/results")
    parser.add_argument("--quick", action="store_true", help="small sizes")
    parser.add_argument("programs", nargs="*", metavar="PROGRAM", help="Conetact, GetFEM, CalculiX: run these only")
    options = parser.parse_args()
    options.build, options.results = options.build.resolve(), options.results.resolve()
    return options


def main():
    options = parse()
    options.results.mkdir(parents=True, exist_ok=True)
    file = options.results / "force-errors.json"
    known = json.loads(file.read_text()) if file.exists() else []
    runs = [run for run in known if options.programs and run["program"].split(",")[0] not in options.programs]
    with tempfile.TemporaryDirectory(prefix="conetact-peers-") as folder:
        for scene, program, n, run in measure(options, Path(folder)):
            if options.programs and program.split(",")[0] not in options.programs:
                continue
            if found := run():
                runs.append({"scene": scene, "program": program, "cells": n, "seconds": found[0], "forces": found[1]})
            else:
                print(f"{program} does not finish: {scene}, {n} cells along an edge", flush=True)
            file.write_text(json.dumps(runs))
    if all(run["program"] != REFERENCE for run in runs):
        raise SystemExit("Errors are those against forces of Conetact: run it, too.")
    rows = list(rows_of(runs))
    print(table(COLUMNS, rows))
    draw(rows, options.results / "force-error-against-time.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
