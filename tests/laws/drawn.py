# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Elastic bodies drawn along elastic ones, far beyond a cell.

disc: a fine disc swept over a layer at constant depth; ironing: dies, round and flat; round_table: a block
pushed round a table; turned: the same turned as a whole; halved: increments halved.
"""
import itertools
import math

from laws.sliding import FAR, energy_error, of_body, slip_error, slab
from support.half_cylinders import die
from support.scenes import box, joint, merge, press_and_shear, support, text
from support.vectors import apply, rotation

MU = .3


def drawn(laws, cells, way, increments, exchanged=False, size=(3.0, 1.0), radius=8.0, depth=.04, young=1000.0, pairing="mortar"):
    """A die on a layer 8 long and 1 high: pressed in up to t = 1, then moved along up to t = 2."""
    file = laws.folder / f"die{radius:g}.msh"
    die(file, cells, size, radius)
    pair = (("die", 1), ("layer", 3))
    slave, master = pair[::-1] if exchanged else pair
    return {"Dimension": 2, "Body layer": box((64, 8), (8.0, 1.0), (-4.0, -1.0)),
            "Body die": {"Mesh": {"File": file.name, "Translation": (-way / 2, 0.0)},
                         "Material": {"Young modulus": young, "Poisson ratio": .3}},
            "Contact bottom": joint(*slave, *master, **{"Friction coefficient": MU, **FAR, "Pairing": pairing}),
            "Support base": support(2, "x, y", body="layer"),
            "Support top": support(2, "x, y", f"{way!r}*max(t - 1, 0) ; {-depth!r}*min(t, 1)", "die"),
            "Time": {"Stages": f"1 : 2, 2 : {increments}"}, "Output": {"VTU": 0}}


def steady(laws, what, run, swing, jumps):
    """Forces once all of it slides."""
    late = [row for row in run.increments if row["time"] > 1.3]
    for name, column in (("normal", "bottom_f_y"), ("tangential", "bottom_f_x")):
        forces = [abs(row[column]) for row in late]
        laws.check(f"{what}: {name} force", (max(forces) - min(forces)) / max(forces), swing)
        laws.check("  from increment to increment", max(abs(a / b - 1) for a, b in zip(forces, forces[1:])), jumps)
    laws.check("  friction of nodes that touch", slip_error(of_body(run), MU, 1.3), 1e-9)
    laws.check("  work, strain energy, dissipation and normal part", energy_error(run), 1e-9)


def disc(laws):
    for exchanged in (False, True):
        run = laws.run(drawn(laws, (40, 10), 3.75, 40, exchanged))
        steady(laws, f"disc swept by 30 cells{', exchanged' * exchanged}", run, .01, .01)
        ratios = [abs(row["bottom_f_x"] / row["bottom_f_y"]) for row in run.increments if row["time"] > 1.3]
        # friction stands across a surface that is curved by a tenth
        laws.check("  resultants about mu", max(abs(ratio / MU - 1) for ratio in ratios), 4e-3)


def ironing(laws):
    for young, exchanged in itertools.product((1e3, 1e4), (False, True)):
        run = laws.run(drawn(laws, (20, 10), 2.0, 40, exchanged, (1.2, .75), 1.0, .08, young))
        steady(laws, f"round die of E = {young:g}{', exchanged' * exchanged}", run, .03, .03)
    for exchanged in (False, True):
        run = laws.run(drawn(laws, (12, 6), 2.0, 40, exchanged, (1.2, .75), 1e9, .03))
        steady(laws, f"flat die{', exchanged' * exchanged}", run, .02, .02)


def halved(laws):
    """Work and dissipation of a way with the increments halved: that of the finest is taken for exact."""
    counts = (5, 10, 20, 80)
    runs = [laws.run(drawn(laws, (40, 10), .3, n)).increments for n in counts]
    for what in ("dissipation", "external_work"):
        sums = [sum(row[what] for row in run) for run in runs]
        errors = [abs(s / sums[-1] - 1) for s in sums[:-1]]
        laws.demand(f"{what} with {counts[:-1]} increments: errors " + ", ".join(f"{e:.2g}" for e in errors),
                    all(b < .55 * a for a, b in zip(errors, errors[1:])))
        laws.check("  the last", errors[-1], .01)
    laws.check("the forces at the end do not depend on them",
               max(abs(run[-1][c] / runs[-1][-1][c] - 1) for run in runs for c in ("bottom_f_x", "bottom_f_y")), 1e-9)


def deep(laws):
    """A roller that is pressed deep into a soft slab, which is the slave, and drawn along it: beside what presses its faces look away by as
    much as faces may that meet. Linear and quadratic cells tell of the same force, and friction of all that slips is about its coefficient."""
    forces = []
    for element, cells, refinements in (("Q1", (12, 4), 3), ("Q1", (16, 6), 4), ("Q2", (12, 4), 3)):
        roller = {"Element": element, "Material": {"Young modulus": 1000.0, "Poisson ratio": .3},
                  "Mesh": {"Generator": "hyper_ball", "Arguments": "0, 10 : 10 : true", "Global refinements": refinements,
                           "Boundary ids": "7 : y < 8 ; 8 : y >= 12"}}
        run = laws.run({"Dimension": 2, "Body slab": merge(box(cells, (24.0, 8.0), (-12.0, -8.0), 100.0), {"Element": element}),
                        "Body roller": roller,
                        "Contact joint": joint("slab", 3, "roller", 7, **{"Friction coefficient": .3, **FAR}),
                        "Support base": support(2, "x, y", "0 ; 0", "slab"),
                        "Support top": support(8, "x, y", "2*max(t - 1, 0) ; -1.6*min(t, 1)", "roller"),
                        "Time": {"Stages": "1 : 2, 3 : 6"}, "Output": {"VTU": 0}})
        end = run.increments[-1]
        what = f"drawn deep in a slab, {element}, {cells[0]} cells"
        laws.check(f"{what}: what supports carry", max(abs(end[f"supports_f_{c}"]) for c in "xy") / abs(end["joint_f_y"]), 1e-9)
        laws.check("  friction over its coefficient", abs(abs(end["joint_f_x"] / end["joint_f_y"]) / .3 - 1), .02)
        forces.append(abs(end["joint_f_y"]))
    laws.check("  forces of three meshes", max(forces) / min(forces) - 1, .02)


def turned_whole(scene, axis, degrees):
    """The same scene, bodies and supports turned about the origin."""
    dim, m = scene["Dimension"], rotation(axis, degrees)
    result = merge(scene, {})
    for name, tree in scene.items():
        if name.startswith("Body "):
            place = tuple(tree["Mesh"].get("Translation", ())) + (0.0, 0.0, 0.0)
            result[name] = merge(tree, {"Mesh": {"Rotation": degrees if dim == 2 else (*map(float, axis), degrees),
                                                 "Translation": apply(m, place[:3])[:dim]}})
        elif name.startswith("Support "):
            axes = (f"({text(tuple(m[d][e] for d in range(dim)))})" for e in range(dim))
            result[name] = merge(tree, {"Directions": ", ".join(axes)})
    return result, m


def turned(laws):
    for pairing in ("node to face", "mortar"):
        plane = drawn(laws, (30, 8), 1.0, 8, pairing=pairing)
        space = slab(press_and_shear(3, (3, 2, 2), MU, 4), (7, 5, 2), (3.5, 2.2, 1.0), (-.93, -.57, -1.0), "bottom", Pairing=pairing)
        space["Support top"]["Displacement"] = "0.21*max(t - 1, 0) ; 0.1*max(t - 1, 0) ; -0.02*min(t, 1)"
        for scene, axis, degrees in ((plane, (0, 0, 1), 37.3), (space, (1, 2, 3), 23.7)):
            other, m = turned_whole(scene, axis, degrees)
            first, second = (of_body(laws.run(s)) for s in (scene, other))
            laws.same(f"{scene['Dimension']}D, {pairing}, turned", first, second, 1e-9, matrix=m)


def round_table(laws):
    """A block on an elastic table, moved round a circle: friction times the way of nodes that slide."""
    radius, found = .5, []
    for n in (8, 16, 32):
        scene = press_and_shear(3, (3, 2, 2), MU)
        scene["Support top"]["Displacement"] = (f"{radius!r}*(cos(2*pi*max(t - 1, 0)) - 1) ; {radius!r}*sin(2*pi*max(t - 1, 0)) ; "
                                                "-0.01*min(t, 1)")
        scene["Time"] = {"Stages": f"1 : 1, 3 : {2 * n}"}
        scene = slab(scene, (9, 9, 1), (4.5, 4.0, .6), (-1.93, -1.57, -.6), "bottom", Pairing="mortar")
        run = laws.run(scene)
        laws.check(f"block round a table, {n} increments: energies", energy_error(run), 1e-9)
        second = [row for row in run.increments if row["time"] > 2 + 1e-9]
        work, lost = (sum(row[c] for row in second) for c in ("external_work", "dissipation"))
        force = sum(row["bottom_f_z"] for row in second) / n
        laws.check("  dissipation over work of the second round", abs(lost / work - 1), 5e-3)
        found.append(abs(lost / (MU * force * 2 * math.pi * radius) - 1))
    laws.check("block round a table: dissipation over friction times the way", found[-1], .02)
    laws.demand("  converges: " + ", ".join(f"{error:.2g}" for error in found), all(b < .5 * a for a, b in zip(found, found[1:])))


def drawn_family(laws):
    for family in (disc, ironing, halved, deep, turned, round_table):
        family(laws)
