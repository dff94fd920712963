# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Supports that hold contact nodes in some stages only: closed forms of blocks that are confined, let go and confined again."""
import math

from support.scenes import box, contact, floor, joint, load, merge, support
from support.tables import Run

YOUNG, POISSON, PRESSED = 1000.0, .3, .01


def confined(dim, backend, mu, side):
    """A unit block on a floor, pressed by its top, between a wall at x = 0 and a support at x = 1 with that Active."""
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    scene = {"Dimension": dim, "Body block": box((3,) * dim, (1.0,) * dim, young=YOUNG, poisson=POISSON), "Obstacle floor": floor(dim),
             "Contact bottom": contact(ids=bottom, mu=mu), "Support wall": support(0, "x"), "Support side": support(1, "x", Active=side),
             "Support press": support(top, "xyz"[dim - 1], f"-{PRESSED}*min(t, 1)"),
             "Time": {"End": 3, "Increments": 3}, "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
    if dim == 3:
        scene["Support front"] = support(2, "y")
        scene["Support back"] = support(3, "y")
    return scene


def pressures(confinement):
    """Of a plane state of strain: with one side free, and with none."""
    free = YOUNG * PRESSED / (1 - POISSON**2)
    none = YOUNG * PRESSED * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
    return none if confinement else free


def frictionless(laws, dim, backend):
    """Held, let go, held again where it was: no memory of the way."""
    run = laws.run(confined(dim, backend, 0, "t < 1.5 || t > 2.5"))
    for t in (1, 2, 3):
        rows = [row for row in run.rows if row["time"] == t]
        p = pressures(t != 2)
        laws.check(f"{dim}D, {backend}, t = {t}: pressure", max(abs(row["pressure"] / p - 1) for row in rows), 1e-10)
        spread = 0 if t != 2 else PRESSED * POISSON / (1 - POISSON)
        laws.check("  way of the side", max(abs(row["u_t1"] - spread * row["x"]) for row in rows) / PRESSED, 1e-10)


def with_friction(laws, dim, backend):
    """Friction takes what the support held: it acts inwards, and by its own law; both sides and supports are in balance."""
    mu = .1
    run = laws.run(confined(dim, backend, mu, "t < 1.5"))
    laws.admissible(f"{dim}D, {backend}, friction", run, lambda row: mu)
    before = [row for row in run.rows if row["time"] == 1]
    after = [row for row in run.rows if row["time"] == 2]
    edge = [row for row in after if row["x"] == 1]
    laws.demand("  released nodes have slipped outwards against friction", edge and all(
        row["state"] == "slip" and row["du_t1"] > 0 and abs(row["r_t1"] + mu * row["r_n"]) < 1e-9 for row in edge))
    laws.demand("  none of it along what was held", all(row["r_t1"] == 0 for row in before if row["x"] == 1))
    laws.check("  balance of forces", max(record["balance"] for record in run.increments), 1e-10)
    for record in run.increments:
        laws.check(f"  energy, t = {record['time']}", abs(energy_gap(run, record)), 1e-9)
    size = run.largest("r_n")
    laws.check("  it rests then", max(abs(a["r_t1"] - b["r_t1"]) + abs(a["r_n"] - b["r_n"])
                                      for a, b in zip(run_at(run, 2), run_at(run, 3))) / size, 1e-9)


def energy_gap(run, record):
    """work - change of energy - what is lost, over the energy."""
    before = [other for other in run.increments if other["increment"] == record["increment"] - 1]
    stored = record["strain_energy"] - (before[0]["strain_energy"] if before else 0)
    return (record["external_work"] - stored - record["dissipation"] - record["contact_work_normal"]) / record["strain_energy"]


def run_at(run, t):
    return [row for row in run.rows if row["time"] == t]


def normal(laws, dim, backend):
    """Half of the bottom rests on a support until the floor carries it, at the same pressure."""
    scene = confined(dim, backend, 0, "1")
    scene["Body block"]["Mesh"]["Boundary ids"] = f"8: {'yz'[dim - 2]} < 1e-9 && x < 0.5"
    scene["Contact bottom"]["Boundary ids"] = ("2" if dim == 2 else "4") + ", 8"
    scene["Support rest"] = support(8, "xyz"[dim - 1], Active="t < 1.5")
    run = laws.run(scene)
    first, second = run_at(run, 1), run_at(run, 2)
    laws.demand(f"{dim}D, {backend}: {len(first)} contact nodes, then {len(second)}", 0 < len(first) < len(second))
    laws.check("  pressure", max(abs(row["r_n"] / row["area"] / pressures(True) - 1) for row in second), 1e-10)


CONFINED = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))  # pressure over compression where nothing gives way aside


def held_for_a_while(dim, backend, rest, top, drawn, end, **law):
    """A block between rollers on a floor; half of its bottom is held by a support for 1.5 < t < 2.5 where `rest` says. All of it is
    pressed evenly else."""
    bottom, upper = (2, 3) if dim == 2 else (4, 5)
    up = dim - 1
    scene = {"Dimension": dim, "Body block": box((4,) + (2,) * (dim - 1), (1.0,) * dim, young=YOUNG, poisson=POISSON,
                                                 **{"Boundary ids": f"8: {'yz'[dim - 2]} < 1e-9 && x < 0.5"}),
             "Obstacle floor": floor(dim, Displacement=" ; ".join([drawn] + ["0"] * up)),
             "Contact bottom": contact(ids=f"{bottom}, 8", **law),
             "Support walls": support("0, 1", "x"), "Support press": support(upper, "xyz"[up], top),
             "Support rest": support(8, "xyz"[up], repr(rest), Active="t > 1.5 && t < 2.5"),
             "Time": {"End": end, "Increments": end}, "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
    if dim == 3:
        scene["Support sides"] = support("2, 3", "y")
    return scene


def apart(laws, what, values, expected):
    laws.check(what, max(abs(value - expected) for value in values) / abs(expected), 1e-8)


def remembers(laws, dim, backend):
    """What a node that was held for a while has worn, slipped, carried and lost is as before."""
    what, way, k = f"{dim}D, {backend}, held for a while", .05, .002
    step = f"{way}*(min(t, 1) + max(min(t - 2, 1), 0))"  # drawn, at rest, drawn, at rest
    first = k * CONFINED * PRESSED * way
    second = k * CONFINED * (PRESSED - first) * way
    run = laws.run(held_for_a_while(dim, backend, -first, f"-{PRESSED}", step, 4, mu=0, **{"Wear coefficient": k}))
    laws.demand(f"{what}: {len(run_at(run, 2))} of {len(run_at(run, 1))} nodes are left", 0 < len(run_at(run, 2)) < len(run_at(run, 1)))
    apart(laws, "  wear", [row["wear"] for row in run_at(run, 3)], first + second)
    apart(laws, "  pressure on it", [row["pressure"] for row in run_at(run, 4)], CONFINED * (PRESSED - first - second))
    run = laws.run(held_for_a_while(dim, backend, 0.0, f"-{PRESSED}", step, 3, mu=f"if(t < 2.5, 0, 0.2*s/{way})"))
    apart(laws, "  friction by the way slipped", [abs(row["r_t1"]) / row["r_n"] for row in run_at(run, 3)], .2)
    soft, back = 2e-4, 5e-5
    most = PRESSED / (1 / CONFINED + soft)

    def after(compressed):  # the pressure on a gasket that has borne the most
        return (compressed - (soft - back) * most) / (1 / CONFINED + back)
    run = laws.run(held_for_a_while(dim, backend, 0.0, f"-{PRESSED}*(1.1 - 0.1*t)", "0", 3, mu=0,
                                    **{"Compliance": soft, "Unloading compliance": back}))
    apart(laws, "  what a gasket has carried", [row["pressure"] for row in run_at(run, 3)], after(.8 * PRESSED))
    run = laws.run(held_for_a_while(dim, backend, 0.0, f"if(t < 1.5, {PRESSED}, if(t < 2.5, -{PRESSED}, {PRESSED / 10}))", "0", 3, mu=0,
                                    **{"Tensile strength": 2, "Cohesion lost": "opening"}))
    laws.demand("  what a bond has lost", all(row["state"] == "open" and row["r_n"] == 0 for row in run_at(run, 3)))


def held_all(laws, dim):
    """A support that holds all nodes of the only contact for a while leaves it without rows; what they press is as before."""
    bottom, upper = (2, 3) if dim == 2 else (4, 5)
    up = "xyz"[dim - 1]
    scene = {"Dimension": dim, "Body block": box((3, 2, 2)[:dim], (1.0,) * dim, young=YOUNG), "Obstacle floor": floor(dim),
             "Contact bottom": contact(ids=bottom, mu=.3), "Load press": load("pressure", 2, upper),
             "Support rest": support(bottom, ", ".join("xyz"[:dim]), " ; ".join(["0"] * dim), Active="t > 1.5 && t < 2.5"),
             "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}
    run = laws.run(scene)
    laws.demand(f"{dim}D: {len(run_at(run, 1))} nodes, none while a support holds them, {len(run_at(run, 3))}",
                len(run_at(run, 1)) == len(run_at(run, 3)) > 0 and not run_at(run, 2))
    laws.check("  what they press", max(abs(record[f"{name}_f_{up}"] / 2 - 1) for record, name in zip(
        run.increments, ("bottom", "support_rest", "bottom"))), 1e-10)


def parted(laws, dim):
    """Work against a softening bond that a support parts: the strength that falls to 0 along the way, and part of it comes back."""
    bottom, upper = (2, 3) if dim == 2 else (4, 5)
    up, length, strength, gap = dim - 1, .1, 2.0, .05
    scene = {"Dimension": dim, "Body block": box((2,) * dim, (1.0,) * dim, young=1e9, poisson=0), "Obstacle floor": floor(dim),
             "Contact bottom": contact(ids=bottom, **{"Tensile strength": strength, "Cohesion lost": "opening",
                                                      "Softening length": length}),
             "Support lift": support(bottom, "xyz"[up], f"{gap}*min(t, 1)", Active="t < 1.5"),
             "Support grip": support(upper, ", ".join("xyz"[:dim]), " ; ".join(["0"] * up + [f"{gap}*min(t, 1) - 0.04*max(0, t - 2)"])),
             "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}
    run = laws.run(scene)
    whole = strength * (gap - gap**2 / (2 * length))
    back = strength * (1 - gap / length) / gap * (gap**2 - .01**2) / 2
    for record, exact in zip(run.increments[1:], (whole, whole - back)):
        laws.check(f"{dim}D, t = {record['time']}: work against a bond that a support has parted",
                   abs(record["bottom_fracture"] / exact - 1), 1e-5)


def agree_in_turn(laws):
    """Supports that move the same nodes one after the other need not agree at times when one of them is off."""
    scene = confined(2, "condensed", 0, "t < 2.5")
    scene["Support other"] = support(1, "x", "0.001*(t - 2)", Active="t > 1.5")
    run = laws.run(scene)
    for t, u in ((1, 0), (2, 0), (3, .001)):
        laws.check(f"supports in turn, t = {t}", max(abs(row["u_t1"] - u) for row in run_at(run, t) if row["x"] == 1), 1e-15)
    done, _ = laws.start(merge(scene, {"Support other": {"Displacement": "0.001*(t - 1)"}}))
    laws.demand("  both at once do", done.returncode == 2 and "another support moves it" in done.stderr)


def assembled(laws, backend):
    """Press, tie, release: a block that a tie has taken keeps its place on the other one when its support lets go."""
    scene = {"Dimension": 2, "Body low": box((4, 2), (2.0, 1.0), young=YOUNG, poisson=POISSON),
             "Body high": box((4, 2), (2.0, 1.0), (0.0, 1.0), young=YOUNG, poisson=POISSON),
             "Contact touch": joint("high", 2, "low", 3, **{"Friction coefficient": .2, "Pairing": "node to face"}),
             "Contact tie": joint("high", 2, "low", 3, Kind="tie", Active="t > 1.5", Pairing="node to face"),
             "Support ground": support(2, "x, y", body="low"), "Support jig": support(0, "x", body="high", Active="t < 2.5"),
             "Support hand": support(3, "y", "-0.01*min(t, 1)", body="high", Active="t < 2.5"),
             "Load push": load("traction", "0.5*max(t - 3, 0) ; -1", 3, body="high"),
             "Time": {"End": 4, "Increments": 4}, "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
    run = laws.run(scene)
    held = [row for row in run.rows if row["contact"] == "tie" and row["time"] > 2]
    laws.check(f"{backend}: press, tie, release: the tie keeps its sides", max(abs(row["du_t1"]) for row in held) / PRESSED, 1e-10)
    last = run.increments[-1]
    laws.check("  what is left is the load", abs(last["tie_f_x"] + last["touch_f_x"] + 1.0), 1e-9)
    laws.check("  and the weight", abs(last["tie_f_y"] + last["touch_f_y"] - 2.0), 1e-9)


def let_go(laws, dim, backend):
    """Two blocks by mortar, the side of the slave in a clamp that is taken off: a node beside it has acted for the held one as well."""
    slave, master, top = (2, 3, 3) if dim == 2 else (4, 5, 5)
    cells, size = (4,) + (2,) * (dim - 1), (2.0,) + (1.0,) * (dim - 1)
    up, below = "xyz"[dim - 1], (0.0,) * (dim - 1) + (-1.0,)
    scene = {"Dimension": dim, "Body upper": box(cells, size), "Body lower": box(cells, size, below),
             "Contact joint": joint("upper", slave, "lower", master, **{"Friction coefficient": .3}),
             "Support floor": support(slave, ", ".join("xyz"[:dim]), body="lower"),
             "Support clamp": support(1, ", ".join("xyz"[:dim]), body="upper", Active="t < 1.5"),
             "Load press": load("pressure", "5*min(t, 1)", top, body="upper"),
             "Time": {"End": 3, "Increments": 3}, "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
    run = laws.run(scene)
    laws.admissible(f"{dim}D, {backend}: a clamp beside a mortar contact is taken off", run, lambda row: .3)
    last = run.increments[-1]
    laws.check("  what is pressed rests on the other", abs(last[f"joint_f_{up}"] - 10.0) / 10, 1e-9)
    rest = [(a["r_n"], b["r_n"], a["r_t1"], b["r_t1"]) for a, b in zip(run_at(run, 2), run_at(run, 3))]
    laws.check("  and rests then", max(abs(a - b) + abs(c - d) for a, b, c, d in rest) / run.largest("r_n"), 1e-9)
    laws.demand("  nodes that were held are there", len(run_at(run, 1)) < len(run_at(run, 2)))


def slides_later(laws):
    """A block that slides by its own width in the second stage: the run begins anew with finite sliding, as if that had been asked for."""
    scene = {"Dimension": 2, "Body block": box((4, 2), (2.0, 1.0)), "Body base": box((12, 2), (6.0, 1.0), (-1.0, -1.0)),
             "Contact sole": joint("block", 2, "base", 3, **{"Friction coefficient": .3}),
             "Support floor": support(2, "x, y", body="base"), "Support clamp": support(1, "x, y", body="base", Active="t < 1.5"),
             "Support push": support(0, "x", "max(0, t - 1)"), "Load press": load("pressure", "5*min(t,1)", 3),
             "Time": {"Times": "1, 2, 3"}, "Output": {"VTU": 0}}
    run = laws.run(scene)
    laws.demand("what slides far in a later stage: three increments", [i["increment"] for i in run.increments] == [1, 2, 3])
    laws.check("  friction of all that is pressed", abs(abs(run.increments[-1]["sole_f_x"]) - 3) / 3, 2e-3)
    asked = laws.run(merge(scene, {"Contact sole": {"Kinematics": "finite sliding"}}))
    laws.check("  as where finite sliding is asked for",
               max(abs(a["r_n"] - b["r_n"]) + abs(a["u_t1"] - b["u_t1"]) for a, b in zip(run.rows, asked.rows)), 1e-11)


def press_fit(laws):
    """A ring is pressed on another without friction, which is then switched on and carries a force along the axis, up to mu p A."""
    inner, joint_radius, outer, depth, mu = 1.0, 2.0, 3.0, .002, .2
    a, b, c = inner**2, joint_radius**2, outer**2
    lame = depth * YOUNG / (joint_radius * ((c + b) / (c - b) + (b + a) / (b - a)))
    limit = mu * lame * 2 * math.pi * joint_radius

    def scene(part):
        result = {"Dimension": 2, "Contact joint": joint("hub", 0, "shaft", 1, Gap=f"-{depth}*min(t, 1)", Pairing="node to face",
                                                         **{"Friction coefficient": f"if(t < 1.1, 0, {mu})"}),
                  "Support shaft": support(2, "y", body="shaft"), "Support jig": support(2, "y", body="hub", Active="t < 1.5"),
                  "Load push": load("traction", f"0 ; -{part * limit / (math.pi * (c - b))!r}*max(t - 2, 0)", 3, body="hub"),
                  "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}
        for name, radius in (("shaft", inner), ("hub", joint_radius)):
            result[f"Body {name}"] = box((16, 4), (1.0, 1.0), (radius, 0.0), young=YOUNG, poisson=POISSON)
            result[f"Body {name}"]["Material"]["Plane"] = "axisymmetric"
        return result
    run = laws.run(scene(.8))
    rows = [row for row in run_at(run, 1) if row["contact"] == "joint"]
    laws.check("press fit: Lame's pressure", abs(sum(row["pressure"] for row in rows) / len(rows) / lame - 1), 2e-3)
    laws.demand("  no friction while it is pressed", all(row["r_t1"] == 0 for row in rows))
    last = run.increments[-1]
    laws.check("  friction carries the load", abs(last["joint_f_y"] / (.8 * limit) - 1), 1e-9)
    done, _ = laws.start(scene(1.2))
    laws.demand("  and no more than mu p A", done.returncode == 2)


def refused_late(laws):
    """What is wrong in the second stage leaves the first one on disk: no wrong input any more, of which nothing is written."""
    scene = confined(2, "condensed", 0, "t > 0")
    scene["Support other"] = support(0, "x", "0.1", Active="t > 1.5")
    done, folder = laws.start(scene)
    laws.demand("supports that disagree in a later stage", done.returncode == 2 and "another support moves it" in done.stderr)
    laws.demand("  the first stage is on disk", [i["increment"] for i in Run(folder).increments] == [1])


def stages(laws):
    for dim in (2, 3):
        for backend in ("condensed", "iterative"):
            frictionless(laws, dim, backend)
            with_friction(laws, dim, backend)
            normal(laws, dim, backend)
            let_go(laws, dim, backend)
        held_all(laws, dim)
        parted(laws, dim)
        remembers(laws, dim, "condensed")  # walls hold its corners along friction
    agree_in_turn(laws)
    assembled(laws, "condensed")  # the iterative one knows no friction along what supports hold of pairs
    press_fit(laws)
    slides_later(laws)
    refused_late(laws)
