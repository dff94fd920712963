# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Round bodies that wear while they are drawn over a plane: volumes by Archard, scars by geometry.

A scar of half width a on a cylinder, or of radius a on a ball, is a plane: what is worn is the segment, 2 a^3/(3 R) and
pi a^4/(4 R), and that is k F s (J. J. Kauzlarich, J. A. Williams, Archard wear and component geometry, Proc. Instn Mech.
Engrs J 215, 2001, 387). A scar that stays plane wears evenly: pressure is F over its area. Bodies give way a little: by
much less than the depth here.
"""
import math
from pathlib import Path

from support.scenes import box, joint, load, support

CYLINDER = Path(__file__).resolve().parents[2] / "parameter-files/cylinder-on-plane.prm"
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
