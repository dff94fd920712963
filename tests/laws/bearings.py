# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Roller bearings: rings and rollers that nothing but contact holds. What is solved is right by statics, and does not take long."""
import math
import re

from support.scenes import joint, load, support

LOAD, CENTRES, ROLLER, MOST = 2000.0, 25.0, 5.0, 900


def body(generator, arguments, refinements, **mesh):
    return {"Mesh": {"Generator": generator, "Arguments": arguments, "Global refinements": refinements, **mesh},
            "Material": {"Young modulus": 210e3, "Poisson ratio": .3}}


def bearing(n, mu, gap, rigid=True):
    """An outer ring that is held at its rim, n rollers, and an inner ring that a force presses down at its bore."""
    scene = {"Dimension": 2, "Body inner": body("hyper_shell", "0, 0 : 12 : 20 : 48 : true", 1),
             "Body outer": body("hyper_shell", "0, 0 : 30 : 38 : 48 : true", 1)}
    for k in range(n):
        angle = -math.pi / 2 + 2 * math.pi * (k + (n % 2 == 0) / 2) / n  # one at the bottom, or two beside it
        scene[f"Body r{k}"] = body("hyper_ball_balanced", f"0, 0 : {ROLLER}", 3, Rotation=math.degrees(angle),
                                   Translation=(CENTRES * math.cos(angle), CENTRES * math.sin(angle)))
        scene[f"Contact i{k}"] = joint(f"r{k}", 0, "inner", 1, **{"Friction coefficient": mu, "Gap": gap})
        scene[f"Contact o{k}"] = joint(f"r{k}", 0, "outer", 0, **{"Friction coefficient": mu, "Gap": gap})
    scene["Support house"] = support(1, "x, y", body="outer")
    scene["Load press"] = load("force", f"0 ; -{LOAD}*t", 0, "inner", **({"Coupling": "rigid", "Point": (0, 0)} if rigid else {}))
    return {**scene, "Time": {"Times": "0.5, 1"}, "Output": {"VTU": 0}}


def counted(run, what):
    return int(re.search(rf"(\d+) {what}", (run.folder / "log.txt").read_text())[1])


def statics(laws, n, run):
    """Each roller is in balance, the rings carry the load."""
    for row in run.increments:
        forces = {c: (row[f"{c}_f_x"], row[f"{c}_f_y"]) for k in range(n) for c in (f"i{k}", f"o{k}")}
        left = max(math.dist(forces[f"i{k}"], [-x for x in forces[f"o{k}"]]) for k in range(n))
        laws.check(f"  t = {row['time']}: what acts on rollers over the load", left / LOAD, 1e-9)
        for ring, sign in (("i", 1), ("o", -1)):
            total = [sum(forces[f"{ring}{k}"][c] for k in range(n)) for c in (0, 1)]
            laws.check(f"  what contacts '{ring}' carry", math.dist(total, (0, -sign * LOAD * row["time"])) / LOAD, 1e-9)


def bearings(laws):
    for n, mu, gap, rigid in ((5, .1, "adjust", True), (8, .01, "adjust", True), (8, .1, "adjust", True), (8, .1, "adjust", False),
                              (8, .5, "adjust", True), (12, .1, "adjust", True)):
        run = laws.run(bearing(n, mu, gap, rigid))
        solves, factors = (counted(run, what) for what in ("linear solves of contact", "dense factorisations"))
        laws.check(f"{n} rollers, mu {mu}, gap {gap}{', rigid bore' if rigid else ''}: {factors} factorisations, solves", solves, MOST)
        laws.check("  factorisations", factors, 3.5 * MOST)
        statics(laws, n, run)
        rolls = [row for row in run.rows if re.fullmatch(r"[io]\d+", row["contact"])]
        laws.check("  pull", max(-row["r_n"] for row in rolls), 0)
        laws.check("  outside the cone", max(abs(row["r_t1"]) - mu * row["r_n"] for row in rolls) / LOAD, 1e-10)
