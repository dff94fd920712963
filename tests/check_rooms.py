#!/usr/bin/env python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rooms stand on each other: a file includes its own room and rooms below.

usage: check_rooms.py SOURCE_TREE"""
import pathlib
import re
import sys

# from the ground up: each may include those before it that are named
BELOW = {"base": (), "solvers": (), "structures": ("base",), "pairing": ("base", "structures"),
         "output": ("base", "structures", "solvers"),
         "contact": ("base", "structures", "pairing", "output", "solvers"),
         "verification": ("base", "output", "contact"),
         "fclib": ("base", "solvers"),
         "application": ("base", "structures", "pairing", "output", "contact", "verification", "solvers", "fclib")}


def includes(tree):
    """(room, name) of each pair of a header and its source, and those they include."""
    result = {}
    for file in sorted([*tree.glob("source/*/*.cc"), *tree.glob("include/conetact/*/*.h")]):
        own = (file.parent.name, file.stem)
        found = re.findall(r'#include "conetact/(\w+)/(\w+)\.h"', file.read_text())
        result.setdefault(own, set()).update(set(found) - {own})
    return result


def main(tree):
    graph, faults = includes(pathlib.Path(tree)), []
    for (room, name), others in sorted(graph.items()):
        for other, header in sorted(others):
            if room not in BELOW:
                faults.append(f"{room} is not among the rooms of {__file__}")
            elif other != room and other not in BELOW[room]:
                faults.append(f"{room}/{name} includes {other}/{header}, which is not below it")
    print("\n".join(faults) or f"{len(graph)} files in {len(BELOW)} rooms")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
