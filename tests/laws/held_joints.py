# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact nodes that a support holds: what joins their sides holds there, or the scene is refused; contacts that are off hinder nothing."""
from support.scenes import box, contact, floor, joint, load, merge, support

ON = "t >= 0"  # never off, but no constant
BONDED = {"Cohesion": 100, "Tensile strength": 100}


def glued(dim, slave, pairing, backend="condensed", **law):
    """Two blocks of the same cells. A support moves a side of the upper one, with an edge of the joint."""
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    cells, size, axes = (4,) + (2,) * (dim - 1), (2.0,) + (1.0,) * (dim - 1), "xyz"[:dim]
    sides = ("upper", bottom, "lower", top) if slave == "upper" else ("lower", top, "upper", bottom)
    return {"Dimension": dim, "Body lower": box(cells, size), "Body upper": box(cells, size, (0.0,) * (dim - 1) + (1.0,)),
            "Contact glue": {**joint(*sides), "Pairing": pairing, **law},
            "Support floor": support(bottom, ", ".join(axes), body="lower"),
            "Support side": support(0, f"x, {axes[-1]}", "0.001*t ; 0.001*t", "upper"),
            "Support top": support(top, axes[-1], "0.001*t", "upper"),
            "Time": {"Times": "1, 2, 3"}, "Solver": {"Backend": backend}, "Output": {"VTU": 0}}


def force_of(run, dim):
    return [run.increments[-1][f"glue_f_{x}"] for x in "xyz"[:dim]]


def difference(a, b, dim):
    one, other = force_of(a, dim), force_of(b, dim)
    return max(abs(x - y) for x, y in zip(one, other)) / max(map(abs, other))


def refused(laws, what, scene):
    done, _ = laws.start(scene)
    laws.demand(f"{what}: refused, with what to do ({done.returncode}): {done.stderr.strip()[-250:]}",
                done.returncode == 2 and "contact 'glue': support 'side' holds the contact node at (0, " in done.stderr
                and "part there by" in done.stderr and "Exchange slave and master" in done.stderr)


def joined(laws):
    """A tie with an Active and a bond do what a permanent tie does, or are refused by the name of the support."""
    for dim in (2, 3):
        for pairing in ("node to face", "mortar"):
            what = f"{dim}D, {pairing}"
            tied = laws.run(glued(dim, "lower", pairing, Kind="tie"))
            for kind, law in (("tie with an Active", {"Kind": "tie", "Active": ON}), ("bond", BONDED)):
                refused(laws, f"{what}, {kind} of a held slave", glued(dim, "upper", pairing, **law))
                run = laws.run(glued(dim, "lower", pairing, **law))
                laws.check(f"{what}, {kind} of a held master: the force of a tie", difference(run, tied, dim), 1e-8)
                resting = merge(glued(dim, "upper", pairing, **law), {"Support side": {"Displacement": "0"}, "Support top": {"Displacement": "0"},
                                                                      "Load none": load("body force", " ; ".join("0" * dim), body="upper")})
                laws.demand(f"{what}, {kind} of a held slave that nothing moves", len(laws.run(resting).increments) == 3)
    refused(laws, "2D, iterative", glued(2, "upper", "node to face", "iterative", Kind="tie", Active=ON))
    refused(laws, "a tie that begins", glued(2, "upper", "node to face", Kind="tie", Active="t > 1.5"))
    ends = laws.run(glued(2, "upper", "node to face", Kind="tie", Active="t < 0.5"))
    laws.demand("a tie that has ended may part", len(ends.increments) == 3)


def bilateral(laws):
    """On matching cells mortar holds each node of both sides together, as node to face does, also where a support holds it."""
    for dim in (2, 3):
        runs = [laws.run(glued(dim, "upper", pairing, Kind="bilateral")) for pairing in ("mortar", "node to face")]
        laws.check(f"{dim}D, bilateral: mortar and node to face", difference(*runs, dim), 1e-8)


def source(laws):
    """A fluid whose source a support holds comes to the nodes beside it, as from a point there."""
    for dim in (2, 3):
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        axes = ", ".join("xyz"[:dim])
        scene = {"Dimension": dim, "Body block": box((4,) + (2,) * (dim - 1), (2.0,) + (1.0,) * (dim - 1)), "Obstacle floor": floor(dim),
                 "Contact bottom": contact(ids=bottom, mu=.3, **{"Penetrating pressure": 3, "Fluid from boundary ids": 0}),
                 "Support left": support(0, axes), "Support top": support(top, axes, Stiffness=1000),
                 "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        laws.check(f"{dim}D: pressure on all nodes but those that are held", abs(run.increments[-1][f"bottom_f_{'xyz'[dim - 1]}"] / 5.25 - 1), 1e-9)
        at = merge(scene, {"Contact bottom": {"Fluid from boundary ids": None, "Fluid from point": (0,) * dim}})
        laws.same(f"{dim}D: as from a point", run, laws.run(at))


def off(laws):
    """What a contact that is not active would meet passes through it, at any speed."""
    for dim in (2, 3):
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        last, rest = "xyz"[dim - 1], "0 ; " * (dim - 1)
        drop = support(top, ", ".join("xyz"[:dim]), rest + "if(t < 1.5, -0.001*t, -1.5*(t - 1))")
        block = box((4,) + (2,) * (dim - 1), (2.0,) + (1.0,) * (dim - 1))
        law = {"Active": "t < 1.5", "Kinematics": "finite sliding"}
        on_floor = {"Dimension": dim, "Body block": block, "Obstacle floor": floor(dim), "Contact bottom": contact(ids=bottom, **law),
                    "Support top": drop, "Time": {"Times": "1, 2, 3"}, "Output": {"VTU": 0}}
        base = box((4,) + (2,) * (dim - 1), (2.0,) + (1.0,) * (dim - 1), (0.0,) * (dim - 1) + (-1.0,))
        on_body = {**{name: part for name, part in on_floor.items() if name not in ("Obstacle floor", "Contact bottom")},
                   "Body base": base, "Support base": support(bottom, ", ".join("xyz"[:dim]), body="base")}
        joints = {pairing: {**joint("block", bottom, "base", top, **law), "Pairing": pairing} for pairing in ("mortar", "node to face")}
        for what, scene in (("obstacle", on_floor), *((f"body, {p}", {**on_body, "Contact bottom": j}) for p, j in joints.items())):
            forces = [i.get(f"bottom_f_{last}", 0.0) for i in laws.run(scene).increments]
            laws.demand(f"{dim}D, {what}: pressed while it is active, and none later: {forces}",
                        len(forces) == 3 and forces[0] > 0 and forces[1:] == [0, 0])


def beside(laws):
    """A block slides far while another contact is on and off: its own coefficient stays what it is."""
    for mu in (.6, .7, .1):
        scene = {"Dimension": 2, "Body block": box((8, 2), (2.0, 1.0)), "Obstacle floor": floor(2),
                 "Obstacle wall": {"Shape": "half space", "Normal": (1, 0)},
                 "Contact bottom": contact(ids=2, mu=mu, Kinematics="finite sliding"),
                 "Contact side": contact(ids=0, obstacle="wall", mu=.6, Active="t < 1.5", Kinematics="finite sliding"),
                 "Support top": support(3, "x, y", "0.03*t ; -0.0013*t"),
                 "Time": {"Times": "1, 2, 3, 4, 5, 6"}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        laws.demand(f"beside a contact that ends, mu = {mu}: all increments", len(run.increments) == 6)
        laws.admissible("  friction", run, lambda row: mu if row["contact"] == "bottom" else .6)


def held_joints(laws):
    beside(laws)
    joined(laws)
    bilateral(laws)
    source(laws)
    off(laws)
