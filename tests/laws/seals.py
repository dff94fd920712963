# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fluids that get between the sides of a contact, in closed form: blocks pressed on a plate by their top."""
import math
import re
from pathlib import Path

from support.logs import log_of
from support.scenes import box, contact, floor, load, merge, support

SHIPPED = Path(__file__).resolve().parents[2] / "parameter-files"
YOUNG, N = 1000.0, 8


def pressed(dim, closing, fluid, mu=.3, **law):
    """A block 2 wide [1 deep], 1 high, without lateral strain; fluid comes from its left side."""
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    scene = {"Dimension": dim, "Body block": box((N, 2, 2)[:dim], (2.0, 1.0, 1.0)[:dim] if dim == 2 else (2.0, 1.0, 1.0),
                                                 young=YOUNG, poisson=0.0),
             "Obstacle floor": floor(dim),
             "Contact bottom": contact(ids=bottom, mu=mu, **{"Penetrating pressure": fluid, "Fluid from boundary ids": 0}, **law),
             "Support top": support(top, "x, y" if dim == 2 else "x, y, z", f"0 ; -({closing})" if dim == 2 else f"0 ; 0 ; -({closing})"),
             "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}
    if dim == 3:
        scene["Support sides"] = support("2, 3", "y")
    return scene


def uniform(laws):
    """Pressed by 10, and a fluid of 5, 15 and 5."""
    for dim, backend in ((2, "condensed"), (2, "iterative"), (3, "condensed"), (3, "iterative")):
        what = f"{dim}D, {backend}"
        run = laws.run(merge(pressed(dim, .01, "if(abs(t - 2) < 0.5, 15, 5)"), {"Solver": {"Backend": backend}}))
        for t, p, gap, state in ((1, 10, 0, "stick"), (2, 15, .005, "wet"), (3, 10, 0, "stick")):
            rows = [row for row in run.rows if row["time"] == t]
            laws.check(f"{what}, t = {t}: pressure", max(abs(row["pressure"] / p - 1) for row in rows), 1e-9)
            laws.check("  gap", max(abs(row["gap"] - gap) for row in rows) / .01, 1e-9)
            laws.demand(f"  {state}", all(row["state"] == state for row in rows))
        laws.demand(f"{what}: it leaks", "leaks" in log_of(run) and "increment 2" in log_of(run))


def away(laws):
    """A contact that begins later, or has ended: sides that do not see each other let no fluid in, and nothing presses them."""
    for dim in (2, 3):
        for active, force in (("t > 1.5", (0, 30, 30)), ("t < 1.5", (30, 0, 0))):
            run = laws.run(pressed(dim, .01, "15", Active=active))
            f = f"bottom_f_{'xyz'[dim - 1]}"
            laws.check(f"{dim}D, Active = {active}: forces", max(abs(i.get(f, 0.0) - e) for i, e in zip(run.increments, force)) / 30, 1e-9)
            laws.demand("  all increments", len(run.increments) == 3)


def wedge(laws):
    """Columns without shear stiffness, pressed by 4 to 20: the fluid of 9 gets to where they are pressed by as much."""
    for dim in (2, 3):
        scene = pressed(dim, "0.004 + 0.008*x", "9*min(t, 1)", mu=0)
        soft = {"Young moduli": f"{YOUNG}, {YOUNG}, {YOUNG}", "Poisson ratios": "0, 0, 0", "Shear moduli": "1e-7, 1e-7, 1e-7"}
        scene["Body block"]["Material"] = soft
        run = laws.run(scene)
        wet = {round(row["x"], 6) for row in run.last() if row["state"] == "wet"}
        columns = [2 * i / N for i in range(N + 1)]
        # a node at the edge bears the pressure of a third of its cell
        expected = {x for x in columns if YOUNG * (.004 + .008 * max(x, 2 / N / 3)) < 9}
        laws.demand(f"{dim}D: wet to where the fluid gets", wet == {round(x, 6) for x in expected})
        laws.check(f"{dim}D: the fluid's pressure", max(abs(row["pressure"] / 9 - 1) for row in run.last() if row["state"] == "wet"), 1e-6)
        laws.check(f"{dim}D: pressure beyond", max(abs(row["pressure"] / (1000 * (.004 + .008 * row["x"])) - 1) for row in run.last()
                                                  if row["state"] != "wet" and max(wet) + 3 / N < row["x"] < 1.9), 1e-6)
        laws.demand(f"{dim}D: it is tight", "leaks" not in log_of(run))


def lubricated(laws):
    """Friction is that of what contact carries beyond the fluid: a block under 10 that is tilted lets a fluid of 9 in."""
    for dim in (2, 3):
        top = 3 if dim == 2 else 5
        scene = pressed(dim, 0, "if(t > 2.5, 9, 0)", mu=.5)
        scene["Support top"] = support(1, "x", Stiffness=10)
        scene["Load press"] = load("pressure", 10, ids=top)
        scene["Load push"] = load("body force", "2*min(t, 1)" + " ; 0" * (dim - 1))
        run = laws.run(scene)
        at = {t: [row for row in run.rows if row["time"] == t] for t in (2, 3)}
        laws.demand(f"{dim}D: all stick before the fluid comes", all(row["state"] == "stick" for row in at[2]))
        wet = [row for row in at[3] if row["state"] == "wet"]
        worst = max(math.hypot(row["traction_t1"], row["traction_t2"]) - .5 * (row["pressure"] - 9) for row in wet)
        laws.check("  friction of what is wet over mu (p - p_f)", max(worst, 0.0), 1e-9)
        laws.demand("  some of it is wet", 0 < len(wet) < len(at[3]))


def pushed(laws):
    """A support pushes a wet node with a layer along the floor: its friction is mu (p - p_f) at most, and what its layer bears, u/C, if less."""
    C = 4e-4
    for dim in (2, 3):
        for law in ({"Compliance": 1e-3}, {"Compliance": 1e-3, "Unloading compliance": 2e-4}):
            scene = pressed(dim, "0.01*(1.5 - 0.5*t)", "3", **{"Shear compliance": C, **law})
            scene["Support top"].update({"Directions": "yz"[dim - 2], "Displacement": "-0.01*(1.5 - 0.5*t)"})
            scene["Support side"] = support(0, "x", "-1e-4*t")
            scene["Solver"] = {"Method": "active set"}  # smoothing does not know fluids
            rows = [row for row in laws.run(scene).last() if row["x"] == 0]
            what = f"{dim}D, pushed, {', '.join(law)}"
            size = [math.hypot(row["traction_t1"], row["traction_t2"]) for row in rows]
            limit = [.3 * max(row["pressure"] - (3 if row["state"] == "wet" else 0), 0.0) for row in rows]
            laws.demand(f"{what}: friction within its limit", all(t <= f * (1 + 1e-9) + 1e-9 for t, f in zip(size, limit)))
            if dim == 2:
                laws.check("  and that of its layer", max(abs(t - min(3e-4 / C, f)) for t, f in zip(size, limit)), 1e-9)


def flange(laws):
    """The shipped flange on a gasket: statics of each increment, and the pressure at which it leaks against that of a rigid flange."""
    run = laws.run(SHIPPED / "gasket-flange.prm", "-s", "Output/VTU=0")
    for record in run.increments:
        p = .25 * max(record["time"] - 1, 0.0)
        error = record["gasket_f_y"] + record["support_bolts_f_y"] + p * math.pi * 2500
        laws.check(f"flange, p = {p}: balance", abs(error) / 2e5, 1e-9)
    k_b, k_g = 106.1 * math.pi * 1500, math.pi * 7500 / .02
    by_hand = .5698 / (1 / k_b + 1 / k_g) / (math.pi * 7500 + (1 - k_b / (k_b + k_g)) * math.pi * 2500)
    leak = .25 * (int(re.search(r"increment (\d+): contact 'gasket' leaks", log_of(run))[1]) - 1)
    laws.demand(f"flange: leaks at {leak} MPa, by hand at {by_hand:.3f}", leak - .25 < by_hand <= leak)


def seals(laws):
    pushed(laws)
    flange(laws)
    uniform(laws)
    away(laws)
    wedge(laws)
    lubricated(laws)
