# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two bodies that do not meet know nothing of each other; free ones that overlap take the shortest way out."""
import math
import re

from support.logs import log_of
from support.scenes import box, contact, floor, load, merge, press_and_shear, ring, support
from support.tables import Run
from support.vectors import apply, rotation


def shortest_way_out(laws):
    """A ring of 12 facets turns in another one until it fits, unless friction jams it; a common turn has no say in either."""
    turns = []
    for mu, young in ((0, 1.0), (.05, 3.8), (.5, 3.8), (2, 3.8), (.5, 1.0)):
        run = laws.run({"Dimension": 2, "Body shaft": ring(.5, 1.04, young=1.0), "Body hub": ring(1.0, 2.0, degrees=12, young=young),
                        "Contact joint": contact("hub", 0, "", mu, **{"Master body": "shaft", "Master boundary ids": 1,
                                                                      "Largest interference": .1, "Pairing": "node to face"}),
                        "Output": {"VTU": 0}})
        what = f"mu {mu}, E {young}"
        if mu < .1:
            laws.demand(f"{what}: no force", run.largest("r_n") == 0)
            turns.append(sorted(row["u_t1"] for row in run.last()))
            continue
        rows, end = run.last(), run.increments[-1]
        forces = sorted(row["r_n"] for row in rows)  # of three nodes a facet
        most = forces[-1]
        laws.check(f"{what}: pressures of 12 equal facets", max(b - a for a, b in zip(forces[::12], forces[11::12])) / most, 1e-9)
        laws.check("  friction within its cone", max(abs(row["r_t1"]) - mu * row["r_n"] for row in rows) / most, 1e-12)
        laws.check("  what is left of forces and moment", max(abs(end[f"joint_{c}"]) for c in ("f_x", "f_y", "m_z")) / most, 1e-9)
        laws.check("  the largest way, over the interference", run.largest("u_t1", "u_n") / .04, 1)
    laws.check("slips of all nodes, whatever friction and stiffness",
               max(abs(u - v) for turn in turns for u, v in zip(turn, turns[0])) / abs(turns[0][0]), 1e-9)


def fit_that_floats(laws):
    """A shaft pressed into a hub of other facets, which nothing holds: friction carries a torque from one to the other and turns
    neither, however the scene is turned."""
    torque = .002
    for pairing in ("mortar", "node to face"):
        pressures = []
        for degrees in (0.0, 33.0):
            run = laws.run({"Dimension": 2, "Body shaft": ring(.5, 1.0, 16, degrees), "Body hub": ring(1.0, 2.0, 12, degrees + 7),
                            "Contact joint": contact("hub", 0, "", .3, **{"Master body": "shaft", "Master boundary ids": 1,
                                                                          "Gap": "-1e-3*min(t, 1)", "Pairing": pairing}),
                            "Load shaft": load("moment", f"{torque}*max(t - 1, 0)", 0, "shaft", Coupling="distributing"),
                            "Load hub": load("moment", f"-{torque}*max(t - 1, 0)", 1, "hub", Coupling="distributing"),
                            "Time": {"Times": "1, 2"}, "Output": {"VTU": 0}})
            what = f"{pairing}, turned by {degrees:g}"
            laws.check(f"{what}: moment of the joint", abs(run.increments[-1]["joint_m_z"] / torque - 1), 1e-9)
            laws.check("  how far it moves, over the interference", run.largest("u_n", "u_t1") / 1e-3, 2)
            pressures.append(sorted(row["r_n"] for row in run.last()))
        laws.check(f"{pairing}: pressures of both", max(abs(a - b) for a, b in zip(*pressures)) / pressures[0][-1], 1e-8)


def fit_without_friction(laws):
    """A shrink fit of rings whose facets resist a turn of one in the other by their last digits only: the pressure of Lame."""
    a, b, c, nu, gap = 1.0, 1.5, 2.3, .3, 5e-5
    inner, outer = 16e3, 37e3
    opened = sum(b / young * ((b * b + r * r) / abs(r * r - b * b) + sign * nu) for young, r, sign in ((inner, a, -1), (outer, c, 1)))
    for element, bound in (("Q1", .03), ("Q2", 3e-3)):
        for n_inner, n_outer, slave in ((99, 101, "hub"), (30, 69, "hub"), (45, 32, "shaft"), (90, 61, "shaft"), (55, 47, "hub"), (37, 38, "shaft")):
            sides = {"shaft": 1, "hub": 0}
            master = "shaft" if slave == "hub" else "hub"
            run = laws.run({"Dimension": 2, "Body shaft": {**ring(a, b, n_inner, young=inner), "Element": element},
                            "Body hub": {**ring(b, c, n_outer, young=outer), "Element": element},
                            "Contact joint": contact(slave, sides[slave], "", 0, **{
                                "Master body": master, "Master boundary ids": sides[master], "Gap": -gap}),
                            "Output": {"VTU": 0}})
            force = sum(row["r_n"] for row in run.rows if row["contact"] == "joint")
            laws.check(f"{element}, {n_inner} on {n_outer} cells, {slave}: pressure", abs(force / (2 * math.pi * b * gap / opened) - 1), bound)


def shortest_way(laws):
    """A block pressed uniformly on a plane without friction: what nothing opposes stays where it is on the average, so that
    the block spreads to both sides alike, however the scene is turned."""
    for axis, degrees in (((0, 0, 1), 0.0), ((1, -2, .5), 1.0), ((1, -2, .5), 49.0), ((1, 1, 1), 120.0)):
        turn = rotation(axis, degrees)
        corner = apply(turn, (2.0, 3.0, 1.0))
        scene = {"Dimension": 3, "Body block": box((3, 4, 2), (2.0, 3.0, 1.0)), "Obstacle floor": {
            "Shape": "half space", "Normal": apply(turn, (0, 0, 1))}, "Contact bottom": contact("block", 4, "floor", 0),
            "Load weight": load("pressure", "5*t", 5), "Time": {"Times": "0.5, 1"},
            "Output": {"VTU": 0, "Probes": "corner: " + ", ".join(map(repr, corner))}}
        scene["Body block"]["Mesh"]["Rotation"] = (*axis, degrees)
        for name in ("condensed", "iterative"):
            run = laws.run(scene, "-s", f"Solver/Backend={name}")
            u = apply(tuple(zip(*turn)), run.probe("corner"))
            laws.check(f"{name}, turned by {degrees}: it spreads to both sides alike",
                       max(abs(a / 5e-3 - b) for a, b in zip(u, (.3, .45, -1))), 1e-9)
            laws.demand("  of many solutions", run.increments[-1]["determinate"] == "no")


def nearby_wall(laws):
    """A block pressed on a plane without friction, a wall some way off: the shortest way does not touch it, whatever the turn."""
    for degrees in (0.0, 20.0, 33.0, 77.0, 150.0, 281.0):
        turn = rotation((0, 0, 1), degrees)
        scene = {"Dimension": 2, "Body block": box((3, 2), (1.5, 1.0), Rotation=degrees),
                 "Obstacle floor": {"Shape": "half space", "Normal": apply(turn, (0, 1, 0))[:2]},
                 "Obstacle wall": {"Shape": "half space", "Normal": apply(turn, (1, 0, 0))[:2], "Point": apply(turn, (-.05, 0, 0))[:2]},
                 "Contact bottom": contact("block", 2, "floor", 0), "Contact side": contact("block", 0, "wall", 0),
                 "Load weight": load("pressure", "5*t", 3), "Time": {"Times": "0.5, 1"}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        slips = [row["u_t1"] for row in run.last() if row["contact"] == "bottom"]
        laws.check(f"turned by {degrees}: a wall nearby is not touched", abs(sum(slips)) / max(map(abs, slips)), 1e-9)


def slips_to_both_sides(laws):
    """A block that grows slips on all its nodes, to the left and to the right: alike."""
    for cells in (3, 4, 5):
        for degrees in (0.0, 33.0):
            turn = rotation((0, 0, 1), degrees)
            scene = {"Dimension": 2, "Body block": merge(box((cells, 2), (1.5, .6), Rotation=degrees), {
                "Material": {"Expansion coefficient": 1e-3}}),
                "Obstacle floor": {"Shape": "half space", "Normal": apply(turn, (0, 1, 0))[:2]},
                "Contact bottom": contact("block", 2, "floor", .05),
                "Load weight": load("body force", " ; ".join(f"{c!r}*min(t, 1)" for c in apply(turn, (0, -1, 0))[:2])),
                "Load heat": load("temperature", "t"), "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}
            for name in ("condensed", "iterative"):
                run = laws.run(scene, "-s", f"Solver/Backend={name}")
                slips = [row["u_t1"] for row in run.last()]
                laws.check(f"{cells} cells, {name}, turned by {degrees}: it grows to both sides alike",
                           abs(sum(slips)) / max(map(abs, slips)), 1e-9)


def lies_as_on_rollers(laws):
    """A slab that lies on a smooth floor does as on rollers, also to what comes down on it over a gap: neither turns."""
    for dim in (2, 3):
        bottom, top, up = (2, 3, "y") if dim == 2 else (4, 5, "z")
        deep = dim == 3
        slab = box((4, 3, 2) if deep else (4, 2), (2.0, 1.5, .5) if deep else (2.0, .5), young=50.0)
        block = box((5, 3, 2) if deep else (5, 2), (1.2, .9, .5) if deep else (1.2, .5), (.4, .3, .6) if deep else (.4, .6))
        scene = {"Dimension": dim, "Body slab": slab, "Body block": block,
                 "Contact joint": {"Body": "block", "Boundary ids": bottom, "Master body": "slab", "Master boundary ids": top,
                                   "Friction coefficient": .3, "Kinematics": "small"},
                 "Load weight": load("body force", " ; ".join(["0"] * (dim - 1) + ["-2"]), body="slab"),
                 "Load press": load("traction", " ; ".join(["0"] * (dim - 1) + ["-0.3*(1 + x)"]), top, body="block"),
                 "Output": {"VTU": 0}}
        rolls = laws.run({**scene, "Support rollers": support(bottom, up, body="slab")})
        lies = laws.run({**scene, "Obstacle floor": floor(dim), "Contact bottom": contact("slab", bottom, "floor", 0)})
        lies.rows = [row for row in lies.rows if row["contact"] == "joint"]
        worst = max(abs(a[c] - b[c]) for a, b in zip(lies.rows, rolls.rows) for c in ("r_n", "r_t1", "r_t2")) / rolls.largest("r_n")
        laws.check(f"{dim}D, on a floor as on rollers: reactions across a gap", worst, 1e-9)


def turned_apart(laws):
    """Friction across a gap sees a slip where both sides turn together: warned of where that is more than a little."""
    for gap, kinematics in ((.05, "small"), (0, "small"), (.05, "automatic")):
        run = laws.run({
            "Dimension": 2, "Body block": box((4, 2), (2.0, 1.0), (-1.0, gap)), "Body base": box((6, 2), (6.0, 1.0), (-3.0, -1.0)),
            "Contact joint": contact("block", 2, "", .5, **{"Master body": "base", "Master boundary ids": 3,
                                                               "Pairing": "node to face", "Kinematics": kinematics}),
            "Support ground": support(2, "x, y", "-0.2*(y + 1) ; 0.2*x", "base"),
            "Load weight": load("traction", "0 ; -0.1", 3), "Output": {"VTU": 0}})
        said = [line for line in log_of(run).splitlines() if line.startswith("warning: contact 'joint'")]
        laws.demand(f"a base that turns under a block, {gap} apart, {kinematics}: {said}",
                    len(said) == (1 if gap and kinematics == "small" else 0) and all("body 'base' turns by 0.2 rad" in line for line in said))


def bodies(laws):
    turned_apart(laws)
    lies_as_on_rollers(laws)
    shortest_way(laws)
    nearby_wall(laws)
    slips_to_both_sides(laws)
    shortest_way_out(laws)
    fit_that_floats(laws)
    fit_without_friction(laws)
    for dim in (2, 3):
        left = press_and_shear(dim)
        right = press_and_shear(dim, mu=.5, young=70.0)
        shift = (5.0,) + (0.0,) * (dim - 1)
        right["Body block"]["Mesh"]["Translation"] = shift
        right["Support top"]["Displacement"] = re.sub(r"0\.004", "-0.003", right["Support top"]["Displacement"])
        other = {"Body other": right["Body block"], "Contact other": {**right["Contact bottom"], "Body": "other"},
                 "Support other": {**right["Support top"], "Body": "other"}}
        both = laws.run({**left, **other})
        for name, alone, start in (("first", laws.run(left), 0), ("second", laws.run(right), 4)):
            part = Run(both.folder)
            part.rows = [row for row in both.rows if (row["x"] > 4) == (start > 0)]
            laws.same(f"{dim}D, {name} body", alone, part, 1e-12)
