#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that are used several times are factorised once, however they are turned and where they touch each other;
results are those of each by itself.

usage: check_equal_bodies.py PROGRAM [FAMILY...]      (default: every family)
"""
import sys

from support import scenes
from support.checks import run_families
from support.logs import check_estimates, demand_work, dry_run, log_of
from support.tables import Run

TURNS = {2: (((0, 0, 1), 0.0), ((0, 0, 1), 37.3), ((0, 0, 1), -101.7)),
         3: (((0, 0, 1), 0.0), ((1, 2, 3), 23.7), ((-2, 1, .3), 131.1))}
TWO = {2: "x, y", 3: "x, y, z"}


def renamed(scene, number):
    """The same scene with other names."""
    result = {}
    for key, entry in scene.items():
        kind, _, name = key.partition(" ")
        if kind in scenes.LISTS:
            entry = {what: f"{value} {number}" if what in ("Body", "Obstacle") else value for what, value in entry.items()}
            key = f"{kind} {name} {number}"
        result[key] = entry
    return result


def part_of(run, number):
    """The rows of one of the scenes."""
    part = Run(run.folder)
    part.rows = [row for row in part.rows if row["contact"].endswith(f" {number}")]
    return part


def demand_shared(laws, name, run, shared, bodies):
    demand_work(laws, name, run, {"factorisations of the elastic system": bodies - shared,
                                  "condensations": bodies - shared})
    laws.demand(f"the log says {shared} of {bodies}",
                f"condensation of {shared} of {bodies} bodies, equal to others" in log_of(run))


def together(laws, name, dim, make, changes=(), shared=2):
    """Three scenes in one, each turned another way, against the first by itself."""
    both, turned = {}, []
    for number, (axis, degrees) in enumerate(TURNS[dim]):
        scene, m = make(axis, degrees)
        turned.append((scene, m))
        both |= renamed(scene, number)
    for key, change in dict(changes).items():
        both = scenes.merge(both, {key: change})
    run = laws.run(both)
    demand_shared(laws, name, run, shared, 3)
    alone = laws.run(turned[0][0])
    for number, (_, m) in enumerate(turned):
        if not changes or number == 1:
            laws.same(f"{name}, body {number}", alone, part_of(run, number), matrix=m)


def turned(laws):
    """Bodies with all that acts on them turned: objectivity, and one factorisation."""
    for dim in (2, 3):
        for supports in ("axes", "normal", "oblique", "springs"):
            together(laws, f"{dim}D, {supports}", dim, lambda *turn: scenes.turned_scene(dim, *turn, supports))
        for what, change in (("Q1 B-bar", {"Element": "Q1 B-bar"}),
                             ("incompatible modes", {"Element": "Q1 incompatible modes"}),
                             ("hanging nodes", {"Mesh": {"Refinement distance": f"{2 if dim == 2 else 4} : 0.1 : 1"}})):
            def with_change(axis, degrees):
                scene, m = scenes.turned_scene(dim, axis, degrees, "oblique")
                return scenes.merge(scene, {"Body block": change}), m
            together(laws, f"{dim}D, {what}", dim, with_change)

        def smooth(axis, degrees):
            scene, m = scenes.turned_scene(dim, axis, degrees, "normal")
            return scenes.merge(scene, {"Contact bottom": {"Friction coefficient": 0}}), m
        together(laws, f"{dim}D, without friction", dim, smooth)


def others(laws):
    """What differs in material or supports has a factor of its own."""
    for dim in (2, 3):
        for what, key, change in (("another material", "Body block 2", {"Material": {"Poisson ratio": .301}}),
                                  ("another support", "Support left 2", None),
                                  ("another foundation", "Support weak 2", {"Stiffness": 1.01e-9})):
            def on_springs(axis, degrees):  # so weak that stiffnesses do not show it
                scene, m = scenes.turned_scene(dim, axis, degrees, "normal")
                return {**scene, "Support weak": {**scene["Support top"], "Boundary ids": 1, "Stiffness": 1e-9}}, m
            together(laws, f"{dim}D, {what}", dim, on_springs, {key: change}, shared=1)
        alone = laws.run(scenes.turned_scene(dim, *TURNS[dim][0], "normal")[0])
        laws.demand("one body has no equal", "equal to others" not in log_of(alone))


def without_equals(scene, names):
    """The same with materials that differ by more than round-off, but by less than the results are compared."""
    for number, name in enumerate(names):
        young = scene[f"Body {name}"]["Material"]["Young modulus"] * (1 + 1e-11 * number)
        scene = scenes.merge(scene, {f"Body {name}": {"Material": {"Young modulus": young}}})
    return scene


def told_beforehand(laws, name, scene, run):
    """A dry run knows what is shared and what it takes."""
    text = dry_run(laws, scene)
    skipped = [line for line in log_of(run).splitlines() if "bodies, equal to others" in line]
    laws.demand(f"{name}: a dry run says so, too", all(line.strip() in text for line in skipped))
    check_estimates(laws, name, text, run, "factor", "memory")


def stacked(laws):
    """Blocks one on the other: each is both slave and master."""
    for dim, cells in ((2, (14, 14)), (3, (6, 6, 6))):
        scene = scenes.stack(dim, (cells,) * 4, (1.0,) * 4, .3, .2)
        run = laws.run(scene)
        demand_shared(laws, f"{dim}D, a stack of 4, the topmost held", run, 2, 4)
        told_beforehand(laws, f"{dim}D, a stack", scene, run)
        whole = laws.run(without_equals(scene, [f"block {i}" for i in range(4)]))
        laws.demand("without equals it is a whole", "equal to others" not in log_of(whole))
        laws.same(f"{dim}D, a stack", whole, run, 1e-9)


def turned_stack(laws):
    """Equal blocks that are turned against each other, meshes that do not match."""
    for dim, cells, half in ((2, (14, 14), ()), (3, (6, 6, 6), (-.5, -.5))):
        size = (1.0,) * dim
        down, side = "-0.01*min(t, 1)", "0.002*max(t - 1, 0)"
        scene = {"Dimension": dim, "Obstacle floor": scenes.floor(dim), "Time": {"End": 3, "Increments": 3},
                 "Output": {"VTU": 0}}
        last = "xyz"[dim - 1]
        for i in range(4):
            # by right angles about the middle of the block in the plane, by any about the vertical in space
            turn = 90.0 * i if dim == 2 else (0.0, 0.0, 1.0, 17.0 * i)
            low, high = f"{last} < {i} + 1e-6", f"{last} > {i + 1} - 1e-6"
            scene[f"Body {i}"] = scenes.box(cells, size, (-.5, -.5) if dim == 2 else (*half, 0.0), Rotation=turn,
                                            Translation=(0.0, i + .5) if dim == 2 else (0.0, 0.0, float(i)),
                                            **{"Boundary ids": f"20: {low} ; 21: {high}"})
            scene[f"Contact {i}"] = {"Body": i, "Boundary ids": 20, "Friction coefficient": .2,
                                     **({"Obstacle": "floor"} if i == 0 else
                                        {"Master body": i - 1, "Master boundary ids": 21, "Pairing": "node to face"})}
        scene["Support top"] = scenes.support(21, TWO[dim], f"{side} ; {down}" if dim == 2 else f"{side} ; 0 ; {down}", 3)
        run = laws.run(scene)
        demand_shared(laws, f"{dim}D, turned blocks in a stack", run, 2, 4)
        laws.same(f"{dim}D, turned blocks in a stack", laws.run(without_equals(scene, "0123")), run, 1e-9)


def mirrored(laws):
    """Two blocks that are each other's mirror image, held and pushed from outside."""
    for dim, cells, size in ((2, (7, 5), (1.0, .8)), (3, (5, 4, 3), (1.0, .9, .8))):
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        zeros = " ; ".join(("0",) * (dim - 2))
        scene = {"Dimension": dim, "Obstacle floor": scenes.floor(dim), "Time": {"End": 2, "Increments": 2},
                 "Output": {"VTU": 0}}
        for name, at, side, sign in (("left", 0.0, 0, ""), ("right", 3.0, 1, "-")):
            scene[f"Body {name}"] = scenes.box(cells, size, (at,) + (0.0,) * (dim - 1))
            scene[f"Contact {name}"] = scenes.contact(name, bottom, mu=.3)
            scene[f"Support {name}"] = {"Body": name, "Boundary ids": side, "Directions": ", ".join("xyz"[:dim]),
                                        "Displacement": " ; ".join(filter(None, (f"{sign}0.001*t", "0", zeros)))}
            scene[f"Load {name}"] = scenes.load("pressure", "2*t", top, name)
        run = laws.run(scene)
        demand_shared(laws, f"{dim}D, mirror images", run, 1, 2)
        laws.same(f"{dim}D, mirror images", laws.run(without_equals(scene, ("left", "right"))), run, 1e-9)


def with_others(laws):
    """Equal blocks on one that is another."""
    for dim, cells in ((2, (14, 14)), (3, (6, 6, 6))):
        scene = scenes.stack(dim, (tuple(c - 1 for c in cells), cells, cells), (.5, 1.0, 1.0), .3, .2)
        scene.pop("Support top")
        scene["Load top"] = scenes.load("pressure", "2*min(t, 1)", 3 if dim == 2 else 5, "block 2")
        scene["Load side"] = scenes.load("traction", " ; ".join(("0.1*max(t - 1, 0)",) + ("0",) * (dim - 1)),
                                         3 if dim == 2 else 5, "block 2")
        run = laws.run(scene)
        demand_work(laws, f"{dim}D, two on another", run, {"factorisations of the elastic system": 2})
        laws.same(f"{dim}D, two on another", laws.run(without_equals(scene, ("block 1", "block 2"))), run, 1e-9)


FAMILIES = {"turned": turned, "others": others, "stacked": stacked, "turned-stack": turned_stack,
            "mirrored": mirrored, "with-others": with_others}


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(run_families(FAMILIES, sys.argv[1], *(sys.argv[2:] or ["all"])))
