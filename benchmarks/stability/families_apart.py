# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that touch nowhere, inside and beside each other: no reaction, and gaps as a brute-force search finds them."""
import math
import random

import numpy as np

from support.scenes import ELEMENTS, load, support
from support.tables import read
from pictures import closest, face_normals, read_vtu, surface
from static_cases import StaticCase
from statics import Statement, Touch, place

REACH = 1.0  # of the smaller body: gaps are compared below it
OPPOSING = (0.0, .1, .2, .35, .5, .6, .7072, .8, .87)  # -cosines of the angle that a surface may ask for
GAPS = 2e-6  # VTU has seven digits
OVERHANG = .01  # of a face: a node beyond its edge by less is over it


def shapes(dim):
    """Generators of bodies within a sphere of radius 1: name, arguments, refinements, number of ids."""
    centre = ", ".join(["0"] * dim)
    side = 1 / math.sqrt(dim)
    corners = f"{', '.join([repr(-side)] * dim)} : {', '.join([repr(side)] * dim)}"
    cells = ", ".join(["3"] * dim)
    shell = 8 if dim == 2 else 6
    return {"ball": ("hyper_ball", f"{centre} : 1 : false", 1, 1),
            "balanced ball": ("hyper_ball_balanced", f"{centre} : 1", 1, 1),
            "box": ("subdivided_hyper_rectangle", f"{cells} : {corners} : true", 0, 2 * dim),
            "thick shell": ("hyper_shell", f"{centre} : 0.6 : 1 : {shell} : true", 1, 2)}


def turn_of(rng, dim):
    angle = rng.uniform(-180, 180)
    return angle if dim == 2 else (*(rng.uniform(-1, 1) for _ in range(3)), angle)


def body_of(rng, dim, shape, radius, middle):
    """A body of a shape, turned at random, and its number of boundary ids."""
    generator, arguments, levels, ids = shapes(dim)[shape]
    mesh = {"Generator": generator, "Arguments": arguments, "Global refinements": levels, "Scale": radius,
            "Rotation": turn_of(rng, dim), "Translation": tuple(middle)}
    return {"Element": rng.choice(ELEMENTS), "Mesh": mesh,
            "Material": {"Young modulus": 10 ** rng.uniform(0, 5), "Poisson ratio": .3}}, tuple(range(ids))


def outer_shell(rng, dim, radius):
    """Its inner surface is at .85 or more of its inner radius."""
    mesh = {"Generator": "hyper_shell", "Arguments": f"{', '.join(['0'] * dim)} : 1 : 1.2 : 12 : true",
            "Global refinements": 1, "Scale": radius, "Rotation": turn_of(rng, dim)}
    return {"Mesh": mesh, "Material": {"Young modulus": 10 ** rng.uniform(0, 5), "Poisson ratio": .3}}, (0, 1)


def direction(rng, dim):
    v = np.array([rng.gauss(0, 1) for _ in range(dim)])
    return v / np.linalg.norm(v)


def two_bodies(rng, dim):
    """Entries, ids and names of a body inside a shell or beside another one."""
    shape, unit = rng.choice(list(shapes(dim))), 10 ** rng.uniform(-1, 2)
    if rng.random() < .5:
        inner = rng.uniform(.3, .7)
        off = direction(rng, dim) * rng.uniform(0, .8) * (.82 - inner) * unit
        return body_of(rng, dim, shape, inner * unit, off), outer_shell(rng, dim, unit), f"{shape} in a shell", inner * unit
    other, ratio = rng.choice(list(shapes(dim))), rng.uniform(.4, 1.5)
    far = direction(rng, dim) * unit * (1 + ratio) * (1.01 + 10 ** rng.uniform(-3, 0))
    return body_of(rng, dim, shape, unit, [0.0] * dim), body_of(rng, dim, other, ratio * unit, far), \
        f"{shape} beside {other}", min(1, ratio) * unit


def joint(body, ids, master, master_ids, mu):
    return {"Body": body, "Boundary ids": ids, "Master body": master, "Master boundary ids": master_ids,
            "Friction coefficient": mu, "Pairing": "node to face"}


def gap_faults(folder, contacts, size):
    """Gaps of rows below the reach against the distance of the node to the faces of the other body."""
    rows = [row for row in read(folder / "reactions.csv") if row["contact"] in contacts and row["increment"] == 1]
    rows = [row for row in rows if row["gap"] <= REACH * size]
    if not rows:
        return []
    faces = {}
    for name in {name for touch in contacts.values() for name in (touch.body, touch.master)}:
        points, cells, _ = read_vtu(folder / f"solution-{name}-0001.vtu")
        faces[name] = surface(points, cells)
    faults = []
    for row in rows:
        touch = contacts[row["contact"]]
        fault = gap_fault(row, faces[touch.body], faces[touch.master], size)
        faults += [fault] if fault else []
    return faults


def own_normals(point, faces, size):
    """Outward normals of the faces at a node of the body itself."""
    s, d = closest(faces, point)
    at = d < 1e-4 * size
    return face_normals(faces[at], s[at])


def sizes(faces):
    """The diagonal of each face."""
    return np.linalg.norm(faces.max(axis=1) - faces.min(axis=1), axis=1)


def gap_fault(row, own, other, size):
    """The gap must be the distance to the nearest of the faces that oppose one of the node's, whatever angle that asks
    for, or to its plane where the node is beyond its edge by next to nothing."""
    point = place(row)
    s, d = closest(other, point)
    cosines = (-face_normals(other, s) @ own_normals(point, own, size).T).max(axis=1)
    for cosine in OPPOSING:
        opposing = np.flatnonzero(cosines > cosine - 1e-6)
        if opposing.size == 0:
            continue
        nearest = opposing[d[opposing].argmin()]
        if abs(d[nearest] - row["gap"]) <= GAPS * size:
            return None
        beyond = np.sqrt(max(d[nearest] ** 2 - row["gap"] ** 2, 0))
        if row["gap"] <= d[nearest] and beyond <= OVERHANG * sizes(other[[nearest]])[0]:
            return None
    return f"{row['contact']} at {row['x']:.6g}, {row['y']:.6g}, {row['z']:.6g}: gap {row['gap']:.6g}, " \
           f"nearest face at {d.min():.6g}"


def no_touch(number):
    rng = random.Random(f"no-touch {number}")
    dim = 2 + number % 2
    one, other, name, size = two_bodies(rng, dim)
    (first, ids), (second, other_ids) = (one, other) if rng.random() < .5 else (other, one)
    mu = rng.choice((0.0, .3))
    scene = {"Dimension": dim, "Body first": first, "Body second": second,
             "Contact one": joint("first", ids, "second", other_ids, mu),
             "Output": {"VTU": 1}}
    for body, tags in (("first", ids), ("second", other_ids)):
        scene[f"Support {body}"] = support(tags, ", ".join("xyz"[:dim]), body=body, Stiffness=1.0)
        if rng.random() < .5:
            scene[f"Load {body}"] = load("body force", " ; ".join(["1e-9*t"] * dim), body=body)
    contacts = {"one": Touch("first", mu, "second")}
    statement = Statement(dim, [], contacts, {}, length=1e-6 * size, motion=1e-3 * size, silent=True)
    return StaticCase(f"{dim}D, {name}, {len(ids)} ids against {len(other_ids)}", scene, statement,
                      more=[lambda folder: gap_faults(folder, contacts, size)])
