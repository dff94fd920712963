#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Upper bounds of the work that shipped scenes take, by the counts of their logs.

usage: check_work.py PROGRAM

One row a scene. Counts of the elastic system are exact on every machine; those
of contact solves have room for one that rounds differently, a tenth or two.
"""
import re
import sys

from support.checks import run_families
from support.logs import log_of, work_of
from support.scenes import SHIPPED

COUNTS = ("factorisations of the elastic system", "condensations", "reductions of loads", "recoveries of displacements",
          "triangular solves", "linear solves of contact", "dense factorisations")
SIZES = {"factor, MB": r"factor of (\S+) MB", "condensed stiffness, MB": r"condensed stiffness: (\S+) MB"}
SQUARES = "Body block/Mesh/Arguments=200, 200 : 0, 0 : 80, 80 : true"
CUBES = "Body block/Mesh/Arguments=8, 8, 8 : 0, 0, 0 : 1, 1, 1 : true"

# scene, changes, bounds of COUNTS and SIZES
SCENES = (
    # bodies that float, or meet others, condense themselves: forces are reduced once more to recover displacements
    ("square-greco", (), (1, 1, 2, 1, 6, 10, 9), (.37, .034)),
    ("inclined-obstacle", (), (1, 1, 0, 23, 25, 84, 83), (2.4, .084)),
    # a large mesh: no increment is corrected, which would double recoveries and solves
    ("inclined-obstacle", (SQUARES, "Time/End=20", "Time/Increments=20"), (1, 1, 0, 20, 22, 160, 9), (56, 1.4)),
    ("block-press-shear", (CUBES,), (1, 1, 0, 11, 13, 57, 56), (3.4, .48)),
    ("double-layer-grid-07", (), (1, 1, 1, 1, 5, 10, 9), (.11, .18)),
    ("double-layer-grid-unloading", (), (1, 1, 1, 6, 15, 37, 35), (.53, 1.5)),
    ("floating-block", (), (1, 1, 2, 1, 6, 8, 7), (.12, .015)),
    ("stacked-blocks", (), (3, 3, 18, 18, 42, 14, 12), (.18, .022)),
)


def check(laws, scene, changes, counts, sizes):
    print(scene)
    arguments = [word for change in ("Output/VTU=0", *changes) for word in ("-s", change)]
    run = laws.run(SHIPPED / f"{scene}.prm", *arguments)
    work, log = work_of(run), log_of(run)
    for what, bound in zip(COUNTS, counts):
        laws.check(what, work[what], bound)
    for (what, pattern), bound in zip(SIZES.items(), sizes):
        laws.check(what, float(re.search(pattern, log)[1]), bound)


def work(laws):
    for row in SCENES:
        check(laws, *row)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(run_families({"work": work}, sys.argv[1], "all"))
