# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Round bodies that wear while they are drawn over a plane: volumes by Archard, scars by geometry.

A scar of half width a on a cylinder, or of radius a on a ball, is a plane: what is worn is the segment, 2 a^3/(3 R) and
pi a^4/(4 R), and that is k F s (J. J. Kauzlarich, J. A. Williams, Archard wear and component geometry, Proc. Instn Mech.
Engrs J 215, 2001, 387). A scar that stays plane wears evenly: pressure is F over its area. Bodies give way a little: by
much less than the depth here.

Fretting wears half planes as boundary elements say, which are apart from the program: 10 000 cycles, 100 at once.
"""
import math

import re

from laws.layers import clamped
from support.logs import log_of
from support.scenes import SHIPPED, box, joint, load, merge, support
from support.worn_half_planes import HalfPlanes

CYLINDER = SHIPPED / "cylinder-on-plane.prm"
R = 10.0


def worn_by(run, contact, k):
    """Archard's sum over nodes and increments."""
    return sum(k * row["r_n"] * math.hypot(row["du_t1"], row["du_t2"]) for row in run.rows
               if row["contact"] == contact and row["state"] == "slip")


def plane_scar(laws, what, run, a, force, area, bound):
    """The last increment against a plane scar of known size under even pressure."""
    rows = [row for row in run.last() if row["r_n"] > 0 and not row["contact"].endswith("_master")]
    depth = a * a / (2 * R)
    inside = [row for row in rows if math.hypot(row["x"], row["y"] if run.dim == 3 else 0) < .9 * a]
    laws.check(f"{what}: depths", max(abs(row["wear"] + (row["x"]**2 + (row["y"]**2 if run.dim == 3 else 0)) / (2 * R) - depth)
                                      for row in inside) / depth, bound)
    laws.check(f"{what}: pressures", max(abs(row["pressure"] / (force / area) - 1) for row in inside), .05)
    laws.check(f"{what}: area of the scar", abs(sum(row["area"] for row in rows) / area - 1), .05)


def cylinder(laws):
    k, force, way, n = 1e-3, 10.0, 4.5, 40
    run = laws.run(CYLINDER, "-s", "Output/VTU=0", "-s", "Body cylinder/Material/Young modulus=1e5",
                   "-s", "Load press/Value=0.5",
                   "-s", "Body cylinder/Mesh/Refinement boxes=-1.5, 0 : 1.5, 1.2 : 2 ; -1, 0 : 1, 0.3 : 3",
                   "-s", f"Obstacle plane/Displacement={way}*t ; 0", "-s", f"Contact bottom/Wear coefficient={k}",
                   "-s", "Contact bottom/Wear integration=implicit", "-s", f"Time/Increments={n}")
    volume = run.increments[-1]["bottom_worn"]
    laws.check("cylinder: volume of all nodes", abs(volume / worn_by(run, "bottom", k) - 1), 1e-12)
    # ways of nodes differ by what the surface gives way along x
    laws.check("cylinder: volume = k F s", abs(volume / (k * force * way) - 1), 1e-6)
    a = (1.5 * R * k * force * way)**(1 / 3)
    plane_scar(laws, "cylinder", run, a, force, 2 * a, .005)


def ball(laws):
    """A quarter of it."""
    k, force, way, n = 1e-3, 40.0, 1.3, 20
    side = 1.2
    scene = {"Dimension": 3, "Body ball": box((12, 12, 4), (side, side, .4), young=1e5),
             "Body plane": box((1, 1, 1), (side, side, .4), (0.0, 0.0, -.4), young=1e9),
             "Contact joint": {**joint("ball", 4, "plane", 5), "Pairing": "node to face", "Kinematics": "small", "Gap": f"(x^2 + y^2)/{2 * R}",
                               "Wear coefficient": k, "Wear integration": "implicit"},
             "Support left": support(0, "x", body="ball"), "Support front": support(2, "y", body="ball"),
             "Support ground": support(4, "x, y, z", f"{way}*t ; 0 ; 0", "plane"),
             "Load press": load("pressure", force / 4 / side**2, 5, "ball"),
             "Time": {"End": 1, "Increments": n}, "Output": {"VTU": 0}}
    run = laws.run(scene)
    volume = 4 * run.increments[-1]["joint_worn"]
    laws.check("ball: volume of all nodes", abs(volume / (4 * worn_by(run, "joint", k)) - 1), 1e-12)
    laws.check("ball: volume = k F s", abs(volume / (k * force * way) - 1), 1e-4)
    a = (4 * R * k * force * way / math.pi)**.25
    plane_scar(laws, "ball", run, a, force / 4, math.pi * a * a / 4, .02)


def worn(laws):
    cylinder(laws)
    ball(laws)


def fretting(laws, amplitude, k, cycles=100):
    """The shipped scene with other cycles; what its top is moved by at each increment, and the run."""
    wave = "2/pi * asin(sin(pi/2 * (t - 1)))"
    run = laws.run(SHIPPED / "fretting-wear.prm", "-s", "Output/VTU=0", "-s", f"Contact joint/Wear coefficient={k}",
                   "-s", "Contact joint/Wear acceleration=100", "-s", f"Time/Stages=1 : 1, {1 + 4 * cycles} : {8 * cycles}",
                   "-s", f"Support top/Displacement=if(t < 1, 0, {amplitude} * {wave}) ; -0.0133 * min(t, 1)")
    moves = [amplitude * 2 / math.pi * math.asin(math.sin(math.pi / 2 * (record["time"] - 1))) for record in run.increments]
    return run, moves


def half_planes(laws):
    """In partial slip and in gross slip. What gives way behind the half planes is that of the first two increments."""
    soft = None
    for what, amplitude, k, bounds in (("partial slip", .0071, 6e-5, (.002, .01, .015, .03)),
                                       ("gross slip", .03, 1e-6, (.002, .005, .01, .015))):
        run, moves = fretting(laws, amplitude, k)
        planes = HalfPlanes(1000 / (2 * (1 - .3**2)), 100, .5, 1.40625, 90)
        if soft is None:
            first, second = run.increments[:2]
            planes.fit(.0133, first["joint_f_y"], moves[1], -second["joint_f_x"])
            soft = planes.soft_n, planes.soft_t
        planes.soft_n, planes.soft_t = soft
        planes.press(.0133)
        for move in moves[1:]:
            planes.press(.0133)
            planes.wear(100 * k, planes.shear(move))
        compare(laws, f"fretting, {what}", run, planes, bounds)


def worn_off(laws):
    """Until what slips carries nothing: a punch of the profile that sticks is left (I. G. Goryacheva, P. T. Rajeev, T. N. Farris,
    J. Tribol. 123, 2001, 848). On cells half as large forces of nodes that wear are rounding of others in the end."""
    finer = {"lower": "-1.45, -0.15 : 1.45, 0", "upper": "-1.45, 0 : 1.45, 0.15"}
    boxes = {"lower": "-2.5, -1.5 : 2.5, 0 : 1 ; -1.9, -0.7 : 1.9, 0 : 2 ; -1.5, -0.3 : 1.5, 0 : 3",
             "upper": "-2.5, 0 : 2.5, 1.5 : 1 ; -1.9, 0 : 1.9, 0.7 : 2 ; -1.5, 0 : 1.5, 0.3 : 3"}
    refined = [word for body, box in finer.items()
               for word in ("-s", f"Body {body}/Mesh/Refinement boxes={boxes[body]} ; {box} : 4")]
    run = laws.run(SHIPPED / "fretting-wear.prm", "-s", "Output/VTU=0", *refined)
    laws.demand("worn off: no increment is cut", len(run.increments) == 201 and all(row["substeps"] == 1 for row in run.increments))
    rows = sorted((row for row in run.last() if row["contact"] == "joint"), key=lambda row: row["x"])
    stick = max(row["x"] for row in rows if row["state"] == "stick")
    c, force, modulus, radius = stick + (rows[1]["x"] - rows[0]["x"]) / 2, run.increments[-1]["joint_f_y"], 1000 / (2 * (1 - .3**2)), 100
    convex = math.pi * modulus * c**2 / (4 * radius)

    def published(x):
        root = math.sqrt(c**2 - x**2)
        return 2 * convex / (math.pi * c**2) * root + (force - convex) / (math.pi * root)
    inner = [row for row in rows if abs(row["x"]) < .8 * c]
    laws.check("worn off: pressures of what sticks", max(abs(row["pressure"] / published(row["x"]) - 1) for row in inner), .04)
    laws.check("  those of what slips, over the largest",
               max(row["pressure"] for row in rows if row["state"] == "slip") / max(row["pressure"] for row in rows), 1e-9)


def compare(laws, what, run, planes, bounds):
    volume, last = planes.worn.sum() * planes.width, run.increments[-1]
    rows = {round(row["x"], 6): row for row in run.last() if row["contact"] == "joint"}
    between = [(at, planes.worn[i], planes.p[i]) for i, at in enumerate(planes.x)]

    def interpolated(x, column):
        below, above = max(b for b in between if b[0] <= x), min(b for b in between if b[0] > x)
        return below[column] + (x - below[0]) / (above[0] - below[0]) * (above[column] - below[column])
    deepest = max(planes.worn)
    laws.check(f"{what}: force", abs(last["joint_f_y"] / planes.force()[0] - 1), bounds[0])
    laws.check(f"{what}: volume", abs(last["joint_worn"] / volume - 1), bounds[1])
    laws.check(f"{what}: pressure in the middle", abs(rows[0.0]["pressure"] / interpolated(0.0, 2) - 1), bounds[2])
    for x in (.6875, .75, .8125):
        laws.check(f"{what}: depth at {x}", abs(2 * rows[x]["wear"] - interpolated(x, 1)) / deepest, bounds[3])


def told(run, name):
    """Parts by which half of Wear acceleration would change depths and volume, as the log has them."""
    found = re.search(rf"Contact '{name}': Wear acceleration = \S+ half of it would change depths of wear by about (\S+) % of the largest, "
                      r"the volume by (\S+) %", log_of(run))
    return tuple(float(x) / 100 for x in found.groups())


def compare_halves(laws, what, run, half, name, within=1.1):
    """What the log tells against a run with half of it and twice the increments: within this factor."""
    rows = [[row for row in r.last() if row["contact"] == name] for r in (run, half)]
    deepest = max(row["wear"] for row in rows[1])
    depth = max(abs(a["wear"] - b["wear"]) for a, b in zip(*rows)) / deepest
    volume = abs(run.increments[-1][f"{name}_worn"] / half.increments[-1][f"{name}_worn"] - 1)
    found = told(run, name)
    laws.demand(f"{what}: depths are off by {depth:.3g}, told {found[0]:.3g}", 1 / within < found[0] / depth < within)
    if name != "joint":
        laws.demand(f"  the volume by {volume:.3g}, told {found[1]:.3g}", 1 / within < found[1] / volume < within)


def faster(laws):
    """Wear acceleration N beside half of it in twice as many increments: between plates, and in cycles of fretting that are alike: the
    first one, which begins at rest, does not wear."""
    for dim in (2, 3):
        for way in ("explicit", "implicit"):
            for n, k in ((10, .002), (40, .002), (10, .005)):
                def drawn(acceleration, increments):
                    scene = clamped(dim, .01, 0, increments=increments, end=increments / 10, mu=0,
                                    **{"Wear coefficient": k, "Wear acceleration": acceleration, "Wear integration": way})
                    scene["Support springs"] = support("0, 1", "x", "0.02*t")
                    return laws.run(scene)
                compare_halves(laws, f"{dim}D, between plates, {way}, {n} increments, k = {k}", drawn(10, n), drawn(5, 2 * n), "below")
    for way, most in (("implicit", 400), ("explicit", 100), ("explicit", 50)):
        def fretted(acceleration, cycles):
            return laws.run(SHIPPED / "fretting-wear.prm", "-s", "Output/VTU=0", "-s", f"Contact joint/Wear acceleration={acceleration}",
                            "-s", f"Contact joint/Wear integration={way}", "-s", "Contact joint/Wear coefficient=if(t < 5.1, 0, 1e-4)",
                            "-s", f"Time/Stages=1 : 1, {5 + 4 * cycles} : {8 + 8 * cycles}")
        compare_halves(laws, f"fretting, {way}, {most}", fretted(most, 12), fretted(most / 2, 24), "joint", 2)
    scene = clamped(2, .01, 0, increments=10, mu=0, **{"Wear coefficient": .002})
    scene["Support springs"] = support("0, 1", "x", "0.02*t")
    once = laws.run(scene)
    laws.demand("without it nothing is told", "Wear acceleration" not in log_of(once))
    rough = laws.run(merge(scene, {"Contact below": {"Wear acceleration": 200}, "Contact above": {"Wear acceleration": 200}}))
    laws.demand("a large error is a warning", "warning: Contact 'below': Wear acceleration = 200, half of it" in log_of(rough))
    scene = merge(scene, {"Contact below": {"Wear acceleration": 10}, "Output": {"Checkpoint": 1}})
    whole = laws.run(scene)
    part = laws.run(scene, "-s", "Time/End=0.5", "-s", "Time/Increments=5")
    laws.check("the estimate of a run that goes on", abs(told(laws.run(scene, "--restart", part.folder), "below")[0] / told(whole, "below")[0] - 1), 1e-9)
