#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Condensed problems of the 3D block: our solver beside those of Siconos.

usage: compare.py [BUILD [N...]]      (default: build/ and N = 16 24 32)

block-press-shear.prm with N^3 elements, pressed and sheared in one increment,
is exported and solved from a cold start to 1e-8 and 1e-12 by `conetact-fclib
solve` and by the solvers of Siconos, which get the problem in balanced units.
One thread; CPU seconds of the solves alone, medians of REPEAT, residuals by one
measure. A solver of Siconos that misses a tolerance tenfold does not count, and
what does not end within LIMIT seconds is stopped.
"""
import importlib.util
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from measure import TOP, table  # noqa: E402

os.environ["OPENBLAS_NUM_THREADS"] = "1"
SOLVERS = ("NSN_AC", "NSN_FB", "NSGS", "ADMM")
REPEAT, LIMIT = 3, 600


def export(build, n, folder):
    subprocess.run([build / "conetact", TOP / "parameter-files/block-press-shear.prm", "-q", "-o", folder,
                    "-s", "Output/VTU=0", "-s", "Output/FCLib increments=1", "-s", "Time/Increments=1", "-s", "Time/End=1",
                    "-s", "Support top/Displacement=0.02 ; 0 ; -0.01",
                    "-s", f"Body block/Mesh/Arguments={n}, {n}, {n} : 0, 0, 0 : 1, 1, 1 : true"], check=True)
    return Path(folder) / "problem-0001.hdf5"


def ours(build, file, tolerance, method="automatic"):
    """CPU seconds and residual; None where it does not converge."""
    run = subprocess.run([build / "conetact-fclib", "solve", file, "--tolerance", str(tolerance), "--solver", method],
                         capture_output=True, text=True)
    if run.returncode != 0:
        return None
    return tuple(float(re.search(rf"^{what} +(\S+)", run.stdout, re.M)[1]) for what in ("CPU time", "residual"))


def installed(solvers):
    """None of them without Siconos and h5py."""
    return solvers if all(map(importlib.util.find_spec, ("siconos", "h5py"))) else ()


def theirs(file, solver, tolerance):
    """In a process of its own, for it may crash or not end."""
    command = [sys.executable, TOP / "tests/support/siconos_solve.py", file, solver, str(tolerance)]
    try:
        run = subprocess.run(command, capture_output=True, text=True, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return None
    found = re.search(rf"{solver}: (\S+) s, .*residual (\S+)", run.stdout)
    return (float(found[1]), float(found[2])) if found else None


def repeated(solve):
    """Median CPU seconds and worst residual; one run is enough if it failed."""
    runs = []
    for _ in range(REPEAT):
        runs.append(solve())
        if runs[-1] is None:
            return None
    return statistics.median(r[0] for r in runs), max(r[1] for r in runs)


def compare(build, n):
    """Rows of the table: every solver at both tolerances."""
    with tempfile.TemporaryDirectory() as folder:
        file = export(build, n, folder)
        for tolerance in (1e-8, 1e-12):
            own = repeated(lambda: ours(build, file, tolerance))
            yield (n + 1)**2, f"{tolerance:g}", "Conetact", f"{own[0]:.4g}", f"{own[1]:.1e}", 1
            for solver in SOLVERS:
                found = repeated(lambda: theirs(file, solver, tolerance))
                row = (n + 1)**2, f"{tolerance:g}", solver
                if found is None:
                    yield *row, f"> {LIMIT}", "-", "-"
                else:
                    counts = found[1] <= 10 * tolerance
                    yield *row, f"{found[0]:.4g}", f"{found[1]:.1e}", f"{found[0] / own[0]:.1f}" if counts else "missed"


if __name__ == "__main__":
    if not installed(SOLVERS):
        sys.exit("Siconos is not installed (Debian: python3-siconos, python3-h5py)")
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else TOP / "build").resolve()
    sizes = [int(n) for n in sys.argv[2:]] or (16, 24, 32)
    print(table(("n_c", "tolerance", "solver", "CPU s", "residual", "times ours"),
                [row for n in sizes for row in compare(folder, n)]))
