# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Round bodies in round ones, without friction: no moment holds them, and none is asked for, whatever their facets."""
import math
import random

from support.scenes import joint, load, merge, ring, support
from support.vectors import cross, scaled

YOUNG = 2e5


def spins(laws):
    pins(laws)
    lugs(laws)
    pins_in_space(laws)
    what_turns(laws)


def disc(radius, refinements, element, degrees):
    return {"Mesh": {"Generator": "hyper_ball_balanced", "Arguments": f"0, 0 : {radius!r}", "Global refinements": refinements,
                     "Rotation": degrees},
            "Material": {"Young modulus": YOUNG, "Poisson ratio": .3}, "Element": element}


def pull(body, force):
    return load("body force", " ; ".join(f"{f!r}*t" for f in force), None, body)


def pin(chance, **more):
    """A disc in the hole of a ring that is held outside, pulled by its weight in any direction; sizes of any units."""
    radius, angle = 10**chance.uniform(-2, 2), chance.uniform(0, 2 * math.pi)
    clearance = chance.choice((0, 0, 1e-3, 1e-2)) * radius
    element = chance.choice(("Q1", "Q2", "Q1 incompatible modes"))
    force = [100 / radius * f for f in (math.cos(angle), math.sin(angle))]
    eye = ring(radius, 2 * radius, chance.choice((12, 17, 20, 28)), chance.uniform(0, 90), young=YOUNG)
    eye["Mesh"]["Global refinements"] = 1
    return {"Dimension": 2, "Body pin": disc(radius - clearance, chance.choice((1, 2, 3)), element, chance.uniform(0, 90)),
            "Body eye": {**eye, "Element": element}, "Contact joint": joint("pin", 0, "eye", 0, **more),
            "Support out": support(1, "x, y", body="eye"), "Load pull": pull("pin", force),
            "Output": {"VTU": 0}}, radius, force


def torque(run, radius):
    """Of the contact about the axis of the pin, over force times radius, from the forces at its nodes."""
    rows = [row for row in run.last() if row["contact"] == "joint" and row["r_n"] > 0]
    sums, size = 0.0, 0.0
    for row in rows:
        force = scaled(row["r_n"], (row["n_x"], row["n_y"], 0))
        sums += cross((row["x"], row["y"], 0), force)[2]
        size += math.hypot(*force) * radius
    return abs(sums) / size


def pins(laws):
    for seed in range(16):
        chance = random.Random(seed)
        pairing = chance.choice(("mortar", "node to face"))
        scene, radius, force = pin(chance, Pairing=pairing)
        run = laws.run(scene, bounds=False)
        row = run.increments[-1]
        loads = [row[f"load_pull_f_{c}"] for c in "xy"]
        laws.check(f"pin {seed}, {pairing}, {scene['Body pin']['Element']}: force on it", math.dist([row[f"joint_f_{c}"] for c in "xy"], scaled(-1, loads)) / math.hypot(*loads), 1e-10)
        laws.check("  it is not turned", torque(run, radius), 1e-10)


def lugs(laws):
    """A ring that hangs on a pin which is held: the side that may turn is the master, too."""
    ids = {"pin": 1, "eye": 0}
    for element, slave, master in (("Q1", "eye", "pin"), ("Q2", "eye", "pin"), ("Q1", "pin", "eye"), ("Q2", "pin", "eye")):
        scene = {"Dimension": 2, "Body pin": {**ring(.5, .99, 37, 10.0, YOUNG), "Element": element},
                 "Body eye": {**ring(1.0, 2.0, 40, 7.0, YOUNG), "Element": element},
                 "Contact joint": joint(slave, ids[slave], master, ids[master]), "Support pin": support(0, "x, y", body="pin"),
                 "Load pull": pull("eye", (37.0, -80.0)), "Output": {"VTU": 0}}
        row = laws.run(scene, bounds=False).increments[-1]
        loads = [row[f"load_pull_f_{c}"] for c in "xy"]
        laws.check(f"lug on a pin, {element}, slave {slave}: the support of the pin",
                   math.dist([row[f"support_pin_f_{c}"] for c in "xy"], scaled(-1, loads)[:2]) / math.hypot(*loads), 1e-10)


def pins_in_space(laws):
    """It neither turns nor drifts along its axis, in the plane of x and z."""
    for degrees, element, backend in ((0.0, "Q1", "condensed"), (33.0, "Q1", "iterative"), (33.0, "Q2", "condensed")):
        material = {"Material": {"Young modulus": YOUNG, "Poisson ratio": .3}, "Element": element}
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        # the cylinder lies along x, the shell stands along z from 0 on
        along, half = (c, 0.0, -s), .5
        from_axis = f"(x - ({c!r})*(({c!r})*x - ({s!r})*z))^2 + y^2 + (z + ({s!r})*(({c!r})*x - ({s!r})*z))^2"
        scene = {"Dimension": 3, "Body pin": {"Mesh": {"Generator": "cylinder", "Arguments": f"0.99 : {half!r}", "Global refinements": 1,
                                                       "Rotation": (0.0, 1.0, 0.0, degrees)}, **material},
                 "Body eye": {"Mesh": {"Generator": "cylinder_shell", "Arguments": "2 : 1 : 1.8 : 18 : 4", "Rotation": (0.0, 1.0, 0.0, 90.0 + degrees),
                                       "Translation": tuple(-x for x in along), "Boundary ids": f"4: {from_axis} < 1.2 ; 5: {from_axis} > 2.9"}, **material},
                 "Contact joint": joint("pin", 0, "eye", 4), "Support out": support(5, "x, y, z", body="eye"),
                 "Load pull": pull("pin", cross(along, (0.3, 1.0, 0.2))), "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
        row = laws.run(scene, bounds=False).increments[-1]
        loads = [row[f"load_pull_f_{c}"] for c in "xyz"]
        force = [row[f"joint_f_{c}"] for c in "xyz"]
        laws.check(f"pin in space, {element}, {backend}, turned by {degrees:g}: force on it", math.dist(force, scaled(-1, loads)) / math.hypot(*loads), 1e-9)


def what_turns(laws):
    """A moment that nothing takes is told, and what is not round holds as it did."""
    scene, _, _ = pin(random.Random(1))
    moved = merge(scene, {"Load turn": load("moment", "1e-3*t", 0, "pin")})
    done, _ = laws.start(moved)
    laws.demand(f"a moment on a smooth pin: {done.stderr.strip()}", done.returncode == 2 and "turning" in done.stderr)
