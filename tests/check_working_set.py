#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact nodes that are left out of the condensation leave no trace in the results.

usage: check_working_set.py PROGRAM [FAMILY...]      (default: every family)

Each scene runs with Solver/Working set = automatic and = all; reactions, gaps,
slips and displacements agree to 1e-10. Counts of the log say that nodes were left out,
and how those that were missing came in.
"""
import random
import re
import sys

from support.checks import run_families
from support.logs import log_of, work_of
from support.scenes import box, contact, load, merge, support


def both(laws, what, scene, bound=1e-10):
    """Runs a scene both ways; returns the counts of the log."""
    whole = laws.run(scene, "-s", "Solver/Working set=all")
    part = laws.run(scene)
    laws.same(what, whole, part, bound)
    found = re.search(r"skipped: condensation of (\d+) of (\d+) contact nodes, working set of (\d+) at the start and "
                      r"(\d+) at the end, (\d+) times larger", log_of(part))
    if not found:
        return None
    left_out, candidates, start, end, larger = map(int, found.groups())
    return {"candidates": candidates, "start": start, "end": end, "larger": larger, **work_of(part)}


def touching(run):
    return len({row["node"] for row in run.rows if row["state"] != "open"})


def sheet(dim, cells, gap, loads=None, mu=.3, increments=3, held="top"):
    """A sheet over an obstacle with a gap of its own, pressed down and sheared by its far side."""
    size = (24.0, 4.0) if dim == 2 else (8.0, 8.0, 2.0)
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    down, side = "-0.1*min(t, 1)", "0.02*max(t - 1, 0)"
    scene = {"Dimension": dim, "Body block": box(cells, size),
             "Obstacle floor": {"Shape": "prescribed gap", "Normal": (0, 1) if dim == 2 else (0, 0, 1), "Gap": gap},
             "Contact bottom": contact(ids=bottom, mu=mu),
             "Time": {"End": increments, "Increments": increments}, "Output": {"VTU": 0}}
    if loads:
        return {**scene, **loads}
    return {**scene, "Support top": support(top, "x, y" if dim == 2 else "x, y, z",
                                            f"{side} ; {down}" if dim == 2 else f"{side} ; 0 ; {down}")}


def hertz(laws):
    """A parabola pressed in: the guess holds all that touches, one factorisation."""
    for dim, cells, gap in ((2, (240, 8), "0.005*(x - 12)^2"), (3, (20, 20, 4), "0.02*((x - 4)^2 + (y - 4)^2)")):
        for mu in (.3, 0.0):
            counts = both(laws, f"{dim}D, mu = {mu:g}", sheet(dim, cells, gap, mu=mu))
            laws.demand(f"{dim}D: {counts}", counts and counts["start"] < .5 * counts["candidates"]
                        and counts["factorisations of the elastic system"] == 1 and counts["larger"] == 0)


def travelling(laws):
    """The far side rolls: contact runs along the sheet to where no motion of the whole leads."""
    scene = sheet(2, (160, 8), "0.001*(x - 12)^2", increments=12)
    scene["Support top"]["Displacement"] = "0 ; -0.02*min(t, 1) - 0.001*t*(x - 12)"
    counts = both(laws, "rolling in 2D", scene)
    laws.demand(f"nodes join: {counts}", counts and counts["larger"] > 0 and counts["end"] > counts["start"]
                and counts["end"] < .7 * counts["candidates"])
    scene = sheet(3, (28, 12, 3), "0.01*(x - 4)^2", increments=8)
    scene["Support top"]["Displacement"] = "0 ; 0 ; -0.01*min(t, 1) - 0.005*t*(x - 4)"
    counts = both(laws, "rolling in 3D", scene)
    laws.demand(f"nodes join: {counts}", counts and counts["larger"] > 0)


def poor_guess(laws):
    """A cantilever bends down at its free end, far from where the gap is smallest."""
    scene = sheet(2, (160, 6), "0.3 + 0.001*x", {
        "Support left": support(0, "x, y"),
        "Load top": load("traction", "0 ; -0.05*t", 3)}, increments=4)
    counts = both(laws, "cantilever in 2D", scene)
    laws.demand(f"nodes join: {counts}", counts and counts["larger"] > 0)
    scene = sheet(3, (30, 8, 3), "0.3 + 0.02*x", {
        "Support left": support(0, "x, y, z"),
        "Load top": load("traction", "0 ; 0 ; -0.3*t", 5)}, increments=4)
    counts = both(laws, "cantilever in 3D", scene)
    laws.demand(f"nodes join: {counts}", counts and counts["larger"] > 0)


def floating(laws):
    """Held by contact alone: the guess holds the body, and no refusal is a false one."""
    for dim, cells, gap in ((2, (160, 8), "0.2*(1 + cos(x))"), (3, (20, 20, 4), "0.2*(2 + cos(2*x) + cos(2*y))")):
        down = "0 ; -0.2" if dim == 2 else "0 ; 0 ; -0.2"
        push = "0.01*t ; 0" if dim == 2 else "0.01*t ; 0.005*t ; 0"
        scene = sheet(dim, cells, gap, {"Load weight": load("body force", down), "Load push": load("body force", push)})
        counts = both(laws, f"{dim}D on a few feet", scene)
        laws.demand(f"{dim}D: {counts}", counts)
    slides = merge(scene, {"Load push": {"Value": "0.2 ; 0 ; 0"}})
    ends = [laws.start(slides, "-s", f"Solver/Working set={word}")[0] for word in ("automatic", "all")]
    laws.demand(f"refused alike: {ends[0].stderr.strip()}",
                ends[0].returncode == 2 and ends[0].stderr == ends[1].stderr)


def bodies(laws):
    """Contact between bodies and with an obstacle, a moving obstacle."""
    for dim in (2, 3):
        cells, size = ((120, 8), (24.0, 4.0)) if dim == 2 else ((16, 16, 3), (8.0, 8.0, 2.0))
        gap = "0.005*(x - 12)^2" if dim == 2 else "0.02*((x - 4)^2 + (y - 4)^2)"
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        scene = sheet(dim, cells, gap)
        below = tuple(-s if d == dim - 1 else 0.0 for d, s in enumerate(size))
        scene = merge(scene, {
            "Body lower": box(tuple(c - 2 for c in cells), size, below),
            "Contact joint": {"Body": "block", "Boundary ids": bottom, "Master body": "lower",
                              "Master boundary ids": top, "Gap": gap, "Friction coefficient": .4,
                              "Pairing": "node to face"},
            "Contact bottom": {"Body": "lower", "Boundary ids": bottom},
            "Support lower": None})
        counts = both(laws, f"{dim}D, two bodies", scene)
        laws.demand(f"{dim}D: {counts}", counts)
    scene = sheet(2, (160, 8), "0.005*(x - 12)^2")
    scene["Support top"]["Displacement"] = "0 ; 0"
    scene["Obstacle floor"]["Displacement"] = "0.02*max(t - 1, 0) ; 0.1*min(t, 1)"
    counts = both(laws, "moving obstacle", scene)
    laws.demand(f"moving obstacle: {counts}", counts and counts["larger"] == 0)
    scene = sheet(2, (240, 8), "0.005*(x - 12)^2")
    scene |= {"Body other": box((240, 8), (24.0, 4.0), (30.0, 0.0)),
              "Obstacle other": {**scene["Obstacle floor"], "Gap": "0.005*(x - 42)^2"},
              "Contact other": {**scene["Contact bottom"], "Body": "other", "Obstacle": "other"},
              "Support other": {**scene["Support top"], "Body": "other"}}
    counts = both(laws, "equal bodies", scene)
    laws.demand(f"equal bodies: {counts}", counts and counts["factorisations of the elastic system"] == 1)


def anywhere(laws):
    """Random gaps, loads and motions."""
    rng = random.Random(20)
    left_out = 0
    for number in range(24):
        dim = rng.choice((2, 2, 3))
        terms = [f"{rng.uniform(.1, .8):.3f}*(1 + cos({rng.uniform(.1, .9):.3f}*x + {rng.uniform(0, 6):.3f}))"
                 for _ in range(2)]
        if dim == 3:
            terms.append(f"{rng.uniform(.01, .15):.3f}*(1 + cos({rng.uniform(.3, .9):.3f}*y))")
        scene = sheet(dim, (210, 6) if dim == 2 else (16, 14, 3), " + ".join(terms), mu=rng.choice((0.0, .2, .8)),
                      increments=4)
        tilt, down = rng.uniform(-.01, .01), rng.uniform(.05, .3)
        parts = [f"{rng.uniform(-.02, .02):.4f}*t", f"-{down:.4f}*min(t, 2) + {tilt:.4f}*t*(x - 6)"]
        scene["Support top"]["Displacement"] = " ; ".join(parts if dim == 2 else (parts[0], "0", parts[1]))
        if rng.random() < .4:
            scene["Load side"] = load("pressure", f"{rng.uniform(-5, 5):.3f}*t", 0)
        left_out += both(laws, f"scene {number}, {dim}D", scene) is not None
    laws.demand(f"nodes were left out in {left_out} of 24 scenes", left_out >= 8)


FAMILIES = {"hertz": hertz, "travelling": travelling, "poor-guess": poor_guess, "floating": floating, "bodies": bodies,
            "anywhere": anywhere}


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(run_families(FAMILIES, sys.argv[1], *(sys.argv[2:] or ["all"])))
