# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The families of hard cases: each is a function that returns its cases."""
import math
from pathlib import Path

from program import Case, read, run

SCENES = Path(__file__).resolve().parents[2] / "parameter-files"
SQUARE = SCENES / "square-greco.prm"  # example 5.1 of [K]
INCLINED = SCENES / "inclined-obstacle.prm"  # example 5.2 of [K]
BLOCK = SCENES / "block-press-shear.prm"
FLOATING = SCENES / "floating-block.prm"
STACK = SCENES / "stacked-blocks.prm"

MU = "Contact bottom/Friction coefficient"
MESH = "Body block/Mesh/Arguments"
TOP = "Support top/Displacement"
SHOWN = ((SQUARE, "5.1"), (INCLINED, "5.2"), (BLOCK, "block"))


def mesh(cells, size):
    return ", ".join(map(str, cells)) + " : " + ", ".join("0" for _ in size) + " : " + \
        ", ".join(map(repr, size)) + " : true"


def block_cells(n):
    return {MESH: mesh((n, n, n), (1, 1, 1))}


def friction_values():
    """40 values from 0 to 100."""
    return [0.0] + [float(f"{10 ** (-2 + 4 * i / 38):.4g}") for i in range(39)]


def friction(setup):
    return [Case(f"{name}, mu = {mu:g}", scene, {MU: mu, **(setup.block if scene == BLOCK else {})})
            for scene, name in SHOWN for mu in friction_values()]


def incompressible(setup):
    return [Case(f"{name}, nu = {nu}, mu = {mu}", scene,
                 {f"Body {'square' if scene == SQUARE else 'block'}/Material/Poisson ratio": nu, MU: mu,
                  **(block_cells(8) if scene == BLOCK else {})})
            for scene, name in SHOWN for nu in (.49, .499, .4999) for mu in (.1, .5, 1, 3)]


def contrast(setup):
    young = {"lower": 3, "middle": 1, "upper": 2}
    return [Case(f"{body} block {factor:g} times as stiff, mu = {mu}", STACK,
                 {f"Body {body}/Material/Young modulus": young[body] * factor,
                  "Contact joint 1/Friction coefficient": mu, "Contact joint 2/Friction coefficient": mu})
            for body in young for factor in (1e6, 1e-6) for mu in (.1, .4, 1)]


def slender(setup):
    inclined = "-0.0005*max(t - 1, 0) ; -0.007*min(t, 1)"
    forms = [
        ("lying strip", INCLINED, {MESH: mesh((400, 4), (80.0, .8)), TOP: inclined,
                                   "Obstacle plane/Gap": "0.01*(80 - x)/80"}),
        ("strip on end", INCLINED, {MESH: mesh((4, 400), (.8, 80.0)), TOP: inclined, "Obstacle plane/Normal": "-1, 80",
                                    "Obstacle plane/Gap": "0.01*(0.8 - x)/0.8"}),
        ("floating strip", FLOATING, {MESH: mesh((200, 2), (100.0, 1.0)), "Load weight/Value": "0.01*t",
                                      "Load push/Value": "0.99*{mu}*t"}),
        ("long bar", BLOCK, {MESH: mesh((100, 2, 2), (100.0, 1.0, 1.0))}),
        ("bar on end", BLOCK, {MESH: mesh((2, 2, 100), (1.0, 1.0, 100.0))}),
        ("plate", BLOCK, {MESH: mesh((24, 24, 1), (100.0, 100.0, 1.0))})]
    return [Case(f"{name}, mu = {mu}", scene,
                 {key: value.format(mu=mu) for key, value in settings.items()} | {MU: mu})
            for name, scene, settings in forms for mu in (.1, .3, 1)]


def in_units(scene, length, stress):
    """Lengths and loads in other units, and Young's modulus with them."""
    if scene == SQUARE:
        return {"Body square/Mesh/Scale": length, "Body square/Material/Young modulus": 130000 * stress,
                "Load left/Value": f"{100 * stress!r}*t", "Load top/Value": f"{50 * stress!r}*t"}
    if scene == INCLINED:
        return {"Body block/Mesh/Scale": length, "Body block/Material/Young modulus": 5 * stress,
                "Obstacle plane/Gap": f"({80 * length!r} - x)/80",
                TOP: f"{-.05 * length!r}*max(t - 1, 0) ; {-.7 * length!r}*min(t, 1)"}
    return {"Body block/Mesh/Scale": length, "Body block/Material/Young modulus": stress,
            TOP: f"{.002 * length!r}*max(t - 1, 0) ; 0 ; {-.01 * length!r}*min(t, 1)"}


def units(setup):
    powers = range(-9, 10)
    systems = [(10.0 ** k, 10.0 ** k) for k in powers] + [(10.0 ** k, 10.0 ** -k) for k in powers if k % 3 == 0 and k]
    return [Case(f"{name}, lengths {length:g}, stresses {stress:g}", scene,
                 in_units(scene, length, stress) | (block_cells(8) if scene == BLOCK else {}), group=name)
            for scene, name in SHOWN for length, stress in systems]


def floating(dim, width=2, height=1):
    """The floating block with other proportions, p = 1 and q = t times the result's push."""
    n = 10 if dim == 2 else 5
    if dim == 2:
        return {MESH: mesh((n * width, n * height), (width, height)), "Load weight/Value": f"{1 / width!r}*t"}
    return {"Dimension": 3, MESH: mesh((n * width, n, n * height), (width, 1, height)),
            "Obstacle floor/Normal": "0, 0, 1", "Contact bottom/Boundary ids": 4, "Load weight/Boundary ids": 5,
            "Load weight/Value": f"{1 / width!r}*t"}


def sliding(setup):
    held = [.04 * i for i in range(12)] + [.48, .49, .499, .4999]
    cases = [(q, None) for q in held] + [(q, r"slides along \(1, 0, 0\)") for q in (.5001, .55, 1.0, 5.0)]
    return [Case(f"{dim}D, q/p = {q:.4g}", FLOATING, {**floating(dim), "Load push/Value": f"{q!r}*t"}, refused)
            for dim in (2, 3) for q, refused in cases]


def tipping(setup):
    held = (0.0, .1, .2, .24, .249, .2499)
    cases = [(q, None) for q in held] + [(q, "tips over") for q in (.2501, .251, .26, .4)]
    return [Case(f"{dim}D, q/p = {q:g}", FLOATING,
                 {**floating(dim, 1, 2), "Load push/Kind": "traction", "Load push/Boundary ids": 2 * dim - 1,
                  "Load push/Value": f"{q!r}*t ; 0" + (" ; 0" if dim == 3 else "")}, refused)
            for dim in (2, 3) for q, refused in cases]


def unloading(setup):
    """Up to the peak at t = 1, down to a fraction of it at t = 2."""
    cases = []
    for left in [10.0 ** -k for k in range(1, 9)] + [0.0]:
        g = f"(min(t, 1) - {1 - left!r}*max(t - 1, 0))"
        scenes = [("5.1", SQUARE, {"Load left/Value": f"100*{g}", "Load top/Value": f"50*{g}"}),
                  ("5.2", INCLINED, {TOP: f"-0.3*{g} ; -0.7*{g}", "Obstacle plane/Gap": "0"}),
                  ("block", BLOCK, {TOP: f"0.005*{g} ; 0.002*{g} ; -0.01*{g}", **block_cells(8)})]
        scenes += [(f"floating {d}D", FLOATING,
                    {**floating(d), "Load weight/Value": f"0.5*{g}", "Load push/Value": f"0.45*{g}"}) for d in (2, 3)]
        cases += [Case(f"{name}, down to {left:g}", scene, {**settings, "Time/End": 2, "Time/Increments": 2})
                  for name, scene, settings in scenes]
    return cases


def grazing_at_start(number):
    """A block that comes down until a corner, or all nodes, are at 1e-12 from touching: freely, or from deeper."""
    rest = (1e-12, 1e-13, 0.0, -1e-13, -1e-12)[number % 5]
    gap, tilt = .1 + .037 * number, (0.0, .5)[number // 5 % 2]
    mu, deeper = (0.0, .3, 1.0, 10.0)[number % 4], (0.0, .01)[number // 2 % 2]
    return Case(f"arrival {number} from {'below' if deeper else 'above'}, rest {rest:g}, tilt {tilt}, mu {mu}", INCLINED,
                {MESH: mesh((20, 20), (1, 1)), "Obstacle plane/Normal": "0, 1",
                 "Obstacle plane/Gap": f"{gap!r} + {tilt}*x",
                 TOP: f"0.001*t ; {-gap!r}*min(t, 1) + {rest!r}*max(t - 1, 0) - {deeper!r}*(1 - abs(t - 1))",
                 MU: mu, "Time/End": 2, "Time/Increments": 2})


def grazing_in_contact(setup, number):
    """The first open node of a pressed block is brought to within 1e-12 of touching by a dent of its obstacle."""
    press, mu = .3 + .1 * (number % 5), (0.0, .2, .5, 1.0, 5.0)[number // 5 % 5]
    settings = {MESH: mesh((20, 20), (80, 80)), TOP: f"{-.3 * press!r}*t ; {-press!r}*t", MU: mu,
                "Time/End": 1, "Time/Increments": 1}
    rest = (1e-12, -1e-12)[number % 2]
    folder = setup.folder / f"grazing-{number}"
    run(setup.program, Case("", INCLINED, settings), folder)
    rows = [row for row in read(folder / "reactions.csv") if row["state"] == "open"] \
        if (folder / "reactions.csv").exists() else []
    if not rows:
        return Case(f"dent {number}, mu {mu}: all nodes touch", INCLINED, settings)
    node = min(rows, key=lambda row: float(row["gap"]))
    dent = float(node["gap"]) - rest
    gap = f"(80 - x)/80 - {dent!r}*(abs(x - {node['x']}) < 0.01)"
    return Case(f"dent {number}, rest {rest:g}, mu {mu}", INCLINED, {**settings, "Obstacle plane/Gap": gap})


def grazing(setup):
    numbers = range(0, 50, 24 if setup.quick else 1)
    return [grazing_at_start(i) for i in numbers] + [grazing_in_contact(setup, i) for i in numbers]


def groove(setup):
    """Normals 30 degrees above the horizontal, mu = 0.8, W = 1: along the axis friction holds 2 mu N = 1.6 at most.

    Jammed walls could hold any load, so there is no proof against more; it must not be solved all the same."""
    c, s = math.cos(math.pi / 6), .5
    base = {**floating(3), "Contacts": "bottom, right", "Obstacles": "floor, wall",
            MESH: "6, 16, 4 : -0.5, -2, 0 : 0.5, 2, 1 : true",
            "Body block/Mesh/Boundary ids": "7: z < 1e-6 && x < -0.2 ; 8: z < 1e-6 && x > 0.2",
            "Obstacle floor/Shape": "prescribed gap", "Obstacle floor/Normal": f"{c!r}, 0, {s}",
            "Obstacle wall/Shape": "prescribed gap", "Obstacle wall/Normal": f"{-c!r}, 0, {s}",
            "Contact bottom/Boundary ids": 7, "Contact right/Body": "block", "Contact right/Boundary ids": 8,
            "Contact right/Obstacle": "wall", MU: .8, "Contact right/Friction coefficient": .8,
            "Load weight/Value": "0.25*min(t, 1)", "Load push/Kind": "body force", "Load push/Boundary ids": "",
            "Time/End": 2, "Time/Increments": 2}
    cases = [(q, None) for q in (0.0, .4, .8, 1.2, 1.4, 1.5, 1.55, 1.59, 1.599)] + \
        [(q, "not converged|stalled|no equilibrium|solved up to") for q in (1.601, 1.61, 1.7, 2.0, 5.0, 15.0, 25.0, 100.0)]
    return [Case(f"q/W = {q:g}", FLOATING, {**base, "Load push/Value": f"0 ; {q / 4!r}*max(t - 1, 0) ; 0"}, refused)
            for q, refused in cases]


def rotating(setup):
    angle, on = "2*pi*(t - 1)/48", "min(t, 1)"
    time = {"Time/Stages": "1 : 1, 49 : 48", "Time/End": "", "Time/Increments": ""}
    turning = f"0.004*{on}*cos({angle}) ; 0.004*max(min(t - 1, 1), 0)*sin({angle}) ; -0.01*{on}"
    cases = [Case(f"block, mu = {mu}", BLOCK, {**block_cells(8), TOP: turning, MU: mu, **time})
             for mu in (.1, .3, .6, 1)]
    return cases + [
        Case(f"floating block, q/p = {q}", FLOATING,
             {**floating(3), "Load weight/Value": f"0.5*{on}", "Load push/Kind": "body force",
              "Load push/Boundary ids": "",
              "Load push/Value": f"{q / 2}*{on}*cos({angle}) ; {q / 2}*{on}*sin({angle}) ; 0", **time})
        for q in (.1, .3, .45, .499)]


def grids(setup):
    """Floating double-layer grids: the least friction that holds them is sqrt(5)/2 = 1.1180."""
    feet = "Contact feet/Friction coefficient"
    limits = ((1.119, None), (1.118, r"slides along \(0.8944, 0.4472, 0\)"))
    scenes = [SCENES / f"double-layer-grid-{n}.prm" for n in ("04", "07", "10", "12")]
    return [Case(scene.stem, scene) for scene in [*scenes, SCENES / "double-layer-grid-unloading.prm"]] + \
        [Case(f"{scene.stem}, mu = {mu}", scene, {feet: mu}, refused) for scene in scenes for mu, refused in limits]


def stacked(setup):
    return [Case(f"mu = {mu}", STACK, {"Contact joint 1/Friction coefficient": mu,
                                       "Contact joint 2/Friction coefficient": mu})
            for mu in (.05, .1, .2, .3, .4, .6, .8, 1, 1.5, 2)]


def anisotropic(setup):
    return [Case(f"mu = 0.5 and 0.5/{ratio}, first axis at {angle} degrees", BLOCK,
                 {**block_cells(8), MU: .5, "Contact bottom/Second friction coefficient": .5 / ratio,
                  "Contact bottom/Friction angle": angle})
            for ratio in (1, 2, 5, 10, 20, 50, 100) for angle in (0, 30, 90)]


def moving(setup):
    ways = {"sideways": "0.004*t ; 0", "up": "0 ; 0.001*t", "away": "0 ; -0.02*t",
            "up and down": "0.002*t ; 0.004*sin(t)", "around": "0.003*cos(2*t) ; 0.002*sin(2*t)"}
    scenes = (("5.2", INCLINED, "plane", 10, {}), ("block", BLOCK, "floor", 1, block_cells(8)),
              ("floating 2D", FLOATING, "floor", 1, {"Load weight/Value": "0.5*min(t, 1)",
                                                     "Load push/Value": "0.4*min(t, 1)"}),
              ("floating 3D", FLOATING, "floor", 1, {**floating(3), "Load weight/Value": "0.5*min(t, 1)",
                                                     "Load push/Value": "0.4*min(t, 1)"}))
    cases = []
    for name, scene, obstacle, size, settings in scenes:
        for way, text in ways.items():
            parts = [f"{size}*{part}" for part in text.split(" ; ")]
            if "3D" in name or scene == BLOCK:
                parts.insert(1, "0")
            cases.append(Case(f"{name}, obstacle moves {way}", scene,
                              {**settings, f"Obstacle {obstacle}/Displacement": " ; ".join(parts),
                               "Time/End": 8, "Time/Increments": 8}))
    return cases


FAMILIES = {
    "friction": ("friction 0 to 100 on 5.1, 5.2, 3D block", friction),
    "incompressible": ("nu = .49, .499, .4999", incompressible),
    "contrast": ("stiffness contrast 1e6 between bodies", contrast),
    "slender": ("slender bodies 1:100", slender),
    "units": ("units: lengths and loads x 1e-9 to 1e9", units),
    "sliding": ("floating block pushed up to its limit and beyond", sliding),
    "tipping": ("tall block pushed at its top", tipping),
    "unloading": ("loads removed to 1e-1 ... 1e-8 and 0", unloading),
    "grazing": ("grazing contacts, to within 1e-12", grazing),
    "groove": ("V-groove up to its limit and beyond", groove),
    "rotating": ("rotating loads of 48 steps", rotating),
    "grids": ("double-layer grids", grids),
    "stacked": ("three stacked blocks, mu = .05 to 2", stacked),
    "anisotropic": ("anisotropic friction, ratios 1 to 100", anisotropic),
    "moving": ("moving obstacles", moving),
}
