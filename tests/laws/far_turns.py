# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that turn as far as they like, driven by supports or rolled by contacts."""
import math

from support.scenes import box, contact, joint, load, merge, support
from support.tables import MOTION, in_space
from support.vectors import apply, plus, rotation, scaled

FAR = {"Kinematics": "finite sliding"}


def far_turns(laws):
    unloaded(laws)
    loaded(laws)
    totals(laws)
    shaft(laws)
    rolled_disc(laws)
    rolled_ball(laws)
    braked(laws)


def bar(dim, degrees, axis=(0, 0, 1), steps=1, **mesh):
    """A bar held at its left end, which turns, and a far floor that tells where its other end is."""
    cells, size = ((8, 2), (4.0, 1.0)) if dim == 2 else ((5, 2, 2), (3.0, 1.0, .8))
    far = {"Shape": "half space", "Normal": (0, 1) if dim == 2 else (0, 0, 1), "Point": (0, -50.0) if dim == 2 else (0, 0, -50.0)}
    return {"Dimension": dim, "Body bar": box(cells, size, **mesh), "Obstacle floor": far,
            "Contact end": contact("bar", 1, **FAR),
            "Support hub": {"Body": "bar", "Boundary ids": 0, "Turn": f"{degrees!r}*min(t, 1)", "Turn axis": tuple(map(float, axis)),
                            "Reference point": (.3, .2, .1)[:dim]},
            "Time": {"Stages": f"1 : {steps}, 2 : 1"}, "Output": {"VTU": 0}}


def unloaded(laws):
    for dim, axis, degrees, steps in ((2, (0, 0, 1), 90.0, 1), (2, (0, 0, 1), 360.0, 5), (3, (1, 2, 3), 90.0, 1), (3, (1, 0, 1), 150.0, 2)):
        run = laws.run(bar(dim, degrees, axis, steps))
        what = f"{dim}D, turned by {degrees:g} degrees in {steps}"
        laws.check(f"{what}: strain energy", run.increments[-1]["strain_energy"] / 1e3, 1e-24)
        m, centre = rotation(axis, degrees), (.3, .2, .1)[:dim] + (0.0,) * (3 - dim)
        errors = []
        for row in run.last():
            arm = plus((row["x"], row["y"], row["z"]), scaled(-1, centre))
            errors.append(math.dist(plus(apply(m, arm), scaled(-1, arm)), in_space(row, dim, MOTION)))
        laws.check(f"  where its end is ({len(errors)} nodes)", max(errors), 1e-12)


def loaded(laws):
    """A bar that is turned and one that stands there from the start; loads keep their directions, pressures turn along."""
    for dim, axis, degrees in ((2, (0, 0, 1), 70.0), (3, (1, 2, 3), 110.0)):
        def later(*v, n=dim):
            return " ; ".join(f"{c}*max(t - 1, 0)" for c in v[:n])
        m = rotation(axis, degrees)
        dead = {"Load end": load("traction", later(.3, -.2, .1), 1, "bar"),
                "Load weight": load("body force", later(.05, -.1, .02), None, "bar")}
        follows = {"Load end": load("pressure", "0.5*max(t - 1, 0)", 3, "bar"),
                   "Load heat": load("temperature", "20*max(t - 1, 0)", None, "bar")}
        hot = {"Body bar": {"Material": {"Expansion coefficient": 1e-4}}}
        centre = (.3, .2, .1)[:dim] + (0.0,) * (3 - dim)
        moved = plus(centre, scaled(-1, apply(m, centre)))
        for name, loads, change in (("dead loads", dead, {}), ("pressure and heat", follows, hot)):
            change = {**change, "Obstacle floor": None, "Contact end": None}
            turned = laws.run(merge({**bar(dim, degrees, axis, 3), **loads}, change))
            there = merge({**bar(dim, 0.0), **loads}, change)
            if loads is dead:
                there["Body bar"]["Mesh"].update(Rotation=degrees if dim == 2 else (*map(float, axis), degrees),
                                                 Translation=moved[:dim])
            still = laws.run(there)
            a, b = turned.increments[-1], still.increments[-1]
            laws.check(f"{dim}D, {name}: strain energy", abs(a["strain_energy"] / b["strain_energy"] - 1), 1e-10)
            force = [b[f"support_hub_f_{c}"] for c in "xyz"]
            if loads is follows:
                force = apply(m, force)
            size = max(math.hypot(*force), 1e-3)
            laws.check(f"{dim}D, {name}: force of the support",
                       math.dist([a[f"support_hub_f_{c}"] for c in "xyz"], force) / size, 1e-10)
            laws.check(f"{dim}D, {name}: balance", max(row["balance"] for row in turned.increments), 1e-10)


def totals(laws):
    """Forces and moments of given size keep size and direction in space; a force turns with the point that it acts at."""
    for dim, axis, degrees in ((2, (0, 0, 1), 70.0), (3, (1, 2, 3), 110.0)):
        m, centre = rotation(axis, degrees), (.3, .2, .1)[:dim] + (0.0,) * (3 - dim)
        point, force = (5.0, 2.0, -1.0)[:dim], (.3, -.2, .1)[:dim]
        moment = (.7,) if dim == 2 else (.7, -.4, .2)
        def text(values):
            return " ; ".join(map(repr, values))
        scene = merge(bar(dim, degrees, axis), {
            "Load pull": load("force", text(force), 1, "bar", Point=point),
            "Load twist": load("moment", text(moment), 1, "bar")})
        last = laws.run(scene).increments[-1]
        force, arm = force + (0.0,) * (3 - dim), plus(point + (0.0,) * (3 - dim), scaled(-1, centre))
        at = plus(centre, apply(m, arm))
        whole = {"pull": [at[1] * force[2] - at[2] * force[1], at[2] * force[0] - at[0] * force[2], at[0] * force[1] - at[1] * force[0]],
                 "twist": [0.0, 0.0, .7] if dim == 2 else moment}
        for name, expected in whole.items():
            error = max(abs(last[f"load_{name}_m_{c}"] - value) for c, value in zip("xyz", expected))
            laws.check(f"{dim}D, turned by {degrees:g} degrees: moment of '{name}'", error, 1e-12)
        laws.check("  what the support carries", max(abs(last[f"supports_m_{c}"] + last[f"loads_m_{c}"]) for c in "xyz"), 1e-10)


def shell(inner, outer, cells, poisson=.3):
    return {"Mesh": {"Generator": "hyper_shell", "Arguments": f"0, 0 : {inner!r} : {outer!r} : {cells} : true"},
            "Material": {"Young modulus": 1000.0, "Poisson ratio": poisson}}


def shaft(laws):
    """A shaft with an overlap in its hub, without friction, turned from facet to facet."""
    scene = {"Dimension": 2, "Body shaft": shell(.5, 1.001, 64), "Body hub": shell(1.0, 2.0, 64),
             "Contact fit": joint("shaft", 1, "hub", 0, **FAR),
             "Support drive": {"Body": "shaft", "Boundary ids": 0, "Turn": "max(t - 1, 0)"},
             "Support frame": support(1, "x, y", body="hub"),
             "Time": {"Stages": "1 : 1, 91 : 90"}, "Output": {"VTU": 0}}
    run = laws.run(scene, bounds=False)  # resultants vanish: their balance is compared with nothing
    laws.check("shaft: residual, equilibrium", max(max(row["residual"], row["equilibrium"]) for row in run.increments), 1e-10)
    pressures = {}
    for row in run.rows:
        if row["contact"] == "fit":
            pressures.setdefault(row["increment"], []).append(row["pressure"])
    means = [sum(p) / len(p) for p in pressures.values()]
    laws.check("shaft: its torque over pressure times radius times circumference",
               max(abs(row[f"support_{s}_m_z"]) for row in run.increments for s in ("drive", "frame")) / (2 * math.pi * means[0]), 1e-3)
    laws.check("shaft: pressure is the same all around", max(max(p) / min(p) - 1 for p in pressures.values()), 1e-6)
    laws.check("shaft: pressure stays", max(means) / min(means) - 1, 1e-3)


def rolled(increments, way, cells=4):
    """A disc between two rough plates, of which the upper one moves."""
    def plate(normal, point, **entries):
        return {"Shape": "half space", "Normal": normal, "Point": point, **entries}
    return {"Dimension": 2,
            "Body disc": {"Mesh": {"Generator": "hyper_ball_balanced", "Arguments": "0, 1 : 1", "Global refinements": cells},
                          "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}},
            "Obstacle low": plate((0, 1), (0, 0)),
            "Obstacle high": plate((0, -1), (0, 2), Displacement=f"{way!r}*max(t - 1, 0) ; -0.02*min(t, 1)"),
            "Contact low": contact("disc", 0, "low", .5, **FAR), "Contact high": contact("disc", 0, "high", .5, **FAR),
            "Time": {"Stages": f"1 : 2, 2 : {increments}"}, "Output": {"VTU": 0}}


def rolled_disc(laws):
    way = 2.0
    run = laws.run(rolled(40, way=way))
    rolling = [row for row in run.increments if row["time"] > 1]
    normal = [row["low_f_y"] for row in rolling]
    laws.check("rolled disc: normal force from facet to facet", max(normal) / min(normal) - 1, .02)
    laws.check("rolled disc: what is lost, over sliding all the way",
               sum(row["dissipation"] for row in rolling) / (.5 * max(normal) * way), 1e-3)
    turned = []  # rim nodes about the middle of the disc
    last = [row for row in run.last() if row["contact"] == "low"]
    places = [plus((row["x"], row["y"], 0), in_space(row, 2, MOTION)) for row in last]
    middle = [sum(p[c] for p in places) / len(places) for c in range(2)]
    for row, p in zip(last, places):
        angle = math.atan2(row["y"] - 1, row["x"]) - math.atan2(p[1] - middle[1], p[0] - middle[0])
        turned.append(angle % (2 * math.pi))
    mean = sum(turned) / len(turned)
    laws.check("rolled disc: its middle goes half the way", abs(middle[0] / (way / 2) - 1), .01)
    laws.check("rolled disc: its angle is that over its radius", abs(mean / (way / 2 / .99) - 1), .01)


def rolled_ball(laws):
    """In space, and the same with everything turned."""
    def scene(axis=(0, 0, 1), degrees=0.0):
        m = rotation(axis, degrees)

        def plate(normal, point, **entries):
            return {"Shape": "half space", "Normal": apply(m, normal), "Point": apply(m, point), **entries}
        moves = "0.8*max(t - 1, 0)", "0.3*max(t - 1, 0)", "-0.12*min(t, 1)"  # several nodes touch: none spins freely
        drive = " ; ".join(" + ".join(f"({m[d][e]!r})*({move})" for e, move in enumerate(moves)) for d in range(3))
        return {"Dimension": 3,
                "Body ball": {"Mesh": {"Generator": "hyper_ball_balanced", "Arguments": "0, 0, 1 : 1", "Global refinements": 2,
                                       "Rotation": (*map(float, axis), degrees)},
                              "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}},
                "Obstacle low": plate((0, 0, 1), (0, 0, 0)), "Obstacle high": plate((0, 0, -1), (0, 0, 2), Displacement=drive),
                "Contact low": contact("ball", 0, "low", .5, **FAR), "Contact high": contact("ball", 0, "high", .5, **FAR),
                "Time": {"Stages": "1 : 1, 2 : 6"}, "Output": {"VTU": 0}}
    run = laws.run(scene())
    axis, degrees = (1, 2, 3), 40.0
    laws.same("rolled ball, turned", run, laws.run(scene(axis, degrees)), 1e-9, matrix=rotation(axis, degrees))
    last = run.increments[-1]
    laws.check("rolled ball: both plates press alike", abs(last["low_f_z"] / last["high_f_z"] + 1), 1e-9)


def braked(laws):
    """A disc that a rough plane brakes: far turns are done in parts, or friction would see chords."""
    for degrees, increments in ((270.0, 1), (360.0, 1), (120.0, 8)):
        scene = {"Dimension": 2, "Body disc": shell(.5, 1.0, 96), "Obstacle floor": {"Shape": "half space", "Normal": (0, 1), "Point": (0, -.995)},
                 "Contact brake": contact("disc", 1, "floor", .4, **FAR),
                 "Support drive": {"Body": "disc", "Boundary ids": 0, "Turn": f"{degrees!r}*max(t - 1, 0)"},
                 "Time": {"Stages": f"1 : 1, 2 : {increments}"}, "Output": {"VTU": 0}}
        last = laws.run(scene).increments[-1]
        laws.check(f"braked disc, {degrees:g} degrees in {increments}: friction over mu times the normal force",
                   abs(last["brake_f_x"] / (.4 * last["brake_f_y"]) + 1), .02)
