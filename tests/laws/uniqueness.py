# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether increments have one solution: a single node, whose solutions are known (Klarbring, Ing. Arch. 60 (1990) 529-541), and blocks."""
import math
import re

from support.scenes import beam, contact, floor, load, merge, press_and_shear, support
from support.logs import log_of
from support.tables import read

YOUNG, HEIGHT, DEGREES = 1000.0, .1, 45.0


def stiffness():
    """k_tt, k_nn and k_tn of the tip of a clamped bar of length 1 that leans by 45 degrees."""
    axial, across = YOUNG * HEIGHT**2, 3 * YOUNG * HEIGHT**4 / 12
    c, s = math.cos(math.radians(DEGREES)), math.sin(math.radians(DEGREES))
    return axial * c * c + across * s * s, axial * s * s + across * c * c, (axial - across) * c * s


def solutions(mu, ft, fn):
    """All (r_n, r_t) of the tip on the floor, from no force at all."""
    ktt, knn, ktn = stiffness()
    found = []
    if ktt * fn - ktn * ft > 0:  # it opens
        found.append((0.0, 0.0))
    if fn < 0 and abs(ft) <= -mu * fn:
        found.append((-fn, -ft))
    for sign in (1, -1):
        t = (ft + sign * mu * fn) / (ktt + sign * mu * ktn)
        r = ktn * t - fn
        if t * sign > 0 and r > 0:
            found.append((r, -sign * mu * r))
    return found


def leaning(mu, ft, fn):
    c, s = math.cos(math.radians(DEGREES)), math.sin(math.radians(DEGREES))
    return {"Dimension": 2, "Body bar": beam((c, s), (0.0, 0.0), 1, YOUNG, HEIGHT), "Obstacle floor": floor(2),
            "Contact tip": contact("bar", 2, mu=mu), "Support wall": support(1, "clamped", body="bar"),
            "Load push": load("nodal force", f"{ft} ; {fn}", 2, body="bar"),
            "Time": {"Increments": 1}, "Output": {"VTU": 0, "Uniqueness": "yes"}}


def single_node(laws):
    ktt, knn, ktn = stiffness()
    limit = 2 * math.sqrt(ktt * knn - ktn * ktn) / knn
    told = several = 0
    for mu in (.5 * limit, .95 * limit, 1.5 * limit, .9, 1.2, 2.0, 5.0, 20.0):
        for k in range(24):
            ft, fn = math.cos(math.pi * k / 12 + .05), math.sin(math.pi * k / 12 + .05)
            right = solutions(mu, ft, fn)
            run = laws.run(leaning(mu, ft, fn))
            record, row = run.increments[-1], run.last()[0]
            near = min(math.hypot(row["r_n"] - n, row["r_t1"] - t) for n, t in right)
            bound = re.search(r"proved up to a coefficient of friction of ([0-9.e+-]+)", log_of(run))
            ok = near < 1e-9 and abs(float(bound[1]) / limit - 1) < 1e-3
            if len(right) > 1:
                several += 1
                others = read(run.folder / "reactions-2.csv")
                ok = ok and record["unique"] == "no" and len(others) == 1
                other = (others[0]["r_n"], others[0]["r_t1"]) if others else (math.nan, math.nan)
                ok = ok and min(math.hypot(other[0] - n, other[1] - t) for n, t in right) < 1e-9
                ok = ok and math.hypot(other[0] - row["r_n"], other[1] - row["r_t1"]) > 1e-6
            else:
                ok = ok and record["unique"] == "yes"
            told += not ok
            if not ok:
                print(f"  mu = {mu}, f = {ft}, {fn}: {right}, found {row['r_n']}, {row['r_t1']}, {record['unique']}")
    laws.check("single nodes that are judged wrong", told, .5)
    laws.demand(f"some of them have several solutions: {several}", several > 5)


def blocks(laws):
    for dim in (2, 3):
        for mu, proved in ((.1, True), (20.0, False)):
            scene = merge(press_and_shear(dim, mu=mu), {"Output": {"Uniqueness": "yes", "VTU": 0}})
            run = laws.run(scene)
            found = {record["unique"] for record in run.increments}
            bound = float(re.search(r"proved up to a coefficient of friction of ([0-9.e+-]+)", log_of(run))[1])
            laws.demand(f"{dim}D, mu = {mu}: {found}, proved up to {bound}", (bound >= mu) == proved and (found == {"yes"} or not proved))
            laws.same("  and the same results", laws.run(merge(press_and_shear(dim, mu=mu), {"Output": {"VTU": 0}})), run, 1e-13)


def every_solution(laws):
    """Method = all solutions: those of a node are the closed forms; those of blocks obey the law, and are one where that is proved."""
    ktt, knn, ktn = stiffness()
    wrong = several = 0
    for mu in (.4, 2.0, 5.0, 20.0):
        for k in range(24):
            ft, fn = math.cos(math.pi * k / 12 + .05), math.sin(math.pi * k / 12 + .05)
            right = sorted(solutions(mu, ft, fn))
            scene = merge(leaning(mu, ft, fn), {"Solver": {"Method": "all solutions"}, "Output": {"Uniqueness": "no"}})
            found = sorted((row["r_n"], row["r_t1"]) for row in read(laws.run(scene).folder / "solutions.csv"))
            several += len(right) > 1
            wrong += len(found) != len(right) or any(math.dist(a, b) > 1e-9 for a, b in zip(found, right))
    laws.check("nodes whose solutions are others", wrong, .5)
    laws.demand(f"some have several: {several}", several > 5)
    bar = merge(leaning(5.0, 1.0, 1.0), {"Load push": {"Value": "-0.866*t*(3 - t)/2 ; -0.5*t"}, "Output": {"Uniqueness": "no"}, "Time": {"End": 2, "Increments": 5}})
    for what, mu, many, scene in (("a block", .3, 1, press_and_shear(2, cells=(7, 4), mu=.3)),
                                  ("a block", 8.0, 1000, press_and_shear(2, cells=(7, 4), mu=8.0)), ("a bar", 5.0, 1000, bar)):
        run = laws.run(merge(scene, {"Solver": {"Method": "all solutions"}}))
        rows = read(run.folder / "solutions.csv")
        branches = {(row["increment"], row["branch"]) for row in rows}
        laws.demand(f"{what}, mu = {mu}: {len(branches)} solutions of {len(run.increments)} increments",
                    len(run.increments) + (what == "a bar") <= len(branches) <= many * len(run.increments))
        laws.demand("  each follows one", all(row["increment"] == 1 or (row["increment"] - 1, row["parent"]) in branches for row in rows))
        scale = max(row["r_n"] for row in rows)
        worst = 0.0
        for row in rows:
            limit = mu * row["r_n"]
            worst = max(worst, -row["r_n"], abs(row["r_t1"]) - limit, min(row["r_n"], 1e3 * row["gap"]), -1e3 * row["gap"])
            if row["state"] == "slip":
                worst = max(worst, abs(abs(row["r_t1"]) - limit), scale * (row["r_t1"] * row["du_t1"] > 0))
            if row["state"] == "stick":
                worst = max(worst, 1e3 * abs(row["du_t1"]))
        laws.check("  the law of contact, all of them", worst / scale, 1e-9)
        before = {(row["increment"], row["branch"], row["node"]): row["u_t1"] for row in rows}
        laws.check("  each goes on from the one that it follows",
                   max((abs(row["u_t1"] - row["du_t1"] - before[row["increment"] - 1, row["parent"], row["node"]])
                        for row in rows if row["increment"] > 1), default=0.0), 1e-12)
        first = [row for row in rows if row["branch"] == 1]
        laws.check("  the first one is the run", max(abs(a["r_n"] - b["r_n"]) + abs(a["r_t1"] - b["r_t1"]) for a, b in zip(first, run.rows)) / scale, 1e-9)


def triangle(mu, angle):
    """An elastic triangle that stands on its side y = 0, is held at x + 2 y = 1 and pushed at x + y = 0."""
    return {"Dimension": 2, "Body triangle": {"Mesh": {"Generator": "simplex", "Arguments": "0, 0 ; 1, 0 ; -1, 1", "Global refinements": 1,
                                                       "Boundary ids": "7: y < 1e-9 ; 8: abs(x + 2*y - 1) < 1e-6 ; 9: abs(x + y) < 1e-6 && y > 1e-9"},
                                              "Material": {"Young modulus": 1.0, "Poisson ratio": .2}},
            "Obstacle floor": floor(2), "Contact bottom": contact("triangle", 7, mu=mu), "Support wall": support(8, "x, y", body="triangle"),
            "Load push": load("traction", f"{math.cos(angle)} ; {math.sin(angle)}", 9, "triangle"),
            "Time": {"Increments": 1}, "Solver": {"Method": "all solutions"}, "Output": {"VTU": 0}}


def on_foundations(laws):
    """A foundation holds a body as a support does, the more so the stiffer it is: as many solutions, and the same verdicts."""
    for mu, verdict in ((2.9, "yes"), (3.1, "no")):
        rigid = triangle(mu, 2.382)
        stiff = merge(rigid, {"Support wall": {"Stiffness": 1e6}})
        tables = [read(laws.run(scene).folder / "solutions.csv") for scene in (rigid, stiff)]
        counts = [len({row["branch"] for row in table}) for table in tables]
        laws.demand(f"on a foundation, mu = {mu}: solutions {counts}", counts[0] == counts[1])
        free = {row["node"] for row in tables[0]}  # the corner that the rigid support holds has no row
        rows = [sorted((row["node"], row["r_n"], row["r_t1"]) for row in table if row["node"] in free) for table in tables]
        laws.check("  and these are the same, of a load of 1", max(math.dist(a, b) for a, b in zip(*rows)), 1e-4)
        asked = merge(stiff, {"Solver": {"Method": "automatic"}, "Output": {"Uniqueness": "yes"}})
        laws.demand(f"  Output/Uniqueness: {verdict}", laws.run(asked).increments[-1]["unique"] == verdict)
    weak = merge(triangle(2.9, 2.382), {"Support wall": {"Directions": "x", "Stiffness": 1.0}})
    done, _ = laws.start(weak)
    laws.demand(f"a body that a foundation leaves a motion: {done.stderr.strip()}", done.returncode == 1 and "and one of these is not" in done.stderr)


def elastic_body(laws):
    """An elastic body in place of a bar, after P. Hild (C. R. Acad. Sci. Paris I 337, 2003, 685) and V. Rey (C. R. Mecanique 354, 2026,
    461), who has several solutions beyond mu = 3. The numbers of their bodies were not at hand: this is a triangle of that kind, which on
    this mesh has one solution up to mu = 2.9, and three beyond 3.02 under some loads."""
    for mu, several in ((1.0, False), (2.9, False), (3.02, True), (3.1, True)):
        counts = {}
        for i in range(9):
            angle = 2.34 + .012 * i
            run = laws.run(triangle(mu, angle))
            rows = read(run.folder / "solutions.csv")
            branches = {}
            for row in rows:
                branches.setdefault(row["branch"], []).append(row["state"])
            counts[angle] = len(branches)
            if len(branches) > 1:
                changing = {tuple(states) for states in zip(*branches.values()) if len(set(states)) > 1}
                laws.demand(f"an elastic triangle, mu = {mu}, {angle:.3f}: one node is open, slips or sticks",
                            len(branches) == 3 and {frozenset(states) for states in changing} == {frozenset(("open", "slip", "stick"))})
        laws.demand(f"an elastic triangle, mu = {mu}: solutions {sorted(set(counts.values()))}", (max(counts.values()) > 1) == several)
    for mu, verdict in ((2.9, "yes"), (3.1, "no")):
        scene = merge(triangle(mu, 2.382), {"Solver": {"Method": "automatic"}, "Output": {"Uniqueness": "yes"}})
        laws.demand(f"  Output/Uniqueness, mu = {mu}: {verdict}", laws.run(scene).increments[-1]["unique"] == verdict)


def uniqueness(laws):
    every_solution(laws)
    elastic_body(laws)
    on_foundations(laws)
    single_node(laws)
    blocks(laws)
