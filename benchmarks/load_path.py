#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load paths: cost against the number of contact nodes, and increments against the path.

usage: load_path.py [--build FOLDER] [--results FOLDER] [--quick]

Prints two tables and writes FOLDER/load-path-time.png. Cost: CPU seconds of whole
processes, one thread, for m contact nodes: the bar of bar-on-rigid-base.prm and the
block of pushed-block.prm, with the limit load it finds. Increments: pressed and sheared on
a sloping plane, reactions of ever smaller equal increments of the default method against
those of the path.
"""
import argparse
import csv
import tempfile
from pathlib import Path

from measure import cpu_seconds

TOP = Path(__file__).resolve().parent.parent
SIZES = (20, 40, 80, 160, 320)


def run(options, scene, folder, *changes):
    """Runs a shipped scene; CPU seconds, rows of its tables."""
    command = [options.build / "conetact", TOP / "parameter-files" / scene, "-o", folder, "--quiet", "-s", "Output/VTU=0"]
    for change in changes:
        command += ["-s", change]
    seconds = cpu_seconds(command)
    tables = {}
    for name in ("events.csv", "reactions.csv"):
        if (Path(folder) / name).exists():
            with open(Path(folder) / name, newline="") as stream:
                tables[name] = list(csv.DictReader(stream))
    return seconds, tables


def bar(options, m, folder):
    return run(options, "bar-on-rigid-base.prm", folder, "Solver/Method=load path",
               f"Body bar/Frame/Arguments=0, 0 : 260, 0 : {m}", "Load weight/Value=0 ; -3975",
               "Load pull/Value=243750*t ; 0", "Time/End=1.4", "Time/Increments=1")


def block(options, m, folder):
    return run(options, "pushed-block.prm", folder,
               f"Body block/Mesh/Arguments={m - 1}, {max(1, (m - 1) // 8)} : 0, 0 : 2, 1 : true")


def cost(options):
    rows = []
    print("| scene | contact nodes | events | CPU s | p at the end | outcome |\n|---|---|---|---|---|---|")
    for name, scene in (("bar", bar), ("block", block)):
        for m in SIZES[:2] if options.quick else SIZES:
            with tempfile.TemporaryDirectory() as results:
                seconds, tables = scene(options, m, results)
            *events, outcome = tables["events.csv"]
            rows.append((name, m, len({e["event"] for e in events}), round(seconds, 2), outcome["parameter"],
                         outcome["to"]))
            print("| " + " | ".join(map(str, rows[-1])) + " |", flush=True)
    draw(rows, options.results / "load-path-time.png")


def draw(rows, picture):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(figsize=(5.5, 4), layout="constrained")
    for name in dict.fromkeys(row[0] for row in rows):
        axes.loglog(*zip(*((row[1], row[3]) for row in rows if row[0] == name)), "o-", label=name)
    axes.set_xlabel("contact nodes m")
    axes.set_ylabel("CPU seconds of the process")
    axes.legend(frameon=False)
    figure.savefig(picture, dpi=130)


def increments(options):
    cases = {"pressed, then moved": ("-0.05*max(t - 1, 0) ; -0.7*min(t, 1)", 23),
             "pressed while it is moved": ("-0.2*max(t - 1, 0) ; -0.35*t", 2)}
    print("\n| load | increments | largest difference of r_n | of r_t |\n|---|---|---|---|")
    for name, (displacement, end) in cases.items():
        changes = (f"Support top/Displacement={displacement}", "Contact bottom/Friction coefficient=0.2")
        with tempfile.TemporaryDirectory() as folder:
            _, tables = run(options, "inclined-obstacle.prm", folder, "Solver/Method=load path", f"Time/Times=1, {end}",
                            *changes)
            path = tables["reactions.csv"][-51:]
            size = max(float(row["r_n"]) for row in path)
            for n in (1, 4, 16) if options.quick else (1, 2, 4, 8, 16, 32, 64):
                _, tables = run(options, "inclined-obstacle.prm", folder, f"Time/Stages=1 : {n}, {end} : {n}", *changes)
                rows = list(zip(path, tables["reactions.csv"][-51:]))
                worst = [max(abs(float(a[c]) - float(b[c])) for a, b in rows) / size for c in ("r_n", "r_t1")]
                print(f"| {name} | {2 * n} | " + " | ".join("%.1e" % d for d in worst) + " |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=Path, default=TOP / "build")
    parser.add_argument("--results", type=Path, default=TOP / "benchmarks/results")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    options.results.mkdir(parents=True, exist_ok=True)
    cost(options)
    increments(options)


if __name__ == "__main__":
    main()
