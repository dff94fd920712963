#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws a finished load path: load parameter against a displacement, with its events.

usage: plot_load_path.py FOLDER PICTURE.png [--contact NAME] [--node N] [--displacement u_t1]

Without options the contact node and the component (u_n, u_t1 or u_t2) that move
most. Marks tell what the nodes of an event go over to; a line shows a limit load.
Needs python3-matplotlib.
"""
import argparse
import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

COMPONENTS = ("u_n", "u_t1", "u_t2")
MARKS = {"open": ("o", "C3"), "stick": ("s", "C2"), "slip+": (">", "C0"), "slip-": ("<", "C1"), "slip": ("D", "C0")}


def read(file):
    try:
        with open(file, newline="") as stream:
            return list(csv.DictReader(stream))
    except OSError:
        raise SystemExit(f"{file} cannot be read: run the scene with Solver/Method = load path.")


def choose(rows, contact, node, component):
    """The rows of one node, and the component."""
    rows = [row for row in rows if contact in (None, row["contact"]) and node in (None, int(row["node"]))]
    if not rows:
        raise SystemExit("no row of reactions.csv has this contact and node.")
    components = [component] if component else COMPONENTS
    largest = max(rows, key=lambda row: max(abs(float(row[c])) for c in components))
    component = max(components, key=lambda c: abs(float(largest[c])))
    place = largest["contact"], largest["node"]
    return [row for row in rows if (row["contact"], row["node"]) == place], component


def crossings(path, parameter):
    """The points of a path at which its load parameter is that of an event."""
    return [(u, p) for p, u in path if abs(p - parameter) <= 1e-9 * max(1, abs(parameter))]


def draw_events(axes, path, events):
    for state, (mark, colour) in MARKS.items():
        loads = sorted({float(e["parameter"]) for e in events if e["to"] == state})
        points = [point for p in loads for point in crossings(path, p)]
        if points:
            axes.plot(*zip(*points), mark, markersize=5, color=colour, label=f"to {state}", linestyle="none")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--contact", help="name; default: that of the node that moves most")
    parser.add_argument("--node", type=int, help="number of the node in its body")
    parser.add_argument("--displacement", choices=COMPONENTS)
    args = parser.parse_args()

    *events, outcome = read(args.folder / "events.csv")
    rows, component = choose(read(args.folder / "reactions.csv"), args.contact, args.node, args.displacement)
    path = [(float(row["time"]), float(row[component])) for row in rows]

    figure, axes = plt.subplots(figsize=(7, 4.6), layout="constrained")
    axes.plot([u for _, u in path], [p for p, _ in path], color="black", linewidth=1)
    draw_events(axes, path, events)
    if outcome["to"].startswith("limit load"):
        axes.axhline(float(outcome["parameter"]), color="grey", linestyle="--", linewidth=1, label=outcome["to"])
    axes.set_xlabel(f"{component} of node {rows[0]['node']} of contact {rows[0]['contact']}")
    axes.set_ylabel("load parameter p")
    axes.set_title(f"{len({e['event'] for e in events})} events, {outcome['to']} at p = {float(outcome['parameter']):.6g}")
    axes.legend(frameon=False)
    figure.savefig(args.picture, dpi=130)


if __name__ == "__main__":
    main()
