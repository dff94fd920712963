#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Deflections of coarse meshes over exact ones, by element and Poisson ratio, as a Markdown table.

usage: locking.py [PROGRAM] [--quick]

Beams of length 10 and height 1 with 5 x 2 cells (x 2 in space), bent by end moments,
where the exact deflection is known; Cook's membrane in plane strain with 8 x 8 cells,
beside the same with 64 x 64 cells `Q1 B-bar`. 1 is exact, 0 is locked. P1 and P2 divide
each cell into 8 triangles, 24 tetrahedra.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

from measure import TOP, table  # first: it knows the way to tests/support
from support.bending import cantilever, cook, deflection
from support.scenes import ELEMENTS, write_scene
from support.tables import Run

POISSON = (.3, .49, .4999)


class Bench:
    def __init__(self, program, fine, folder):
        self.program, self.fine, self.folder = program, fine, folder

    def deflection(self, scene, y=0.0):
        file, result = self.folder / "scene.prm", self.folder / "result"
        write_scene(scene, file)
        subprocess.run([self.program, file, "-q", "-o", result], check=True)
        return deflection(Run(result), y)

    def bent(self, dim, element, poisson):
        scene, exact = cantilever(dim, element, poisson, (5, 2, 2)[:dim], tolerance=1e-6)
        return self.deflection(scene) / exact

    def sheared(self, element, poisson, n):
        return self.deflection(cook(self.folder, element, poisson, n), 60.0)


def main(*arguments):
    quick = "--quick" in arguments
    program = next((word for word in arguments if word != "--quick"), TOP / "build/conetact")
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(program, 16 if quick else 64, Path(folder))
        for poisson in POISSON:
            fine = bench.sheared("Q1 B-bar", poisson, bench.fine)
            for element in (*ELEMENTS, "P1", "P2", "Q2"):
                in_space = "" if element == "P2" else f"{bench.bent(3, element, poisson):.3f}"
                rows.append((poisson, element, f"{bench.bent(2, element, poisson):.3f}", in_space,
                             f"{bench.sheared(element, poisson, 8) / fine:.3f}"))
    print(table(("nu", "element", "beam, plane strain", "beam, 3D", "Cook's membrane"), rows))


if __name__ == "__main__":
    main(*sys.argv[1:])
