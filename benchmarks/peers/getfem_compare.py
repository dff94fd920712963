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
import os
import statistics
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
TOP = HERE.parent.parent


def cpu_seconds(command, output):
    """Of the process, pinned to one core; what it prints goes to a file."""
    child = os.fork()
    if child == 0:
        os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
        os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"
        os.dup2(os.open(output, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), 1)
        os.execv(command[0], command)
    _, status, usage = os.wait4(child, 0)
    if status != 0:
        raise SystemExit(f"{' '.join(command)} failed; what it said is in {output}")
    return usage.ru_utime + usage.ru_stime


def compare(build, scene, n=None):
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder) / "result"
        own = [str(build / "conetact"), str(TOP / "parameter-files" / f"{scene}.prm"), "-q", "-o", str(result),
               "-s", "Output/VTU=0"]
        if n:
            own += ["-s", f"Body block/Mesh/Arguments={n}, {n}, {n} : 0, 0, 0 : 1, 1, 1 : true"]
        peer = [sys.executable, str(HERE / "getfem_scene.py"), scene] + ([str(n)] if n else [])
        said = Path(folder) / "getfem"
        ours = statistics.median(cpu_seconds(own, "/dev/null") for _ in range(3))
        theirs = cpu_seconds(peer, said)
        with open(result / "increments.csv", newline="") as table:
            forces = [[float(row[f"bottom_f_{d}"]) for d in "xyz"] for row in csv.DictReader(table)]
        lines = [line.split() for line in said.read_text().splitlines() if line[:1].isdigit()]
    largest = max(abs(f) for row in forces for f in row)
    found = [[float(x) for x in line[1:-1]] for line in lines]
    if len(found) != len(forces):
        raise SystemExit(f"GetFEM finished {len(found)} of {len(forces)} increments")
    difference = max(abs(a - b) for row, other in zip(forces, found) for a, b in zip(row, other)) / largest
    print(f"{scene} {n or ''}: ours {ours:.2f} s, GetFEM {theirs:.1f} s, ratio {theirs / ours:.1f},"
          f" forces differ by {difference:.1e}", flush=True)


if __name__ == "__main__":
    try:
        import getfem  # noqa: F401
    except ImportError:
        sys.exit("GetFEM is not installed (Debian: python3-getfem)")
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else TOP / "build").resolve()
    compare(folder, "inclined-obstacle")
    for size in [int(n) for n in sys.argv[2:]] or (16,):
        compare(folder, "block-press-shear", size)
