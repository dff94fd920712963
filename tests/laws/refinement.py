# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Refined meshes, with hanging nodes and adaptive ones."""
import math

from support.scenes import SHIPPED, load, merge, press_and_shear
from support.tables import read


def refinement(laws):
    for dim in (2, 3):
        far = "0.5, 0.6 : 1.5, 1 : 2" if dim == 2 else "0.3, 0.3, 0.6 : 0.8, 0.8, 1 : 1"
        near = "0, 0 : 0.6, 0.3 : 2 ; 1.6, 0 : 2, 0.2 : 3" if dim == 2 else "0, 0, 0 : 0.5, 0.5, 0.3 : 1"
        coarse = press_and_shear(dim, cells=(8, 4) if dim == 2 else (4, 4, 4))
        for name, boxes in (("away", far), ("at the contact", near)):
            run = laws.run(merge(coarse, {"Body block": {"Mesh": {"Refinement boxes": boxes}}}))
            laws.admissible(f"{dim}D, refined {name}", run, lambda row: .3)
            if dim == 3 and name != "away":
                # 5 x 5 nodes, 5 x 5 where refined (x < .75, y < .5), 4 of them hanging
                laws.demand(f"no hanging contact node: {len(run.last())} nodes", len(run.last()) == 25 + 16 - 4)
            run = laws.run(merge(coarse, {"Body block": {"Mesh": {"Refinement boxes": boxes}},
                                          "Support top": {"Stiffness": "5000*(1 + x)"}}))
            laws.admissible(f"{dim}D, on springs, refined {name}", run, lambda row: .3)
        fine = laws.run(merge(coarse, {"Body block": {"Mesh": {"Global refinements": 1}}}))
        everywhere = ("-1, -1 : 3, 2 : 1" if dim == 2 else "-1, -1, -1 : 3, 2, 2 : 1")
        boxed = laws.run(merge(coarse, {"Body block": {"Mesh": {"Refinement boxes": everywhere}}}))
        laws.same(f"{dim}D, one box around all", fine, boxed, 1e-11)
        bottom = 2 if dim == 2 else 4
        beside = laws.run(merge(coarse, {"Body block": {"Mesh": {"Refinement distance": f"{bottom} : 5 : 1"}}}))
        laws.same(f"{dim}D, everything is near the contact", fine, beside, 1e-11)
        near = laws.run(merge(coarse, {"Body block": {"Mesh": {"Refinement distance": f"{bottom} : 0.1 : 1"}}}))
        laws.admissible(f"{dim}D, refined beside the contact", near, lambda row: .3)
        laws.demand(f"all {len(near.last())} contact nodes of the fine mesh", len(near.last()) == len(fine.last()))
    adaptive(laws)


def adaptive(laws):
    """The corners of a punch: fewer dofs than with equal cells for the same forces."""
    def forces(run):
        return [run.increments[-1]["bottom_f_" + c] for c in "xy"]

    coarse, fine, exact = (press_and_shear(2, cells=(n, n // 2), increments=3) for n in (8, 64, 128))
    run = laws.run({"Adaptive refinement": 5, **coarse})
    laws.admissible("adaptive", run, lambda row: .3)
    meshes = read(run.folder / "refinement.csv")
    laws.demand(f"one row for each of {len(meshes)} meshes", [m["mesh"] for m in meshes] == [1, 2, 3, 4, 5, 6])
    laws.check("the first mesh is the scene's", abs(meshes[0]["bottom_n"] - forces(laws.run(coarse))[1]), 1e-10)
    laws.check("the results are those of the last mesh", abs(meshes[-1]["bottom_n"] - forces(run)[1]), 1e-10)
    laws.demand(f"{meshes[-1]['contact_nodes']:g} contact nodes", meshes[-1]["contact_nodes"] == len(run.last()))
    laws.demand("estimates decrease", all(b["estimate"] < a["estimate"] for a, b in zip(meshes, meshes[1:])))
    dofs = 2 * 65 * 33
    laws.demand(f"{meshes[-1]['dofs']:g} dofs, {dofs} of equal cells", 2 * meshes[-1]["dofs"] < dofs)
    target, uniform, local = (forces(r) for r in (laws.run(exact), laws.run(fine), run))
    laws.check(f"error of forces, to {math.dist(uniform, target):.3g} of equal cells",
               math.dist(local, target) / math.dist(uniform, target), .6)

    for name, entries in (("stacked-blocks", ()), ("shrink-fit", ("-s", "Adaptive fraction=0.1"))):
        run = laws.run(SHIPPED / f"{name}.prm", "-s", "Output/VTU=0", "-s", "Adaptive refinement=1", *entries)
        first, last = read(run.folder / "refinement.csv")
        laws.demand(f"{name}: {first['dofs']:g} and {last['dofs']:g} dofs", first["dofs"] < last["dofs"])
    failing = merge(coarse, {"Support top": {"Directions": "y", "Displacement": "-0.01*min(t, 1)"},
                             "Load push": load("traction", "100*max(t - 1, 0) ; 0", 3)})
    done, folder = laws.start({"Adaptive refinement": 1, **failing})
    laws.demand(f"no equilibrium: exit code {done.returncode}: {done.stderr.strip()}", done.returncode == 2)
    laws.demand("the increment before it is on disk", len(read(folder / "increments.csv")) == 1)
