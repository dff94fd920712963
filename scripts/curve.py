#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws any column of a table of a finished run against any other.

usage: curve.py FOLDER COLUMN [AGAINST] [-o CURVE.png] [--contact NAME] [--node N | --near X,Y] [--increment N]

COLUMN and AGAINST (default: time) are columns of increments.csv, history.csv, reactions.csv, events.csv
or refinement.csv; those of the first three go together: bottom_f_x against u_t1 of a node. Columns of
contact nodes against x, y or z are drawn along each contact in one increment (the last
one, or --increment); all others along the history of one node: the one of --node or --near,
or the one where the column is largest. Of a load path, time is the load parameter p: its
events are marked, a limit load is a line. Without COLUMN: names of all columns.
Needs python3-numpy and python3-matplotlib.
"""
import argparse
import difflib
import os
import sys
from pathlib import Path

import drawing  # noqa: F401 (first: it knows the way to python/)
import matplotlib.pyplot as plt
import numpy as np
from conetact import ConetactError, Result
from conetact.units import units_of
from drawing.files import save

TABLES = ("increments", "history", "reactions", "refinement")
OF_INCREMENTS = ("increments", "history")  # one row each
ALONE = ("refinement", "events")  # their rows are no increments
MARKS = {"open": ("o", "C3"), "stick": ("s", "C2"), "slip+": (">", "C0"), "slip-": ("<", "C1"), "slip": ("D", "C0")}


class Tables:
    """What can be drawn of a run."""

    def __init__(self, result):
        self.result = result
        self.tables = {name: result.table(name) for name in TABLES if (result.folder / f"{name}.csv").exists()}
        if (result.folder / "events.csv").exists():
            self.tables["events"] = result.events
        if "increments" not in self.tables:
            result.table("increments")  # says that it is missing

    def columns(self, name):
        kinds = self.tables[name].dtype
        return [c for c in kinds.names if kinds[c].kind in "if"]

    def of(self, column):
        """Names of the tables with this column."""
        found = [name for name in self.tables if column in self.columns(name)]
        if not found:
            near = difflib.get_close_matches(column, [c for name in self.tables for c in self.columns(name)], 1)
            raise ConetactError(f"The tables of {self.result.folder} have no column '{column}' with numbers. "
                                + (f"Did you mean '{near[0]}'? " if near else "")
                                + f"All names: curve.py {self.result.folder}")
        return found

    def of_increments(self):
        """Columns of increments.csv and history.csv, which have a row for each increment."""
        history = self.tables.get("history")
        columns = {} if history is None else {c: history[c] for c in self.columns("history")}
        return {**columns, **{c: self.tables["increments"][c] for c in self.columns("increments")}}

    def told(self):
        return "\n".join(f"{name}.csv: {', '.join(self.columns(name))}" for name in self.tables)


def places_of(rows):
    return np.column_stack([rows[axis] for axis in "xyz"])


def chosen_rows(rows, args):
    """Of the contact and node that are asked for."""
    if args.contact:
        names = list(dict.fromkeys(rows["contact"].tolist()))
        if args.contact not in names:
            raise ConetactError(f"There is no contact '{args.contact}'; those of this run: {', '.join(names)}.")
        rows = rows[rows["contact"] == args.contact]
    if args.node is not None:
        numbers = np.unique(rows["node"])
        if args.node not in numbers:
            raise ConetactError(f"No row of reactions.csv has node {args.node}; numbers of nodes are "
                                f"{numbers.min()} to {numbers.max()}, some of these.")
        rows = rows[rows["node"] == args.node]
    if args.near:
        place = np.array([*args.near, 0, 0][:3])
        distances = np.linalg.norm(places_of(rows) - place, axis=1)
        rows = rows[distances == distances.min()]
    return rows


def one_node(rows, columns):
    """History of the contact node at which the first of these columns of reactions.csv is largest."""
    row = rows[np.abs(rows[next(c for c in columns if c in rows.dtype.names)]).argmax()]
    return rows[(rows["contact"] == row["contact"]) & (rows["node"] == row["node"])]


def profiles(tables, args):
    """A curve for each contact in one increment."""
    rows = chosen_rows(tables.tables["reactions"], args)
    increment = rows["increment"].max() if args.increment is None else args.increment
    rows = rows[rows["increment"] == increment]
    if not len(rows):
        last = tables.tables["increments"]["increment"].max(initial=0)
        raise ConetactError(f"There is no increment {increment}; the last one is {last}.")
    curves = {}
    for name in dict.fromkeys(rows["contact"].tolist()):
        part = np.sort(rows[rows["contact"] == name], order=args.against)
        curves[f"contact {name}"] = part[args.against], part[args.column]
    return curves, f"increment {increment}, t = {rows['time'][0]:.4g}"


def history(tables, args):
    """One curve over increments, of one node if a column belongs to nodes."""
    where = [tables.of(column) for column in (args.against, args.column)]
    asked = args.contact or args.node is not None or args.near
    steps = tables.of_increments()
    same = [name for name in tables.tables if all(name in names for names in where)
            and not (name in OF_INCREMENTS and asked and "reactions" in where[0] and "reactions" in where[1])]
    if same and same[0] != "reactions":
        table = tables.tables[same[0]]
        return {"": (table[args.against], table[args.column])}, ""
    if args.against in steps and args.column in steps:
        return {"": (steps[args.against], steps[args.column])}, ""
    for names in where:
        if names[0] in ALONE:
            raise ConetactError(f"Rows of {names[0]}.csv are no increments: draw its columns against each other.")
    rows = tables.tables["reactions"]
    of_nodes = [c for c, names in zip((args.column, args.against), (where[1], where[0])) if "reactions" in names]
    moving = [c for c in of_nodes if c not in ("time", "increment")] or of_nodes
    rows = one_node(chosen_rows(rows, args), moving) if len(rows) else rows
    if not len(rows):
        raise ConetactError("The run has no contact node.")
    at = np.searchsorted(steps["increment"], rows["increment"])
    values = [rows[c] if c in rows.dtype.names else steps[c][at] for c in (args.against, args.column)]
    place = ", ".join(f"{x:.6g}" for x in places_of(rows)[0][:tables.result.dimension])
    return {"": tuple(values)}, f"node {rows['node'][0]} at ({place}) of contact {rows['contact'][0]}"


def at_parameters(parameters, points, wanted):
    """The points of a path at which its load parameter is one of these."""
    near = np.abs(parameters[:, None] - wanted[None]) <= 1e-9 * np.maximum(1, np.abs(wanted))
    return points[near.any(axis=1)]


def draw_events(axes, result, curve, time_is_up):
    """Marks where nodes of an event go over to another state, and a line for a limit load."""
    points, parameters = np.column_stack(curve), np.asarray(curve[1 if time_is_up else 0])
    words, last = result.outcome
    for state, (mark, colour) in MARKS.items():
        found = at_parameters(parameters, points, np.unique(result.events["parameter"][result.events["to"] == state]))
        if len(found):
            axes.plot(*found.T, mark, markersize=5, color=colour, label=f"to {state}", linestyle="none")
    if words.startswith("limit load"):
        (axes.axhline if time_is_up else axes.axvline)(last, color="grey", linestyle="--", linewidth=1, label=words)
    return f"{len(np.unique(result.events['event']))} events, {words} at p = {last:.6g}"


def draw(result, args):
    tables = Tables(result)
    of_increments = [tables.of(column)[0] not in ALONE for column in (args.column, args.against)]
    if all(of_increments) and not len(tables.tables["increments"]):
        raise ConetactError(f"{result.folder} has no increment that could be drawn: log.txt says why none was solved.")
    is_profile = args.against in ("x", "y", "z") and "reactions" in tables.of(args.column)
    curves, title = (profiles if is_profile else history)(tables, args)
    is_path = (result.folder / "events.csv").exists()
    units = units_of(result, args.units)

    figure, axes = plt.subplots(figsize=(7, 4.6), layout="constrained")
    for name, (x, y) in curves.items():
        axes.plot(x, y, "." if args.points else "-" if is_path else ".-", color="black" if is_path else None,
                  linewidth=1, label=name or None)
    if is_path and "time" in (args.column, args.against) and not is_profile:
        title = draw_events(axes, result, curves[""], args.column == "time") + (f"\n{title}" if title else "")
    for column, set_label in ((args.against, axes.set_xlabel), (args.column, axes.set_ylabel)):
        set_label("load parameter p" if is_path and column == "time" else units.label(column))
    axes.set_title(title or result.folder.resolve().name, fontsize="medium")
    axes.set_xscale("log" if "x" in args.log else "linear")
    axes.set_yscale("log" if "y" in args.log else "linear")
    if axes.get_legend_handles_labels()[1]:
        axes.legend(frameon=False, fontsize="small")
    save(figure, args.output or args.folder / "curve.png", args.dpi)


def numbers(text):
    return [float(word) for word in text.split(",")]


def parse(arguments):
    summary, usage, rest = __doc__.split("\n\n", 2)
    parser = argparse.ArgumentParser(usage=usage.removeprefix("usage: ").replace("curve.py", "%(prog)s"),
                                     description=f"{summary}\n\n{rest}",
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("column", nargs="?")
    parser.add_argument("against", nargs="?", default="time")
    parser.add_argument("-o", "--output", type=Path, help="default: curve.png in the folder")
    parser.add_argument("--contact", help="only nodes of this contact")
    parser.add_argument("--node", type=int, help="number of a node in its body")
    parser.add_argument("--near", type=numbers, metavar="X,Y[,Z]", help="the contact node next to this place")
    parser.add_argument("--increment", type=int, help="of curves along a contact; default: the last one")
    parser.add_argument("--points", action="store_true", help="no lines between points")
    parser.add_argument("--log", default="", choices=("x", "y", "xy"), help="logarithmic axes")
    parser.add_argument("--dpi", type=int, default=130, help="dots an inch; default 130")
    parser.add_argument("--units", help="of length, force and stress, such as 'mm, N, MPa'; default: those of the scene")
    return parser.parse_args(arguments)


def main(arguments):
    args = parse(arguments)
    try:
        result = Result(args.folder)
        if args.column is None:
            print(Tables(result).told(), flush=True)
        else:
            draw(result, args)
    except (ConetactError, ValueError) as error:
        sys.exit(f"curve.py: {error}")
    except BrokenPipeError:  # who reads the list has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


if __name__ == "__main__":
    main(sys.argv[1:])
