# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Obstacles that turn far, are pressed by loads, have edges, and slide: Kinematics = finite sliding."""
import math

from laws.driven import along_last, layer
from laws.sliding import FAR, energy_error, place_of, slip_error
from support.logs import log_of
from support.scenes import box, contact, floor, load, merge, press_and_shear, support
from support.surfaces import brick, write_msh, write_stl


def far(dim, obstacle, mu, increments, stages=2, cells=None, size=None):
    """The layer of driven.py, or a longer one, under an obstacle that is pressed (t = 1) and then driven."""
    scene = layer(dim, obstacle, cells, mu)
    if size:
        scene["Body block"] = box(cells, size, tuple(-s / 2 for s in size[:-1]) + (-size[-1],))
    scene["Time"] = {"Stages": f"1 : 1, {stages} : {increments}"}
    return merge(scene, {"Contact top": FAR})


def spun(laws):
    """A ball and a disc pressed into a layer and spun where they are."""
    ball = {"Shape": "sphere", "Center": (0, 0, 2.0), "Radius": 2.0, "Displacement": along_last(3, "-0.05*min(t, 1)"),
            "Turn": "40*max(t - 1, 0)", "Turn axis": (0, 0, 1), "Reference point": (0, 0, 2.0)}
    for n in (4, 8):
        run = laws.run(far(3, ball, .3, n))
        last = run.increments[-1]
        laws.check(f"ball spun in {n} increments: energies", energy_error(run), 1e-9)
        rows = [row for row in run.last() if row["state"] != "open"]
        run.rows = [row for row in run.rows if row["x"]**2 + row["y"]**2 > 1e-6]  # where it stands still
        laws.check("  friction of nodes that touch", slip_error(run, .3, 1.5), 1e-9)
        lost = last["dissipation"] / sum(.3 * row["r_n"] * math.hypot(*place_of(row, 3)[:2]) * math.radians(40) / n for row in rows)
        laws.check("  dissipation over friction times way", abs(lost - 1), .15 / n**2)
        laws.check("  no force across", math.hypot(last["top_f_x"], last["top_f_y"]) / abs(last["top_f_z"]), 1e-9)

    disc = {"Shape": "cylinder", "Point": (0, 4.0), "Radius": 4.0, "Displacement": "0 ; -0.04*min(t, 1)",
            "Turn": "60*max(t - 1, 0)", "Reference point": (0, 4.0)}
    run = laws.run(far(2, disc, .3, 6))
    first, last = run.increments[0], run.increments[-1]
    laws.check("disc spun: energies", energy_error(run), 1e-9)
    laws.check("  friction of nodes that touch", slip_error(run, .3, 1.5), 1e-9)
    lost = last["dissipation"] / (.3 * sum(row["r_n"] for row in run.last()) * 4.0 * math.radians(60) / 6)
    laws.check("  dissipation over friction times way", abs(lost - 1), 6e-3)
    laws.demand("  it drags the layer against friction", abs(last["top_f_x"]) > .25 * abs(first["top_f_y"]))


def rolled(laws):
    """A disc that turns as it goes forward rolls: friction is a small part of its limit."""
    way, radius = 1.2, 2.0
    disc = {"Shape": "cylinder", "Point": (-.6, radius), "Radius": radius,
            "Displacement": f"{way}*max(t - 1, 0) ; -0.03*min(t, 1)", "Reference point": (-.6, radius)}
    forces = {}
    for turn in (0.0, -math.degrees(way / radius)):
        run = laws.run(far(2, merge(disc, {"Turn": f"{turn!r}*max(t - 1, 0)"}), .3, 24, 2, (48, 6), (3.0, .6)))
        laws.check(f"disc forward, turned by {turn:.3g} degrees: energies", energy_error(run), 1e-9)
        last = run.increments[-1]
        forces[turn] = abs(last["top_f_x"] / last["top_f_y"])
    slides, rolls = forces.values()
    laws.check("  friction over normal force where it slides", abs(slides / .3 - 1), .02)
    laws.check("  and where it rolls", rolls, .06)


def turned_box(laws):
    """A box that is turned by a right angle before it is pressed is one with other sides."""
    sides = (1.06, .4)
    tall = {"Shape": "box", "Center": (0, 1.0), "Sizes": sides, "Reference point": (0, 1.0),
            "Turn": "90*min(t, 1)", "Displacement": "0 ; -0.48*max(t - 1, 0)"}
    scene = far(2, tall, .3, 2)
    a, b = laws.run(scene), laws.run(merge(scene, {"Obstacle punch": {"Turn": "0", "Sizes": sides[::-1]}}))
    size = b.largest("r_n")
    laws.demand(f"a box turned by a right angle touches, by {size:.3g}", size > 0)
    second = b.at()
    laws.check("  reactions are those of one with other sides",
               max(abs(row[c] - second[key][c]) for key, row in a.at().items() for c in ("r_n", "r_t1")) / size, 1e-9)


def shapes(laws):
    """Edges of a punch pass over cells; files are what they describe."""
    low, high = (-.73, -.47, .0), (-.01, .55, .5)
    motion = "0.31*max(t - 1, 0) ; 0.12*max(t - 1, 0) ; -0.02*min(t, 1)"
    punch = {"Shape": "box", "Center": tuple((a + b) / 2 for a, b in zip(low, high)),
             "Sizes": tuple(b - a for a, b in zip(low, high)), "Displacement": motion}
    points, faces = brick(low, high)
    write_stl(laws.folder / "box.stl", points, faces)
    a = laws.run(far(3, punch, .3, 3))
    b = laws.run(far(3, {"Shape": "surface mesh", "File": "box.stl", "Displacement": motion}, .3, 3))
    laws.same("box and its file, drawn", a, b, 1e-9)
    laws.check("  energies", max(energy_error(a), energy_error(b)), 1e-9)
    laws.check("  friction of nodes that touch", slip_error(a, .3, 1.5), 1e-9)

    cone = {"Shape": "cone", "Point": (-.4, .1, .0), "Axis": (0, 0, 1), "Half angle": 80.0, "Apex radius": .3,
            "Displacement": "0.6*max(t - 1, 0) ; 0 ; -0.04*min(t, 1)"}
    run = laws.run(far(3, cone, .3, 6))
    laws.check("cone, drawn: energies", energy_error(run), 1e-9)
    laws.check("  friction of nodes that touch", slip_error(run, .3, 1.6), 1e-9)

    write_msh(laws.folder / "line.msh", [(-1.13, .0, 0), (-.07, .0, 0), (-.07, .4, 0), (-1.13, .4, 0)],
              [(0, 1), (1, 2), (2, 3), (3, 0)])
    motion = "0.77*max(t - 1, 0) ; -0.02*min(t, 1)"
    plane = {"Shape": "box", "Center": (-.6, .2), "Sizes": (1.06, .4), "Displacement": motion}
    a = laws.run(far(2, plane, .3, 7))
    b = laws.run(far(2, {"Shape": "surface mesh", "File": "line.msh", "Displacement": motion}, .3, 7))
    laws.same("rectangle and lines of a file, drawn", a, b, 1e-9)


def pressed(laws):
    """Loads press a ball, a disc and a plate that are driven across: each carries its load everywhere."""
    ball = {"Shape": "sphere", "Center": (-.3, 0, 2.0), "Radius": 2.0, "Free": "z", "Reference point": (-.3, 0, 2.0),
            "Force": "0 ; 0 ; -8*min(t, 1)", "Displacement": "0.6*max(t - 1, 0) ; 0.1*max(t - 1, 0) ; 0"}
    run = laws.run(far(3, ball, .3, 8))
    laws.check("ball under a load: the load", max(abs(row["top_f_z"] / -8 - 1) for row in run.increments), 1e-9)
    laws.check("  energies", energy_error(run), 1e-9)
    laws.check("  balance of the ball", max(row["balance_punch"] for row in run.increments), 1e-10)
    laws.check("  friction of nodes that touch", slip_error(run, .3, 1.5), 1e-9)
    depth = [row["obstacle_punch_u_z"] for row in run.increments]
    laws.check("  its depth on the way", (max(depth) - min(depth)) / abs(depth[0]), .05)

    # turned by what touches it, a disc rolls
    disc = {"Shape": "cylinder", "Point": (-.1, 4.0), "Radius": 4.0, "Free": "y, rz", "Reference point": (-.1, 4.0),
            "Force": "0 ; -10*min(t, 1)", "Displacement": "0.16*max(t - 1, 0) ; 0"}
    for way in (.16, 1.6):
        disc["Displacement"] = f"{way}*max(t - 1, 0) ; 0"
        run = laws.run(far(2, merge(disc, {"Point": (-way / 2, 4.0), "Reference point": (-way / 2, 4.0)}), .3, 16, 2, (48, 6), (3.0, .6)))
        last = run.increments[-1]
        laws.check(f"disc that may turn, by {way}: the load", max(abs(row["top_f_y"] / -10 - 1) for row in run.increments), 1e-9)
        laws.check("  it rolls", abs(last["obstacle_punch_rot_z"] / (-way / 4) - 1), .03)
        laws.check("  friction", abs(last["top_f_x"] / last["top_f_y"]), 1e-2)
        laws.check("  energies", energy_error(run), 1e-9)


def beside(laws):
    """Blocks that are tied, or guided, slide as one block, or one whose side is held."""
    whole = press_and_shear(2, (12, 6), .3, 5)
    whole["Support top"]["Displacement"] = whole["Support top"]["Displacement"].replace("0.004", "0.4")
    whole["Contact bottom"].update(FAR)
    a = laws.run(whole)
    lower, upper = box((12, 3), (2.0, .5)), box((12, 3), (2.0, .5), (0.0, .5))
    tied = merge(whole, {"Body block": lower, "Body cap": upper, "Support top": {"Body": "cap"},
                         "Contact joint": {"Body": "cap", "Boundary ids": 2, "Master body": "block", "Master boundary ids": 3,
                                           "Kind": "tie"}})
    b = laws.run(tied)
    b.rows = [row for row in b.rows if row["contact"] == "bottom"]
    laws.same("two tied blocks and one", a, b, 1e-9)
    guided = {"Dimension": 2, "Body block": box((12, 6), (2.0, 1.0)), "Obstacle floor": floor(2),
              "Obstacle wall": {"Shape": "half space", "Normal": (1, 0), "Displacement": "0.4*max(t - 1, 0) ; 0"},
              "Contact bottom": contact(mu=.3, **FAR), "Load top": load("pressure", "min(t, 1)", 3),
              "Contact guide": {"Body": "block", "Boundary ids": 0, "Obstacle": "wall", "Kind": "bilateral"},
              "Time": {"End": 5, "Increments": 5}, "Output": {"VTU": 0}}
    last = laws.run(guided).increments[-1]
    laws.check("a block that a guide pushes: friction", abs(last["guide_f_x"] / (.3 * 2) - 1), 1e-9)
    gap = {"Body side": box((2, 4), (.5, 1.0), (2.0, 0.0)), "Support side": support("1", "x, y", "0.4*max(t - 1, 0) ; 0", "side"),
           "Contact fit": {"Body": "side", "Boundary ids": 0, "Master body": "block", "Master boundary ids": 1,
                           "Gap": "-0.001*min(t, 1)"}}
    run = laws.run({**merge(whole, {"Support top": {"Displacement": "0.4*max(t - 1, 0) ; -0.01*min(t, 1)"}}), **gap})
    laws.demand("a press fit beside what slides", all(row["fit_f_x"] > 0 for row in run.increments))
    laws.check("  energies", energy_error(run), 1e-9)


def in_parts(laws):
    """A block in a valley that is pulled over: increments are cut, and said to be."""
    scene = {"Dimension": 2, "Body block": box((1, 4), (.1, .4), (-.05, .05)),
             "Obstacle hill": {"Shape": "implicit", "Function": "y - 0.2*(1 - cos(2*pi*x))"},
             "Contact bottom": contact(obstacle="hill", mu=.3, **FAR), "Support top": support(3, "x", "2*max(t - 1, 0)"),
             "Load weight": load("pressure", "min(t, 1)", 3), "Time": {"Stages": "1 : 1, 2 : 3"}, "Output": {"VTU": 0}}
    run = laws.run(scene)
    parts = [int(row["substeps"]) for row in run.increments]
    laws.demand(f"increments in {parts} parts", max(parts) > 1)
    laws.demand("  the log says so", "it is cut: a part up to t = " in log_of(run))
    laws.check("  energies of whole increments", energy_error(run), 1e-9)
    # parts are halves of halves here, as twelve increments are
    fine = laws.run(merge(scene, {"Time": {"Stages": "1 : 1, 2 : 12"}}))
    for node in {row["x"] for row in run.rows}:
        coarse, others = ([row for row in r.rows if row["x"] == node] for r in (run, fine))
        slips = [sum(row["du_t1"] for row in others[4 * k - 3:4 * k + 1]) for k in (1, 2, 3)]
        laws.check(f"  node at {node:g}: slips are those of all parts",
                   max(abs(row["du_t1"] - slip) for row, slip in zip(coarse[1:], slips)), 1e-9)
        laws.check("  reactions are those of the last", max(abs(row["r_n"] - others[4 * k]["r_n"]) for k, row in enumerate(coarse)), 1e-9)
    work = [sum(row["external_work"] for row in r.increments) for r in (run, fine)]
    laws.check("  work", abs(work[0] / work[1] - 1), 1e-9)


def through(laws):
    """An obstacle that would be behind the body at the end of an increment has met it on its way."""
    disc = {"Shape": "cylinder", "Point": (0, .6), "Radius": .5, "Displacement": "0 ; -3*t"}
    scene = far(2, disc, .3, 1) | {"Time": {"End": 1, "Increments": 1}}
    done, _ = laws.start(scene)
    laws.demand(f"a disc that jumps through a layer is refused: {done.stderr.strip()[:120]}",
                done.returncode == 2 and "obstacle 'punch' passes through body 'block'" in done.stderr)
    # in one increment a plate comes to stand with its other side nearer
    plate = {"Shape": "box", "Center": (.1, .03), "Sizes": (4.0, .05), "Displacement": "0 ; -0.04*t"}
    thin, thick = (laws.run(scene | {"Obstacle punch": plate | more})
                   for more in ({}, {"Center": (.1, 1.005), "Sizes": (4.0, 2.0)}))
    laws.check("a thin plate presses as a thick one", max(abs(row["r_n"] - other["r_n"]) for row, other in zip(thin.last(), thick.last()))
               / thick.largest("r_n"), 1e-9)
    slab = {"Body plate": box((7, 1), (1.5, .05), (-.75, .0)), "Support plate": support("2, 3", "x, y", "0 ; -0.04*t", body="plate"),
            "Contact top": {"Body": "block", "Boundary ids": 3, "Master body": "plate", "Master boundary ids": 2,
                            "Friction coefficient": 0, "Kinematics": "finite sliding"}}
    one, many = (laws.run({key: value for key, value in scene.items() if key not in ("Obstacle punch", "Contact top")} | slab
                          | {"Time": {"End": 1, "Increments": n}}) for n in (1, 8))
    laws.check("a thin body that is driven past its own thickness", max(abs(row["r_n"] - other["r_n"]) for row, other in zip(one.last(), many.last()))
               / many.largest("r_n"), 1e-6)
    beside = laws.run(merge(scene, {"Obstacle punch": {"Displacement": "9*t ; 0"}}))
    laws.demand("one that passes by is not", beside.largest("r_n") == 0)


def driven_far(laws):
    for family in (spun, rolled, turned_box, shapes, pressed, beside, in_parts, through):
        family(laws)
