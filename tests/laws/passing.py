# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that meet others between the ends of an increment: they are met, or the scene is refused."""
import itertools
import re

from support.logs import log_of
from support.scenes import box, merge, support
from support.tables import Run

FAR = {"Kinematics": "finite sliding"}


def passing(laws):
    bullets(laws)
    small_bullets(laws)
    swings(laws)
    deep_punch(laws)
    flush(laws)
    needles(laws)
    pressed_between(laws)
    askew(laws)


def met(laws, what, scene):
    """Refused, or there are forces: for what is driven so far both are right."""
    done, folder = laws.start(scene)
    force = 0 if done.returncode else Run(folder).largest("r_n")
    laws.demand(f"{what}: {done.stderr.strip().splitlines()[-1][:140] if done.returncode else f'a force of {force:.4g}'}",
                done.returncode == 2 or force > 0)


def pair(slave, slave_ids, master, master_ids, **entries):
    return {"Body": slave, "Boundary ids": slave_ids, "Master body": master, "Master boundary ids": master_ids,
            "Friction coefficient": 0, **FAR, **entries}


def bullets(laws):
    """A block that is driven to the other side of another one."""
    for dim in (2, 3):
        more = (.4,) * (dim - 2)
        for width, cells in ((.5, 3), (.03, 1), (1.5, 6)):
            for slave in ("bullet", "wall"):
                shot = {"Dimension": dim, "Body bullet": box((3,) * dim, (.4, .4) + more, (-2.0, .13) + (.05,) * (dim - 2)),
                        "Body wall": box((cells, 7) + (3,) * (dim - 2), (width, 1.4) + (.5,) * (dim - 2), (0.0, -.3) + (0.0,) * (dim - 2)),
                        "Support bullet": support(0, "x, y, z"[:3 * dim - 2], "4*t" + " ; 0" * (dim - 1), "bullet"),
                        "Support wall": support(1, "x, y, z"[:3 * dim - 2], "0", "wall"),
                        "Contact hit": pair("bullet", 1, "wall", 0) if slave == "bullet" else pair("wall", 0, "bullet", 1),
                        "Time": {"End": 1, "Increments": 1}, "Output": {"VTU": 0}}
                what = f"{dim}D, {slave} as slave, wall of {width:g}"
                met(laws, f"{what}: one that goes through it", shot)
                beside = laws.run(merge(shot, {"Support bullet": {"Displacement": "4*t ; 5*t" + " ; 0" * (dim - 2)}}))
                laws.demand(f"{what}: one that passes beside it is not", beside.largest("r_n") == 0)


def small_bullets(laws):
    """What is smaller than the cells of the slave is found by its own nodes."""
    for thickness in (.2, .6):
        for pairing in ("mortar", "node to face"):
            scene = {"Dimension": 2, "Body plate": box((4, 1), (4.0, thickness), (-2.0, -thickness)), "Support base": support(2, "x, y", body="plate"),
                     "Body ball": box((2, 2), (.04, .04), (.03, 3.0)), "Support drive": support(3, "x, y", "0 ; -6*t", "ball"),
                     "Contact hit": pair("plate", 3, "ball", "0, 1, 2", Pairing=pairing), "Time": {"End": 1, "Increments": 1}, "Output": {"VTU": 0}}
            for n in (1, 7, 23):
                what = f"a small block through a plate of {thickness:g} in {n}, {pairing}"
                met(laws, what, merge(scene, {"Time": {"Increments": n}}))
                if pairing == "node to face":  # the only one that takes nodes of supports
                    met(laws, f"{what}, top and bottom in contact",
                        merge(scene, {"Contact hit": {"Boundary ids": "3, 4"},
                                      "Body plate": {"Mesh": {"Boundary ids": f"4: y < {.01 - thickness!r} && x > -0.9"}},
                                      "Time": {"Increments": n}}))


def swings(laws):
    """A bar that is swung through a block, which its supports bend it round else."""
    bar = {"Dimension": 2, "Body bar": box((20, 2), (4.0, .3)), "Body post": box((2, 9), (.5, 3.0), (-.25, 1.6)),
           "Support hub": {"Body": "bar", "Boundary ids": 0, "Turn": "178*t", "Reference point": (0, .15)},
           "Support post": support(0, "x, y", "0", "post"),
           "Contact hit": pair("bar", 3, "post", 1, Pairing="node to face"), "Time": {"End": 1, "Increments": 1}, "Output": {"VTU": 0}}
    met(laws, "a bar that is swung through a block", bar)
    turned = merge(bar, {"Contact hit": {"Body": "post", "Boundary ids": 1, "Master body": "bar", "Master boundary ids": 3}})
    met(laws, "  the block as slave", turned)
    rigid = merge(bar, {"Body post": None, "Support post": None,
                        "Obstacle post": {"Shape": "box", "Center": (0, 3.1), "Sizes": (.5, 3.0)},
                        "Contact hit": {"Master body": None, "Master boundary ids": None, "Obstacle": "post"}})
    met(laws, "  through an obstacle", rigid)
    met(laws, "  in increments of 6 degrees", merge(rigid, {"Time": {"Increments": 30}}))
    short = laws.run(merge(bar, {"Body post": box((2, 2), (.5, .5), (-.25, 4.5))}))
    laws.demand("  one that is out of its reach is not", short.largest("r_n") == 0)


def deep_punch(laws):
    """A punch that comes in by more than a cell in one increment is met by its face, not by its sides."""
    scene = {"Dimension": 2, "Body block": box((24, 12), (2.0, 1.0), (-1.0, -1.0)), "Support ground": support(2, "x, y"),
             "Body punch": box((5, 4), (.61, .5), (-.305, .0)), "Support punch": support(3, "x, y", "0 ; -0.2*t", body="punch"),
             "Contact top": pair("block", 3, "punch", "0, 1, 2"), "Time": {"End": 1, "Increments": 1}, "Output": {"VTU": 0}}
    one, many = (laws.run(merge(scene, {"Time": {"Increments": n}})) for n in (1, 8))
    force = [run.increments[-1]["top_f_y"] for run in (one, many)]
    laws.check(f"a punch pressed in by two cells, {force[0]:.5g}: as in eight increments", abs(force[0] / force[1] - 1), 1e-6)


def flush(laws):
    """A block whose bottom is level with another one's top slides onto it, whatever sides are in contact."""
    for gap, n in itertools.product((0.0, 1e-9, 1e-6), (8, 40)):
        run = laws.run({"Dimension": 2, "Body low": box((8, 6), (2.0, 1.0)), "Support low": support(2, "x, y", body="low"),
                        "Body up": box((5, 4), (1.0, 1.0), (-1.5, 1 + gap)), "Support up": support(3, "x, y", "4*t ; 0", "up"),
                        # mortar takes no nodes of supports
                        "Contact joint": pair("up", "0, 1, 2", "low", "1, 0, 3", Pairing="node to face"),
                        "Time": {"End": 1, "Increments": n}, "Output": {"VTU": 0}})
        laws.check(f"a block flush with another to {gap:g} slides across it in {n}, force", run.largest("r_n"), 1e-9)


def pressed_between(laws):
    """What meets no node at all is warned of before it is deep."""
    for radius, depth in ((1.0, .06), (2.0, .025)):
        run = laws.run({"Dimension": 3, "Body block": box((4, 4, 2), (2.0, 2.0, 1.0), (-1.0, -1.0, -1.0)), "Support ground": support(4, "x, y, z"),
                        "Obstacle ball": {"Shape": "sphere", "Center": (.25, .25, radius), "Radius": radius, "Displacement": f"0 ; 0 ; -{depth}*t"},
                        "Contact top": {"Body": "block", "Boundary ids": 5, "Obstacle": "ball", **FAR},
                        "Time": {"End": 1, "Increments": 1}, "Output": {"VTU": 0}})
        laws.demand(f"a ball of {radius / .5:g} cells pressed between nodes: warned of",
                    "in between its nodes" in log_of(run) and run.largest("r_n") == 0)


def needles(laws):
    """What comes in between two nodes meets none: the log says so; what is as large as cells does not come in."""
    for kinematics in ("small", "finite sliding"):
        for width, radius, beside, warns in ((.05, .04, 0, True), (.05, .04, .055, True), (.4, 2.0, 0, False)):
            plane = {"Dimension": 2, "Body block": box((10, 5), (2.0, 1.0), (-1.1, -1.0)), "Support ground": support(2, "x, y"),
                     "Obstacle punch": {"Shape": "box", "Center": (beside, .5), "Sizes": (width, 1.0), "Displacement": "0 ; -0.03*t"},
                     "Contact top": {"Body": "block", "Boundary ids": 3, "Obstacle": "punch", "Friction coefficient": 0,
                                     "Kinematics": kinematics},
                     "Time": {"End": 1, "Increments": 2}, "Output": {"VTU": 0}}
            ball = merge(plane, {"Dimension": 3, "Body block": box((5, 5, 3), (1.0, 1.0, .5), (-.5, -.5, -.5)),
                                 "Support ground": support(4, "x, y, z"), "Contact top": {"Boundary ids": 5},
                                 "Obstacle punch": {"Shape": "sphere", "Center": (beside, 0, radius), "Sizes": None, "Radius": radius,
                                                    "Displacement": "0 ; 0 ; -0.03*t"}})
            for scene in (plane, ball):
                run = laws.run(scene)
                says = "in between its nodes" in log_of(run)
                laws.demand(f"{scene['Dimension']}D, {kinematics}, a punch of {width if scene is plane else radius:g} at {beside:g}: "
                            f"{'warned of' if says else 'no warning'}, force {run.largest('r_n'):.3g}",
                            says == warns and (warns or run.largest("r_n") > 0))
    for pairing in ("mortar", "node to face"):
        for slave in ("block", "pin"):
            joint = pair("block", 3, "pin", "0, 1, 2") if slave == "block" else pair("pin", "0, 1, 2", "block", 3)
            scene = {"Dimension": 2, "Body block": box((4, 2), (2.0, 1.0), (-.75, -1.0)), "Support ground": support(2, "x, y"),
                     "Body pin": box((2, 4), (.1, .4), (.02, .001)), "Support pin": support(3, "x, y", "0 ; -0.1*t", body="pin"),
                     "Contact top": {**joint, "Pairing": pairing, "Kinematics": "small"}, "Time": {"End": 1, "Increments": 1},
                     "Output": {"VTU": 0}}
            for n in (1, 24):  # once, or as it comes nearer
                run = laws.run(merge(scene, {"Time": {"Increments": n}}))
                force = abs(run.increments[-1]["top_f_y"])
                says = re.search("warning: .*(in between nodes of the slave|no node)", log_of(run))
                laws.demand(f"{pairing}, a pin of fine cells, {slave} as slave, {n} increments: "
                            f"{'warned of' if says else 'no warning'}, force {force:.3g}", bool(says) != (force > 0))


def askew(laws):
    """An obstacle's edge on a node presses along neither side: the log says so; what is round does not."""
    block = {"Dimension": 2, "Body block": box((8, 4), (2.0, 1.0), (-1.0, -1.0)), "Support ground": support(2, "x, y"),
             "Contact top": {"Body": "block", "Boundary ids": 3, "Obstacle": "punch", "Friction coefficient": .3},
             "Time": {"End": 1, "Increments": 1}, "Output": {"VTU": 0}}
    for name, punch, warns in (("edges on nodes", {"Shape": "box", "Center": (0, .5), "Sizes": (1.0, 1.0)}, True),
                               ("edges between nodes", {"Shape": "box", "Center": (0, .5), "Sizes": (1.1, 1.0)}, False),
                               ("a disc", {"Shape": "cylinder", "Point": (0, 1.0), "Radius": 1.0}, False)):
        run = laws.run(merge(block, {"Obstacle punch": {**punch, "Displacement": "0 ; -0.01*t"}}))
        says = "off the body's normal" in log_of(run)
        laws.demand(f"{name}: {'warned of' if says else 'no warning'}", says == warns)
