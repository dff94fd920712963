# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Springs between points, ties that begin and end, layers that stay compressed, in closed form."""
import csv
import itertools

from support.scenes import beam, box, contact, floor, joint, load, merge, support

YOUNG = 1000.0


def bar(dim, poisson=.3):
    """Clamped at its left side and pulled at a point inside of a cell of its right half."""
    size, point = (2.0, 1.0, 1.0)[:dim], (1.83, .41, .37)[:dim]
    return {"Dimension": dim, "Body block": box((6, 3, 3)[:dim], size, young=YOUNG, poisson=poisson),
            "Support left": support(0, "x, y" if dim == 2 else "x, y, z"),
            "Output": {"VTU": 0, "Probes": f"there: {', '.join(map(repr, point))}"}}, point


def moved(run):
    with open(run.folder / "history.csv", newline="") as stream:
        return [float(row["there_u_x"]) for row in csv.DictReader(stream)]


def spring(point, end, k, **entries):
    return {"Body": "block", "Kind": "spring", "Point": point, "Master point": end, "Stiffness": k, **entries}


def force_of(run, t, name="strap"):
    """Of a spring on the body, along x."""
    return next(row[f"{name}_f_x"] for row in run.increments if row["time"] == t)


def single(laws):
    """Against the flexibility c of the bar there: u = c (F + S), S = -k u."""
    k, F = 300.0, 5.0
    for dim, backend in ((2, "condensed"), (3, "condensed"), (2, "iterative"), (3, "iterative")):
        scene, point = bar(dim)
        scene["Solver"] = {"Backend": backend}
        scene["Load pull"] = load("point force", f"{F}*(2*t - 3)" + " ; 0" * (dim - 1), Point=point)
        scene["Time"] = {"End": 2, "Increments": 2}  # pushed by F to the left, pulled by F to the right
        c = moved(laws.run(merge(scene, {"Solver": {"Backend": "condensed"}})))[-1] / F
        ends = {"push and pull": (3.0, *point[1:]), "push": (3.0, *point[1:]), "pull": (3.0, *point[1:])}
        gap, tension, pressed = .002, 1.5, 2.5
        # force on the body along x of one that ends to its right, from its displacement and the load f: by hand
        cases = {"both": ({}, lambda f: -k * c * f / (1 + k * c)),
                 "both, tightened": ({"Preload": tension}, lambda f: (tension - k * c * f) / (1 + k * c)),
                 "push": ({"Acts": "push"}, lambda f: min(0.0, -k * c * f / (1 + k * c))),
                 "pull": ({"Acts": "pull"}, lambda f: max(0.0, -k * c * f / (1 + k * c))),
                 "push after a gap": ({"Acts": "push", "Gap": gap}, lambda f: min(0.0, -k * (c * f - gap) / (1 + k * c))),
                 "pull after a gap": ({"Acts": "pull", "Gap": gap}, lambda f: max(0.0, -k * (c * f + gap) / (1 + k * c))),
                 "pressed": ({"Acts": "push", "Preload": pressed}, lambda f: min(0.0, -(pressed + k * c * f) / (1 + k * c)))}
        for what, (entries, S) in cases.items():
            run = laws.run({**scene, "Contact strap": spring(point, ends["push"], k, **entries)}, bounds=False)
            for t, f in ((1, -F), (2, F)):
                laws.check(f"{dim}D, {backend}, {what}, load {f}", abs(force_of(run, t) - S(f)) / F, 1e-9)
                laws.check("  displacement", abs(moved(run)[t - 1] - c * (f + S(f))) / (c * F), 1e-9)


def hanging(laws):
    """What only springs hold: a block on two of them by its weight, a moving end, a pair of blocks, a truss."""
    k, weight = 250.0, 8.0
    for dim in (2, 3):
        low, high = (0.0,) * dim, (2.0, 1.0, 1.0)[:dim]
        scene = {"Dimension": dim, "Body block": box((4, 2, 2)[:dim], high, young=1e6, poisson=0.0),
                 "Obstacle hook": {**floor(dim), "Displacement": "0 ; 0.1*(t - 1)" if dim == 2 else "0 ; 0 ; 0.1*(t - 1)"},
                 "Support guide": support("0", "x" if dim == 2 else "x, y"),
                 "Load weight": load("body force", " ; ".join(["0"] * (dim - 1) + [f"-{weight / 2}"])),
                 "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
        for name, x in (("a", 0.0), ("b", 2.0)):
            point = (x, .5, 1.0)[:dim] if dim == 3 else (x, 1.0)
            scene[f"Contact {name}"] = {**spring(point, (*point[:-1], 4.0), k, Acts="pull"), "Obstacle": "hook"}
        run = laws.run(scene, bounds=False)
        for t in (1, 2):
            bear = [next(row[f"{name}_f_{'y' if dim == 2 else 'z'}"] for row in run.increments if row["time"] == t) for name in "ab"]
            laws.check(f"{dim}D, hung up, t = {t}: the weight", abs(sum(bear) / weight - 1), 1e-9)
            laws.check("  half of it, as the block hardly bends", abs(bear[0] / bear[1] - 1), 2e-3)
        for row in run.last():
            laws.check("  its way", abs(row["gap"] + weight / 2 / k) / .1, 1e-3)  # the block gives way by 1e-5
        two = {"Dimension": dim, "Body block": box((2, 2, 2)[:dim], (1.0,) * dim, young=YOUNG, poisson=0.0),
               "Body other": box((3, 3, 3)[:dim], (1.0,) * dim, (3.0, *low[1:]), young=YOUNG, poisson=0.0),
               "Support left": support(0, "x, y" if dim == 2 else "x, y, z"),
               "Support guide": support("2" if dim == 2 else "2, 4", "normal", body="other"),
               "Load pull": load("traction", "3" + " ; 0" * (dim - 1), 1, body="other"), "Output": {"VTU": 0}}
        for n, y in enumerate((.2, .8)):
            end = (y, .5)[:dim - 1]
            two[f"Contact s{n}"] = {**spring((1.0, *end), (3.0, *end), k), "Master body": "other"}
        run = laws.run(two, bounds=False)
        laws.check(f"{dim}D, between blocks: all of the load", abs(sum(run.increments[-1][f"s{n}_f_x"] for n in (0, 1)) - 3), 1e-9)
    h, n = 2.0, 4
    frame = {"Dimension": 2, "Body block": beam((0.0, 0.0), (6.0, 0.0), n, 1e4, h / 4), "Support left": support(1, "clamped"),
             "Contact strap": spring((6.0, 0.0), (6.0, 3.0), k, Acts="pull"), "Load down": load("point force", "0 ; -2", Point=(6.0, 0.0)),
             "Output": {"VTU": 0}}
    c = 6.0**3 / (3 * 1e4 * (h / 4)**4 / 12)
    laws.check("a cantilever on a strap", abs(laws.run(frame, bounds=False).increments[-1]["strap_f_y"] - 2 * k * c / (1 + k * c)), 1e-9)


def on_springs(laws):
    """What nothing but springs holds, of any stiffness beside that of the body: statics, and both backends."""
    for dim, k, acts in ((2, 300.0, "both"), (3, .3, "both"), (3, 300.0, "both"), (3, 300.0, "pull"), (3, 1e9, "both")):
        size, axes = (1.0,) * dim, "xyz"[:dim]
        low, top = (3, 3) if dim == 2 else (5, 5)
        force = [f * min(k, 300.0) * 1e-4 for f in (3.0, -5.0) if dim == 2] or [f * min(k, 300.0) * 1e-4 for f in (3.0, 1.0, -5.0)]
        scene = {"Dimension": dim, "Body block": box((8, 8, 8)[:dim], size, young=YOUNG), "Output": {"VTU": 0},
                 "Load top": load("traction", " ; ".join(map(repr, force)), top)}
        ends = {}
        for point in itertools.product((0.0, 1.0), repeat=dim):
            if acts == "both" and point[-1] > 0:
                continue
            for c in range(dim):
                end = [x + (.7 if i == c and x > .5 else -.7 if i == c else 0.0) for i, x in enumerate(point)]
                name = f"s{len(ends)}"
                ends[name] = (point, c)
                scene[f"Contact {name}"] = {**spring(point, tuple(end), k), **({} if acts == "both" else {"Acts": "pull", "Preload": .3})}
        runs = [laws.run(merge(scene, {"Solver": {"Backend": backend}}), bounds=False) for backend in ("condensed", "iterative")]
        what = f"{dim}D, held by {len(ends)} springs, {acts}, k = {k:g}"
        laws.demand(f"{what}: solved without condensation", {row["solver"] for row in runs[1].increments} == {"iterative"})
        row, size = runs[1].increments[-1], max(map(abs, force))
        carried = [sum(row[f"{name}_f_{c}"] for name in ends) for c in axes]
        laws.check("  their forces and the load", max(abs(a + b) for a, b in zip(carried, force)) / size, 1e-9)
        # about the corner at the origin; the load acts at the middle of the top
        place = [.5] * (dim - 1) + [1.0]
        turning = sum(point[0] * row[f"{name}_f_{axes[-1]}"] - point[-1] * row[f"{name}_f_x"] for name, (point, _) in ends.items())
        laws.check("  their moments", abs(turning + place[0] * force[-1] - place[-1] * force[0]) / size, 1e-9)
        laws.check("  as condensed", max(abs(row[f"{name}_f_{axes[c]}"] - runs[0].increments[-1][f"{name}_f_{axes[c]}"])
                                         for name, (_, c) in ends.items()) / size, 1e-9)


def beside_nothing(laws):
    """A loaded body that does not touch the other one, on which nothing acts: not even rounding of what the first one bears."""
    for dim in (2, 3):
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        axes, above = "x, y, z"[:3 * dim - 2], (0.0,) * (dim - 1) + (1.1,)
        scene = {"Dimension": dim, "Body low": box((8, 8, 8)[:dim], (1.0,) * dim, young=YOUNG),
                 "Body high": box((7, 7, 7)[:dim], (1.0,) * dim, above, young=YOUNG),
                 "Support low": support(bottom, axes, body="low"), "Contact joint": joint("high", bottom, "low", top, **{"Friction coefficient": .3}),
                 "Load pull": load("traction", " ; ".join(["0.5*t"] + ["0"] * (dim - 2) + ["5"]), top, body="high"),
                 "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
        for point in itertools.product((0.0, 1.0), repeat=dim - 1):
            for c in range(dim):
                own = (*point, 2.1)
                end = [x + (.7 if i == c else 0.0) for i, x in enumerate(own)]
                scene[f"Contact s{''.join(map(str, map(int, point)))}{c}"] = {**spring(own, tuple(end), 300.0), "Body": "high"}
        run = laws.run(merge(scene, {"Solver": {"Backend": "iterative"}}), bounds=False)
        laws.demand(f"{dim}D, held by springs apart from the other body: solved without condensation",
                    {row["solver"] for row in run.increments} <= {"iterative", "linear"})
        laws.check("  what the other one bears", max(abs(row[f"support_low_f_{c}"]) for row in run.increments for c in "xyz"[:dim]), 0)
        laws.demand("  open", {row["state"] for row in run.last() if row["contact"] == "joint"} == {"open"})


def parting(laws):
    """Two columns, 1 high each, that a tie joins for a while: drawn apart by .1, tied, pulled by .01, sheared, let go."""
    for dim, backend, pairing in ((2, "condensed", "mortar"), (2, "iterative", "mortar"), (3, "condensed", "mortar"), (3, "condensed", "node to face"),
                                  (3, "iterative", "node to face")):
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        side = (1.0,) * (dim - 1)
        up, along = "0.1*min(t, 1) + 0.01*max(0, min(t, 3) - 2)", "0.004*max(0, min(t, 4) - 3)"
        all_of = "x, y" if dim == 2 else "x, y, z"
        scene = {"Dimension": dim, "Body low": box((3, 2) if dim == 2 else (2, 2, 2), (*side, 1.0), young=YOUNG, poisson=0.0),
                 "Body high": box((4, 2) if dim == 2 else (3, 3, 2) if pairing == "mortar" else (2, 2, 2), (*side, 1.0), (*(0.0 for _ in side), 1.0), young=YOUNG, poisson=0.0),
                 "Support low": support(bottom, all_of, body="low"),
                 "Support high": support(top, all_of, f"{along} ; {up}" if dim == 2 else f"{along} ; 0 ; {up}", body="high"),
                 "Contact tie": merge(joint("high", bottom, "low", top, Kind="tie", Active="t > 1.5 && t < 4.5"), {"Pairing": pairing}),
                 "Time": {"End": 5, "Increments": 5}, "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
        what = f"{dim}D, {backend}, {pairing}"
        run = laws.run(scene, bounds=False)
        normal = "y" if dim == 2 else "z"
        force = {row["time"]: (row["tie_f_x"], row[f"tie_f_{normal}"]) for row in run.increments}
        for t, pull in ((1, 0), (2, 0), (3, -.005 * YOUNG), (4, -.005 * YOUNG), (5, 0)):
            laws.check(f"{what}, t = {t}: pull", abs(force[t][1] - pull), 1e-8)
        laws.demand("  it bears shear at t = 4 only", abs(force[4][0]) > .1 and all(abs(force[t][0]) < 1e-8 for t in (1, 2, 3, 5)))
        laws.demand("  states", {(row["time"], row["state"]) for row in run.rows} ==
                    {(1, "open"), (2, "stick"), (3, "stick"), (4, "stick"), (5, "open")})
        whole = laws.run(merge(scene, {"Contact tie": {"Active": "t >= 0"}, "Support high": {"Displacement": scene["Support high"]["Displacement"].replace("0.1*min(t, 1)", "0")}}),
                         bounds=False)
        tied = laws.run(merge(scene, {"Contact tie": {"Active": "1"}, "Support high": {"Displacement": scene["Support high"]["Displacement"].replace("0.1*min(t, 1)", "0")}}),
                        bounds=False)
        laws.check("  a tie for ever: as one without an end",
                   max(abs(a[f"tie_f_{c}"] - b[f"tie_f_{c}"]) for a, b in zip(whole.increments, tied.increments) for c in "xyz"), 1e-8)


def packed(laws):
    """A gasket between a block and a floor, pressed, let go, pressed again: its thickness follows the curve by hand."""
    for dim, backend in ((2, "condensed"), (3, "condensed"), (2, "iterative")):
        C, back, height = 2e-3, 5e-4, 1.0
        way = [.02, .045, .035, .02, .042, .06]  # of the top
        scene = {"Dimension": dim, "Body block": box((3, 2, 2)[:dim], (1.0,) * dim, young=YOUNG, poisson=0.0), "Obstacle floor": floor(dim),
                 "Contact bottom": contact(ids=2 if dim == 2 else 4, Compliance=C, **{"Unloading compliance": back}),
                 "Support top": support(3 if dim == 2 else 5, "x, y" if dim == 2 else "x, y, z",
                                        " ; ".join(["0"] * (dim - 1) + ["-table(t; 0 : 0; " + "; ".join(f"{n + 1} : {w}" for n, w in enumerate(way)) + ")"])),
                 "Time": {"End": len(way), "Increments": len(way)}, "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        most = 0.0
        for n, w in enumerate(way):
            p = w / (C + height / YOUNG)
            if p < most:  # C P - back (P - p) + p h / E = w
                p = max(0.0, (w - (C - back) * most) / (back + height / YOUNG))
            most = max(most, p)
            rows = [row for row in run.rows if row["time"] == n + 1]
            laws.check(f"{dim}D, {backend}, pressed by {w}", max(abs(row["pressure"] - p) for row in rows), 1e-9)
        laws.demand("  it opens as it is let go", any(row["state"] == "open" for row in run.rows if row["time"] == 4))


def across_a_tie(laws):
    """Springs between tied bodies, with ends in cells that have tied nodes and at these: of the law by their ends, which move apart."""
    k, high = 1000.0, {"Body": "high", "Boundary ids": 3}
    for backend, pairing, (point, end) in itertools.product(("condensed", "iterative"), ("mortar", "node to face"), (
            ((.3, .2), (1.7, 1.2)), ((.3, .8), (1.7, 1.2)), ((.3, 1.0), (1.7, 1.0)), ((.5, 1.0), (.5, 2.0)), ((.5, 1.0), (1.5, 1.0)))):
        strap = {"Kind": "spring", "Body": "low", "Point": point, "Master body": "high", "Master point": end, "Stiffness": k}
        scene = {"Dimension": 2, "Body low": box((4, 2), (2.0, 1.0), young=YOUNG), "Body high": box((4, 2), (2.0, 1.0), (0.0, 1.0), young=YOUNG),
                 "Contact glue": merge(joint("high", 2, "low", 3, Kind="tie"), {"Pairing": pairing}), "Contact strap": strap,
                 "Support floor": support(2, "x, y", body="low"), "Load pull": load("traction", "3 ; 1", high["Boundary ids"], high["Body"]),
                 "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        row = next(row for row in run.last() if row["contact"] == "strap")
        one = laws.run(merge(scene, {"Contact glue": {"Kind": "tie", "Active": "t > -1"}}))
        other = next(row for row in one.last() if row["contact"] == "strap")
        what = f"{backend}, {pairing}, a spring from {point} to {end} across a tie"
        laws.demand(f"{what}: it bears", abs(row["r_n"]) > .1)
        laws.check("  its law", abs(row["r_n"] + k * row["u_n"]) / abs(row["r_n"]), 1e-8)
        laws.check("  a tie that may end", abs(row["r_n"] - other["r_n"]) / abs(row["r_n"]), 1e-8)


def joints(laws):
    across_a_tie(laws)
    single(laws)
    hanging(laws)
    on_springs(laws)
    beside_nothing(laws)
    parting(laws)
    packed(laws)
