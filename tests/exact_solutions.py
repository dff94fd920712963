#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results against exact solutions with friction, and how fast errors fall with h.

usage: exact_solutions.py PROGRAM FAMILY...      (all: every family)

compression: uniform stress with every node slipping, exact on any mesh;
manufactured: smooth fields, full slip and then full stick (support/manufactured.py);
hertz, partial-slip: line and point contact (support/half_space.py).
"""
import math
import sys

from support import half_space, manufactured
from support.checks import orders, run_families
from support.meshes import distorted, tributary
from support.scenes import SHIPPED, contact, floor, load, support


def compression(laws):
    """Stresses -p, mu p and along: at the bottom the body slides along x by c + e x."""
    young, poisson, mu, p, along, c = 1000.0, .3, .4, 5.0, 2.0, .01
    for dim, ids in ((2, (10, 11, 12, 13)), (3, (10, 11, 12, 13, 14, 15))):
        up, across = "xyz"[dim - 1], poisson * (along - p)  # no strain along the third axis
        e = (along - poisson * (across - p)) / young
        thinner = (-p - poisson * (along + across)) / young
        gamma = mu * p * 2 * (1 + poisson) / young
        motion = [f"{c!r} + {e!r}*x + {gamma!r}*{up}", "0", f"{thinner!r}*{up}"]
        if dim == 2:
            motion.pop(1)
        stress = [[0.0] * dim for _ in range(dim)]
        stress[0][0], stress[-1][-1] = along, -p
        stress[0][-1] = stress[-1][0] = mu * p
        if dim == 3:
            stress[1][1] = across
        file = laws.folder / f"distorted{dim}.msh"
        points, faces = distorted(file, dim)
        areas = {tuple(round(x, 9) for x in points[i]): area for i, area in tributary(points, faces).items()}
        scene = {"Dimension": dim, "Obstacle floor": floor(dim), "Contact bottom": contact(ids=ids[-2], mu=mu),
                 "Body block": {"Mesh": {"File": file.name},
                                "Material": {"Young modulus": young, "Poisson ratio": poisson}},
                 "Support top": support(ids[-1], ", ".join("xyz"[:dim]), " ; ".join(motion)), "Output": {"VTU": 0}}
        for side in range(2 * dim - 2):
            sign = 1 if side % 2 else -1
            scene[f"Load {side}"] = load("traction", " ; ".join(repr(sign * row[side // 2]) for row in stress), ids[side])
        run = laws.run(scene)
        laws.demand(f"{dim}D: all slip", all(row["state"] == "slip" for row in run.rows))
        stresses = [(row, areas[tuple(round(row[x], 9) for x in "xyz")]) for row in run.rows]
        laws.check(f"{dim}D: pressure and friction",
                   max(abs(row["r_n"] / area - p) + abs(row["r_t1"] / area + mu * p) + abs(row["r_t2"]) / area
                       for row, area in stresses) / p, 1e-11)
        laws.check(f"{dim}D: slips", max(abs(row["du_t1"] - c - e * row["x"]) + abs(row["du_t2"])
                                         for row in run.rows) / c, 1e-11)


def manufactured_family(laws):
    # reactions over areas: 3/2 from below, for those at the edges are of first order
    for dim, sizes in ((2, (8, 16)), (3, (4, 8))):
        errors = [manufactured.solution_errors(laws, dim, n) for n in sizes]
        names = [f"{what}, {state}" for state in ("slip", "stick") for what in ("displacement", "energy", "reactions")]
        for name, size, order, least in zip(names, errors[-1], orders(sizes, errors), (1.95, .97, 1.3) * 2):
            laws.check(f"{dim}D: {name}: error {size:.2g}, order {order:.2f}, missing", max(0, least - order), 0)


def hertz(laws):
    for dim, sizes, grading, bounds in ((2, (16, 32), 2, (5e-4, 5e-5, 7e-4, .013)),
                                        (3, (4, 8), 1, (1e-3, 2e-3, 5e-4, .05))):
        found = [half_space.hertz_errors(laws.run(half_space.hertz(dim, n, grading)), n) for n in sizes]
        for name, error, order, bound in zip(found[-1], found[-1].values(),
                                             orders(sizes, [list(f.values()) for f in found]), bounds):
            laws.check(f"{dim}D: {name}, order {order:.1f}", error, bound)


def partial_slip(laws):
    for dim, sizes, grading, bounds in ((2, (16, 32), 2, (5e-4, 5e-4, 1e-4, .04, .022, 1)),
                                        (3, (4, 8), 1, (1e-3, 2e-3, 2e-3, .04, .06, 1))):
        found = [half_space.partial_slip_errors(laws.run(half_space.partial_slip(dim, n, grading)), n) for n in sizes]
        for (name, error), bound in zip(found[-1].items(), bounds):
            laws.check(f"{dim}D: {name}", error, bound)
    shipped_partial_slip(laws)


def shipped_partial_slip(laws):
    """Blocks of finite size: half widths, in cells of 1/16, and peak from the forces of each step."""
    run = laws.run(SHIPPED / "partial-slip.prm", "-s", "Output/VTU=0")
    radius, modulus, mu, cell = 100, 1000 / (2 * (1 - .3**2)), .5, 1 / 16
    for increment in run.increments:
        force, shear = increment["joint_f_y"], abs(increment["joint_f_x"])
        touch = math.sqrt(4 * force * radius / (math.pi * modulus))
        stick = touch * math.sqrt(1 - shear / (mu * force))
        rows = [row for row in run.rows if row["increment"] == increment["increment"] and row["contact"] == "joint"]
        widths = [cell / 2 * sum(row["state"] in states for row in rows) for states in (("stick", "slip"), ("stick",))]
        laws.check(f"blocks, Q/(mu P) = {shear / (mu * force):.2f}: half widths that touch and stick, in cells",
                   max(abs(widths[0] - touch), abs(widths[1] - stick)) / cell, 1)
        laws.check("blocks: peak", abs(max(row["r_n"] for row in rows) / cell / (2 * force / (math.pi * touch)) - 1), .012)


FAMILIES = {"compression": compression, "manufactured": manufactured_family, "hertz": hertz,
            "partial-slip": partial_slip}

if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(run_families(FAMILIES, *sys.argv[1:]))
