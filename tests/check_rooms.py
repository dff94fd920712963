#!/usr/bin/env python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rooms stand on each other: a file includes its own room and rooms below; files stand on each other, too; and
tests stand below benchmarks.

usage: check_rooms.py SOURCE_TREE

A header and its source count as one: of files in a circle none can be read, or used, without
the others. The table of the kinds of x, x_table.cc, knows them all and nobody knows it: without
a header of its own it stands by itself, outside of circles.
"""
import pathlib
import re
import sys

# from the ground up: each may include those before it that are named
BELOW = {"base": (), "solvers": (), "load_path": ("solvers",),
         "reproductions": ("solvers", "load_path"), "bodies": ("base",),
         "pairing": ("base", "bodies"), "condensed": ("base", "solvers"),
         "iterative": ("base", "solvers", "condensed"),
         "model": ("base", "bodies", "pairing", "solvers"),
         "output": ("base", "bodies", "model", "condensed", "solvers"), "exchange": ("base", "solvers"),
         "contact": ("base", "bodies", "pairing", "model", "condensed", "iterative", "solvers"),
         "verification": ("base", "model", "contact"),
         "application": ("base", "bodies", "pairing", "model", "condensed", "iterative", "output", "contact", "solvers", "load_path"),
         "analysis": ("base", "bodies", "pairing", "model", "condensed", "iterative", "output", "contact", "verification",
                      "solvers", "load_path", "application")}


def includes(tree):
    """(room, name) of each pair of a header and its source, and those they include."""
    result = {}
    for folder in (tree / "source", tree / "include/conetact"):
        for file in sorted([*folder.glob("*/**/*.cc"), *folder.glob("*/**/*.h")]):
            path = file.relative_to(folder)
            own = (path.parts[0], str(path.with_suffix("")))
            found = re.findall(r'#include "conetact/((\w+)/[\w/]+)\.h"', file.read_text())
            result.setdefault(own, set()).update({(room, name) for name, room in found} - {own})
    return result


def circles(graph):
    """Sets of more than one node of which each reaches all others, by Tarjan's algorithm."""
    number, lowest, stack, found = {}, {}, [], []

    def visit(node):
        number[node] = lowest[node] = len(number)
        stack.append(node)
        for other in sorted(graph.get(node, ())):
            if other not in number:
                visit(other)
            if other in stack:
                lowest[node] = min(lowest[node], lowest[other])
        if lowest[node] == number[node]:
            at = stack.index(node)
            found.append(frozenset(stack[at:]))
            del stack[at:]

    for node in sorted(graph):
        if node not in number:
            visit(node)
    return {circle for circle in found if len(circle) > 1}


def faults_of_rooms(graph):
    for (room, name), others in sorted(graph.items()):
        for other, header in sorted(others):
            if room not in BELOW:
                yield f"{room} is not among the rooms of {__file__}"
            elif other != room and other not in BELOW[room]:
                yield f"{name} includes {header}, which is not below it"


def faults_of_circles(found):
    """A header and its source are one file."""
    for circle in sorted(map(sorted, found)):
        yield f"{', '.join(circle)} include each other: move what both need into a file below them"


def faults_of_scripts(tree):
    """Tests import nothing of benchmarks, and these of tests nothing but `support`."""
    files = {folder: sorted((tree / folder).rglob("*.py")) for folder in ("tests", "benchmarks")}
    own = {"tests": {"tests", "laws", *(file.stem for file in (tree / "tests").glob("*.py"))},
           "benchmarks": {"benchmarks", *(file.stem for file in files["benchmarks"])}}
    for folder, other in (("tests", "benchmarks"), ("benchmarks", "tests")):
        for file in files[folder]:
            found = set(re.findall(r"^ *(?:import|from) (\w+)", file.read_text(), re.M))
            for module in sorted(found & own[other] - own[folder]):
                yield f"{file.relative_to(tree)} imports {module} of {other}: move what both need to tests/support"


def main(tree):
    tree = pathlib.Path(tree)
    graph = includes(tree)
    found = {frozenset(name for _, name in circle) for circle in circles(graph)}
    faults = [*faults_of_rooms(graph), *faults_of_circles(found), *faults_of_scripts(tree)]
    print("\n".join(faults) or f"{len(graph)} files in {len(BELOW)} rooms")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
