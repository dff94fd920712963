#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program beside GetFEM on the same meshes.

usage: getfem_compare.py [BUILD [N...]]      (default: build/ and N = 16)

Example 5.2 (23 increments) and block-press-shear.prm with N^3 elements: CPU
seconds of whole processes pinned to one core, no VTU files (median of three of
ours, one of GetFEM), and the largest difference of the contact forces of all
increments over the largest force.
"""
import csv
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
from measure import TOP, cpu_seconds, median_cpu_seconds, table  # noqa: E402


def compare(build, scene, n=None):
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder) / "result"
        own = [str(build / "conetact"), str(TOP / "parameter-files" / f"{scene}.prm"), "-q", "-o", str(result),
               "-s", "Output/VTU=0"]
        if n:
            own += ["-s", f"Body block/Mesh/Arguments={n}, {n}, {n} : 0, 0, 0 : 1, 1, 1 : true"]
        peer = [sys.executable, str(HERE / "getfem_scene.py"), scene] + ([str(n)] if n else [])
        said = Path(folder) / "getfem"
        ours = median_cpu_seconds(own)
        theirs = cpu_seconds(peer, said)
        with open(result / "increments.csv", newline="") as stream:
            forces = [[float(row[f"bottom_f_{d}"]) for d in "xyz"] for row in csv.DictReader(stream)]
        lines = [line.split() for line in said.read_text().splitlines() if line[:1].isdigit()]
    largest = max(abs(f) for row in forces for f in row)
    found = [[float(x) for x in line[1:-1]] for line in lines]
    if len(found) != len(forces):
        raise SystemExit(f"GetFEM finished {len(found)} of {len(forces)} increments")
    difference = max(abs(a - b) for row, other in zip(forces, found) for a, b in zip(row, other)) / largest
    return f"{scene} {n or ''}", f"{ours:.2f}", f"{theirs:.1f}", f"{theirs / ours:.1f}", f"{difference:.1e}"


if __name__ == "__main__":
    try:
        import getfem  # noqa: F401
    except ImportError:
        sys.exit("GetFEM is not installed (Debian: python3-getfem)")
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else TOP / "build").resolve()
    rows = [compare(folder, "inclined-obstacle")]
    rows += [compare(folder, "block-press-shear", n) for n in [int(n) for n in sys.argv[2:]] or (16,)]
    print(table(("scene", "Conetact, s", "GetFEM, s", "ratio", "largest difference of forces"), rows))
