# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes in two and three contacts: floating and held, with closed forms."""
import math

from support.scenes import box, contact, load, support
from support.tables import REACTION, in_space
from support.vectors import plus, scaled


def in_corner(dim, mu, pressures, supports=None, side_mu=None, turned=0.0, cells=3):
    """A block in the corner of dim walls, pressed against each of them; its edges stand in several contacts."""
    axes = "xyz"[:dim]
    scene = {"Dimension": dim, "Body block": box((cells,) * dim, (1.0,) * dim),
             "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    for k, axis in enumerate(axes):
        normal = tuple(float(i == k) for i in range(dim))
        if turned:
            c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
            normal = (c * normal[0] - s * normal[1], s * normal[0] + c * normal[1]) + normal[2:]
        scene[f"Obstacle {axis}"] = {"Shape": "half space", "Normal": normal}
        scene[f"Contact {axis}"] = contact(ids=2 * k, obstacle=axis, mu=mu if k == dim - 1 or side_mu is None else side_mu)
        scene[f"Load {axis}"] = load("pressure", f"{pressures[k]}*t", 2 * k + 1)
    if turned:
        scene["Body block"]["Mesh"]["Rotation"] = turned if dim == 2 else (0, 0, 1, turned)
    return {**scene, **(supports or {})}


def corners(laws):
    """Nodes in two and three contacts: floating and held, with closed forms."""
    for dim in (2, 3):
        pressures = (1.0, 2.0, 3.0)[:dim]
        bottom = "xyz"[dim - 1]
        share = 1 / 3 ** (dim - 1)  # of a cell's face
        for turned in (0.0, 30.0):
            run = laws.run(in_corner(dim, 0, pressures, turned=turned))
            worst = 0.0
            for row in run.last():
                at = [row["x"], row["y"], row["z"]]
                if turned:
                    c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
                    at[:2] = [c * at[0] + s * at[1], -s * at[0] + c * at[1]]
                k = "xyz".index(row["contact"])
                part = math.prod(.5 if min(at[i], 1 - at[i]) < 1e-9 else 1.0 for i in range(dim) if i != k)
                worst = max(worst, abs(row["r_n"] - 2 * pressures[k] * share * part))
            laws.check(f"{dim}D, frictionless corner turned by {turned:g}: each reaction is its share of the pressure",
                       worst, 1e-10)
            laws.demand(f"{dim}D: the corner has a row in each contact",
                        sum(math.dist((row["x"], row["y"], row["z"]), (0, 0, 0)) < 1e-12 for row in run.last()) == dim)
        for mu in (.2, .8):
            run = laws.run(in_corner(dim, mu, pressures))
            laws.admissible(f"{dim}D, corner, mu {mu}", run, lambda row: mu)
            found = plus((0, 0, 0), *(in_space(row, dim, REACTION) for row in run.last()))
            laws.check(f"{dim}D, corner, mu {mu}: reactions balance the pressures",
                       math.dist(found, scaled(2, pressures + (0,) * (3 - dim))), 1e-10)
            held = {"Support hold": support(2 * dim - 1, ", ".join("xyz"[:dim]), Stiffness=1.0)}
            run = laws.run(in_corner(dim, mu, pressures, held))
            laws.admissible(f"{dim}D, corner, mu {mu}, on springs", run, lambda row: mu)

        # pulled out along the bottom against friction of the bottom alone, or of the wall besides
        for side_mu in (0.0, .4):
            weight, squeeze, mu = 2.0, 1.0, .3
            limit = mu * weight + side_mu * squeeze * (dim == 3)
            for share_of_limit, rightly in ((.98, True), (1.02, False)):
                scene = in_corner(dim, mu, (0.0, weight) if dim == 2 else (0.0, squeeze, weight), side_mu=side_mu)
                scene["Contact x"]["Friction coefficient"] = 0
                scene["Load x"] = load("body force", " ; ".join([f"{share_of_limit * limit / 2!r}*t"] + ["0"] * (dim - 1)))
                scene["Load " + bottom] = load("pressure", f"{weight / 2}*t", 2 * dim - 1)
                if dim == 3:
                    scene["Load y"] = load("pressure", f"{squeeze / 2}*t", 3)
                done, _ = laws.start(scene)
                laws.demand(f"{dim}D, wall of mu {side_mu}: pulled out of the corner at {share_of_limit} of the limit "
                            f"{'holds' if rightly else 'moves'}", done.returncode == (0 if rightly else 2))

    # a disc in a groove of 90 degrees: its nodes meet both walls
    groove = {"Dimension": 2,
              "Body disc": {"Mesh": {"Generator": "hyper_ball", "Arguments": "0, 0 : 1 : false", "Global refinements": 3,
                                     "Rotation": 45},
                            "Material": {"Young modulus": 1e5, "Poisson ratio": .3}},
              "Obstacle left": {"Normal": (1, 1), "Point": (-math.sqrt(.5), -math.sqrt(.5))},
              "Obstacle right": {"Normal": (-1, 1), "Point": (math.sqrt(.5), -math.sqrt(.5))},
              "Contact left": contact("disc", 0, "left"), "Contact right": contact("disc", 0, "right"),
              "Load weight": load("body force", "0 ; -1*t", body="disc"), "Output": {"VTU": 0}}
    last = laws.run(groove).increments[-1]
    weight = -last["loads_f_y"]
    for side, sign in (("left", 1), ("right", -1)):
        found = (last[f"{side}_f_x"], last[f"{side}_f_y"])
        laws.check(f"disc in a groove, {side} wall carries W/sqrt(2)",
                   math.dist(found, (sign * weight / 2, weight / 2)) / weight, 1e-10)
