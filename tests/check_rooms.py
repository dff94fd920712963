#!/usr/bin/env python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rooms stand on each other: a file includes its own room and rooms below.

usage: check_rooms.py SOURCE_TREE"""
import pathlib
import re
import sys

# from the ground up: each may include those before it that are named
BELOW = {"base": (), "solvers": (), "load_path": ("solvers",),
         "reproductions": ("solvers", "load_path"), "bodies": ("base",),
         "pairing": ("base", "bodies"), "backends": ("base", "solvers"),
         "output": ("base", "bodies", "solvers"), "exchange": ("base", "solvers"),
         "contact": ("base", "bodies", "pairing", "backends", "output", "solvers"),
         "verification": ("base", "output", "contact"),
         "application": ("base", "bodies", "pairing", "output", "contact", "solvers", "load_path"),
         "analysis": ("base", "bodies", "pairing", "backends", "output", "contact", "verification",
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


def main(tree):
    graph, faults = includes(pathlib.Path(tree)), []
    for (room, name), others in sorted(graph.items()):
        for other, header in sorted(others):
            if room not in BELOW:
                faults.append(f"{room} is not among the rooms of {__file__}")
            elif other != room and other not in BELOW[room]:
                faults.append(f"{name} includes {header}, which is not below it")
    print("\n".join(faults) or f"{len(graph)} files in {len(BELOW)} rooms")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
