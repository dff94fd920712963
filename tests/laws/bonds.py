# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laws of bonds in closed form: a block that is glued to a plate is pulled, sheared and bent off it."""
import math
from pathlib import Path

from laws.layers import SPRINGS, YOUNG, clamped, sliding
from support.scenes import box, contact, floor, load, merge, support

SHIPPED = Path(__file__).resolve().parents[2] / "parameter-files"
T, LENGTH = 2.0, .01  # of elastic T/YOUNG = .002, stable for YOUNG > T/LENGTH


def glued(dim, pulled, times, n=2, **law):
    """A unit cube without lateral strain whose top goes up by `pulled`."""
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    scene = {"Dimension": dim, "Body block": box((n,) * dim, (1.0,) * dim, young=YOUNG, poisson=0.0),
             "Obstacle floor": floor(dim), "Contact bottom": contact(ids=bottom, mu=.3, **law),
             "Support top": support(top, "y" if dim == 2 else "z", pulled), "Support side": support(0, "x"),
             "Time": {"Times": times}, "Output": {"VTU": 0}}
    if dim == 3:
        scene["Support front"] = support(2, "y")
    return scene


def zone(u, opened=0.0):
    """Stress and gap of a softening zone under a column that is stretched by u."""
    if opened == 0 and u <= T / YOUNG:
        return YOUNG * u, 0.0
    gap = (u - T / YOUNG) / (1 - T / LENGTH / YOUNG)
    if gap >= opened:
        return (T * (1 - gap / LENGTH), gap) if gap < LENGTH else (0.0, u)
    if opened >= LENGTH:
        return min(YOUNG * u, 0.0), max(u, 0.0)
    slope = T * (1 - opened / LENGTH) / opened  # back to 0 along a line
    gap = max(u / (1 + slope / YOUNG), 0.0)
    return (slope * gap if u > 0 else YOUNG * u), gap


def pulled(laws):
    softens = {"Tensile strength": T, "Cohesion": 1, "Cohesion lost": "opening", "Softening length": LENGTH}
    times = "1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12"
    # up, back to pressure, up again until all is lost, and down
    ways = [.001, .0019, .004, .006, .003, -.001, .003, .006, .008, .012, .005, -.002]
    table = "table(t; 0 : 0; " + "; ".join(f"{i + 1} : {u}" for i, u in enumerate(ways)) + ")"
    for dim, backend in ((2, "condensed"), (2, "iterative"), (3, "condensed"), (3, "iterative")):
        what = f"{dim}D, {backend}, pulled"
        run = laws.run(merge(glued(dim, table, times, **softens), {"Solver": {"Backend": backend}}))
        opened, stress, gap = 0.0, 0.0, 0.0
        for i, u in enumerate(ways):
            s, g = zone(u, opened)
            opened = max(opened, g)
            rows = [row for row in run.rows if row["increment"] == i + 1]
            stress = max(stress, *(abs(row["pressure"] + s) for row in rows))
            gap = max(gap, *(abs(row["gap"] - g) for row in rows))
        laws.check(f"{what}: stress", stress / T, 1e-9)
        laws.check(f"{what}: opening", gap / LENGTH, 1e-9)
        laws.check(f"{what}: energy of fracture", abs(run.increments[-1]["bottom_fracture"] / (T * LENGTH / 2) - 1), 1e-6)
        laws.demand(f"{what}: bonded until it opens",
                    all((row["state"] == "bonded") == (row["time"] < 2.5) for row in run.rows))
    for lost, stays in (("never", True), ("opening", False)):
        for dim in (2, 3):
            run = laws.run(glued(dim, "0.004*min(t, 1) - 0.004*max(t - 1, 0)", "0.25, 0.5, 0.75, 1, 2",
                                 **{"Tensile strength": T, "Cohesion lost": lost}))
            expected = [-1, -2, -2, -2, 0] if stays else [-1, -2, -2, 0, 0]
            error = max(abs(row["pressure"] - expected[int(row["increment"]) - 1]) for row in run.rows)
            laws.check(f"{dim}D, {lost} lost: pressure", error, 1e-9)


def elastic(laws):
    """A bond in a soft layer stretches by C p before it opens, and then softens: u = q/E + C q + gap, q = T (1 - gap/L)."""
    C, ways = 2e-3, [.002, .0059, .008, .011, .014, .02]
    table = "table(t; 0 : 0; " + "; ".join(f"{i + 1} : {u}" for i, u in enumerate(ways)) + ")"
    for dim, backend in ((2, "condensed"), (2, "iterative"), (3, "condensed"), (3, "iterative")):
        scene = glued(dim, table, "1, 2, 3, 4, 5, 6", Compliance=C, **{"Tensile strength": T, "Cohesion": 1, "Cohesion lost": "slip",
                                                                      "Softening length": .02})
        run = laws.run(merge(scene, {"Solver": {"Backend": backend}}))
        worst = 0.0
        for i, u in enumerate(ways):
            stress = u / (1 / YOUNG + C)
            if stress > T:
                gap = (u - T * (1 / YOUNG + C)) / (1 - T / .02 * (1 / YOUNG + C))
                stress = max(0.0, T * (1 - gap / .02))
            worst = max(worst, *(abs(row["pressure"] + stress) for row in run.rows if row["increment"] == i + 1))
        laws.check(f"{dim}D, {backend}, a bond in a layer: stress", worst / T, 1e-9)
    # stuck in a layer that gives way by shear, softening where it slips: each node obeys its own law
    scene = glued(2, "-0.002*min(t, 1)", "1", n=6, **{"Tensile strength": .3, "Cohesion": .7, "Cohesion lost": "slip",
                                                     "Softening length": .01, "Shear compliance": 1e-3})
    scene["Support top"] = support(3, "x, y", "0.001*max(t - 1, 0) ; -0.002*min(t, 1)")
    del scene["Support side"]
    scene["Time"] = {"End": 20, "Increments": 20}
    run = laws.run(scene)
    laws.demand("sheared in a layer: runs to its end, with slip", any(row["state"] == "slip" for row in run.last()))


def sheared(laws):
    """Block on springs between two plates: k u + 2 (mu p + c (1 - u/L)) = F."""
    p, c, length = 10.0, 3.0, 1.0
    for dim, backend in ((2, "condensed"), (2, "iterative"), (3, "condensed"), (3, "iterative")):
        what = f"{dim}D, {backend}, sheared"
        law = {"Cohesion": c, "Cohesion lost": "slip", "Softening length": length}
        scene = merge(clamped(dim, .01, "40*t", increments=20, mu=.2, **law), {"Solver": {"Backend": backend}})
        expected = []
        for i in range(20):
            pushed = 40 * (i + 1) / 20
            u = max(0.0, (pushed - 2 * .2 * p - 2 * c) / (SPRINGS - 2 * c / length))
            expected.append(u if u < length else (pushed - 2 * .2 * p) / SPRINGS)
        run = laws.run(scene)
        sliding(laws, f"{what}: slides", run, expected)
        laws.check(f"{what}: energy of fracture", abs(run.increments[-1]["below_fracture"] / (c * length / 2) - 1), 1e-6)
        scene = merge(clamped(dim, .01, "20*t", increments=10, mu=.2, Cohesion=c), {"Solver": {"Backend": backend}})
        run = laws.run(scene)
        sliding(laws, f"{what}, never lost", run, [max(0.0, (2 * (i + 1) - 4 - 2 * c) / SPRINGS) for i in range(10)])
        scene = merge(clamped(dim, .01, "20*t", increments=10, mu=.2, Cohesion=c, **{"Cohesion lost": "slip"}),
                      {"Solver": {"Backend": backend}})
        expected, lost = [], False
        for i in range(10):
            u = max(0.0, (2 * (i + 1) - 4 - (0 if lost else 2 * c)) / SPRINGS)
            lost = lost or u > 0
            expected.append(u)
        sliding(laws, f"{what}, lost at once", laws.run(scene), expected)


def lifted(laws):
    """Cohesion without tensile strength holds what is open, too: a block is lifted, and its feet bear the shear."""
    for dim, backend in ((2, "condensed"), (3, "condensed"), (3, "iterative")):
        scene = glued(dim, "0.002*t", "1, 2, 3", n=3, Cohesion=3)
        along = "0.003*t ; 0.002*t" if dim == 2 else "0.003*t ; 0 ; 0.002*t"
        scene["Support top"] = support(3 if dim == 2 else 5, "x, y" if dim == 2 else "x, y, z", along)
        del scene["Support side"]
        scene.pop("Support front", None)
        run = laws.run(merge(scene, {"Solver": {"Backend": backend}}))
        friction = [sum(row[c]**2 for c in ("traction_t1", "traction_t2"))**.5 for row in run.rows]
        laws.demand(f"{dim}D, {backend}: all are open and none presses", all(row["state"] == "open" and abs(row["r_n"]) < 1e-9 for row in run.last()))
        laws.check("  friction within cohesion", max(friction) / 3 - 1, 1e-9)
        laws.demand("  and not nothing", max(friction) > .5)


def tensile_shear(laws):
    """What is pulled by half its strength has that much less friction, mu p + c with p < 0."""
    for dim in (2, 3):
        scene = clamped(dim, "-0.001", "10*t", mu=.5, Cohesion=3, **{"Tensile strength": 2})
        run = laws.run(scene)
        sliding(laws, f"{dim}D, sheared while it is pulled", run,
                [max(0.0, ((i + 1) - 2 * (3 - .5)) / SPRINGS) for i in range(10)])


def bent(laws):
    """A stiff block is turned off its plate about one edge: all of it has parted in the end."""
    for dim in (2, 3):
        top, down = (3, 2) if dim == 2 else (5, 4)
        n = (8, 2) if dim == 2 else (8, 2, 2)
        scene = {"Dimension": dim, "Body block": box(n, (2.0, 1.0, 1.0)[:dim], young=1e5, poisson=0.0),
                 "Obstacle floor": floor(dim),
                 "Contact bottom": contact(ids=down, mu=0, **{"Tensile strength": T, "Cohesion lost": "opening",
                                                             "Softening length": LENGTH}),
                 "Support top": support(top, "x, y" if dim == 2 else "x, y, z",
                                        "0 ; 0.02*t*x + 0.001*t" if dim == 2 else "0 ; 0 ; 0.02*t*x + 0.001*t"),
                 "Time": {"End": 20, "Increments": 40}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        laws.check(f"{dim}D, bent off: energy of fracture", abs(run.increments[-1]["bottom_fracture"] / (T * LENGTH) - 1), 1e-6)
        laws.demand("  nothing is held", all(row["state"] == "open" and abs(row["r_n"]) < 1e-9 for row in run.last()))
        # moments of what the nodes bear, against the support's own
        worst = 0.0
        for record in run.increments:
            rows = [row for row in run.rows if row["increment"] == record["increment"]]
            pull = sum(row["r_n"] for row in rows)
            worst = max(worst, abs(pull + record["support_top_f_" + ("y" if dim == 2 else "z")]))
        laws.check("  force of the support", worst / (2 * T), 1e-9)


def pier(laws):
    """The shipped pier of stones: its bed joint slides by friction alone in the end, and has taken c A L / 2."""
    run = laws.run(SHIPPED / "masonry-pier.prm", "-s", "Output/VTU=0")
    laws.check("pier: friction in the end", abs(run.increments[-1]["support_jack_f_x"] / 15000 - 1), 1e-9)
    laws.check("pier: energy of fracture", abs(run.increments[-1]["middle_high_fracture"] / 500 - 1), 1e-6)
    peak = max(record["support_jack_f_x"] for record in run.increments)
    laws.demand(f"pier: the highest force, {peak:.0f}, is below that of all cohesion at once", 15000 < peak < 35000)


SOFT = 40.0  # of the springs that drag it [force/length]


def dragged_by_springs(dim, increments, **law):
    """A stiff block pressed by 10 and dragged by springs whose far ends go 0.1 t along x, over an area of 2."""
    size, sides = ((2.0, .1), (2, 3)) if dim == 2 else ((2.0, 1.0, .1), (4, 5))
    return {"Dimension": dim, "Body block": box((6, 1) if dim == 2 else (6, 2, 1), size, young=1e5, poisson=0.0),
            "Obstacle floor": floor(dim), "Contact bottom": contact(ids=sides[0], **{"Kinematics": "small", **law}),
            "Support drag": support(sides[1], "x", "0.1*t", Stiffness=SOFT / 2),
            **({} if dim == 2 else {"Support across": support(2, "y")}),
            "Load press": load("pressure", "5", sides[1]), "Time": {"Times": increments}, "Output": {"VTU": 0}}


def snaps(laws):
    """What softens faster than its springs let go jumps to where the friction that is left holds it, slip s: SOFT (d - s) = it."""
    falling = "0.4*(0.5 + 0.5*exp(-v/0.001))"
    for name, law, peak, rest in (
            ("cohesion lost by slip", {"mu": .2, "Cohesion": 1, "Cohesion lost": "slip", "Softening length": .01}, 4, 2),
            ("cohesion and strength", {"mu": .2, "Cohesion": 1, "Tensile strength": .5, "Cohesion lost": "slip",
                                       "Softening length": .01}, 4, 2),
            ("a strength of more than c/mu", {"mu": .2, "Cohesion": .3, "Tensile strength": 2}, 2.6, 2.6),
            ("friction that falls with speed", {"mu": falling}, 4, 2),
            ("both", {"mu": falling, "Cohesion": 1, "Cohesion lost": "slip", "Softening length": .01}, 6, 2)):
        for dim in (2, 3):
            t = peak / SOFT / .1  # when it lets go
            run = laws.run(dragged_by_springs(dim, f"{.98 * t!r}, {1.05 * t!r}", **law))
            forces = [abs(record["bottom_f_x"]) for record in run.increments]
            laws.check(f"{dim}D, {name}: held before", abs(forces[0] / (.98 * peak) - 1), 1e-3)
            laws.check("  and after", abs(forces[1] / rest - 1), 1e-3)
            slip = .105 * t - rest / SOFT
            laws.check("  slip", max(abs(row["u_t1"] / slip - 1) for row in run.last()), 1e-2)


def pushed(laws):
    """A support pushes nodes of a glued block along the floor: friction of these is mu p + c at once, however short the way."""
    c = .4
    for dim in (2, 3):
        for motion in ("1e-7*t", "0.0003*t", "0.001*t", "0.003*t"):
            for law in ({"Cohesion": c}, {"Cohesion": c, "Tensile strength": .5}, {"Cohesion": c, "Shear compliance": 1e-5}):
                scene = {"Dimension": dim, "Body block": box((4, 2) if dim == 2 else (4, 2, 2), (2.0, 1.0, 1.0)[:dim]),
                         "Obstacle floor": floor(dim), "Contact bottom": contact(ids=2 * dim - 2, mu=.3, **law),
                         "Support side": support(0, "x", motion), "Load press": load("pressure", "5*t", 2 * dim - 1),
                         "Output": {"VTU": 0}}
                rows = laws.run(scene).last()
                what = f"{dim}D, pushed by {motion}, {', '.join(law)}"
                limit = {id(row): .3 * row["r_n"] + c * row["area"] for row in rows}
                friction = {id(row): math.hypot(row["r_t1"], row["r_t2"]) for row in rows}
                dragged = [row for row in rows if row["x"] == 0] if "Shear compliance" not in law else []
                laws.check(f"{what}: friction at its limit", max((abs(friction[id(row)] / limit[id(row)] - 1) for row in dragged), default=0.0), 1e-9)
                if dim == 2 and "Shear compliance" in law:  # a layer lets the pushed node stick
                    size = float(motion[:-2])
                    laws.check("  as its layer is sheared", max(abs(friction[id(row)] / min(size / 1e-5 * row["area"], limit[id(row)]) - 1)
                                                                for row in rows if row["x"] == 0), 1e-9)
                laws.demand("  no more anywhere", all(friction[id(row)] <= limit[id(row)] * (1 + 1e-9) for row in rows))
                laws.demand("  and less only without slip", all(row["state"] == "slip" or "Shear compliance" in law or math.hypot(row["du_t1"], row["du_t2"]) < 1e-12 for row in rows))
    # a bond that holds next to nothing changes nothing
    none, little = (laws.run(merge(scene, {"Contact bottom": {"Cohesion": cohesion, "Shear compliance": 0}})) for cohesion in (0, 1e-9))
    laws.check("a bond of next to nothing", max(math.dist((one["r_n"], one["r_t1"], one["r_t2"]), (two["r_n"], two["r_t1"], two["r_t2"]))
                                                for one, two in zip(none.last(), little.last())), 1e-7)


def way_of_slip(laws):
    """What goes along while its bond opens does not slip in contact: friction that falls with s begins at s = 0."""
    for dim in (2, 3):
        for lost, length in (("slip", LENGTH), ("opening", LENGTH), ("slip", None)):
            law = {"Tensile strength": T, "Cohesion": 1, "Cohesion lost": lost, **({"Softening length": length} if length else {})}
            scene = glued(dim, "0", "1, 2, 3", **law)
            scene["Contact bottom"]["Friction coefficient"] = "table(s; 0 : 0.5; 0.004 : 0.2)"
            del scene["Support side"]
            up = "table(t; 0 : 0; 1 : 0.02; 2 : -0.002; 3 : -0.002)"
            scene["Support top"].update({"Directions": "x, y, z"[:3 * dim - 2], "Displacement": f"0.01*t ; {'0 ; ' * (dim - 2)}{up}"})
            run = laws.run(scene)
            what = f"{dim}D, lost by {lost}{'' if length else ' at once'}"
            laws.demand(f"{what}: open, then all slip", all(row["state"] == ("open" if row["time"] == 1 else "slip") for row in run.rows))
            for t, mu in ((2, .5), (3, .2)):
                laws.check(f"  friction at t = {t}", max(abs(math.hypot(row["r_t1"], row["r_t2"]) - mu * row["r_n"]) for row in run.rows
                                                       if row["time"] == t), 1e-9)


def bonds(laws):
    way_of_slip(laws)
    pushed(laws)
    snaps(laws)
    pier(laws)
    pulled(laws)
    elastic(laws)
    sheared(laws)
    lifted(laws)
    tensile_shear(laws)
    bent(laws)
    scene = glued(3, "0.01*t", "0.1, 0.3, 0.5, 0.7, 0.9", **{"Tensile strength": "2 + x", "Cohesion": 1, "Cohesion lost": "slip",
                                                            "Softening length": LENGTH})
    scene["Output"]["Checkpoint"] = 1
    whole = laws.run(scene)
    half = laws.run(scene, "-s", "Time/Times=0.1, 0.3")
    laws.same("continued", whole, laws.run(scene, "--restart", half.folder), 1e-10)
    scene["Load side"] = load("pressure", "0.3*t", ids=1)
    laws.same("iterative", laws.run(scene), laws.run(scene, "-s", "Solver/Backend=iterative"), 1e-8)
