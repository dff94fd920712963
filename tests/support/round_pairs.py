# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two cylinders or balls pressed together, then sheared: both curved, meshes that do not match.

Cut out of half spaces as in half_space.py (contact half width 1, size 4, far sides moved
exactly), but the surface of each body is the parabola of radius 2 RADIUS.
"""
import itertools
import math

from support import half_space
from support.half_cylinders import graded
from support.half_space import MU, RADIUS, SIZE, STICK
from support.meshes import write_msh
from support.scenes import joint, merge, support

SURFACE, FAR, MIDDLE, ACROSS = 1, 2, 3, 4


def along(step, both, growth):
    x = graded(step, 1.25, SIZE, growth)
    return [-c for c in reversed(x[1:])] + x if both else x


def mesh(file, dim, step, sign, growth, radius=RADIUS, quarter=False):
    """In space half of a body, y > 0, or a quarter, x > 0, too; fine where it touches."""
    axes = [along(step, not quarter, growth)] + [along(step, False, growth)] * (dim - 2) + [graded(step, .75, SIZE, growth)]
    number, points = {}, []
    for at in itertools.product(*(range(len(axis)) for axis in axes)):
        *across, depth = (axis[i] for axis, i in zip(axes, at))
        number[at] = len(points)
        height = depth + sum(c * c for c in across) / (4 * radius) * (1 - depth / SIZE)
        points.append((*across, sign * height, 0.0)[:3])
    quad = ((0, 0), (1, 0), (1, 1), (0, 1))
    corners = list(quad) if dim == 2 else [(*c, k) for k in (0, 1) for c in quad]
    turn = (lambda c: c) if sign > 0 else (lambda c: [c[i] for i in ((3, 2, 1, 0) if dim == 2 else (4, 5, 6, 7, 0, 1, 2, 3))])
    cells = [turn([number[tuple(i + c for i, c in zip(at, corner))] for corner in corners])
             for at in itertools.product(*(range(len(axis) - 1) for axis in axes))]
    faces = [(tag, nodes) for d in range(dim) for last in (False, True)
             for tag, nodes in side(axes, number, d, last, quarter)]
    write_msh(file, dim, points, cells, faces)


def side(axes, number, d, last, quarter):
    """Faces with an id; the surface only as far as it may touch."""
    cuts = {0: ACROSS if quarter else FAR, 1: MIDDLE, 2: FAR} if len(axes) == 3 else {0: FAR, 1: FAR}
    others = [e for e in range(len(axes)) if e != d]
    corners = ((0,), (1,)) if len(others) == 1 else ((0, 0), (1, 0), (1, 1), (0, 1))
    for at in itertools.product(*(range(len(axes[e]) - 1) for e in others)):
        nodes = []
        for corner in corners:
            place = [0] * len(axes)
            place[d] = len(axes[d]) - 1 if last else 0
            for e, i, c in zip(others, at, corner):
                place[e] = i + c
            nodes.append(number[tuple(place)])
        if d == len(axes) - 1 and not last:
            if math.hypot(*(min(abs(axes[e][i]), abs(axes[e][i + 1])) for e, i in zip(others, at))) < 1.25:
                yield SURFACE, nodes
        else:
            yield (FAR if last else cuts[d]), nodes


def pair(folder, dim, cells, ratio, exchanged=False, growth=1.25, radius=RADIUS):
    """`cells` of the slave a half width, those of the master `ratio` times as large."""
    poisson = half_space.POISSON["partial slip"][dim]
    exact = half_space.Hertz(dim, poisson, 2, radius)
    names = ("lower", "upper") if exchanged else ("upper", "lower")
    scene = {"Dimension": dim, "Contact joint": joint(names[0], SURFACE, names[1], SURFACE, **{"Friction coefficient": MU}),
             "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    press, shear = half_space.press_and_shear(exact, poisson, f"abs({'xyz'[dim - 1]})")
    for body, sign in (("upper", 1), ("lower", -1)):
        file = folder / f"{body}{dim}.msh"
        mesh(file, dim, (1 if body == names[0] else ratio) / cells, sign, growth, radius)
        mirrored = [(sign if i == dim - 1 else 1, sign if i < dim - 1 else 1) for i in range(dim)]
        motion = " ; ".join(f"{m!r}*min(t, 1)*({p}) + {n!r}*max(0, t - 1)*({q})"
                            for (m, n), p, q in zip(mirrored, press, shear))
        scene[f"Body {body}"] = {"Mesh": {"File": file.name}, "Material": {"Young modulus": 1.0, "Poisson ratio": poisson}}
        scene[f"Support far {body}"] = support(FAR, ", ".join("xyz"[:dim]), motion, body)
        if dim == 3:
            scene[f"Support middle {body}"] = support(MIDDLE, "y", body=body)
    return scene


def pressed_quarter(folder, cells, ratio, growth):
    """Balls that are pressed together only, a quarter of each."""
    scene = pair(folder, 3, cells, ratio, growth=growth)
    for body, sign in (("upper", 1), ("lower", -1)):
        mesh(folder / f"{body}3.msh", 3, (1 if sign > 0 else ratio) / cells, sign, growth, quarter=True)
        scene[f"Support across {body}"] = support(ACROSS, "x", body=body)
    return merge(scene, {"Contact joint": {"Friction coefficient": 0.0}, "Time": {"End": 1, "Increments": 1}})


def errors_of_pressure(rows, dim, exact, parts):
    """`parts`: of which the model shows one."""
    force = sum(row["r_n"] for row in rows)
    spread = sum(row["r_n"] * half_space.distance(at(row, dim))**2 for row in rows) / force
    stresses = [(at(row, dim), row["area"]) for row in rows if row["area"] > 0]
    pressure, peak = half_space.l2_error(stresses, "r_n", exact.pressure)
    return {"force": abs(parts * force / exact.force - 1), "peak pressure": abs(peak / exact.peak - 1),
            "half width": abs(math.sqrt(spread * (4 if dim == 2 else 2.5)) - 1), "pressure in L2": pressure}


def errors_of_quarter(run):
    exact = half_space.Hertz(3, half_space.POISSON["partial slip"][3], 2)
    return errors_of_pressure([row for row in run.rows if row["contact"] == "joint"], 3, exact, 4)


def errors(run, cells, radius=RADIUS):
    """Of Hertz's pressure after the first increment, of Cattaneo's shear after the second."""
    dim = run.dim
    exact = half_space.Hertz(dim, half_space.POISSON["partial slip"][dim], 2, radius)
    rows = [[row for row in run.rows if row["contact"] == "joint" and row["increment"] == k] for k in (1, 2)]
    of_pressure = errors_of_pressure(rows[0], dim, exact, 2**(dim - 2))
    stresses = [(at(row, dim), row["area"]) for row in rows[1] if row["area"] > 0]
    normal, shear = (2**(dim - 2) * abs(sum(row[c] for row in rows[1])) for c in ("r_n", "r_t1"))
    for row, area in stresses:
        row["r_t1"] = abs(row["r_t1"])
    friction, _ = half_space.l2_error(stresses, "r_t1", exact.friction)
    stuck = [half_space.distance(at(row, dim)) for row in rows[1] if row["state"] == "stick"]
    slipping = [half_space.distance(at(row, dim)) for row in rows[1] if row["state"] == "slip"]
    return {**of_pressure,
            "stick width from the forces": abs((1 - shear / (MU * normal))**(1 / dim) / STICK - 1),
            "shear stress in L2": friction,
            "nodes out of place, in cells": cells * max(max(stuck) - STICK, STICK - min(slipping))}


def at(row, dim):
    """In the plane y is the height."""
    return {**row, "y": 0.0} if dim == 2 else row
