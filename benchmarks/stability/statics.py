# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A judge that knows statics only.

It takes the tables of a run and what the author of the scene knows about it: the resultants
of all loads in closed form, which motions of each body no support holds, who touches whom
with which friction. It computes sums of forces and moments of each body from the rows of
reactions.csv, looks at cones, signs, gaps and states of every row, and believes none of the
columns in which the program judges itself.
"""
from dataclasses import dataclass, field

import numpy as np

from support.tables import TEXTS, read

SUMS = 1e-9  # of the sum of all magnitudes
FORCES = 1e-8  # of the largest load of a body: cones and signs
PAST = 1e-13  # of the largest force so far: what is left of loads that vanish
ALL = {2: ("x", "y", "rz"), 3: ("x", "y", "z", "rx", "ry", "rz")}


@dataclass
class Load:
    """A resultant: `force` at `point`, times factor(t)."""
    body: str
    point: tuple
    force: tuple
    factor: callable = lambda t: 1.0


@dataclass
class Touch:
    """A contact of the scene."""
    body: str
    mu: float
    master: str = None


@dataclass
class Statement:
    """What is known about a scene without having solved it."""
    dim: int
    loads: list
    contacts: dict
    free: dict  # of each body that no support holds entirely: the motions that none holds
    length: float  # what counts as closed
    motion: float = np.inf  # larger displacements are absurd
    tolerance: float = 1e-10  # of the scene
    pressed: dict = field(default_factory=dict)  # contact: (direction, sum of its reactions along it at the end)
    silent: bool = False  # no reaction at all


def vector(row, name):
    return np.array([row[f"{name}_{c}"] for c in "xyz"])


def place(row):
    return np.array([row[c] for c in "xyz"])


def tangents(n, dim):
    """t1 = n x e_z (e_y x n where |n_z| > .9), t2 = n x t1; in the plane t1 = (n_y, -n_x)."""
    if dim == 2:
        return np.array([n[1], -n[0], 0]), np.array([0, 0, 1.0])
    t1 = np.cross((0, 1, 0), n) if abs(n[2]) > .9 else np.cross(n, (0, 0, 1))
    t1 = t1 / np.linalg.norm(t1)
    return t1, np.cross(n, t1)


def reaction(row, dim):
    """Force on the body of the row."""
    n = vector(row, "n")
    t1, t2 = tangents(n, dim)
    return row["r_n"] * n + row["r_t1"] * t1 + row["r_t2"] * t2


def padded(v):
    return np.array([*v, 0, 0, 0][:3], dtype=float)


def acting_at(row):
    """Where a reaction acts on its body: at its node where the table does not say."""
    return vector(row, "acts") if "acts_x" in row and np.isfinite(row["acts_x"]) else place(row)


class Sums:
    """Forces and moments about the origin, and the sums of their magnitudes."""

    def __init__(self):
        self.total, self.size, self.reach = np.zeros(6), np.zeros(6), 0.0

    def add(self, point, force):
        self.reach = max(self.reach, np.linalg.norm(point))
        moment = np.cross(point, force)
        self.total += np.concatenate([force, moment])
        self.size[:3] += np.linalg.norm(force)
        self.size[3:] += np.linalg.norm(point) * np.linalg.norm(force)

    def faults(self, free, bound, what, past=0.0):
        """`past`: the largest force so far, whose rounding is no fault."""
        for i, name in enumerate(ALL[3]):
            rounding = PAST * past * (1 if i < 3 else self.reach)
            if name in free and not abs(self.total[i]) <= bound * self.size[i] + rounding:
                yield f"{what}: {name} sums to {self.total[i]:.3g} of {self.size[i]:.3g}"


def other_side(name):
    return name.endswith("_master")


def owner(statement, name):
    """The body on which the reactions of these rows act."""
    touch = statement.contacts[name.removesuffix("_master")]
    return touch.master if other_side(name) else touch.body


def still(point):
    return point


def way_of(statement, body, rows):
    """Where points of a body come to that turns far: the rotation and translation nearest to what its nodes that meet obstacles
    at rest have moved (Kabsch, Acta Cryst. A 32 (1976))."""
    own = [row for row in rows if statement.contacts[row["contact"].removesuffix("_master")].master is None
           and owner(statement, row["contact"]) == body]
    if len(own) < 3:
        return still
    before = np.array([place(row) for row in own])
    moved = []
    for row in own:
        n = vector(row, "n")
        moved.append(sum(row[f"u_{name}"] * axis for name, axis in zip(("n", "t1", "t2"), (n, *tangents(n, statement.dim)))))
    after = before + moved
    a, b = before.mean(axis=0), after.mean(axis=0)
    u, _, v = np.linalg.svd((before - a).T @ (after - b))
    turn = v.T @ np.diag([1, 1, np.sign(np.linalg.det(v.T @ u.T))]) @ u.T
    return lambda point: b + turn @ (point - a)


def balance_faults(statement, t, rows, past, far=False):
    """Each body's loads and reactions, in the directions that no support holds, undeformed or `far` from there."""
    sums = {body: Sums() for body in statement.free}
    ways = {body: way_of(statement, body, rows) if far else still for body in sums}
    for load in statement.loads:
        if load.body in sums:
            sums[load.body].add(ways[load.body](padded(load.point)), load.factor(t) * padded(load.force))
    for row in rows:
        body = owner(statement, row["contact"])
        if body in sums:
            sums[body].add(ways[body](acting_at(row)), reaction(row, statement.dim))
    bound = max(SUMS, 10 * statement.tolerance)
    for body, free in statement.free.items():
        yield from sums[body].faults(free, bound, f"body {body}", past)


def action_faults(statement, rows, past):
    """What acts on a body acts on its master, at the foot where the table has one."""
    for name, touch in statement.contacts.items():
        if touch.master is None:
            continue
        forces, at_foot = Sums(), Sums()
        own = [row for row in rows if row["contact"] == name]
        masters = [row for row in rows if row["contact"] == name + "_master"]
        for row in own + masters:
            force = reaction(row, statement.dim)
            forces.add(place(row), force)
            foot = not other_side(row["contact"]) and "foot_x" in row and np.isfinite(row["foot_x"])
            at_foot.add(vector(row, "foot") if foot else place(row), force)
        if masters:
            yield from forces.faults(("x", "y", "z"), SUMS, f"action and reaction of {name}", past)
        if masters and "foot_x" in own[0]:
            yield from at_foot.faults(("rx", "ry", "rz"), SUMS, f"action and reaction of {name} at the feet",
                                      past)


def row_faults(row, mu, tiny, length, motion, in_parts):
    """Signs, cone, gap and state of a contact node; forces below `tiny` are none."""
    r_n, r_t = row["r_n"], np.array([row["r_t1"], row["r_t2"]])
    du, tangential = np.array([row["du_t1"], row["du_t2"]]), np.linalg.norm(r_t)
    slide = np.linalg.norm(du)
    if not all(np.isfinite(value) for name, value in row.items()
               if name not in TEXTS and not name.startswith(("foot", "acts"))):
        yield "is not finite"
    if r_n < -tiny:
        yield f"pulls by {r_n:.3g}"
    if tangential > mu * max(r_n, 0) + tiny:
        yield f"friction {tangential:.6g} above {mu * r_n:.6g}"
    if row["gap"] < -length:
        yield f"penetrates by {row['gap']:.3g}"
    if max(abs(r_n), tangential) > tiny and row["gap"] > length:
        yield f"reaction {r_n:.3g} across a gap of {row['gap']:.3g}"
    if row["state"] == "open" and max(abs(r_n), tangential) > tiny:
        yield f"open with a reaction {r_n:.3g}"
    if row["state"] != "open" and abs(row["gap"]) > length:
        yield f"{row['state']} with a gap of {row['gap']:.3g}"
    if row["state"] == "slip" and mu * r_n - tangential > tiny and not in_parts:
        yield f"slips with friction {tangential:.6g} below {mu * r_n:.6g}"
    if row["state"] == "stick" and slide > length and not in_parts:
        yield f"sticks and slides by {slide:.3g}"
    if row["state"] != "open" and slide > length and not in_parts \
            and np.linalg.norm(r_t + mu * r_n * du / slide) > tiny:
        yield "friction is not against the slip"
    if np.linalg.norm([row["u_n"], row["u_t1"], row["u_t2"]]) > motion:
        yield f"has moved by {row['u_n']:.3g}, {row['u_t1']:.3g}, {row['u_t2']:.3g}"


def loads_on(statement, t):
    """Of each body that is loaded: the sum of magnitudes."""
    sizes = {load.body: 0.0 for load in statement.loads}
    for load in statement.loads:
        sizes[load.body] += abs(load.factor(t)) * np.linalg.norm(load.force)
    return sizes


def largest_force(statement, t, rows):
    """Of loads and reactions at a time."""
    return max([*loads_on(statement, t).values(), *(abs(row["r_n"]) for row in rows)], default=0.0)


def law_faults(statement, t, rows, in_parts, past):
    known = [size for size in loads_on(statement, t).values() if size > 0]
    size = min(known) if known else max((abs(row["r_n"]) for row in rows), default=0)
    tiny = FORCES * size + PAST * past
    for row in rows:
        if other_side(row["contact"]):
            continue
        mu = statement.contacts[row["contact"]].mu
        for fault in row_faults(row, mu, tiny, statement.length, statement.motion, in_parts):
            yield f"{row['contact']} at {row['x']:.4g}, {row['y']:.4g}, {row['z']:.4g}: {fault}"
        if statement.silent and (row["r_n"], row["r_t1"], row["r_t2"]) != (0, 0, 0):
            yield f"{row['contact']} at {row['x']:.4g}, {row['y']:.4g}, {row['z']:.4g}: reaction {row['r_n']:.3g}"


def closed_form_faults(statement, rows):
    """Sums of contacts that are known."""
    for name, (direction, force) in statement.pressed.items():
        along = padded(direction) / np.linalg.norm(direction)
        found = sum(reaction(row, statement.dim) @ along for row in rows if row["contact"] == name)
        if not abs(found - force) <= max(1e-8, 10 * statement.tolerance) * abs(force):
            yield f"{name}: sum of reactions {found:.10g} instead of {force:.10g}"


def judge(folder, statement, finished=True):
    """All faults of the tables in a folder, increment by increment; the last one is the end if the run has finished."""
    file = folder / "reactions.csv"
    rows = read(file) if file.exists() else []
    increments, faults, past = read(folder / "increments.csv"), [], 0.0
    far = (folder / "log.txt").exists() and "kinematics finite sliding" in (folder / "log.txt").read_text()
    by_increment = {}
    for row in rows:
        by_increment.setdefault(row["increment"], []).append(row)
    if statement.contacts and not (statement.silent and not rows) and len(by_increment) != len(increments):
        faults.append(f"{len(by_increment)} increments of reactions, {len(increments)} of resultants")
    for number, own in by_increment.items():
        row = next((row for row in increments if row["increment"] == number), {})
        t, in_parts = own[0]["time"], row.get("substeps", 1) != 1
        past = max(past, largest_force(statement, t, own))
        found = [*balance_faults(statement, t, own, past, far), *action_faults(statement, own, past),
                 *law_faults(statement, t, own, in_parts, past)]
        faults += [f"increment {number:g}, {fault}" for fault in found]
    if by_increment and finished:
        faults += closed_form_faults(statement, own)
    return faults
