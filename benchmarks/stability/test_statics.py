#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The judge itself: it accepts right tables and finds each fault that is planted into them.

usage: test_statics.py PROGRAM

Right tables come from single blocks on a floor and from two equal ones, pressed and pushed.
"""
import csv
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from static_cases import write_scene
from families_statics import Mats, pressed_block
from support.scenes import box, contact, floor, load
from pictures import closest, face_normals, on_face, surface
from statics import ALL, Load, Statement, Touch, judge

HEAVY = .02  # of the load: nodes whose reactions are spoilt


def on_floor(dim):
    """A block pressed and pushed to half of its friction."""
    size = (2.0, 1.0) if dim == 2 else (2.0, 1.5, 1.0)
    area = math.prod(size[:-1])
    push = [.25] + [.1] * (dim - 2)
    scene = {"Dimension": dim, "Body block": box((6, 3) if dim == 2 else (4, 3, 2), size),
             "Obstacle floor": floor(dim), "Contact bottom": contact(ids=2 * dim - 2, mu=.6),
             "Load press": load("traction", " ; ".join(f"{p!r}*t" for p in [*push, -1.0]), 2 * dim - 1),
             "Time": {"End": 1, "Increments": 2}, "Output": {"VTU": 0}}
    top = (*(s / 2 for s in size[:-1]), size[-1])
    statement = Statement(dim, [Load("block", top, tuple(area * p for p in [*push, -1.0]), lambda t: t)],
                          {"bottom": Touch("block", .6)}, {"block": ALL[dim]}, length=1e-11, motion=1.0)
    return scene, statement


def on_mat(dim):
    mats = Mats(random.Random(4), dim, (.1, .3))
    return pressed_block(mats, (10.0, 10.0), .5, 1e-3, .4, "body", True, 2)[:2]


def turned(row, angle):
    c, s, (a, b) = math.cos(angle), math.sin(angle), (float(row["r_t1"]), float(row["r_t2"]))
    return {**row, "r_t1": repr(c * a - s * b), "r_t2": repr(s * a + c * b)}


def scaled(row, names, factor):
    return {**row, **{name: repr(factor * float(row[name])) for name in names}}


FORCES = ("r_n", "r_t1", "r_t2")
FAULTS = {
    "reaction x (1 + 1e-6)": lambda row: scaled(row, FORCES, 1 + 1e-6),
    "normal reaction flipped": lambda row: scaled(row, ("r_n",), -1),
    "friction flipped": lambda row: scaled(row, ("r_t1", "r_t2"), -1) if abs(float(row["r_t1"])) > 1e-4 else None,
    "reaction dropped": lambda row: scaled(row, FORCES, 0),
    "row dropped": lambda row: {},
    "friction turned": lambda row: turned(row, 1e-3) if float(row["r_t2"]) else None,
    "opened": lambda row: {**row, "state": "open"},
    "renamed": lambda row: {**row, "state": "slip"} if row["state"] == "stick" else None,
    "penetrates": lambda row: {**row, "gap": "-1e-6"},
    "apart": lambda row: {**row, "gap": "1e-6"},
    "moved": lambda row: {**row, "u_t1": "1e8"},
    "slides": lambda row: {**row, "du_t1": "1e-3"} if row["state"] == "stick" else None,
    "not a number": lambda row: {**row, "gap": "nan"},
}


def spoilt(rows, fault, number):
    """The rows with a fault in one; None where it does not apply."""
    row = FAULTS[fault](rows[number])
    if row is None:
        return None
    return rows[:number] + ([row] if row else []) + rows[number + 1:]


def write(file, rows):
    with open(file, "w", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)


def heavy(rows, statement):
    """Numbers of rows of bodies, not of their masters, that carry a good part of the load."""
    size = max(abs(f) for each in statement.loads for f in each.force)
    return [i for i, row in enumerate(rows)
            if not row["contact"].endswith("_master") and float(row["r_n"]) > HEAVY * size]


def check(program, name, scene, statement, folder):
    """How many faults were planted, and those that were not found."""
    write_scene(scene, folder / "scene.prm")
    subprocess.run([program, folder / "scene.prm", "-o", folder / "result", "--quiet"], check=True)
    faults = judge(folder / "result", statement)
    missed = [f"{name}: right tables are blamed: {fault}" for fault in faults[:3]]
    file, planted = folder / "result" / "reactions.csv", 0
    with open(file, newline="") as stream:
        rows = list(csv.DictReader(stream))
    for fault in FAULTS:
        for number in heavy(rows, statement):
            if (changed := spoilt(rows, fault, number)) is None:
                continue
            planted += 1
            write(file, changed)
            if not judge(folder / "result", statement):
                missed.append(f"{name}: not found: {fault} in row {number}")
    return planted, missed


def distance_faults():
    """Brute force on a box of two cells, and on one face that is not plane."""
    points = np.array([[x, y, z] for z in (0.0, 1.0, 2.0) for y in (0.0, 1.0) for x in (0.0, 1.0)])
    cells = np.array([[0, 1, 3, 2, 4, 5, 7, 6], [4, 5, 7, 6, 8, 9, 11, 10]])
    faces = surface(points, cells)
    expected = [((2, .5, .3), 1), ((2, 2, .5), math.sqrt(2)), ((-1, -2, -2), 3), ((.5, .5, .9), .5), ((.3, .4, 2.5), .5)]
    faults = [f"{len(faces)} faces instead of 10"] if len(faces) != 10 else []
    faults += [f"distance of {p}" for p, d in expected if abs(closest(faces, np.array(p))[1].min() - d) > 1e-12]
    if min(face_normals(faces, np.full((10, 2), .5))[i] @ (f.mean(axis=0) - (.5, .5, 1)) for i, f in enumerate(faces)) < .4:
        faults.append("a normal points inward")
    warped = np.array([[[0, 0, 0], [1, 0, 0], [1, 1, .5], [0, 1, 0]]])
    s, d = np.array([[.4, .3]]), .2
    point = on_face(warped, s)[0] + d * face_normals(warped, s)[0]
    found, distance = closest(warped, point)
    if abs(distance[0] - d) > 1e-9 or np.abs(found - s).max() > 1e-4:
        faults.append(f"warped face: {distance[0]} at {found[0]}")
    return faults


def main():
    program, missed, planted = Path(sys.argv[1]).resolve(), distance_faults(), 0
    for name, maker in (("floor", on_floor), ("mat", on_mat)):
        for dim in (2, 3):
            with tempfile.TemporaryDirectory() as scratch:
                count, faults = check(program, f"{name}, {dim}D", *maker(dim), Path(scratch))
            planted, missed = planted + count, missed + faults
    print(f"{planted} faults planted, {len(missed)} not found", *missed[:20], sep="\n")
    return 1 if missed or planted < 200 else 0


if __name__ == "__main__":
    sys.exit(main())
