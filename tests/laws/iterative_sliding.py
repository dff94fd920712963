# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contacts that slide far without condensation: the tables of the condensed backend."""
import math

from laws.drawn import drawn
from laws.iterative import backend, compare
from laws.sliding import FAR, disc, slab
from support.scenes import box, contact, floor, joint, load, merge, press_and_shear, support


def ball():
    """Pressed into a layer, then moved over it."""
    return {"Dimension": 3, "Body layer": box((9, 4, 3), (3.6, 1.6, .8), (-1.8, -.8, -.8)),
            "Obstacle ball": {"Shape": "sphere", "Radius": 2.0, "Center": (-.8, -.1, 2.0),
                              "Displacement": "1.6*max(t - 1, 0) ; 0.2*max(t - 1, 0) ; -0.06*min(t, 1)"},
            "Contact top": contact("layer", 5, "ball", .2, **FAR), "Support base": support(4, "x, y, z", body="layer"),
            "Time": {"Stages": "1 : 2, 2 : 4"}, "Output": {"VTU": 0}}


def rolling_disc(degrees, increments):
    """An elastic disc, which nothing else holds, between a floor and a plate that is drawn along."""
    way = 2 * math.radians(degrees)
    return {"Dimension": 2,
            "Body disc": {"Mesh": {"Generator": "hyper_ball_balanced", "Arguments": "0, 0 : 1", "Global refinements": 3,
                                   "Boundary ids": "1: y < -0.2 ; 2: y > 0.2"},
                          "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}},
            "Obstacle floor": {"Shape": "half space", "Normal": (0, 1), "Point": (0, -.99)},
            "Obstacle plate": {"Shape": "half space", "Normal": (0, -1), "Point": (0, .99),
                               "Displacement": f"{way!r}*max(t - 1, 0) ; 0"},
            "Contact low": contact("disc", 1, "floor", .4, **FAR), "Contact high": contact("disc", 2, "plate", .4, **FAR),
            "Time": {"Stages": f"1 : 1, 2 : {increments}"}, "Output": {"VTU": 0}}


def guided():
    """A block drawn over a hill: contacts alone hold it up, and it rises far."""
    return {"Dimension": 2, "Body block": box((4, 4), (.2, .2), (-.1, .005), 1e5, **{"Boundary ids": "7: x < -0.09 && y > 0.1"}),
            "Obstacle hill": {"Shape": "implicit", "Function": "y - 0.1*(1 - cos(pi*x))"},
            "Contact bottom": contact(obstacle="hill", mu=.2, **FAR),
            "Support left": support(7, "x", "2*max(t - 1, 0)"), "Load weight": load("pressure", "min(t, 1)", 3),
            "Time": {"Stages": "1 : 1, 2 : 20"}, "Output": {"VTU": 0}}


def pushed_to_and_fro():
    """A heavy block that discs on both sides push over a floor, and tilt."""
    def pusher(x, y):
        return {"Shape": "sphere", "Center": (x, y), "Radius": .4, "Displacement": "0.05*sin(1.5708*t) ; 0"}
    return {"Dimension": 2, "Body block": box((16, 8), (2.0, 1.0), **{"Boundary ids": "10: x < 1e-9 && y > 0.2 ; 11: x > 2 - 1e-9 && y > 0.2"}),
            "Obstacle floor": floor(2), "Obstacle left": pusher(-.4, .55), "Obstacle right": pusher(2.42, .5),
            "Contact bottom": contact(mu=.05, **FAR), "Contact left": contact(ids=10, obstacle="left", mu=.1, **FAR),
            "Contact right": contact(ids=11, obstacle="right", mu=.1, **FAR), "Load weight": load("body force", "0 ; -10"),
            "Time": {"Times": "1, 2, 3, 4, 5, 5.5"}, "Output": {"VTU": 0}}


def three_bodies():
    """A runner is drawn over a block towards its edge, which is pressed on a neighbour."""
    return {"Dimension": 2, "Body runner": box((3, 2), (.5, .3), (.2, 1.0)), "Body block": box((8, 4), (2.0, 1.0)),
            "Body neighbour": box((4, 4), (1.0, 1.0), (2.0, 0.0)),
            "Contact top": joint("runner", 2, "block", 3, **{"Friction coefficient": .2, "Pairing": "node to face", **FAR}),
            "Contact side": joint("block", 1, "neighbour", 0, **{"Friction coefficient": .2, "Pairing": "node to face"}),
            "Support base": support(0, "x, y", body="block"), "Support wall": support(1, "x, y", "-0.005*min(t, 1) ; 0", "neighbour"),
            "Support grip": support(3, "x, y", "0.5*max(t - 1, 0) ; -0.005*min(t, 1)", "runner"),
            "Time": {"End": 4, "Increments": 4}, "Output": {"VTU": 0}}


def iterative_sliding(laws):
    compare(laws, "disc over a layer", disc(8, 1.0))
    compare(laws, "ball over a layer", ball())
    for dim in (2, 3):
        scene = press_and_shear(dim, increments=4)
        scene["Support top"]["Displacement"] = scene["Support top"]["Displacement"].replace("0.004", "0.43")
        cells = ((28, 1), (7.0, .5), (-1.0, -.5)) if dim == 2 else ((13, 11, 1), (6.5, 4.4, .5), (-1.0, -1.0, -.5))
        for pairing in ("node to face", "mortar"):
            compare(laws, f"{dim}D, block over a slab, {pairing}", slab(scene, *cells, "bottom", Pairing=pairing))
    compare(laws, "pushed to and fro", pushed_to_and_fro())
    # both backends say alike how far a strained body has turned
    run = compare(laws, "rolling disc", rolling_disc(40.0, 10))
    low = [row for row in run.rows if row["contact"] == "low" and row["state"] != "open"]
    turned = [math.degrees(math.atan2(row["x"], -row["y"])) for row in low if row["increment"] == run.increments[-1]["increment"]]
    laws.check("  it rolls: what touches the floor is 40 degrees from where it did", abs(sum(turned) / len(turned) / 40 - 1), .1)
    compare(laws, "block over a hill", guided())
    # a frame of the body follows it, so that the motion costs no digits
    compare(laws, "block over a plane, far", merge(press_and_shear(2), {
        "Support top": {"Displacement": "100*max(t - 1, 0) ; -0.01*min(t, 1)"}, "Contact bottom": FAR}))
    # nothing carries anything, and what moves rounds no forces
    for kinematics in ({}, FAR):
        still = compare(laws, f"a block that is carried over a floor{', far' * bool(kinematics)}", merge(press_and_shear(2), {
            "Support top": {"Displacement": "3.1*t ; -0.11*max(t - 0.5, 0)"}, "Contact bottom": kinematics,
            "Obstacle floor": {"Point": (0.0, -1.0)}}))
        laws.check("  no force", max(abs(row[name]) for row in still.rows for name in ("r_n", "r_t1")), 0)
    # blocks that fall 2e10 times as far as they are strained: nodal forces are known to the rounding of that, sums to all digits
    for dim in (2, 3):
        fall = {"Dimension": dim, "Body block": box((9, 3) if dim == 2 else (4, 4, 3), (1.0,) * dim, (0.0,) * (dim - 1) + (20.0,), 2e5),
                "Obstacle floor": floor(dim), "Contact bottom": contact(ids=2 if dim == 2 else 4, mu=.5),
                "Load weight": load("body force", " ; ".join(["0"] * (dim - 1) + ["-2e-4"])), "Load push": load(
                    "traction", " ; ".join(["9e-5*max(t - 1, 0)/2"] + ["0"] * (dim - 1)), 0),
                "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}
        run = compare(laws, f"{dim}D, a block that falls far", fall, bound=1e-4)
        laws.check("  the floor carries it", max(abs(row["bottom_f_" + "xyz"[dim - 1]] / 2e-4 - 1) for row in run.increments), 1e-9)
    # faces that are covered in part: means over nodes of the slave, by the neighbours of which they are
    for exchanged in (False, True):
        compare(laws, f"die on a layer{', exchanged' * exchanged}", merge(
            drawn(laws, (20, 6), .5, 1, exchanged), {"Time": {"Stages": None, "Times": "0.5, 1, 1.3, 2"}}))
    # the runner comes to nodes that face a third body themselves
    run = laws.run(three_bodies(), *backend("iterative"))
    laws.same("over an edge that meets another body", laws.run(three_bodies(), *backend("condensed")), run, 1e-8)
    laws.demand("  it is condensed where it has to be", [row["solver"] == "iterative" for row in run.increments]
                == [True, True, True, False] and "From here on bodies are condensed" in (run.folder / "log.txt").read_text())
