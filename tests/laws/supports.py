# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Supports in any direction, springs, rollers, held contact nodes, and times."""
import math

from support.scenes import box, contact, floor, load, merge, press_and_shear, support
from support.tables import REACTION, in_space
from support.vectors import plus, rotation, unit


def carried(laws):
    """A block that springs carry through the air: nothing acts on it; one with a weight hangs by as much."""
    for dim in (2, 3):
        for k in (1e2, 1e4, 1e7):
            scene = {"Dimension": dim, "Body block": box((3,) * dim, (1.0,) * dim),
                     "Obstacle floor": floor(dim, Point=(0.0,) * (dim - 1) + (-10.0,)), "Contact bottom": contact(ids=2 * dim - 2),
                     "Support top": support(2 * dim - 1, "x, y, z"[:3 * dim - 2], " ; ".join(["0.3*t"] * (dim - 1) + ["-0.5*t"]), Stiffness=k),
                     "Time": {"End": 1, "Increments": 2}, "Output": {"VTU": 0}}
            force = "support_top_f_" + "xyz"[dim - 1]
            laws.check(f"{dim}D, k {k:g}, carried through the air: force", abs(laws.run(scene).increments[-1][force]), 0)
            heavy = {**scene, "Load weight": load("body force", " ; ".join(["0"] * (dim - 1) + ["-1"]))}
            laws.check("  with a weight", abs(laws.run(heavy, bounds=False).increments[-1][force] - 1), 1e-15 * k + 1e-12)


def supports(laws):
    carried(laws)
    # a bar between a floor and springs: pressure = d / (1/k + H/E)
    young, height, k, d = 1000.0, 1.5, 400.0, .01
    for dim in (2, 3):
        size = (1.0, height) if dim == 2 else (1.0, 1.0, height)
        springs = {"Dimension": dim, "Body block": box((2,) * dim, size), "Output": {"VTU": 0},
                   "Support bottom": support(2 * dim - 2, "x, y, z"[:3 * dim - 2], Stiffness=k),
                   "Load top": load("pressure", "2", 2 * dim - 1)}
        found = laws.run(springs).increments[-1]["support_bottom_f_" + "xyz"[dim - 1]]
        laws.check(f"{dim}D, elastic foundation, no contact", abs(found - 2), 1e-10)
        scene = {"Dimension": dim, "Body block": box((4, 3) if dim == 2 else (2, 2, 3), size, young=young),
                 "Obstacle floor": floor(dim), "Contact bottom": contact(ids=2 * dim - 2),
                 "Support left": support(0, "x"),
                 "Support top": support(2 * dim - 1, "y" if dim == 2 else "z", f"-{d}*t", Stiffness=k),
                 "Output": {"VTU": 0}}
        if dim == 3:
            scene["Support front"] = support(2, "y")
        else:
            scene["Body block"]["Material"]["Plane"] = "stress"
        run = laws.run(scene)
        expected = d / (1 / k + height / young)
        total = sum(row["r_n"] for row in run.rows)
        laws.check(f"{dim}D, elastic foundation, total force", abs(total / expected - 1), 1e-12)
        inner = [row for row in run.rows if 0 < row["x"] < 1 and (dim == 2 or 0 < row["y"] < 1)]
        laws.check(f"{dim}D, elastic foundation, pressure",  # of 4 cells, or of 2 by 2
                   max(abs(row["r_n"] / (1 / 4) / expected - 1) for row in inner), 1e-12)
        normal_springs = merge(scene, {"Support top": {"Directions": "normal"}})
        normal_springs["Support top"]["Displacement"] = f"-{d}*t"
        laws.same(f"{dim}D, springs along the normal", run, laws.run(normal_springs), 1e-12)

    # any directions: u.e = d for each gives the same u
    scene = press_and_shear(2)
    ux, uy = "0.004*max(t - 1, 0)", "-0.01*min(t, 1)"
    first = laws.run(scene)
    a, b = unit((1, 1)), unit((1, -2))
    along = [f"{e[0]!r}*({ux}) + ({e[1]!r})*({uy})" for e in (a, b)]
    oblique = merge(scene, {"Support top": {"Directions": "(1, 1), (1, -2)", "Displacement": " ; ".join(along)}})
    laws.same("directions that are not orthogonal", first, laws.run(oblique), 1e-11)
    two = merge(scene, {"Support top": {"Directions": "(1, 1)", "Displacement": along[0]},
                        "Support more": support(3, "(1, -2)", along[1]),
                        "Support again": support(3, "x", ux)})
    laws.same("several supports that agree", first, laws.run(two), 1e-11)
    springs = merge(oblique, {"Support top": {"Stiffness": "20000"}})
    one = merge(two, {"Support top": {"Stiffness": "20000"}, "Support again": None})
    one["Support more"]["Stiffness"] = "20000"
    laws.same("springs that are not orthogonal", laws.run(springs), laws.run(one), 1e-11)
    space = press_and_shear(3)
    functions = [f.strip() for f in space["Support top"]["Displacement"].split(";")]
    vectors = [unit(v) for v in ((1, 1, 0), (0, 1, -2), (3, 0, 1))]
    along = [" + ".join(f"({c!r})*({f})" for c, f in zip(e, functions)) for e in vectors]
    oblique = merge(space, {"Support top": {"Directions": "(1, 1, 0), (0, 1, -2), (3, 0, 1)",
                                            "Displacement": " ; ".join(along)}})
    laws.same("3D, directions that are not orthogonal", laws.run(space), laws.run(oblique), 1e-11)

    # a belt under a block whose contact nodes supports hold: friction is mu N there too, along the slip
    for dim, held, belt in ((2, "x", (.5, 0)), (3, "x, y", (.3, .4, 0)), (3, "x", (.3, .4, 0))):
        scene = {"Dimension": dim, "Body block": box((4,) * dim, (1.0,) * dim),
                 "Obstacle floor": floor(dim, Displacement=" ; ".join(f"{v}*t" for v in belt)),
                 "Contact bottom": contact(ids=2 * dim - 2, mu=.25), "Support bottom": support(2 * dim - 2, held),
                 "Load top": load("pressure", "2", 2 * dim - 1),
                 "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
        if dim == 3:
            scene["Support top"] = support(5, "x, y")
        last = laws.run(scene).last()
        name = f"{dim}D, a belt, {held} of contact nodes held"
        laws.check(f"{name}: size of friction", abs(sum(math.hypot(row["r_t1"], row["r_t2"]) for row in last) - .5), 1e-9)
        laws.demand(f"{name}: none sticks", all(row["state"] != "stick" for row in last))
        if len(held.split()) == dim - 1:
            total = plus((0, 0, 0), *(in_space(row, dim, REACTION) for row in last))
            laws.check(f"{name}: friction along the belt", math.dist(total[:dim - 1], belt[:dim - 1]), 1e-9)

    # rollers at 30 degrees
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    straight = {"Dimension": 2, "Body block": box((8, 6), (1.0, 1.0)), "Obstacle floor": floor(2),
                "Contact bottom": contact(mu=.2), "Support right": support(1, "x"),
                "Load left": load("pressure", "2*t", 0), "Load top": load("pressure", "3*t", 3),
                "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    turned = merge(straight, {"Body block": {"Mesh": {"Rotation": 30}},
                              "Obstacle floor": {"Normal": (-s, c)}, "Support right": {"Directions": f"({c!r}, {s!r})"}})
    laws.same("rollers at 30 degrees", laws.run(straight), laws.run(turned), matrix=rotation((0, 0, 1), 30))

    first = laws.run({**scene, "Time": {"Stages": "1 : 1, 3 : 4"}})
    times = laws.run({**scene, "Time": {"Times": "1, 1.5, 2, 2.5, 3"}})
    laws.same("stages and times", first, times, 0)
    equal = laws.run(merge(scene, {"Time": {"End": 3, "Increments": 3}}))
    laws.same("End and Increments", equal, laws.run({**scene, "Time": {"Stages": "3 : 3"}}), 0)
    table = [row["time"] for row in first.increments]
    laws.demand(f"times {table}", table == [1, 1.5, 2, 2.5, 3])
