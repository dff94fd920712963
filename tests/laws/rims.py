# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slaves that reach beyond the rim of their master.

rims: one of 20 cells on a master that ends anywhere in a cell, against an independent implementation and against
meshes whose nodes end at the rim; masters that few nodes face.
"""
import itertools

from support.scenes import box, joint, load, merge, support

CELLS, WIDTH = 20, 2.0
# Largest pressures under 1 where functions beyond the rim are given to covered nodes, by an independent
# implementation: two blocks of Q1 cells without friction, the master of 15 cells up to this end.
LARGEST = {1.5: 4.05, 1.501: 4.01, 1.51: 3.75, 1.52: 3.53, 1.55: 3.10, 1.58: 2.76, 1.59: 2.66, 1.6: 3.44}


def overhang(dim, end, slave="upper", fitted=False, layers=10):
    """A block pressed by 1 on one that ends at `end`; the longer one is the slave. Fitted: its nodes end there, too."""
    up = slave == "upper"
    inner = round(end / WIDTH * CELLS)
    across = (1,) * (dim - 2)
    counts = {slave: (CELLS, *across, layers), "lower" if up else "upper": (15, *across, layers)}
    blocks = {name: box(cells, (WIDTH if name == slave else end, *(.5 for _ in across), 1.0),
                        (*(0.0,) * (dim - 1), 0.0 if name == "upper" else -1.0)) for name, cells in counts.items()}
    if fitted:
        lengths = [end / inner] * inner + [(WIDTH - end) / (CELLS - inner)] * (CELLS - inner)
        steps = " ; ".join(", ".join(map(repr, axis)) for axis in (lengths, *([.5] for _ in across), [1 / layers] * layers))
        mesh = blocks[slave]["Mesh"]
        mesh["Arguments"] = " : ".join((steps, *mesh["Arguments"].split(" : ")[1:]))
    bottom, top = 2 * dim - 2, 2 * dim - 1
    sides = (("upper", bottom), ("lower", top))
    return {"Dimension": dim, **{f"Body {name}": block for name, block in blocks.items()},
            "Contact joint": joint(*(sides[0] + sides[1] if up else sides[1] + sides[0])),
            "Support floor": support(bottom, ", ".join("xyz"[:dim]), body="lower"),
            "Support guide": support("0" if dim == 2 else "0, 2, 3", "normal", body="upper"),
            "Load press": load("pressure", "1*t", top, "upper"), "Output": {"VTU": 0}}


def largest(laws, scene, what, force):
    """Largest pressure; forces of both sides balance and are the load."""
    run = laws.run(scene)
    up = "xyz"[scene["Dimension"] - 1]
    on_slave, on_master = (run.increments[-1][f"joint_{side}f_{up}"] for side in ("", "master_"))
    laws.check(f"{what}: the whole force", abs(abs(on_slave) / force - 1), 1e-9)
    laws.check("  forces of both sides", abs(on_slave + on_master) / force, 1e-12)
    return max(row["r_n"] / row["area"] for row in run.last() if row["contact"] == "joint")


def rims(laws):
    for end, expected in LARGEST.items():
        found = largest(laws, overhang(2, end), f"master ends at {end}", WIDTH)
        laws.check(f"  largest pressure {found:.4g}", abs(found / expected - 1), .005)
    for dim, slave, end in itertools.product((2, 3), ("upper", "lower"), (1.51, 1.58)):
        force = (WIDTH if slave == "upper" else end) * (.5 if dim == 3 else 1)
        found, fitted = (largest(laws, overhang(dim, end, slave, fit, 10 if dim == 2 else 2),
                                 f"{dim}D, slave {slave}, master ends at {end}{', nodes at the rim' * fit}", force)
                         for fit in (False, True))
        laws.check(f"  largest pressure {found:.4g} instead of {fitted:.4g}: factor", max(found / fitted, fitted / found), 1.5)
    small_masters(laws)
    feet(laws)


def feet(laws):
    """A block with a foot and an overhang beside it: what is a step behind the foot takes no part in means over it."""
    for dim, cells in itertools.product((2, 3), (7, 16)):
        turned = 180.0 if dim == 2 else (1.0, 0.0, 0.0, 180.0)
        up = "xyz"[dim - 1]
        block = {"Mesh": {"Generator": "hyper_L", "Arguments": "-1 : 1 : false", "Rotation": turned, "Global refinements": 2,
                          "Boundary ids": f"7: {up} < -0.999 ; 8: {up} > 0.999"},
                 "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}}
        cells = cells if dim == 2 else cells - 4
        table = box((cells,) * (dim - 1) + (2,), (3.0,) * (dim - 1) + (1.0,), (-1.5,) * (dim - 1) + (-2.0,))
        scene = {"Dimension": dim, "Body block": block, "Body table": table,
                 "Contact joint": joint("table", 2 * dim - 1, "block", "0, 7", **{"Friction coefficient": .3}),
                 "Support floor": support(2 * dim - 2, ", ".join("xyz"[:dim]), body="table"),
                 "Load press": load("traction", " ; ".join(["0.1*t"] * (dim - 1) + ["-1*t"]), 8, "block"), "Output": {"VTU": 0}}
        whole = laws.run(scene)
        foot = laws.run(merge(scene, {"Contact joint": {"Master boundary ids": 7}}))
        pressed = [{(row["x"], row["y"], row["z"]): row["r_n"] for row in run.last() if row["contact"] == "joint"} for run in (whole, foot)]
        size = max(pressed[1].values())
        laws.check(f"{dim}D, {cells} cells: as with the foot alone",
                   max(abs(r - pressed[1].get(place, 0)) for place, r in pressed[0].items()) / size, 1e-9)
        laws.check("  moments of both sides", max(abs(whole.increments[-1][f"joint_m_{c}"] + whole.increments[-1][f"joint_master_m_{c}"])
                                                  for c in "xyz") / size, 1e-9)


def small_masters(laws):
    """Blocks on a plate whose cells are nearly as large: they stand, one node facing them or none, and keep a pressure."""
    for dim, (low, high) in itertools.product((2, 3), ((.1, .45), (.02, .52), (.2, 1.2))):
        size = high - low
        upper = box((3,) * (dim - 1) + (2,), (size,) * (dim - 1) + (.4,), (low,) * (dim - 1) + (0.0,))
        lower = box((3,) * (dim - 1) + (1,), (1.5,) * (dim - 1) + (.5,), (0.0,) * (dim - 1) + (-.5,), young=1e5)
        scene = {"Dimension": dim, "Body lower": lower, "Body upper": upper,
                 "Contact joint": joint("lower", 2 * dim - 1, "upper", 2 * dim - 2, **{"Friction coefficient": .5}),
                 "Support floor": support(2 * dim - 2, ", ".join("xyz"[:dim]), body="lower"),
                 "Load press": load("pressure", "1*t", 2 * dim - 1, "upper"), "Output": {"VTU": 0}}
        found = largest(laws, scene, f"{dim}D, a block from {low} to {high} on cells of .5", size**(dim - 1))
        laws.check(f"  largest pressure {found:.4g}", found, 4)
        tied = merge(scene, {"Contact joint": {"Kind": "tie", "Friction coefficient": None},
                             "Load side": load("traction", "0.3*t" + " ; 0" * (dim - 1), 2 * dim - 1, "upper")})
        largest(laws, tied, "  tied", size**(dim - 1))
