# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Round bodies of second degree, whose faces are bent, in contact with one another.

rings: Lame's pressure, through meshes that match and that do not; pins: a pin in a bore that is a little wider;
balls: Hertz, and Cattaneo and Mindlin, of P2 tetrahedra from Gmsh whose meshes do not match.
"""
import itertools
import math

from support import half_space, round_tetrahedra
from support.half_space import MU, STICK
from support.scenes import box, contact, joint, load, merge, support

CIRCLE = (16, 32, 64)  # corners a circle


def shell(inner, outer, around, young, element):
    """A quarter of a ring: ids 0 inside, 1 outside, 2 on x = 0, 3 on y = 0."""
    finer = round(math.log2(around / 16))
    halved = element == "P2"  # a cell of P2 is cut at the middles of its sides
    return {"Mesh": {"Generator": "quarter_hyper_shell", "Arguments": f"0, 0 : {inner!r} : {outer!r} : {2 if halved else 4} : true",
                     "Global refinements": finer},
            "Element": element, "Material": {"Young modulus": young, "Poisson ratio": .3}}


def fit(element, around, ratio, exchanged, young=1e9, **entries):
    """A ring, pressed from outside, on a shaft that hardly deforms."""
    other = 2 * round(around * ratio / 2)
    sides = ("shaft", 1, "ring", 0) if exchanged else ("ring", 0, "shaft", 1)
    return {"Dimension": 2, "Body ring": shell(1.0, 2.0, around, 1000.0, element), "Body shaft": shell(.5, 1.0, other, young, element),
            "Contact fit": joint(*sides, **entries),
            **{f"Support {body} {axis}": support(2 + i, axis, body=body) for i, axis in enumerate("xy") for body in ("ring", "shaft")},
            "Support inside": support(0, "x, y", body="shaft"),
            "Load press": load("pressure", "10*t", 1, "ring"), "Output": {"VTU": 0}}


def pressures(run):
    return [row["pressure"] for row in run.rows if row["contact"] == "fit"]


def mean_pressure(run):
    rows = [row for row in run.rows if row["contact"] == "fit"]
    return sum(row["r_n"] for row in rows) / sum(row["area"] for row in rows)


def rings(laws):
    """12.727 by Lame; errors of the mean fall with h^4."""
    exact = 14 / 1.1  # of 10 outside, Poisson's ratio .3, twice as wide outside as inside
    for element, ratio, exchanged in itertools.product(("P2", "Q2"), (1, 1.5), (False, True)):
        for around, mean, single in zip(CIRCLE, (4e-3, 3e-4, 3e-5), (3e-2, 6e-3, 1.5e-3)):
            run = laws.run(fit(element, around, ratio, exchanged))
            what = f"{element}, {around} corners a circle on {ratio:g} times as many{', exchanged' * exchanged}"
            laws.check(f"{what}: mean pressure", abs(mean_pressure(run) / exact - 1), mean)
            laws.check("  pressures", max(abs(p / exact - 1) for p in pressures(run)), single)
    for element in ("P2", "Q2"):
        run = laws.run(fit(element, 32, 1.5, False, Pairing="node to face"))
        laws.check(f"{element}, node to face, finer slave: mean pressure", abs(mean_pressure(run) / exact - 1), 3e-4)
        laws.check("  pressures", max(abs(p / exact - 1) for p in pressures(run)), 3e-3)


CORNERS = """Point(1) = {.6, 0, 0, .3}; Point(2) = {4.4, 0, 0, .3}; Point(3) = {5, .6, 0, .3}; Point(4) = {5, 3, 0, .3};
Point(5) = {0, 3, 0, .3}; Point(6) = {0, .6, 0, .3}; Point(7) = {.6, .6, 0}; Point(8) = {4.4, .6, 0};
Line(1) = {1, 2}; Circle(2) = {2, 8, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Circle(6) = {6, 7, 1};
Curve Loop(1) = {1:6}; Plane Surface(1) = {1}; Physical Surface("block") = {1}; Physical Curve("bottom") = {6, 1, 2}; Physical Curve("top") = {4};
"""


def rounded_corners(laws):
    """A block with a flat bottom and rounded corners: all of the bottom touches from the start, so that the force is linear."""
    (laws.folder / "corners.geo").write_text(CORNERS)
    forces = {}
    for order in (1, 2):
        run = laws.run({"Dimension": 2, "Body block": {"Mesh": {"File": "corners.geo", "Order": order},
                                                       "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}},
                        "Obstacle floor": {"Shape": "half space", "Normal": (0, 1)}, "Contact sole": contact("block", "bottom", "floor", 0),
                        "Support top": support("top", "x, y", "0 ; -0.02*t", "block"), "Time": {"Times": ".25, 1"}, "Output": {"VTU": 0}})
        forces[order] = [row["sole_f_y"] for row in run.increments]
        laws.check(f"rounded corners, order {order}: force over time", abs(forces[order][1] / forces[order][0] / 4 - 1), 1e-8)
    laws.check("  of both orders", abs(forces[2][1] / forces[1][1] - 1), .02)


def vees(laws):
    """A disc that lies in a vee of 90 degrees and is pressed into it. It starts where it is drawn to touch, so both flanks' friction holds
    it: N (1 + mu) sqrt(2) = W, however little it is pressed."""
    drawn_balls(laws)
    rounded_corners(laws)
    mu = .2
    for element, facing in itertools.product(("Q2", "P2"), ("obstacles", "bodies")):
        for around, weight in ((16, 1.0), (16, 1e-3), (32, 1e-2)):
            disc = {"Mesh": {"Generator": "hyper_shell", "Arguments": f"0, 0 : 0.4 : 1 : {around // 2 if element == 'P2' else around} : true",
                             "Boundary ids": "11: x < 0 && x^2 + y^2 > 0.9 ; 12: x > 0 && x^2 + y^2 > 0.9"},
                    "Element": element, "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}}
            scene = {"Dimension": 2, "Body disc": disc, "Load weight": load("force", f"0 ; -{weight!r}*t", 0, "disc"), "Output": {"VTU": 0}}
            for side, ids, sign in (("left", 11, 1), ("right", 12, -1)):
                met = {"Body": "disc", "Boundary ids": ids, "Friction coefficient": mu}
                if facing == "obstacles":
                    scene[f"Obstacle {side}"] = {"Shape": "half space", "Normal": (sign, 1.0), "Point": (0.0, -math.sqrt(2))}
                    scene[f"Contact {side}"] = {**met, "Obstacle": side}
                else:
                    scene[f"Body {side}"] = {"Mesh": {"Generator": "subdivided_hyper_rectangle", "Rotation": -45.0 * sign, "Arguments": "4, 1 : -1, -0.5 : 1, 0 : true",
                                                      "Translation": (-sign / math.sqrt(2), -1 / math.sqrt(2))},
                                             "Material": {"Young modulus": 1e6, "Poisson ratio": .3}}
                    scene[f"Support {side}"] = support(2, "x, y", body=side)
                    scene[f"Contact {side}"] = {**met, "Master body": side, "Master boundary ids": 3}
            end = laws.run(scene).increments[-1]
            normal = weight / (1 + mu) / math.sqrt(2)
            for side, sign in (("left", 1), ("right", -1)):
                force = (end[f"{side}_f_x"], end[f"{side}_f_y"])
                exact = (sign * normal * (1 - mu) / math.sqrt(2), weight / 2)
                laws.check(f"{element} in a vee of {facing}, {around} round, {weight:g}: {side}", math.dist(force, exact) / weight, 1e-6)


def implicit_units(laws):
    """Half a disc of second degree on a bump that a function gives: lengths in another unit are the same scene."""
    def run(unit):
        half = {"Mesh": {"Generator": "half_hyper_ball", "Arguments": f"0, 0 : {unit!r}", "Global refinements": 3, "Rotation": -90,
                         "Translation": (0, unit)}, "Element": "Q2", "Material": {"Young modulus": 1000 / unit**2, "Poisson ratio": .3}}
        return laws.run({"Dimension": 2, "Body disc": half, "Support top": support(1, "x, y", f"0 ; {-.05 * unit!r}*t", "disc"),
                         "Obstacle bump": {"Shape": "implicit", "Function": f"sqrt(x^2 + (y + {.5 * unit!r})^2) - {.5 * unit!r}"},
                         "Contact touch": {"Body": "disc", "Boundary ids": 0, "Obstacle": "bump", "Friction coefficient": .2,
                                           "Kinematics": "small"}, "Output": {"VTU": 0}})
    one = run(1.0)
    for unit in (1e-3, 1e3):
        other = run(unit)
        laws.check(f"disc on a bump, in units of {1 / unit:g}: reactions",
                   max(abs(a["r_n"] - b["r_n"] * unit) for a, b in zip(one.last(), other.last())) / one.largest("r_n"), 1e-7)


def pin_in_bore(element, around, bore, **entries):
    """Half a pin is pressed into half a bore that is a little wider."""
    clearance = .002
    pin = {"Mesh": {"Generator": "quarter_hyper_ball", "Arguments": f"0, 0 : {1 - clearance!r}",
                    "Global refinements": round(math.log2(around / (16 if element == "P2" else 8))),
                    "Translation": (0, clearance), "Boundary ids": f"2: x < 1e-9 ; 3: y < {clearance + 1e-9!r}"},
           "Element": element, "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}}
    return {"Dimension": 2, "Body pin": pin, "Body plate": shell(1.0, 3.0, bore, 1000.0, element),
            "Contact fit": joint("pin", 0, "plate", 0, **entries),
            "Support pin": support(2, "x", body="pin"), "Support plate": support(2, "x", body="plate"),
            "Support outside": support(1, "x, y", body="plate"), "Load push": load("pressure", "2*t", 3, "pin"),
            "Output": {"VTU": 0}}


def pins(laws):
    """The largest pressure, and that at 22.5 degrees, against a finer mesh."""
    def found(element, around, bore):
        run = laws.run(pin_in_bore(element, around, bore))
        rows = [row for row in run.rows if row["contact"] == "fit"]
        return [min(rows, key=lambda row: abs(row["x"] - math.sin(angle)))["pressure"] for angle in (0, math.pi / 8)]
    for element in ("P2", "Q2"):
        exact = found(element, 256, 256)
        for ratio in (1, 1.5):
            errors = [[abs(a / b - 1) for a, b in zip(found(element, n, 2 * round(n * ratio / 2)), exact)] for n in CIRCLE]
            for i, (what, bounds) in enumerate((("largest pressure", (.02, .005, .002)), ("pressure at 22.5 degrees", (.03, .008, .002)))):
                for n, of_mesh, bound in zip(CIRCLE, errors, bounds):
                    laws.check(f"{element}, {n} corners a circle on {ratio:g} times as many: {what}", of_mesh[i], bound)


def errors_of_shear(rows, exact):
    """Of Cattaneo's and Mindlin's shear stress along x."""
    normal, shear = (sum(row[c] for row in rows) for c in ("r_n", "r_t1"))
    wrong, size = (sum(row["area"] * f(abs(row["traction_t1"]), exact.friction(half_space.distance(row)))**2 for row in rows)
                   for f in (lambda a, b: a - b, lambda a, b: b))
    stuck = max(half_space.distance(row) for row in rows if row["state"] == "stick")
    slipping = min(half_space.distance(row) for row in rows if row["state"] == "slip")
    return {"shear force": abs(2 * abs(shear) / exact.shear_force() - 1),
            "stick width from the forces": abs((1 - abs(shear) / (MU * normal))**(1 / 3) / STICK - 1),
            "shear stress in L2": math.sqrt(wrong / size),
            "edge of the stick zone": max(abs(stuck - STICK), abs(slipping - STICK))}


BOUNDS = {"force": 5e-3, "peak pressure": .01, "pressures within 0.8, root of the mean square": .01, "zigzag": .02}


def check(laws, what, found, bounds):
    for name, bound in bounds.items():
        laws.check(f"{what}: {name}", found[name], bound)


def balls(laws):
    """Tetrahedra of Gmsh, 8 corners a half width: on a plane, on 8 of the same mesh, on 7; then sheared."""
    exact = half_space.Hertz(3, half_space.POISSON["hertz"], 1)
    run = laws.run(round_tetrahedra.on_plane(laws.folder, 1 / 8))
    check(laws, "on a plane", round_tetrahedra.pressure_errors(run.last(), exact, 4), BOUNDS)
    exact = half_space.Hertz(3, half_space.POISSON["partial slip"][3], 2)
    for other in (8, 7):
        run = laws.run(round_tetrahedra.on_ball(laws.folder, (1 / 8, 1 / other)))
        rows = [row for row in run.rows if row["contact"] == "joint"]
        check(laws, f"8 corners a half width on {other}", round_tetrahedra.pressure_errors(rows, exact, 4), BOUNDS)


def drawn_balls(laws):
    """A rigid ball that is pressed into a slab and drawn along it, by more than cells: linear and quadratic cells tell of the same force,
    and friction of all that presses is about its coefficient."""
    ends = {}
    for element, cells in (("P1", (16, 8, 6)), ("P2", (8, 4, 3)), ("Q2", (8, 4, 3))):
        body = box(cells, (16.0, 8.0, 6.0), (-8.0, -4.0, -6.0), 100.0)
        run = laws.run({"Dimension": 3, "Body slab": merge(body, {"Element": element}),
                        "Obstacle ball": {"Shape": "sphere", "Center": (-2.0, 0.0, 10.0), "Radius": 10.0,
                                          "Displacement": "4*max(t - 1, 0) ; 0 ; -min(t, 1)"},
                        "Contact sole": contact("slab", 5, "ball", .3, Kinematics="finite sliding"),
                        "Support base": support(4, "x, y, z", "0 ; 0 ; 0", "slab"), "Time": {"Stages": "1 : 2, 2 : 4"}, "Output": {"VTU": 0}})
        end = run.increments[-1]
        force = [end[f"sole_f_{c}"] for c in "xyz"]
        laws.check(f"{element}: what the support carries", max(abs(f + end[f"supports_f_{c}"]) for f, c in zip(force, "xyz")) / abs(force[2]), 1e-9)
        laws.check("  friction over its coefficient", abs(abs(force[0] / force[2]) / .3 - 1), .1)
        ends[element] = abs(force[2])
    laws.check("forces of linear and quadratic cells", max(ends.values()) / min(ends.values()) - 1, .08)


def sheared_balls(laws):
    exact = half_space.Hertz(3, half_space.POISSON["partial slip"][3], 2)
    run = laws.run(round_tetrahedra.on_ball(laws.folder, (1 / 8, 1 / 7), quarter=False))
    rows = [row for row in run.last() if row["contact"] == "joint" and row["area"] > 0]
    check(laws, "sheared", round_tetrahedra.pressure_errors(rows, exact, 2), BOUNDS)
    check(laws, "sheared", errors_of_shear(rows, exact),
          {"shear force": 5e-3, "stick width from the forces": .01, "shear stress in L2": .06, "edge of the stick zone": .06})
