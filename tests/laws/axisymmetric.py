# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies of revolution: x is the radius, y the axis, forces are those of the whole circumference."""
import itertools
import math

from laws.driven import energy
from support.checks import orders
from support.meshes import distorted
from support.scenes import box, contact, floor, joint, load, merge, support

YOUNG, POISSON = 1000.0, .3
ELEMENTS = ("Q1", "Q1 B-bar", "P1")


def section(cells, size, origin, element="automatic", young=YOUNG, poisson=POISSON, **mesh):
    """A ring or disc: ids 0 inside, 1 outside, 2 bottom, 3 top."""
    return merge(box(cells, size, origin, young, poisson, **mesh), {"Element": element, "Material": {"Plane": "axisymmetric"}})


def scene(**entries):
    return {"Dimension": 2, "Output": {"VTU": 0}, **{name.replace("_", " "): entry for name, entry in entries.items()}}


def radial(row):
    """Displacement along x of a node on a floor."""
    return row["u_t1"]


def patch(laws):
    """Uniform stresses -p along the axis and -q all round, of rings and discs; areas contain 2 pi r."""
    p, q = 9.0, 3.0
    for (name, shift, element), poisson in itertools.product(
            (("ring", 1.0, "Q1"), ("ring", 1.0, "Q1 B-bar"), ("ring", 1.0, "P1"), ("disc", 0.0, "Q1"),
             ("disc", 0.0, "Q1 B-bar"), ("disc", 0.0, "P1")), (.3, .49)):
        file = laws.folder / "distorted.msh"
        distorted(file, 2)
        body = {"Element": element, "Mesh": {"File": file.name, "Translation": (shift, 0.0)},
                "Material": {"Young modulus": YOUNG, "Poisson ratio": poisson, "Plane": "axisymmetric"}}
        if element != "P1":
            body["Mesh"]["Refinement boxes"] = f"{shift + .4!r}, 0 : {shift + .6!r}, 0.3 : 2"
        sides = {"Load outside": load("pressure", q, 11)}
        if shift:
            sides["Load inside"] = load("pressure", q, 10)
        run = laws.run({**scene(), "Body block": body, "Obstacle floor": floor(2), "Contact bottom": contact(ids=12),
                        "Load top": load("pressure", p, 13), **sides})
        what = f"{name}, {element}, nu = {poisson}"
        laws.check(f"{what}: pressure", max(abs(row["r_n"] / row["area"] - p) for row in run.rows) / p, 1e-12)
        strain = (-q * (1 - poisson) + poisson * p) / YOUNG
        laws.check(f"{what}: u_r", max(abs(radial(row) - strain * row["x"]) for row in run.rows) / abs(strain), 1e-12)
        area = math.pi * ((shift + 1)**2 - shift**2)
        laws.check(f"{what}: areas", abs(sum(row["area"] for row in run.rows) / area - 1), 1e-13)
        last = run.increments[-1]
        laws.check(f"{what}: force of the load", abs(last["load_top_f_y"] / (-p * area) - 1), 1e-13)
        laws.check(f"{what}: force of the contact", abs(last["bottom_f_y"] / (p * area) - 1), 1e-12)
        outside = last["load_outside_f_x"] / (-q * 2 * math.pi * (shift + 1))
        laws.check(f"{what}: radial force of the load", abs(outside - 1), 1e-13)


def joints(laws):
    """A uniform pressure through meshes that do not match: with the radius in its weights mortar passes it."""
    p = 2.0
    for radius, ratio, exchanged in itertools.product((0.0, 1.0), ((2, 3), (7, 5)), (False, True)):
        blocks = (section((n, 3), (2.0, 1.0), (radius, y)) for n, y in zip(ratio, (0.0, 1.0)))
        sides = (("lower", 3), ("upper", 2))
        run = laws.run({**scene(), **dict(zip(("Body lower", "Body upper"), blocks)),
                        "Contact joint": joint(*itertools.chain(*(sides if exchanged else sides[::-1])), **{"Friction coefficient": 0}),
                        "Support ground": support(2, "y", body="lower"),
                        "Load top": load("pressure", p, 3, "upper")})
        rows = [row for row in run.last() if row["contact"] == "joint"]
        what = f"joint of {ratio[0]} on {ratio[1]} cells from r = {radius}{', exchanged' * exchanged}"
        laws.check(f"{what}: pressures", max(abs(row["r_n"] / row["area"] - p) for row in rows) / p, 1e-10)
        force = p * math.pi * ((radius + 2)**2 - radius**2)
        laws.check(f"{what}: force", abs(abs(run.increments[-1]["joint_f_y"]) / force - 1), 1e-12)


def thick_tube(laws):
    """Lame: pressure q outside a tube a < r < b between plates, u_r = -(1 + nu) q b^2 ((1 - 2 nu) r + a^2/r)/(E (b^2 - a^2))."""
    a, b, q = 1.0, 2.0, 5.0
    for element, poisson in (("Q1", .3), ("Q1 B-bar", .3), ("Q1 B-bar", .499), ("P1", .3)):
        sizes, errors = (8, 16, 32), []
        for n in sizes:
            run = laws.run({**scene(), "Body tube": section((n, 2), (b - a, .25), (a, 0.0), element, poisson=poisson),
                            "Obstacle floor": floor(2), "Contact bottom": contact("tube"),
                            "Support top": support(3, "y", body="tube"), "Load outside": load("pressure", q, 1, "tube")})
            factor = -(1 + poisson) * q * b**2 / (YOUNG * (b**2 - a**2))
            exact = [factor * ((1 - 2 * poisson) * row["x"] + a**2 / row["x"]) for row in run.rows]
            along = 2 * poisson * q * b**2 / (b**2 - a**2)  # the pressure on the plates
            errors.append((max(abs(radial(row) - u) for row, u in zip(run.rows, exact)) / max(map(abs, exact)),
                           abs(run.increments[-1]["bottom_f_y"] / (along * math.pi * (b**2 - a**2)) - 1)))
        order = orders(sizes, errors)
        print(f"  {element}, nu = {poisson}: errors {errors[-1]}, orders {order}")
        laws.check(f"thick tube, {element}, nu = {poisson}: displacement", errors[-1][0], 2e-3)
        laws.check(f"thick tube, {element}, nu = {poisson}: 1.9 less the order", 1.9 - order[0], 0)
        laws.check(f"thick tube, {element}, nu = {poisson}: force on the plates", errors[-1][1], 2e-3)


def press_fit(laws):
    """Tubes 1..2 and 2..3 with an interference: Lame's pressure, of steel in bronze."""
    a, b, c, interference, outer_young = 1.0, 2.0, 3.0, .002, 600.0
    stiffness = (b / outer_young * ((c**2 + b**2) / (c**2 - b**2) + POISSON) +
                 b / YOUNG * ((b**2 + a**2) / (b**2 - a**2) - POISSON))
    pressure = interference / stiffness
    for pairing, cells in (("node to face", (6, 6)), ("mortar", (6, 6)), ("mortar", (6, 9))):
        errors = []
        for n in (12, 24, 48):
            run = laws.run({**scene(),
                            "Body inner": section((n, cells[0]), (b - a, .5), (a, 0.0)),
                            "Body outer": section((n, cells[1]), (c - b, .5), (b, 0.0), young=outer_young),
                            "Contact joint": joint("inner", 1, "outer", 0, Gap=-interference, Pairing=pairing,
                                                   **{"Friction coefficient": 0}),
                            "Support inner": support(2, "y", body="inner"), "Support outer": support(2, "y", body="outer")})
            rows = [row for row in run.last() if row["contact"] == "joint"]
            last = run.increments[-1]
            force = pressure * 2 * math.pi * b * .5
            errors.append((max(abs(row["r_n"] / row["area"] / pressure - 1) for row in rows),
                           abs(abs(last["joint_f_x"]) / force - 1)))
            laws.check(f"press fit, {pairing}, {cells[0]} on {cells[1]} cells: forces of both sides",
                       abs(last["joint_f_x"] + last["joint_master_f_x"]) / force, 1e-12)
        what = f"press fit, {pairing}, {cells[0]} on {cells[1]} cells"
        laws.check(f"{what}: radial force round the joint", errors[-1][1], 1e-3)
        laws.check(f"{what}: pressures, also at the ends", errors[-1][0], 2e-3)
        laws.check(f"{what}: 1 less the order of the pressures", 1 - orders((12, 24, 48), errors)[0], 0)


def weights(laws):
    """Loads of every kind are of the whole circumference; a body that floats moves along the axis only."""
    density, height, radius = 3.0, 1.5, 2.0
    area, volume = math.pi * radius**2, math.pi * radius**2 * height
    for element in ELEMENTS:
        run = laws.run({**scene(), "Body block": section((5, 4), (radius, height), (0.0, 0.0), element),
                        "Obstacle floor": floor(2), "Contact bottom": contact(mu=.3),
                        "Load own weight": load("body force", f"0 ; {-density!r}"),
                        "Load top": load("traction", "0 ; -2 - x", 3),
                        "Load ring": load("point force", "0 ; -11", Point=(1.3, .7)),
                        "Load rim": load("pressure", "0.5", 1)}, bounds=element != "P1")
        last = run.increments[-1]
        top = -2 * area - 2 * math.pi * radius**3 / 3
        for name, force in (("own_weight", -density * volume), ("top", top), ("ring", -11.0)):
            laws.check(f"{element}: load '{name}'", abs(last[f"load_{name}_f_y"] / force - 1), 1e-12)
        laws.check(f"{element}: radial load", abs(last["load_rim_f_x"] / (-.5 * 2 * math.pi * radius * height) - 1), 1e-12)
        total = density * volume - top + 11
        laws.check(f"{element}: reactions", abs(sum(row["r_n"] for row in run.rows) / total - 1), 1e-12)
        laws.admissible(element, run, lambda row: .3)
        balance = max(last[name] for name in ("residual", "equilibrium", "balance"))
        laws.check(f"{element}: residual, equilibrium, balance", balance, 1e-10)


def work(laws):
    """A disc that is pressed, slides outward and is let go: work is energy and dissipation."""
    run = laws.run({**scene(), "Body block": section((10, 6), (2.0, 1.0), (0.0, 0.0), "Q1 B-bar", poisson=.45),
                    "Obstacle floor": floor(2), "Contact bottom": contact(mu=.2),
                    "Support top": support(3, "y", "-0.02*sin(t)"), "Load rim": load("pressure", "-4*(t - sin(t))", 1),
                    "Time": {"End": 3, "Increments": 12}})
    laws.demand("some nodes slip and some stick", {"slip", "stick"} <= {row["state"] for row in run.rows})
    laws.check("work less energy and dissipation", energy(run), 1e-10)
    laws.demand("dissipation is not negative", all(row["dissipation"] >= 0 for row in run.increments))
    laws.admissible("pressed disc", run, lambda row: .2)


def hertz(laws):
    """A ball between plates: force against approach (Hertz, and Tatara's share of the far side), radius, peak pressure."""
    radius = 10.0
    modulus = YOUNG / (1 - POISSON**2)
    for half in (.5, .25):
        approach = half**2 / radius
        run = laws.run({**scene(),
                        "Body ball": {"Mesh": {"Generator": "quarter_hyper_ball", "Arguments": f"0, 0 : {radius!r}",
                                               "Global refinements": 3, "Rotation": -90, "Translation": (0.0, radius),
                                               "Refinement boxes": " ; ".join(
                                                   f"0, 0 : {w!r}, {w!r} : {n}" for n, w in
                                                   ((2, 10 * half), (4, 4 * half), (6 + (half < .4), 1.5 * half))),
                                               "Boundary ids": f"7: y < 1 && x > 1e-6 ; 8: y > {radius - 1e-6!r}"},
                                      "Material": {"Young modulus": YOUNG, "Poisson ratio": POISSON, "Plane": "axisymmetric"}},
                        "Obstacle floor": floor(2), "Contact bottom": contact("ball", 7),
                        "Support equator": support(8, "y", f"{-approach!r}*t", "ball"),
                        "Time": {"End": 1, "Increments": 2}})
        rows = sorted(run.last(), key=lambda row: row["x"])
        force = sum(row["r_n"] for row in rows)
        a = (3 * force * radius / (4 * modulus))**(1 / 3)
        peak = 3 * force / (2 * math.pi * a**2)
        far = (2 * (1 + POISSON) * radius**2 / (a**2 + 4 * radius**2)**1.5 +
               (1 - POISSON**2) / math.sqrt(a**2 + 4 * radius**2)) / (math.pi * YOUNG)
        exact = 3 * force / (4 * modulus * a) - force * far
        what = f"ball, a/R = {a / radius:.3f}"
        laws.check(f"{what}: approach", abs(approach / exact - 1), .005)
        touching = [row for row in rows if row["r_n"] > 0]
        laws.check(f"{what}: peak pressure", abs(touching[0]["r_n"] / touching[0]["area"] / peak - 1), .02)
        spread = math.sqrt(2.5 * sum(row["r_n"] * row["x"]**2 for row in rows) / force)
        laws.check(f"{what}: radius from the spread", abs(spread / a - 1), .01)
        profile = max(abs(row["r_n"] / row["area"] - peak * math.sqrt(1 - (row["x"] / a)**2))
                      for row in rows if row["x"] < .8 * a) / peak
        laws.check(f"{what}: pressure over the inner 80 %", profile, .03)


def axisymmetric(laws):
    for law in (patch, joints, thick_tube, press_fit, weights, work, hertz):
        law(laws)
