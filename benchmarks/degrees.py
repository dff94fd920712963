#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tetrahedra of first and of second degree on the same places of nodes.

usage: degrees.py [--build FOLDER] [--cells N...] [--exact N...]

The first table: a block that is pressed and sheared (4 increments, iterative backend), CPU of the process, an
unknown, and its peak memory; N cells of P2 a side, 2 N of P1, each of 24 tetrahedra, so that rows of P1 are equal in long
runs; and where Gmsh is installed tetrahedra of its own, with as many unknowns. The second one: errors of the manufactured solution
of tests/support/manufactured.py, in full slip, with orders between the two finest meshes.
"""
import argparse
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from measure import TOP, checked_resources, table  # first: it knows the way to tests
from support.checks import Laws, orders
from support.manufactured import simplex_fields
from support.scenes import merge, press_and_shear, with_element, write_scene

KINDS = (("P1", 2), ("P2", 1))  # elements, and cells a side beside those of P2


def gmsh_block(folder, element, n):
    """A unit cube of tetrahedra with as many nodes as n^3 cells have; ids of its sides as boxes have them."""
    size = {"P1": .62, "P2": .65}[element] / n
    source, file = folder / "block.geo", folder / "block.msh"
    source.write_text(f"""SetFactory("OpenCASCADE"); Box(1) = {{0, 0, 0, 1, 1, 1}};
Mesh.CharacteristicLengthMin = {size}; Mesh.CharacteristicLengthMax = {size}; Mesh.MshFileVersion = 2.2;
Mesh.ElementOrder = {element[1]}; Physical Volume(1) = {{1}};
low = Surface In BoundingBox{{-.1, -.1, -.1, 1.1, 1.1, .1}}; Physical Surface(4) = {{low()}};
high = Surface In BoundingBox{{-.1, -.1, .9, 1.1, 1.1, 1.1}}; Physical Surface(5) = {{high()}};
""")
    subprocess.run(["gmsh", "-v", "0", "-3", "-nt", "1", source, "-o", file], check=True, stdin=subprocess.DEVNULL)
    return {"File": file.name}


def cost(program, element, n, made_by):
    """Unknowns, linear iterations, CPU seconds, microseconds an unknown, peak memory [MB]."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.prm"
        scene = merge(with_element(press_and_shear(3, cells=(n,) * 3), element),
                      {"Solver": {"Backend": "iterative"}, "Output": {"VTU": 0}})
        if made_by == "Gmsh":
            scene["Body block"]["Mesh"] = gmsh_block(Path(folder), element, n)
        write_scene(scene, file)
        seconds, memory = checked_resources([program, file, "-o", Path(folder) / "out", "--quiet"])
        log = (Path(folder) / "out/log.txt").read_text()
    unknowns, iterations = (int(re.search(words, log)[1]) for words in (r"unknowns of (\d+)", r"(\d+) linear iterations"))
    return made_by, element, unknowns, iterations, f"{seconds:.3g}", f"{1e6 * seconds / unknowns:.3g}", f"{memory:.0f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--cells", type=int, nargs="+", default=(8, 14))
    parser.add_argument("--exact", type=int, nargs="+", default=(3, 6))
    options = parser.parse_args()
    kinds = ("box", "Gmsh") if shutil.which("gmsh") else ("box",)
    print(table(("mesh", "element", "unknowns", "linear iterations", "CPU s", "us an unknown", "peak MB"),
                [cost(options.build / "conetact", element, times * n, made_by)
                 for made_by in kinds for n in options.cells for element, times in KINDS]),
          flush=True)
    laws = Laws(options.build / "conetact")
    names = ("displacement in L2", "energy", "stresses at nodes", "pressures", "pressures inside")
    rows = []
    for element, times in KINDS:
        found = [[simplex_fields(laws, 3, times * n, element)[0][name] for name in names] for n in options.exact]
        rows += [(element, times * n, *(f"{error:.2g}" for error in errors)) for n, errors in zip(options.exact, found)]
        if len(found) > 1:
            rows.append((element, "order", *(f"{order:.2f}" for order in orders(options.exact, found))))
    laws.batch.close()
    print("\n" + table(("element", "cells a side", *names), rows))


if __name__ == "__main__":
    main()
