# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cylinder and sphere on a plane."""
import math

from support.scenes import SHIPPED, contact, floor, load, support


def hertz(laws):
    radius, force, young, poisson = 10.0, 10.0, 1000.0, .3
    half = math.sqrt(4 * force * radius * (1 - poisson**2) / (math.pi * young))
    peak = 2 * force / (math.pi * half)
    run = laws.run(SHIPPED / "cylinder-on-plane.prm", "-s", "Output/VTU=0")
    rows = sorted(run.last(), key=lambda row: row["x"])
    laws.check("cylinder: total force", abs(sum(row["r_n"] for row in rows) / force - 1), 1e-10)
    x = [row["x"] for row in rows]
    stress = [2 * rows[i]["r_n"] / (x[i + 1] - x[i - 1]) for i in range(1, len(rows) - 1)]
    laws.check("cylinder: largest pressure", abs(max(stress) / peak - 1), .02)
    # the square of the pressure is linear in x^2: the width from its moments, <x^2> = a^2/4
    spread = math.sqrt(4 * sum(row["r_n"] * row["x"]**2 for row in rows) / force)
    laws.check("cylinder: half width from the spread", abs(spread / half - 1), .02)
    touching = [row["x"] for row in rows if row["r_n"] > 0]
    cell = min(b - a for a, b in zip(x, x[1:]))
    laws.check("cylinder: half width from the last nodes, in cells",
               abs((touching[-1] - touching[0]) / 2 - half) / cell, 1.5)
    profile = max(abs(s - peak * math.sqrt(max(0, 1 - (row["x"] / half)**2)))
                  for s, row in zip(stress, rows[1:-1]) if abs(row["x"]) < .8 * half)
    laws.check("cylinder: pressure over the inner 80 %", profile / peak, .03)

    # a sphere on a plane: a quarter of a half ball, 1/4 of the force
    force, radius = 100.0, 10.0
    half = (3 * force * radius * (1 - poisson**2) / (4 * young))**(1 / 3)
    peak = 3 * force / (2 * math.pi * half**2)
    scene = {"Dimension": 3,
             "Body block": {"Mesh": {"Generator": "quarter_hyper_ball", "Arguments": "0, 0, 0 : 10",
                                     "Global refinements": 2, "Rotation": (0, 1, 0, 90), "Translation": (0, 0, radius),
                                     "Refinement boxes": "-3, -3, 0 : 3, 3, 2 : 2",
                                     "Boundary ids": "2: z < 2 && x^2 + y^2 > 0 && abs(x) > 1e-3 && abs(y) > 1e-3 && "
                                                     "x^2 + y^2 < 2.5^2; 4: abs(x) < 1e-9; 5: abs(y) < 1e-9; "
                                                     "6: z > 9.999999"},
                            "Material": {"Young modulus": young, "Poisson ratio": poisson}},
             "Obstacle floor": floor(3), "Contact bottom": contact(ids=2),
             "Support x": support(4, "x"), "Support y": support(5, "y"),
             "Load top": load("pressure", force / (math.pi * radius**2), 6), "Output": {"VTU": 0}}
    run = laws.run(scene)
    total = sum(row["r_n"] for row in run.rows)
    area = -run.increments[-1]["loads_f_z"]
    laws.check("sphere: total force", abs(total / area - 1), 1e-10)
    # <x^2 + y^2> = 2/5 a^2 under Hertz's pressure
    spread = math.sqrt(2.5 * sum(row["r_n"] * (row["x"]**2 + row["y"]**2) for row in run.rows) / total)
    laws.check(f"sphere: contact radius from the spread ({spread:.4g}, Hertz {half:.4g})", abs(spread / half - 1), .05)
    centre = max(run.rows, key=lambda row: -math.hypot(row["x"], row["y"]))
    laws.demand("sphere: the first node touches", centre["r_n"] > 0)
