# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a master loses by wear is a depth of its own, which stays where others have slid.

A block under a steady line load q that passes leaves k q behind, whatever its pressure is like: each point sees the integral of k p ds.
What a pin loses as a master that is drawn over a plate is k p s. Sums of depths times areas are k times forces times ways.
"""
import math
import sys
from pathlib import Path

from laws.worn import told
from support.logs import log_of
from support.scenes import box, load, merge, support

sys.path.append(str(Path(__file__).resolve().parents[2] / "python"))
from conetact.vtu import read_vtu  # noqa: E402

K, P, HARD = 1e-8, 10.0, 1e7


def plate(dim, cells, length=5.0):
    return box((cells, *(2,) * (dim - 2), 2), (length, *(1.0,) * (dim - 2), .25), (0.0,) * (dim - 1) + (-.25,), young=HARD, poisson=0.0)


def drawn(dim, slave, share, cells=40, way=2.0, steps=16, **law):
    """A soft slider of length 1 on a plate that is held below, pressed by P and drawn along x without friction."""
    other = {"slider": "plate", "plate": "slider"}[slave]
    top, bottom = (3, 2) if dim == 2 else (5, 4)
    ids = {"slider": bottom, "plate": top}
    scene = {"Dimension": dim,
             "Body slider": box((8, *(2,) * (dim - 2), 2), (1.0, *(1.0,) * (dim - 2), .5), (.5,) + (0.0,) * (dim - 1), poisson=0.0),
             "Body plate": plate(dim, cells),
             "Contact face": {"Body": slave, "Boundary ids": ids[slave], "Master body": other, "Master boundary ids": ids[other],
                              "Friction coefficient": 0, "Pairing": "mortar", "Kinematics": "finite sliding", "Wear coefficient": K,
                              "Wear share": share, **law},
             "Support hand": support("0, 1", "x", f"{way}*max(t - 1, 0)", "slider"),
             "Support ground": support(bottom, "x, y" if dim == 2 else "x, y, z", body="plate"),
             "Load press": load("pressure", f"{P}*min(t, 1)", top, "slider"),
             "Time": {"Stages": f"1 : 1, 2 : {steps}"}, "Output": {"VTU": steps + 1}}
    if dim == 3:
        scene["Support side"] = support("2, 3", "y", body="slider")
    return scene


def depths(run, body, dim, height):
    """Depths of wear of a body's nodes at a height, at the end, by their undeformed places."""
    mesh = read_vtu(max(run.folder.glob(f"surface-{body}-*.vtu")))
    places = (tuple(round(float(c), 12) for c in point) for point in mesh.points)
    return {place: float(depth) for place, depth in zip(places, mesh.arrays["wear"]) if abs(place[dim - 1] - height) < 1e-9}


def lost(run, contact="face", k=K):
    return sum(k * row["r_n"] * math.hypot(row["du_t1"], row["du_t2"]) for row in run.rows
               if row["contact"] == contact and row["state"] == "slip")


def volume(found, dim):
    """The integral of depths that are linear between nodes."""
    axes = [sorted({place[d] for place in found}) for d in range(dim - 1)]
    sizes = [{x: (axis[min(i + 1, len(axis) - 1)] - axis[max(i - 1, 0)]) / 2 for i, x in enumerate(axis)} for axis in axes]
    return sum(depth * math.prod(sizes[d][place[d]] for d in range(dim - 1)) for place, depth in found.items())


def warned(run):
    return [line for line in log_of(run).splitlines() if "warning" in line and "wear" in line or "loses goes up" in line]


def left_behind(laws):
    for dim, cells, bound, law in ((2, 40, 1e-6, {}), (2, 40, 1e-6, {"Pairing": "node to face", "Wear integration": "implicit"}),
                                   (2, 33, 1e-4, {"Wear integration": "implicit"}), (3, 40, 1e-6, {"Wear integration": "implicit"})):
        run = laws.run(drawn(dim, "slider", .25, cells, **law))
        found = depths(run, "plate", dim, 0)
        laws.check(f"{dim}D, {cells} cells, {law or 'explicit'}: volume of the groove", abs(volume(found, dim) / (.75 * lost(run)) - 1), 1e-12)
        laws.check("  of both sides", abs(run.increments[-1]["face_worn"] / lost(run) - 1), 1e-12)
        passed = [depth for place, depth in found.items() if 1.7 < place[0] < 2.4]
        laws.check("  its depth is k F/width", max(abs(depth / (.75 * K * P) - 1) for depth in passed), bound)
        laws.demand("  none where nothing has been", all(depth == 0 for place, depth in found.items() if not .2 < place[0] < 3.8))
        own = [row["wear"] for row in run.last() if row["contact"] == "face" and .7 < row["x"] < 1.3]
        laws.check("  the slider itself: k p s", max(abs(depth / (.25 * K * P * 2.0) - 1) for depth in own), 1e-4)
        there = {round(row["x"], 9): row["wear"] for row in run.last() if row["contact"] == "face_master"}
        laws.check("  the same in its rows", max(abs(depth - there[round(place[0], 9)]) for place, depth in found.items() if round(place[0], 9) in there) / (K * P), 1e-9)
        laws.demand("  no warning", not warned(run))
    run = laws.run(drawn(2, "slider", 0, steps=3))
    laws.demand("long steps are told", len(warned(run)) == 1 and "Use smaller increments" in warned(run)[0])
    laws.check("  the volume is right", abs(volume(depths(run, "plate", 2, 0), 2) / lost(run) - 1), 1e-12)


def pin(laws):
    for dim, cells, share, law in ((2, 40, 0, {}), (2, 120, .5, {"Wear integration": "implicit"}), (3, 40, 0, {"Pairing": "node to face"})):
        run = laws.run(drawn(dim, "plate", share, cells, **law))
        found = depths(run, "slider", dim, 0)
        laws.check(f"{dim}D, plate as Body, share {share}, {law or 'explicit'}: volume of the pin",
                   abs(volume(found, dim) / ((1 - share) * lost(run)) - 1), 1e-12)
        laws.check("  k p s at all of its nodes", max(abs(depth / ((1 - share) * K * P * 2.0) - 1) for depth in found.values()), 1e-3)


def followed(laws):
    """Another body, which does not wear, is pressed into the groove."""
    k, closing = 1e-5, .002
    for way, pairing in (("explicit", "mortar"), ("implicit", "node to face")):
        scene = drawn(2, "slider", 0, way=2.25, steps=18, **{"Wear coefficient": k, "Wear integration": way, "Pairing": pairing})
        scene["Body probe"] = box((4, 4), (.5, .5), (1.75, .1), poisson=0.0)
        scene["Contact groove"] = {**scene["Contact face"], "Body": "probe", "Wear coefficient": 0}
        scene["Support probe"] = support(3, "x, y", f"0 ; -{.1 + closing}*max(t - 2, 0)", "probe")
        scene["Time"] = {"Stages": "1 : 1, 2 : 18, 3 : 4"}
        scene["Support hand"]["Displacement"] = "2.25*min(max(t - 1, 0), 1)"
        run = laws.run(scene)
        pressed = [row["pressure"] for row in run.last() if row["contact"] == "groove"]
        laws.demand("no warning of wear", not warned(run))
        laws.check(f"{way}, {pairing}: pressure in a groove of k F", max(abs(p / (1000 * (closing - k * P) / .5) - 1) for p in pressed), 2e-4)
    scene["Contact groove"] = {name: value for name, value in scene["Contact groove"].items() if not name.startswith("Wear")}
    laws.demand("a contact without wear does not see it, which is told",
                any("contact 'groove' is on a side of body 'plate' that contact 'face' wears" in line for line in warned(laws.run(scene))))


def otherwise(laws):
    """Another backend, several processes, from a checkpoint, with supports that are released meanwhile, in halves."""
    for dim in (2, 3):
        scene = drawn(dim, "slider", .25, 33, way=1.0, steps=8,
                      **{"Wear coefficient": 1e-4, "Wear integration": "implicit", "Friction coefficient": .1})
        top = 3 if dim == 2 else 5
        scene["Support hand"]["Boundary ids"] = top  # friction along what supports hold is none of the iterative backend
        scene["Output"] = {"VTU": 9, "Checkpoint": 1}
        if dim == 3:
            scene["Contact face"]["Friction coefficient"] = 0
            scene["Support side"] = support(top, "y", body="slider")
        run = laws.run(scene)
        stages = merge(scene, {"Support keep": support(top, "y" if dim == 2 else "z", "-0.005", "slider", Active="t > 1.6")})
        half = laws.run(scene, "-s", "Time/Stages=1 : 1, 1.5 : 4")
        for what, other in (("iterative", laws.run(scene, "-s", "Solver/Backend=iterative")),
                            ("three processes", laws.run(scene, "-s", "Solver/Backend=iterative", "--processes", "3")),
                            ("from a checkpoint", laws.run(scene, "-s", "Output/VTU=1", "--restart", half.folder))):
            laws.same(f"{dim}D, {what}", run, other, 1e-8)
            one, two = (depths(of, "plate", dim, 0) for of in (run, other))
            laws.check("  the groove", max(abs(one[place] - two[place]) for place in one) / max(one.values()), 1e-8)
        run = laws.run(stages)
        laws.check(f"{dim}D, stages: volume of the groove", abs(volume(depths(run, "plate", dim, 0), dim) / (.75 * lost(run, k=1e-4)) - 1), 1e-12)

    scene = drawn(2, "slider", .5, steps=8, **{"Wear acceleration": 1000, "Wear integration": "implicit"})
    scene["Output"]["Checkpoint"] = 1
    whole, part = laws.run(scene), laws.run(scene, "-s", "Time/Stages=1 : 1, 1.5 : 4")
    laws.check("Wear acceleration: volume of the groove", abs(volume(depths(whole, "plate", 2, 0), 2) / (500 * lost(whole)) - 1), 1e-12)
    laws.check("  half of it changes little", max(told(whole, "face")), .01)
    on = laws.run(scene, "--restart", part.folder)
    laws.check("  told by a run that goes on", max(abs(a / b - 1) for a, b in zip(told(on, "face"), told(whole, "face"))), 1e-6)


def grooves(laws):
    left_behind(laws)
    pin(laws)
    followed(laws)
    otherwise(laws)
