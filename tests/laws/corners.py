# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes in two and three contacts: floating and held, with closed forms."""
import math

from laws.iterative import backend
from support.scenes import box, contact, joint, load, support
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


def beside_layers(laws):
    """A floor that gives way along its normal only shares what sticks with a frictionless wall; one that is sheared does not."""
    for dim in (2, 3):
        bottom = "xyz"[dim - 1]
        for layer, answer in (({}, "no"), ({"Compliance": 1e-4}, "no"), ({"Shear compliance": 1e-4}, "yes"),
                              ({"Compliance": 1e-4, "Shear compliance": 1e-4}, "yes")):
            held = {"Support hold": support(2 * dim - 1, ", ".join("xyz"[:dim]), Stiffness=1.0)}
            scene = in_corner(dim, .8, (.3,) * (dim - 1) + (3.0,), held, side_mu=0)
            scene[f"Contact {bottom}"].update(layer)
            run = laws.run(scene)
            laws.demand(f"{dim}D, corner of a floor with {', '.join(layer) or 'no layer'}: determinate is {answer}",
                        all(row["determinate"] == answer for row in run.increments))
    # of a wall that is pushed only the sum is given: nodes of an edge share it with the floor, a single one does not
    for dim, answer in ((2, "yes"), (3, "no")):
        held = {"Support hold": support(2 * dim - 1, ", ".join("xyz"[:dim]), Stiffness=1.0)}
        scene = in_corner(dim, .8, (.3,) * (dim - 1) + (3.0,), held, side_mu=0)
        scene["Body block"]["Material"]["Poisson ratio"] = 0  # or its edge leaves the wall
        if dim == 3:
            del scene["Obstacle y"], scene["Contact y"]
        scene["Obstacle x"].update({"Free": "x", "Force": "0.3*t" + " ; 0" * (dim - 1)})
        run = laws.run(scene)
        laws.demand(f"{dim}D, beside a free wall: determinate is {answer}", all(row["determinate"] == answer for row in run.increments))


def in_closed_form(laws, *arguments):
    """Pressed into corners and pulled out of them; by the backend that the arguments ask for."""
    for dim in (2, 3):
        pressures = (1.0, 2.0, 3.0)[:dim]
        bottom = "xyz"[dim - 1]
        share = 1 / 3 ** (dim - 1)  # of a cell's face
        for turned in (0.0, 30.0):
            run = laws.run(in_corner(dim, 0, pressures, turned=turned), *arguments)
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
            run = laws.run(in_corner(dim, mu, pressures), *arguments)
            laws.admissible(f"{dim}D, corner, mu {mu}", run, lambda row: mu)
            found = plus((0, 0, 0), *(in_space(row, dim, REACTION) for row in run.last()))
            laws.check(f"{dim}D, corner, mu {mu}: reactions balance the pressures",
                       math.dist(found, scaled(2, pressures + (0,) * (3 - dim))), 1e-10)
            held = {"Support hold": support(2 * dim - 1, ", ".join("xyz"[:dim]), Stiffness=1.0)}
            run = laws.run(in_corner(dim, mu, pressures, held), *arguments)
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
                done, _ = laws.start(scene, *arguments)
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
    last = laws.run(groove, *arguments).increments[-1]
    weight = -last["loads_f_y"]
    for side, sign in (("left", 1), ("right", -1)):
        found = (last[f"{side}_f_x"], last[f"{side}_f_y"])
        laws.check(f"disc in a groove, {side} wall carries W/sqrt(2)",
                   math.dist(found, (sign * weight / 2, weight / 2)) / weight, 1e-10)


def on_two(dim, mu, wall=False):
    """A block across two others of different stiffness, whose seam lies under its nodes; or tied to one of them and beside a wall."""
    last, bottom, top, every = dim - 1, 2 * (dim - 1), 2 * dim - 1, "x, y, z"[:3 * dim - 2]

    def deep(plane, across):
        return plane if dim == 2 else (plane[0], across, plane[1])
    scene = {"Dimension": dim, "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0},
             "Body block": box(deep((8, 4), 2), deep((2.0, 1.0), .5), deep((-1.0, 1.0), 0.0), young=500.0),
             "Load weight": load("pressure", "2*min(t, 1)", top),
             "Load push": load("body force", " ; ".join([f"{-.3 if mu > 0 or wall else 0}*max(t - 1, 0)"] + ["0"] * last))}
    for name, x, young in (("left", -1.0, 1000.0), ("right", 0.0, 300.0)):
        scene[f"Body {name}"] = box(deep((5, 5), 2), deep((1.0, 1.0), .5), deep((x, 0.0), 0.0), young=young)
        scene[f"Support {name}"] = support(bottom, every, body=name)
        scene[f"Contact {name}"] = joint("block", bottom, name, top, **{"Friction coefficient": mu})
    if wall:
        scene["Body left"] = box(deep((10, 5), 2), deep((2.0, 1.0), .5), deep((-1.0, 0.0), 0.0))
        scene["Contact left"] = {**joint("block", bottom, "left", top), "Kind": "tie"}
        for name in ("Body right", "Support right", "Contact right"):
            del scene[name]
        scene["Obstacle wall"] = {"Shape": "half space", "Normal": (1, 0, 0)[:dim], "Point": deep((-1.0, 0.0), 0.0)}
        scene["Contact wall"] = contact(ids=0, obstacle="wall", mu=mu)
    return scene


def by_both_backends(laws):
    """The same tables where shares are determined: two masters of a node, an obstacle beside a tie, bodies that slide along an edge."""
    scenes = {f"{dim}D, {what}, mu {mu}": on_two(dim, mu, wall) for dim in (2, 3) for wall, what in ((False, "two masters"), (True, "tie and wall"))
              for mu in (0.0, .2)}
    along = in_corner(3, .3, (0.0, 1.0, 2.0), {"Support end": support(0, "x", "0.01*t", Stiffness=200), "Load x": load("body force", "0 ; 0 ; 0")}, side_mu=.2)
    del along["Contact x"], along["Obstacle x"]
    scenes["3D, along an edge"] = along
    # all walls are touched, and friction holds or not: also by all unknowns
    for mu in (0, .2, .8):
        run = laws.run(in_corner(3, mu, (1.0, 2.0, 3.0)), *backend("iterative"))
        laws.demand(f"3D, corner, mu {mu}: solved by all unknowns", all(row["solver"] == "iterative" for row in run.increments))
    for what, scene in scenes.items():
        condensed, iterative = (laws.run(scene, *backend(name)) for name in ("condensed", "iterative"))
        laws.same(f"{what}: both backends", condensed, iterative, 1e-9)
        laws.demand("  solved by all unknowns", all(row["solver"] == "iterative" for row in iterative.increments))


def corners(laws):
    """Nodes in two and three contacts: floating and held, with closed forms; by both backends."""
    beside_layers(laws)
    for name in ("condensed", "iterative"):
        in_closed_form(laws, *backend(name))
    by_both_backends(laws)
