# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""One obstacle described in several ways; only relative motion counts."""
import math
import re

from support.scenes import box, merge, press_and_shear, support
from support.vectors import scaled, unit


def obstacles(laws):
    flat = press_and_shear(2, mu=.4)
    n = unit((.03, 1.0, 0))
    planes = [{"Shape": "half space", "Normal": n[:2], "Point": (0.0, -.002)},
              {"Shape": "prescribed gap", "Normal": (.3, 10.0), "Gap": f"{n[0]!r}*x + {n[1]!r}*(y + 0.002)"},
              {"Shape": "implicit", "Function": "5*(0.03*x + (y + 0.002))"}]
    runs = [laws.run(merge(flat, {"Obstacle floor": None}) | {"Obstacle floor": shape}) for shape in planes]
    laws.same("half space and prescribed gap", runs[0], runs[1], 1e-11)
    laws.same("half space and implicit plane", runs[0], runs[2])

    def block(dim, shape, bottom=None):
        scene = press_and_shear(dim, mu=.3)
        size, cells = ((1.0, .5), (16, 6)) if dim == 2 else ((1.0, 1.0, .5), (6, 6, 3))
        origin = scaled(-.5, size[:-1]) + (bottom if bottom is not None else 1.0,)
        scene["Body block"] = box(cells, size, origin)
        scene["Support top"]["Displacement"] = re.sub(r"-0\.01\*min", "-0.03*min", scene["Support top"]["Displacement"])
        scene["Obstacle floor"] = shape
        return scene

    pairs = (
        ("circle", 2, {"Shape": "sphere", "Radius": 1.0}, {"Function": "sqrt(x^2 + y^2) - 1"}, 1.0),
        ("cylinder in the plane", 2, {"Shape": "cylinder"}, {"Function": "sqrt(x^2 + y^2) - 1"}, 1.0),
        ("sphere", 3, {"Shape": "sphere", "Radius": 1.0}, {"Function": "sqrt(x^2 + y^2 + z^2) - 1"}, 1.0),
        ("cylinder", 3, {"Shape": "cylinder", "Axis": (0, 1, 0)}, {"Function": "sqrt(x^2 + z^2) - 1"}, 1.0),
        ("oblique cylinder", 3, {"Shape": "cylinder", "Axis": (1, 2, 0)},
         {"Function": "sqrt((2*x - y)^2/5 + z^2) - 1"}, 1.0),
        ("inside of a cylinder", 3, {"Shape": "cylinder", "Axis": (0, 1, 0), "Radius": 2.0, "Side": "inside"},
         {"Function": "2 - sqrt(x^2 + z^2)"}, -math.sqrt(4 - .25)),
        ("inside of a circle", 2, {"Shape": "sphere", "Radius": 2.0, "Side": "inside"},
         {"Function": "2 - sqrt(x^2 + y^2)"}, -math.sqrt(4 - .25)))
    for name, dim, shape, function, bottom in pairs:
        a = laws.run(block(dim, shape, bottom))
        b = laws.run(block(dim, {"Shape": "implicit", **function}, bottom))
        laws.demand(f"{name}: {sum(r['state'] != 'open' for r in a.rows)} rows touch",
                    any(r["state"] != "open" for r in a.rows) and any(r["state"] == "open" for r in a.rows))
        laws.same(name, a, b, 1e-9 if dim == 3 else 1e-10)

    # only relative motion counts
    for dim in (2, 3):
        moved = press_and_shear(dim)
        functions = moved["Support top"]["Displacement"].split(";")
        bodies_move = laws.run(moved)
        still = merge(moved, {"Support top": {"Displacement": "0"},
                              "Obstacle floor": {"Displacement": " ; ".join(f"-({f})" for f in functions)}})
        laws.same(f"{dim}D, moving obstacle", bodies_move, laws.run(still), 1e-11)
    held = press_and_shear(3)  # contact nodes whose tangent a support moves
    held["Support front"] = support(2, "y", "0.001*t")
    held["Obstacle floor"]["Displacement"] = "0 ; 0.001*t ; 0"
    held["Support top"]["Displacement"] = "0.004*max(t - 1, 0) ; 0.001*t ; -0.01*min(t, 1)"
    still = merge(held, {"Support front": {"Displacement": "0"}, "Obstacle floor": {"Displacement": "0"},
                         "Support top": {"Displacement": "0.004*max(t - 1, 0) ; 0 ; -0.01*min(t, 1)"}})
    laws.same("3D, all moves along y with a held face", laws.run(held), laws.run(still), 1e-11)
