#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What it costs to find contacts of bodies, against their number.

usage: pairing.py BUILD [N...]      (default: N = 35 50 71 100)

Two thin blocks of N x N faces, one turned by 20 degrees on the other. CPU seconds of a dry run, less those of the
same with an obstacle in place of the pairing; and the exponent over the number of contact nodes. Then two
blocks of 10 N faces in the plane, one of which slides by four cells of the other in as many increments: what all
pairings take of the whole run.
"""
import math
import re
import sys
import tempfile
from pathlib import Path

from measure import cpu_seconds, table  # first: it knows the way to tests/support
from support.scenes import box, contact, floor, joint, support, write_scene

SHARES = ("pairing", "contact nodes", "increments", "pairings", "one pairing, ms", "run, CPU s", "share")
COLUMNS = ("pairing", "contact nodes", "CPU s", "per node, us", "exponent")


def blocks(n, pairing):
    scene = {"Dimension": 3, "Body lower": box((n, n, 1), (1.0, 1.0, .1), (-.5, -.5, -.1)),
             "Body upper": box((n, n, 1), (1.0, 1.0, .1), (-.5, -.5, 0.0), Rotation=(0, 0, 1, 20.0)),
             "Obstacle floor": floor(3), "Support base": support(4, "x, y, z", body="lower"), "Output": {"VTU": 0}}
    if pairing is None:
        scene["Contact joint"] = contact("upper", 4)
    else:
        scene["Contact joint"] = joint("upper", 4, "lower", 5, Pairing=pairing)
    return scene


def sliding(n, pairing):
    """Four increments in which a block slides by a cell of its master each."""
    scene = {"Dimension": 2, "Body lower": box((n, 2), (2.0, .1), (-.5, -.1)),
             "Body upper": box((n, 2), (1.0, .1), (.013, 0.0)), "Obstacle floor": floor(2),
             "Support base": support(2, "x, y", body="lower"),
             "Support top": support(3, "x, y", f"{8 / n!r}*max(t - 1, 0)/4 ; -1e-4*min(t, 1)", "upper"),
             "Time": {"End": 5, "Increments": 5}, "Output": {"VTU": 0}}
    if pairing is None:
        scene["Contact joint"] = contact("upper", 2)
    else:
        scene["Contact joint"] = joint("upper", 2, "lower", 3, Pairing=pairing, Kinematics="finite sliding",
                                       **{"Friction coefficient": .3})
    return scene


def share(program, n, pairing, folder):
    """A pairing before each increment and one after each solution."""
    one = seconds(program, sliding(n, pairing), folder) - seconds(program, sliding(n, None), folder)
    write_scene(sliding(n, pairing), folder / "scene.prm")
    spent = cpu_seconds([program, folder / "scene.prm", "-q", "-o", folder / "results"])
    again = sum(map(int, re.findall(r"contacts found again (\d+)", (folder / "results/log.txt").read_text())))
    count = 5 * 2 + again
    return pairing, n + 1, 5, count, f"{1e3 * one:.1f}", f"{spent:.2f}", f"{count * one / spent:.1%}"


def seconds(program, scene, folder):
    write_scene(scene, folder / "scene.prm")
    return min(cpu_seconds([program, folder / "scene.prm", "--dry-run"]) for _ in range(3))


def main(build, *sizes):
    program, rows = Path(build).resolve() / "conetact", []
    with tempfile.TemporaryDirectory() as folder:
        for pairing in ("mortar", "node to face"):
            before = None
            for n in map(int, sizes or (35, 50, 71, 100)):
                spent = seconds(program, blocks(n, pairing), Path(folder)) - seconds(program, blocks(n, None), Path(folder))
                nodes = (n + 1)**2
                exponent = f"{math.log(spent / before[1]) / math.log(nodes / before[0]):.2f}" if before else ""
                rows.append((pairing, nodes, f"{spent:.2f}", f"{1e6 * spent / nodes:.0f}", exponent))
                before = nodes, spent
        shares = [share(program, 10 * n, pairing, Path(folder)) for pairing in ("mortar", "node to face")
                  for n in map(int, sizes or (50, 100, 200))]
    print(table(COLUMNS, rows))
    print()
    print(table(SHARES, shares))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(*sys.argv[1:])
