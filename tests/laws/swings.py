# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rings that hang on a pin by a node or two: they swing, roll and slide until their load pulls straight, for a pin gives no
moment about where it touches."""
import math
import random

from support.scenes import contact, joint, merge, ring, support
from support.tables import REACTION, in_space
from support.vectors import cross, plus, scaled

YOUNG = 1e8  # forces act on undeformed bodies in their frames: moments are off by what these deform by


def swings(laws):
    at_rest(laws)
    pulled_aside(laws)
    units_and_directions(laws)
    rings_on_bodies(laws)
    turned_weights(laws)
    tubes(laws)


def hung(inner, outer, pin, force, mu, cells=16, degrees=0.0, element="Q1", unit=1.0, **more):
    """A ring about the origin, on a pin that touches it at its top; force in units of the weight, at its lowest node."""
    lowest = -90 + (degrees + 90) % (360 / cells)  # degrees of the node that is nearest to it
    point = [outer * unit * f for f in (math.cos(math.radians(lowest)), math.sin(math.radians(lowest)))]
    return {"Dimension": 2, "Body ring": {**ring(inner * unit, outer * unit, cells, degrees, YOUNG / unit), "Element": element},
            "Obstacle pin": {"Shape": "sphere", "Center": (0.0, (inner - pin) * unit), "Radius": pin * unit},
            "Contact joint": contact("ring", 0, "pin", mu, Kinematics="finite sliding"),
            "Load pull": {"Body": "ring", "Kind": "point force", "Point": tuple(point), "Value": " ; ".join(force)},
            "Output": {"VTU": 0, "Probes": "end: " + ", ".join(map(repr, point))}, "Time": {"End": 1, "Increments": 1}, **more}, point


def balance(laws, what, run, centre, pin, point, force, mu, bound=3e-6):
    """Of moments about where the load has come to, for the nodes that press lie on the pin; and Coulomb's law."""
    rows = [row for row in run.last() if row["r_n"] > 0]
    end = plus((*point, 0.0), run.probe("end"))
    size, moment, total = math.hypot(*force), 0.0, (0.0, 0.0, 0.0)
    for row in rows:
        r = in_space(row, 2, REACTION)
        foot = plus((*centre, 0.0), scaled(pin, (row["n_x"], row["n_y"], 0.0)))
        total = plus(total, r)
        moment += cross(plus(foot, scaled(-1, end)), r)[2]
    laws.check(f"{what}: forces", math.hypot(*plus(total, (*force, 0.0))) / size, 1e-9)
    laws.check("  moment about the load", abs(moment) / (size * pin), bound)
    laws.check("  Coulomb's law", max(0, *(abs(row["r_t1"]) - mu * row["r_n"] for row in rows)) / size, 1e-9)
    return end


def at_rest(laws):
    for seed in range(12):
        chance = random.Random(seed)
        inner, outer = 1.0, chance.uniform(1.2, 2)
        pin, mu = chance.uniform(.6, .98), chance.choice((.05, .1, .3, .5))
        cells, element = chance.choice((16, 24, 32)), chance.choice(("Q1", "Q2", "Q1 incompatible modes"))
        degrees = chance.choice((0, 0, chance.uniform(0, 360)))
        scene, point = hung(inner, outer, pin, ("0", "-t"), mu, cells, degrees, element)
        run = laws.run(scene, bounds=False)
        balance(laws, f"hanging ring {seed}, {element}, {cells} cells", run, (0, inner - pin), pin, point, (0, -1), mu)


def pulled_aside(laws):
    """What was symmetric turns aside with its load, far enough to roll over several facets."""
    for mu, aside, element in ((.1, .3, "Q1"), (.3, .3, "Q1"), (.1, .1, "Q2"), (.3, .6, "Q2"), (.5, .2, "Q1 incompatible modes")):
        scene, point = hung(1, 1.5, .9, (f"{aside}*max(t-1,0)", "-min(t,1)"), mu, 32, 0, element, Time={"Stages": "1 : 1, 2 : 10"})
        run = laws.run(scene, bounds=False)
        # forces of middle nodes act between nodes, within the chord of a facet
        end = balance(laws, f"pulled aside by {aside}, mu = {mu}, {element}", run, (0, .1), .9, point, (aside, -1), mu,
                      3e-6 if "Q1" in element else (math.pi / 32)**2 / 2)
        # the force points from the pin to where it acts, but for the circle of friction
        reach = .9 * math.sin(math.atan(mu)) + 2 * math.pi / 32
        off = abs(cross((*end[:2], 0.0), (aside, -1, 0))[2] - cross((0, .1, 0), (aside, -1, 0))[2]) / math.hypot(aside, 1)
        laws.check("  it pulls at the middle of the pin, within friction", off, reach)


def units_and_directions(laws):
    base, point = hung(1, 1.5, .9, ("0", "-t"), .1, 32, 4, "Q2")
    first = laws.run(base, bounds=False).probe("end")
    for unit in (1e-3, 50.0):
        scene, point = hung(1, 1.5, .9, ("0", "-t"), .1, 32, 4, "Q2", unit)
        moved = laws.run(scene, bounds=False).probe("end")
        laws.check(f"lengths in units of {unit}", math.dist(scaled(1 / unit, moved), first) / math.hypot(*first), 1e-7)


def rings_on_bodies(laws):
    """The pin is a body that is held inside."""
    for seed in range(4):
        chance = random.Random(seed)
        scene, point = hung(1, 1.5, .9, ("0", "-t"), .2, 32, chance.choice((0, 3, 7)), chance.choice(("Q1", "Q2")))
        pin = ring(.5, .9, 32, chance.uniform(0, 20), YOUNG)
        pin["Mesh"]["Translation"] = (0, .1)
        scene = merge(scene, {"Obstacle pin": None, "Body pin": pin, "Support in": support(0, "x, y", body="pin"),
                              "Contact joint": None})
        scene["Contact joint"] = joint("ring", 0, "pin", 1, Kinematics="finite sliding", **{"Friction coefficient": .2})
        run = laws.run(scene, bounds=False)
        row = run.increments[-1]
        end = plus((*point, 0.0), run.probe("end"))
        laws.check(f"ring on an elastic pin {seed}: force in the middle", math.hypot(row["support_in_f_x"], row["support_in_f_y"] - 1), 1e-8)
        # but for the way from facet to facet, between which a force is handed on
        laws.check("  moment of the support", abs(row["support_in_m_z"] + end[0] * -1.0), (math.pi / 32)**3)


def turned_weights(laws):
    """Rings that follow a load which turns, on pins that are slaves, with friction and without."""
    for inner, degrees, cells, element, young, mu in ((1.02, 10, 32, "Q1", 1e4, .2), (1.1, 30, 48, "Q1", 3e5, .2), (1.1, 10, 24, "Q2", 8e5, 0),
                                                      (1.3, 30, 32, "Q1", 2e7, 0), (2.0, 10, 24, "Q2", 7e7, .1)):
        value = f"sin({math.radians(degrees)!r}*max(t-1,0)) ; -min(t,1)*cos({math.radians(degrees)!r}*max(t-1,0))"
        scene, _ = hung(inner, 2 * inner, 1.0, value.split(" ; "), mu, cells, 2.0, element, Time={"Stages": "1 : 1, 2 : 3"})
        pin = ring(.5, 1.0, cells, 5.0, young)
        pin["Mesh"]["Translation"] = (0, inner - 1)
        scene["Body ring"]["Material"]["Young modulus"] = young
        scene = merge(scene, {"Obstacle pin": None, "Contact joint": None, "Body pin": pin, "Support in": support(0, "x, y", body="pin")})
        scene["Contact joint"] = joint("pin", 1, "ring", 0, Kinematics="finite sliding", **{"Friction coefficient": mu})
        row = laws.run(scene, bounds=False).increments[-1]
        force = math.sin(math.radians(degrees)), -math.cos(math.radians(degrees))
        laws.check(f"hole of {inner}, load turned by {degrees}, {element}: force in the middle",
                   math.hypot(row["support_in_f_x"] + force[0], row["support_in_f_y"] + force[1]), 1e-8)


def tubes(laws):
    """A short tube on a round bar; its load is in its middle."""
    for degrees, backend in ((0, "condensed"), (5.0, "condensed"), (5.0, "iterative")):
        scene = {"Dimension": 3,
                 "Body ring": {"Mesh": {"Generator": "cylinder_shell", "Arguments": "0.4 : 1 : 1.5 : 24 : 2", "Rotation": (0.0, 0.0, 1.0, degrees)},
                               "Material": {"Young modulus": YOUNG, "Poisson ratio": .3}},
                 "Obstacle pin": {"Shape": "cylinder", "Point": (0, .1, 0), "Axis": (0, 0, 1), "Radius": .9},
                 "Contact joint": contact("ring", 0, "pin", .2, Kinematics="finite sliding"),
                 "Load pull": {"Body": "ring", "Kind": "body force", "Value": "0 ; -t ; 0"},
                 "Solver": {"Backend": backend}, "Output": {"VTU": 0}, "Time": {"End": 1, "Increments": 1}}
        run = laws.run(scene, bounds=False)
        row = run.increments[-1]
        weight = -row["load_pull_f_y"]
        laws.check(f"tube on a bar, turned by {degrees}, {backend}: forces", abs(row["joint_f_y"] / weight - 1), 1e-9)
        laws.check("  moments about the axis", abs(row["joint_m_z"] + row["load_pull_m_z"]) / weight, 3e-6)
