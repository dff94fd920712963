# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What facets of round bodies must not do. Bars on two plane flanks, without friction: each flank presses along its normal, by
as much as statics says, wherever the nodes of the bar are. Shafts: friction carries its torque, and facets no more."""
import itertools
import math
import random

from support.scenes import box, joint, merge, ring, support
from support.vectors import scaled

YOUNG, RADIUS, MU = 2e5, 10.0, .15


def vees(laws):
    for seed in range(16):
        chance = random.Random(seed)
        bar_in_vee(laws, seed, chance)
    beyond_friction(laws)
    locked_facets(laws)


def flank(angle, side, element):
    """A plate whose upper side the bar touches in its middle, inclined by an angle that rises outward on its side."""
    slope = side * angle
    outward = (-side * math.sin(math.radians(angle)), math.cos(math.radians(angle)))
    plate = box((12, 4), (12.0, 4.0), (-6.0, -4.0), YOUNG, Rotation=slope, Translation=scaled(-RADIUS, outward))
    return {**plate, "Element": element}, outward


def pressed(left, right, load):
    """Forces a and b along two normals that carry a load."""
    det = left[0] * right[1] - left[1] * right[0]
    return (-(load[0] * right[1] - load[1] * right[0]) / det, -(left[0] * load[1] - left[1] * load[0]) / det)


def disc(chance, element):
    return {"Mesh": {"Generator": "hyper_ball_balanced", "Arguments": f"0, 0 : {RADIUS!r}", "Global refinements": chance.choice((1, 2)),
                     "Rotation": chance.uniform(0, 90)},
            "Material": {"Young modulus": YOUNG, "Poisson ratio": .3}, "Element": element}


def bar_in_vee(laws, seed, chance):
    element = chance.choice(("Q1", "Q2", "Q1 incompatible modes"))
    angles = chance.uniform(25, 60), chance.uniform(25, 60)
    left, n_left = flank(angles[0], -1, element)
    right, n_right = flank(angles[1], 1, element)
    load = (chance.uniform(-300, 300), -1000.0)
    entries = {"Pairing": chance.choice(("mortar", "node to face")), "Friction coefficient": 0,
               **chance.choice(({}, {"Gap": "adjust"}, {"Kinematics": "finite sliding"}))}
    bar_is_slave = chance.random() < .7 or "Kinematics" in entries  # nodes of planes slide over the corners of facets
    scene = {"Dimension": 2, "Body left": left, "Body right": right, "Body bar": disc(chance, element),
             "Load pull": {"Body": "bar", "Kind": "body force", "Value": f"{load[0] / (math.pi * RADIUS**2)!r}*t ; {load[1] / (math.pi * RADIUS**2)!r}*t"},
             "Output": {"VTU": 0}, "Time": {"End": 1, "Increments": 1}}
    for name in ("left", "right"):
        sides = ("bar", 0, name, 3) if bar_is_slave else (name, 3, "bar", 0)
        scene[f"Contact on {name}"] = joint(*sides, **entries)
        scene[f"Support {name}"] = support(2, "x, y", body=name)
    row = laws.run(scene, bounds=False).increments[-1]
    whole = [row[f"load_pull_f_{c}"] for c in "xy"]
    exact = pressed(n_left, n_right, whole)
    found = [[row[f"support_{name}_f_{c}"] for c in "xy"] for name in ("left", "right")]
    what = f"bar in a vee {seed}, {element}, {entries}, {'bar' if bar_is_slave else 'flanks'} first"
    laws.check(f"{what}: forces of the flanks",
               max(math.dist(f, scaled(size, n)) for f, size, n in zip(found, exact, (n_left, n_right))) / math.hypot(*whole), 1e-6)


def beyond_friction(laws):
    """A ring shrunk on a shaft carries mu N R, whichever side is the slave; beyond that no facet holds it."""
    for ring_is_slave, share in itertools.product((True, False), (.9, 1.3)):
        hub = {**ring(RADIUS, 2 * RADIUS, 36, 0, YOUNG), "Element": "Q1"}
        shaft = merge(ring(.5 * RADIUS, RADIUS, 36, 0, YOUNG), {"Mesh": {"Rotation": 3.0}})
        hub["Mesh"]["Global refinements"] = shaft["Mesh"]["Global refinements"] = 1
        sides = ("hub", 0, "shaft", 1) if ring_is_slave else ("shaft", 1, "hub", 0)
        scene = {"Dimension": 2, "Body hub": hub, "Body shaft": shaft,
                 "Contact fit": joint(*sides, Gap=-.005, **{"Friction coefficient": MU}),
                 "Support out": support(1, "x, y", body="hub"), "Output": {"VTU": 0}, "Time": {"Times": "1, 2"}}
        pressed = [row for row in laws.run(merge(scene, {"Time": {"Times": 1}}), bounds=False).last() if row["contact"] == "fit"]
        limit = MU * RADIUS * sum(row["r_n"] for row in pressed)
        scene["Load twist"] = {"Body": "shaft", "Kind": "moment", "Boundary ids": 0, "Value": f"{share * limit!r}*max(t-1,0)"}
        done, folder = laws.start(scene)
        what = f"{'ring' if ring_is_slave else 'shaft'} first, {share} of the torque that friction carries"
        laws.demand(f"{what}: {done.stderr.strip()[-120:]}", (done.returncode == 0) == (share < 1))


def locked_facets(laws):
    """Facets of unlike sides lock into each other: what they carry of a torque is told where friction alone could not."""
    shaft = ring(.5 * RADIUS, RADIUS, 43, 0, YOUNG)
    scene = {"Dimension": 2, "Body hub": ring(RADIUS, 2 * RADIUS, 36, 0, YOUNG), "Body shaft": merge(shaft, {"Mesh": {"Rotation": 3.0}}),
             "Contact fit": joint("shaft", 1, "hub", 0, Gap=-.005, Pairing="node to face", **{"Friction coefficient": MU}),
             "Support out": support(1, "x, y", body="hub"), "Output": {"VTU": 0}, "Time": {"Times": "1, 2"}}
    told = "facets of both lock into each other"
    pressed = [row for row in laws.run(merge(scene, {"Time": {"Times": 1}}), bounds=False).last() if row["contact"] == "fit"]
    limit = MU * RADIUS * sum(row["r_n"] for row in pressed)
    for share in (.3, 1.1, 1.3):
        done, folder = laws.start(merge(scene, {"Load twist": {"Body": "shaft", "Kind": "moment", "Boundary ids": 0,
                                                                    "Value": f"{share * limit!r}*max(t-1,0)"}}))
        says = told in (folder / "log.txt").read_text()
        laws.demand(f"{share} of the torque of friction, exit code {done.returncode}, {'told' if says else 'not told'}",
                    done.returncode == 0 and not says if share < 1 else done.returncode == 2 or says)
