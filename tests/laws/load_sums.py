# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Each kind of load by integrals in closed form: its force and moment, and those of the support that bears it, to 1e-12.

In the plane, in space and of revolution, by both backends.
"""
import itertools
import math
import re

from support.scenes import box, contact, load, merge, simplices, support
from support.vectors import cross, scaled

BACKENDS = ("condensed", "iterative")
DENSITY, THICKNESS, SPIN, GRAVITY, DEEP = 2.5, .4, 3.0, 9.81, 7.0
LOW, SIZE = (1.0, .5, .2), (2.0, 1.0, .6)  # of a block that has no corner at the origin
RINGS = (1.0, 3.0, 1.0)  # radii and height of a tube that stands on y = .5


def three(v):
    return (*v, 0.0, 0.0)[:3]


def at(point, force):
    """A force and its moment about the origin."""
    return tuple(force), cross(three(point), three(force))


def of_block(dim):
    """Loads of a block and what they come to: name, entries, gravity, (force, moment)."""
    size, low = SIZE[:dim], LOW[:dim]
    depth = THICKNESS if dim == 2 else SIZE[2]
    mass = DENSITY * SIZE[0] * SIZE[1] * depth
    middle = tuple(a + .5 * b for a, b in zip(low, size))
    right = (low[0] + size[0], *middle[1:])  # centre of the face 1
    area = SIZE[1] * depth
    f, pull = (3.0, -2.0, 1.5)[:dim], (.7, -.4, 2.1)[:dim]
    couple = (0.0, 0.0, 5.0) if dim == 2 else (1.0, -4.0, 2.5)
    text, turn = " ; ".join(map(repr, f)), "5" if dim == 2 else " ; ".join(map(repr, couple))
    down = (0.0,) * (dim - 1) + (-GRAVITY,)
    # p = DEEP + k (top - z) on the right face: its force, and where that acts
    high = dim - 1
    tall, k = size[high], 4.0
    whole, lever = (DEEP + k * tall / 2) * area, k * area * tall**2 / 12
    sinking = (right[0], *(middle[i] - (lever / whole if i == high else 0.0) for i in range(1, dim)))
    top = low[high] + tall
    inside = tuple(a + part * b for a, b, part in zip(low, size, (.61, .37, .83)))
    spun = scaled(mass * SPIN**2, three(middle[:2]))
    return [
        ("a force", load("force", text, 1), None, at(right, f)),
        ("a force at a point, distributed", load("force", text, 1, Point=pull), None, at(pull, f)),
        ("a force at a point, rigid", load("force", text, 1, Point=pull, Coupling="rigid"), None, at(pull, f)),
        ("a moment", load("moment", turn, 1), None, ((0.0,) * 3, couple)),
        ("a moment, rigid", load("moment", turn, 1, Point=pull, Coupling="rigid"), None, ((0.0,) * 3, couple)),
        ("a traction", load("traction", text, 1), None, at(right, scaled(area, f))),
        ("a pressure", load("pressure", DEEP, 1), None, at(right, (-DEEP * area, 0, 0))),
        ("a pressure that grows with depth", load("pressure", f"{DEEP} + {k}*({top!r} - {'xyz'[high]})", 1), None, at(sinking, (-whole, 0, 0))),
        ("a point force", load("point force", text, Point=inside), None, at(inside, f)),
        ("a nodal force", load("nodal force", text, 1), None, at(right, scaled(5 * (1 if dim == 2 else 4), f))),
        ("a body force", load("body force", text), None, at(middle, scaled(mass / DENSITY, f))),
        ("gravity", None, down, at(middle, scaled(mass, down))),
        ("a centrifugal load", load("centrifugal", SPIN), None, at(middle, spun))]


def found(run, what):
    row = run.increments[-1]
    return [tuple(row[f"{what}_{k}_{c}"] for c in "xyz") for k in "fm"]


def compare(laws, what, run, column, expected):
    """Of the load, and the opposite of the support, over a size that both force and moment have."""
    size = max(math.hypot(*expected[0]), math.hypot(*expected[1]))
    for whose, sign in ((column, 1), ("support_left", -1)):
        laws.check(f"{what}, {'its sums' if sign == 1 else 'the support'}", max(
            math.dist(a, scaled(sign, three(b))) for a, b in zip(found(run, whose), expected)) / size, 1e-12)


def told(laws, what, run, area, mass):
    """What the log compares: totals are carried, areas and masses are those of the drawing to the digits that it prints."""
    line = re.search("^Load (a|weight block): .*", (run.folder / "log.txt").read_text(), re.M)[0]
    size = re.search(r"(on an area|on a mass) of (\S+)$", line)
    if any(kind in what for kind in ("point force", "nodal force")):
        laws.demand(f"  the log: {line}", "asked" not in line)
    elif size:
        laws.check(f"  the log: {line}", abs(float(size[2]) / (area if "area" in size[1] else mass) - 1), 1e-5)
    else:
        laws.demand(f"  the log: {line}", "asked: " in line and line.endswith(", carried"))


def blocks(laws):
    for dim, backend in itertools.product((2, 3), BACKENDS):
        body = box((5, 4, 3)[:dim], SIZE[:dim], LOW[:dim])
        body["Material"].update({"Density": DENSITY, **({"Thickness": THICKNESS} if dim == 2 else {})})
        meshes = {"": body, ", simplices": simplices(body)}
        scene = {"Dimension": dim, "Support left": support(0, "x, y, z"[:3 * dim - 2]), "Solver": {"Backend": backend},
                 "Output": {"VTU": 0}}
        for (mesh, block), (what, entries, gravity, expected) in itertools.product(meshes.items(), of_block(dim)):
            acts = {"Load a": entries} if gravity is None else {"Gravity": ", ".join(map(repr, gravity))}
            column = "load_a" if gravity is None else "load_weight_block"
            run, depth = laws.run({**scene, "Body block": block, **acts}), THICKNESS if dim == 2 else SIZE[2]
            compare(laws, f"{dim}D{mesh}, {backend}: {what}", run, column, expected)
            told(laws, what, run, SIZE[1] * depth, DENSITY * SIZE[0] * SIZE[1] * depth)


def bearings(laws):
    """The force of a pin goes through the axis of its bore."""
    for dim, backend in itertools.product((2, 3), BACKENDS):
        mesh = {"Generator": "hyper_cube_with_cylindrical_hole", "Arguments": "0.4 : 1 : 1 : 2 : true", "Global refinements": 2}
        force, middle = (3.0, 4.0, 0.0)[:dim], (0.0, 0.0, .5)[:dim]
        plate = {"Dimension": dim, "Body block": {"Mesh": mesh, "Material": {"Young modulus": 1000, "Poisson ratio": .3}},
                 "Support left": support(0, "x, y, z"[:3 * dim - 2]), "Solver": {"Backend": backend}, "Output": {"VTU": 0},
                 "Load a": load("bearing", " ; ".join(map(repr, force)), 4 if dim == 2 else 6)}
        run = laws.run(plate, bounds=False)
        compare(laws, f"{dim}D, {backend}: a bearing load", run, "load_a", at(middle, force))
        told(laws, "a bearing load", run, None, None)


def tubes(laws):
    """Bodies of revolution: what acts along the axis, of the whole ring."""
    inner, outer, height = RINGS
    end, volume = math.pi * (outer**2 - inner**2), math.pi * (outer**2 - inner**2) * height
    # p(r) = 2 + r on the end, 2 + 3 (top - y) on the wall: no force along the axis
    grows = math.pi * 2 * (outer**2 - inner**2) + 2 * math.pi * (outer**3 - inner**3) / 3
    cases = [("a force", load("force", "0 ; -7", 3), -7), ("a force, rigid", load("force", "0 ; -7", 3, Point=(0, 4), Coupling="rigid"), -7),
             ("a force at a point", load("force", "0 ; -7", 3, Point=(0, 4)), -7), ("a point force", load("point force", "0 ; -7", Point=(1.3, 1.1)), -7),
             ("a nodal force", load("nodal force", "0 ; -7", 3), -7 * 6),
             ("a traction", load("traction", "0 ; 3", 3), 3 * end), ("a pressure", load("pressure", 3, 3), -3 * end),
             ("a pressure that grows with the radius", load("pressure", "2 + x", 3), -grows),
             ("a body force", load("body force", "0 ; -2"), -2 * volume), ("gravity", None, -DENSITY * GRAVITY * volume)]
    for backend, (what, entries, force) in itertools.product(BACKENDS, cases):
        body = merge(box((5, 4), (outer - inner, height), (inner, .5)), {"Material": {"Plane": "axisymmetric", "Density": DENSITY}})
        scene = {"Dimension": 2, "Body block": body, "Support left": support(2, "x, y"), "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
        acts = {"Gravity": f"0, {-GRAVITY}"} if entries is None else {"Load a": entries}
        column = "load_weight_block" if entries is None else "load_a"
        run = laws.run({**scene, **acts})
        for whose, sign in ((column, 1), ("support_left", -1)):
            laws.check(f"axisymmetric, {backend}: {what}, {'its sum' if sign == 1 else 'the support'}",
                       abs(run.increments[-1][f"{whose}_f_y"] / (sign * force) - 1), 1e-12)
        told(laws, what, run, end, DENSITY * volume)
    for backend in BACKENDS:
        spinning(laws, backend)


def spinning(laws, backend):
    """Across the axis: of a tube one cell thick whose walls are tied to what stands still, the sum that both walls bear."""
    inner, outer, height = RINGS
    tube = {"Dimension": 2, "Body block": merge(box((1, 4), (outer - inner, height), (inner, .5)), {"Material": {"Plane": "axisymmetric", "Density": DENSITY}}),
            "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
    for name, ids, x, normal in (("within", 0, inner, 1), ("around", 1, outer, -1)):
        tube[f"Obstacle {name}"] = {"Shape": "half space", "Normal": (normal, 0), "Point": (x, 0)}
        tube[f"Contact {name}"] = contact(ids=ids, obstacle=name, Kind="tie")
    top, k = .5 + height, 4.0
    cases = [("a centrifugal load", load("centrifugal", SPIN), DENSITY * SPIN**2 * 2 * math.pi * height * (outer**3 - inner**3) / 3),
             ("a pressure that grows with depth", load("pressure", f"{DEEP} + {k}*({top!r} - y)", 0),
              2 * math.pi * inner * (DEEP * height + k * height**2 / 2))]
    for what, entries, outwards in cases:
        rows = laws.run({**tube, "Load a": entries}).last()
        borne = sum(row["r_n"] * row["n_x"] for row in rows)
        laws.check(f"axisymmetric, {backend}: {what}, what walls bear", abs(borne / -outwards - 1), 1e-12)


def load_sums(laws):
    blocks(laws)
    bearings(laws)
    tubes(laws)
