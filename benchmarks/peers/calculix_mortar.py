#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mortar contact beside that of CalculiX (Debian: calculix-ccx), on the same meshes that do not match.

usage: calculix_mortar.py [--build FOLDER] [--results FOLDER] [--ratio R] [N...]      (default: N = 4 6, R = 1.5)

Two balls without friction (tests/support/round_pairs.py), half of each, N cells of the slave a half width, those of
the master R times as large; linear hexahedra, far sides moved as in half spaces. CPU seconds of whole
processes pinned to one core (the least of three, or of fewer where they take long), and errors against
Hertz: the force, the peak pressure, and pressures of nodes in L2, with the same areas for both programs.
CalculiX: C3D8, hard contact, *CONTACT PAIR of TYPE=MORTAR (for linear elements the same as LINMORTAR).
"""
import argparse
import csv
import math
import shutil
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from measure import TOP, checked_resources, resources, table  # noqa: E402  first: it knows the way to tests/support
from support import half_space, round_pairs  # noqa: E402
from support.scenes import merge, write_scene  # noqa: E402
from support.tables import Run  # noqa: E402

COLUMNS = ("cells a half width", "dofs", "program", "CPU s", "peak MB", "force", "peak pressure", "pressure in L2")
TYPES = ("MORTAR",)
EXACT = half_space.Hertz(3, half_space.POISSON["partial slip"][3], 2)
GROWTH = 1.5
RUNS, ENOUGH = 3, 20  # runs, CPU seconds after which there are no more
SIDES = {(0, 1, 2, 3): 1, (4, 5, 6, 7): 2, (0, 1, 4, 5): 3, (1, 2, 5, 6): 4, (2, 3, 6, 7): 5, (0, 3, 4, 7): 6}  # of C3D8


def scene_of(folder, n, ratio):
    scene = round_pairs.pair(folder, 3, n, ratio, growth=GROWTH)
    return merge(scene, {"Time": {"End": 1, "Increments": 1}, "Contact joint": {"Friction coefficient": 0.0}})


def read_msh(file):
    """Points, cells, and faces with their ids, of what write_msh wrote."""
    lines = file.read_text().splitlines()
    first, second = lines.index("$Nodes") + 2, lines.index("$Elements") + 2
    points = [tuple(map(float, line.split()[1:])) for line in lines[first:first + int(lines[first - 1])]]
    elements = [list(map(int, line.split())) for line in lines[second:second + int(lines[second - 1])]]
    return (points, [[i - 1 for i in e[5:]] for e in elements if e[1] == 5],
            [(e[3], [i - 1 for i in e[5:]]) for e in elements if e[1] == 3])


def value(function, point):
    """Of an expression of a scene at t = 1."""
    names = {name: getattr(math, name) for name in ("sqrt", "log", "atan")}
    return eval(function.replace("^", "**"), {**names, "abs": abs, "max": max, "min": min, "t": 1.0,  # noqa: S307
                                              **dict(zip("xyz", point))})


def body_lines(scene, folder, name, start, first_cell):
    """Nodes, cells, surface and prescribed displacements of a body, numbered from there on."""
    points, cells, faces = read_msh(folder / scene[f"Body {name}"]["Mesh"]["File"])
    motion = scene[f"Support far {name}"]["Displacement"].split(" ; ")
    with_id = {tag: {i for t, nodes in faces if t == tag for i in nodes} for tag in (round_pairs.FAR, round_pairs.MIDDLE)}
    surface = {frozenset(nodes) for tag, nodes in faces if tag == round_pairs.SURFACE}
    lines = ["*NODE", *(f"{start + i}, " + ", ".join(f"{c:.12e}" for c in p) for i, p in enumerate(points)),
             f"*ELEMENT, TYPE=C3D8, ELSET={name}"]
    lines += [f"{first_cell + e}, " + ", ".join(str(start + i) for i in nodes) for e, nodes in enumerate(cells)]
    lines += [f"*SURFACE, NAME=S{name}"]
    lines += [f"{first_cell + e}, S{side}" for e, nodes in enumerate(cells)
              for corners, side in SIDES.items() if frozenset(nodes[c] for c in corners) in surface]
    lines += [f"*NSET, NSET=F{name}", *(f"{start + i}," for i in sorted(with_id[round_pairs.FAR]))]
    moved = [f"{start + i}, {d + 1}, {d + 1}, {value(f, points[i]):.12e}"
             for i in sorted(with_id[round_pairs.FAR]) for d, f in enumerate(motion)]
    moved += [f"{start + i}, 2, 2, 0." for i in sorted(with_id[round_pairs.MIDDLE] - with_id[round_pairs.FAR])]
    return lines, moved, points, len(cells)


def model(scene, folder, kind):
    """Input of CalculiX, and the points of the slave, which come first."""
    upper, moved, points, n_cells = body_lines(scene, folder, "upper", 1, 1)
    lower, also_moved, others, _ = body_lines(scene, folder, "lower", 1 + len(points), 1 + n_cells)
    lines = [*upper, *lower, f"""*MATERIAL, NAME=M
*ELASTIC
1., {half_space.POISSON["partial slip"][3]}
*SOLID SECTION, ELSET=upper, MATERIAL=M
*SOLID SECTION, ELSET=lower, MATERIAL=M
*SURFACE INTERACTION, NAME=I
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
*CONTACT PAIR, INTERACTION=I, TYPE={kind}
Supper, Slower
*STEP, INC=100
*STATIC
1., 1.
*BOUNDARY""", *moved, *also_moved, """*NODE PRINT, NSET=Fupper, TOTALS=ONLY
RF
*CONTACT FILE
CDIS, CSTR
*END STEP
"""]
    return "\n".join(lines), points, 3 * (len(points) + len(others))


def peer_pressures(file):
    """Pressures of nodes in the last block of contact stresses."""
    found = {}
    inside = False
    for line in file.read_text().splitlines():
        if line.startswith(" -4"):
            inside = line.split()[1] == "CONTACT"
        elif line.startswith(" -3"):
            inside = False
        elif inside and line.startswith(" -1"):
            found[int(line[3:13])] = float(line[13 + 3 * 12:13 + 4 * 12])
    return found


def errors(force, pressures):
    """`pressures`: place, area, and what is found there."""
    rows = [({"x": x, "y": y, "p": area * p}, area) for (x, y), area, p in pressures]
    wrong, peak = half_space.l2_error(rows, "p", EXACT.pressure)
    return [f"{e:.2g}" for e in (abs(2 * force / EXACT.force - 1), abs(peak / EXACT.peak - 1), wrong)]


def several(run):
    """The least CPU seconds and the largest memory of a few runs; None if one fails."""
    used = []
    while len(used) < RUNS and sum(seconds for seconds, _ in used) < ENOUGH:
        used.append(run())
        if used[-1] is None:
            return None
    return min(seconds for seconds, _ in used), max(memory for _, memory in used)


def run_own(build, scene, folder):
    """What was used, errors, and the areas of nodes by place."""
    write_scene(scene, folder / "scene.prm")
    used = several(lambda: checked_resources([build / "conetact", "scene.prm", "-q", "-o", "result"], folder=folder))
    rows = [row for row in Run(folder / "result").rows if row["contact"] == "joint" and row["area"] > 0]
    found = [((row["x"], row["y"]), row["area"], row["r_n"] / row["area"]) for row in rows]
    return used, errors(sum(row["r_n"] for row in rows), found), {place: area for place, area, _ in found}


def run_peer(scene, folder, kind, areas):
    """The same of CalculiX; None where it does not finish."""
    text, points, n_dofs = model(scene, folder, kind)
    (folder / "scene.inp").write_text(text)
    used = several(lambda: resources([shutil.which("ccx"), "scene"], folder=folder))
    lines = (folder / "scene.dat").read_text().splitlines() if used else []
    totals = [i for i, line in enumerate(lines) if "total force" in line]
    if not totals:
        return None, ["", "", ""], n_dofs
    by_place = {(round(x, 7), round(y, 7)): area for (x, y), area in areas.items()}
    pressures = peer_pressures(folder / "scene.frd")
    found = []
    for i, (x, y, _) in enumerate(points, 1):
        area = by_place.get((round(x, 7), round(y, 7)))
        if area and i in pressures:
            found.append(((x, y), area, pressures[i]))
    assert len(found) == len(areas), f"{len(found)} of {len(areas)} nodes"
    return used, errors(-float(lines[totals[-1] + 2].split()[2]), found), n_dofs


def compare(build, n, ratio):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        scene = scene_of(folder, n, ratio)
        own, wrong, areas = run_own(build, scene, folder)
        peers = [(kind, *run_peer(scene, folder, kind, areas)) for kind in TYPES]
    yield n, peers[0][3], "Conetact", f"{own[0]:.3g}", f"{own[1]:.0f}", *wrong
    for kind, used, wrong, n_dofs in peers:
        spent = (f"{used[0]:.3g}", f"{used[1]:.0f}") if used else ("stopped", "")
        yield n, n_dofs, f"CalculiX {kind}", *spent, *wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--results", type=Path, default=TOP / "benchmarks/results")
    parser.add_argument("--ratio", type=float, default=1.5)
    parser.add_argument("sizes", type=int, nargs="*", metavar="N")
    options = parser.parse_args()
    if shutil.which("ccx") is None:
        print("Skipped: CalculiX is not installed (Debian: calculix-ccx).")
        return 0
    rows = []
    print(table(COLUMNS, rows), flush=True)
    for n in options.sizes or [4, 6]:
        for row in compare(options.build.resolve(), n, options.ratio):
            rows.append(row)
            print("| " + " | ".join(map(str, row)) + " |", flush=True)
    options.results.mkdir(parents=True, exist_ok=True)
    with open(options.results / "calculix-mortar.csv", "w", newline="") as stream:
        csv.writer(stream).writerows([COLUMNS, *rows])
    return 0


if __name__ == "__main__":
    sys.exit(main())
