# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Coulomb's cone: in any direction, elliptic, changing in space, without friction."""
import math

from support.scenes import contact, merge, press_and_shear, text
from support.tables import MOTION
from support.vectors import dot, rotation


def friction(laws):
    mu = "0.1 + 0.2*x"
    run = laws.run(press_and_shear(2, mu=mu))
    laws.admissible("2D, mu(x)", run, lambda row: .1 + .2 * row["x"])
    run = laws.run(press_and_shear(3, mu=mu + " + 0.1*y"))
    laws.admissible("3D, mu(x, y)", run, lambda row: .1 + .2 * row["x"] + .1 * row["y"])
    split = press_and_shear(2, mu=".1")
    split["Body block"]["Mesh"]["Boundary ids"] = "8: y < 1e-9 && x > 1"
    split["Contact right"] = contact(ids=8, mu=.3)
    done, _ = laws.start(split)
    laws.demand("two contacts with one obstacle on the node between them are refused", done.returncode == 1)

    isotropic = press_and_shear(3)
    first = laws.run(isotropic)
    laws.admissible("3D", first, lambda row: .3)
    for angle in (0, 33.3):
        both = merge(isotropic, {"Contact bottom": {"Second friction coefficient": .3, "Friction angle": angle}})
        laws.same(f"two equal coefficients at {angle} degrees", first, laws.run(both), 1e-9)

    mu1, mu2, angle = .4, .15, 25.0
    elliptic = merge(isotropic, {"Contact bottom": {"Friction coefficient": mu1, "Second friction coefficient": mu2,
                                                    "Friction angle": angle}})
    first = laws.run(elliptic)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    outside = slack = across = 0.0
    size, length = first.largest("r_n"), first.largest(*MOTION)
    for row in first.rows:
        r = (c * row["r_t1"] + s * row["r_t2"]) / mu1, (c * row["r_t2"] - s * row["r_t1"]) / mu2
        du = (c * row["du_t1"] + s * row["du_t2"]) * mu1, (c * row["du_t2"] - s * row["du_t1"]) * mu2
        outside = max(outside, math.hypot(*r) - row["r_n"])
        if row["state"] == "slip":
            slack = max(slack, abs(math.hypot(*r) - row["r_n"]))
            across = max(across, abs(r[0] * du[1] - r[1] * du[0]), dot(r, du))
    laws.check("elliptic cone: outside", outside / size, 1e-9)
    laws.check("elliptic cone: slip inside", slack / size, 1e-9)
    laws.check("elliptic cone: slip across its normal", across / (size * length), 1e-9)
    swapped = merge(elliptic, {"Contact bottom": {"Friction coefficient": mu2, "Second friction coefficient": mu1,
                                                  "Friction angle": angle - 90}})
    laws.same("axes swapped, 90 degrees less", first, laws.run(swapped), 1e-9)
    turn = 41.0
    m = rotation((0, 0, 1), turn)
    turned = merge(elliptic, {"Body block": {"Mesh": {"Rotation": turn}},
                              "Contact bottom": {"Friction angle": angle + turn},
                              "Support top": {"Directions": ", ".join(f"({text(tuple(row[d] for row in m))})"
                                                                      for d in range(3))}})
    laws.same("elliptic cone turned with the scene", first, laws.run(turned), 1e-9, matrix=m)

    # without lateral strain a plane state is exact: friction acts along the motion alone
    for axis, mu in enumerate((mu1, mu2)):
        scene = press_and_shear(3, poisson=0.0)
        scene["Contact bottom"].update({"Friction coefficient": mu1, "Second friction coefficient": mu2})
        parts = ["0", "0", "-0.01*min(t, 1)"]
        parts[axis] = "0.2*max(t - 1, 0)"
        scene["Support top"]["Displacement"] = " ; ".join(parts)
        rows = [row for row in laws.run(scene).last() if row["r_n"] > 0]
        names = (("r_t1", "r_t2"), ("r_t2", "r_t1"))[axis]
        size = max(row["r_n"] for row in rows)
        laws.demand(f"sheared along axis {axis + 1}: all slip", all(row["state"] == "slip" for row in rows))
        laws.check(f"sheared along axis {axis + 1}: friction",
                   max(abs(row[names[0]] + mu * row["r_n"]) + abs(row[names[1]]) for row in rows) / size, 1e-10)

    for dim in (2, 3):
        scene = press_and_shear(dim, mu=0)
        scene["Obstacle floor"] = {"Shape": "prescribed gap", "Normal": (0, 1) if dim == 2 else (0, 0, 1),
                                   "Gap": "0.02*(x - 1)"}
        runs = {name: laws.run(scene, "-s", f"Solver/Method={name}") for name in
                ("automatic", "smoothing", "active set", "gauss-seidel")}
        first = runs.pop("automatic")
        laws.admissible(f"{dim}D, mu = 0", first)
        laws.check(f"{dim}D, mu = 0: friction", first.largest("r_t1", "r_t2"), 0)
        for name, run in runs.items():
            laws.same(f"{dim}D, mu = 0, {name}", first, run, 1e-8, states=False)
        last = laws.run(scene, "-s", "Time/Times=4")
        direct = [row for row in first.rows if row["increment"] == 4]
        size = max(row["r_n"] for row in direct)
        laws.check(f"{dim}D, mu = 0: no memory of the path",
                   max(abs(a["r_n"] - b["r_n"]) for a, b in zip(direct, last.rows)) / size, 1e-10)
        small = laws.run(merge(scene, {"Contact bottom": {"Friction coefficient": 1e-13}}))
        laws.same(f"{dim}D, mu = 1e-13", first, small, 1e-9, states=False)
