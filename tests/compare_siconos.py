#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Condensed problems that scenes write, solved by Siconos: the same reactions.

usage: compare_siconos.py PROGRAM

Ends with code 77 where Siconos or h5py is missing (Debian: python3-siconos,
python3-h5py). Checks the sign conventions of the files with a program that is
not ours.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

TOP = Path(__file__).resolve().parent.parent
try:
    import h5py  # noqa: F401
    import siconos.numerics  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
from support import siconos_solve  # noqa: E402

# scene, its arguments, solver of Siconos, tolerance it reaches
CASES = (
    ("inclined-obstacle", [], "LEMKE", 1e-10),
    ("block-press-shear", ["-s", "Body block/Mesh/Arguments=8, 8, 8 : 0, 0, 0 : 1, 1, 1 : true"], "NSN_AC", 1e-8),
)


def check(program, scene, arguments, solver, bound):
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, TOP / "parameter-files" / f"{scene}.prm", "-q", "-o", folder, "-s", "Output/VTU=0",
                        "-s", "Output/FCLib increments=1, 2, 11", *arguments], check=True)
        for file in sorted(Path(folder).glob("problem-*.hdf5")):
            problem = siconos_solve.Problem(file)
            r = siconos_solve.solve(problem, solver, 1e-12)[0]
            difference = np.abs(r - problem.r).max() / np.abs(problem.r).max()
            print(f"{scene} {file.stem} {solver}: residual {problem.residual(r):.2g}, ours {problem.residual(problem.r):.2g},"
                  f" reactions differ by {difference:.2g} (bound {bound:g})")
            failed |= not difference <= bound
    return failed


if __name__ == "__main__":
    sys.exit(any([check(sys.argv[1], *case) for case in CASES]))
