# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Boxes on rollers: every face but one is held along its normal, edges and corners along each of theirs."""
import math
import random

import numpy as np

from support.scenes import ELEMENTS, box, load, support
from support.tables import read
from pictures import read_vtu
from static_cases import StaticCase
from statics import Statement


def turn_of(rng, dim):
    if rng.random() < .4:
        return None
    angle = rng.uniform(-180, 180)
    return angle if dim == 2 else (*(rng.uniform(-1, 1) for _ in range(3)), angle)


def matrix(turn, dim):
    """Rotation of a mesh."""
    if turn is None:
        return np.eye(3)
    axis, degrees = ((0, 0, 1), turn) if dim == 2 else (turn[:3], turn[3])
    n, angle = np.array(axis) / np.linalg.norm(axis), math.radians(degrees)
    skew = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    return np.eye(3) + math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew


def stress_faults(folder, rotation, expected, dim):
    """The stress of every point against a uniform one along the axes of the box."""
    _, _, arrays = read_vtu(folder / "solution-block-0001.vtu")
    found = next(a for name, a in arrays.items() if name.endswith("stress")).reshape(-1, 3, 3)
    exact = rotation @ np.diag(expected) @ rotation.T
    error = np.abs(found - exact)[:, :dim, :dim].max() / np.abs(expected).max()
    return [] if error < 2e-6 else [f"stress is off by {error:.2g} of the pressure"]  # VTU has seven digits


def support_faults(folder, names, rotation, expected):
    """Resultant of each support, where increments.csv has it."""
    row = read(folder / "increments.csv")[-1]
    faults = []
    for name, force in zip(names, expected):
        key = name.replace(" ", "_")
        if f"{key}_f_x" in row:
            found = np.array([row[f"{key}_f_{c}"] for c in "xyz"])
            error = np.linalg.norm(found - rotation @ force) / np.linalg.norm(force)
            faults += [f"{name} carries {found}, not {rotation @ force}"] if error > 1e-8 else []
    return faults


def roller_box(number):
    rng = random.Random(f"roller-box {number}")
    dim = 2 + number % 2
    size = [rng.uniform(.5, 2) for _ in range(dim)]
    cells = tuple(rng.randint(1, 4) for _ in range(dim))
    young, nu, pressure = 10 ** rng.uniform(0, 6), rng.uniform(.05, .45), 10 ** rng.uniform(-4, 0)
    turn, one_support = turn_of(rng, dim), rng.random() < .6
    sides = [*range(2 * dim - 1)]
    groups = [sides] if one_support else [[i] for i in sides]
    body = box(cells, tuple(size), None, young, nu)
    if turn is not None:
        body["Mesh"]["Rotation"] = turn
    scene = {"Dimension": dim, "Body block": {"Element": rng.choice(ELEMENTS), **body},
             "Load press": load("pressure", f"{pressure!r}*t", 2 * dim - 1), "Output": {"VTU": 1}}
    for ids in groups:
        scene["Support side " + "".join(map(str, ids))] = support(tuple(ids), "normal")
    lateral = -nu / (1 - nu) * pressure
    stress = [lateral] * (dim - 1) + [-pressure] + [lateral] * (3 - dim)
    rotation, volume = matrix(turn, dim), math.prod(size)

    def force(side):
        """Pushes the box off the side."""
        axis = side // 2
        result = np.zeros(3)
        result[axis] = -stress[axis] * volume / size[axis] * (1 if side % 2 == 0 else -1)
        return result
    expected = [sum(map(force, ids)) for ids in groups]
    names = ["side " + "".join(map(str, ids)) for ids in groups]
    statement = Statement(dim, [], {}, {}, 0.0)
    more = [lambda folder: stress_faults(folder, rotation, stress, dim),
            lambda folder: support_faults(folder, names, rotation, expected)]
    name = f"{dim}D, nu {nu:.2f}, {cells} cells, {'one support' if one_support else 'a support a side'}, " \
           f"turned {turn is not None}"
    return StaticCase(name, scene, statement, more=more)
