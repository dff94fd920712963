#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that are used several times are factorised once, wherever they are moved and touch each other; results are
those of each by itself.

usage: check_equal_bodies.py PROGRAM [FAMILY...]      (default: every family)
"""
import sys

from support import scenes
from support.checks import run_families
from support.logs import check_estimates, demand_work, dry_run, log_of
from support.tables import Run

AXIS = (0, 0, 1)


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


def together(laws, name, scene, changes=(), shared=2):
    """Three of one scene in one, against it by itself."""
    both = {}
    for number in range(3):
        both |= renamed(scene, number)
    for key, change in dict(changes).items():
        both = scenes.merge(both, {key: change})
    run = laws.run(both)
    demand_shared(laws, name, run, shared, 3)
    alone = laws.run(scene)
    for number in (1,) if changes else range(3):
        laws.same(f"{name}, body {number}", alone, part_of(run, number))


def with_all(dim, supports):
    """A block with everything on it that has a direction."""
    return scenes.turned_scene(dim, AXIS, 0.0, supports)[0]


def copies(laws):
    """Copies with all that acts on them: one factorisation."""
    for dim in (2, 3):
        for supports in ("axes", "normal", "oblique", "springs"):
            together(laws, f"{dim}D, {supports}", with_all(dim, supports))
        for what, change in (("Q1 B-bar", {"Element": "Q1 B-bar"}),
                             ("incompatible modes", {"Element": "Q1 incompatible modes"}),
                             ("hanging nodes", {"Mesh": {"Refinement distance": f"{2 if dim == 2 else 4} : 0.1 : 1"}})):
            together(laws, f"{dim}D, {what}", scenes.merge(with_all(dim, "oblique"), {"Body block": change}))
        together(laws, f"{dim}D, without friction", scenes.merge(with_all(dim, "normal"), {"Contact bottom": {"Friction coefficient": 0}}))


def others(laws):
    """What differs in material or supports has a factor of its own."""
    for dim in (2, 3):
        for what, key, change in (("another material", "Body block 2", {"Material": {"Poisson ratio": .301}}),
                                  ("another support", "Support left 2", None),
                                  ("another foundation", "Support weak 2", {"Stiffness": 1.01e-9})):
            scene = with_all(dim, "normal")  # springs so weak that stiffnesses do not show them
            scene["Support weak"] = {**scene["Support top"], "Boundary ids": 1, "Stiffness": 1e-9}
            together(laws, f"{dim}D, {what}", scene, {key: change}, shared=1)
        alone = laws.run(with_all(dim, "normal"))
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


FAMILIES = {"copies": copies, "others": others, "stacked": stacked, "with-others": with_others}


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(run_families(FAMILIES, sys.argv[1], *(sys.argv[2:] or ["all"])))
