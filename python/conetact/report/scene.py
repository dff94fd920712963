# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The scene of a run: its head comment, bodies with sizes, contacts, entries."""
import re
from html import escape

import numpy as np

from ..errors import ResultError
from .tables import table


def head_comment(file):
    """Paragraphs of the comment at the top of a scene, without those of the licence."""
    lines = []
    for line in file.read_text().splitlines() if file else ():
        if not line.startswith("#"):
            break
        lines.append("" if "SPDX" in line else line[1:].strip())
    return [" ".join(part.split()) for part in "\n".join(lines).split("\n\n") if part.strip()]


def without_empty(text):
    """used.prm without entries that have no value, and sections that have no entry then."""
    kept = []
    for line in text.splitlines():
        if re.fullmatch(r"\s*set [^=]*=\s*", line):
            continue
        if line.strip() == "end" and kept and kept[-1].strip().startswith("subsection "):
            kept.pop()
            continue
        kept.append(line)
    return "\n".join(kept)


def size_text(points, dimension, units):
    extent = np.ptp(points, axis=0)[:dimension] if len(points) else []
    unit = units.names.get("length", "")
    return " × ".join(f"{x:.4g}" for x in extent) + (f" {unit}" if unit else "")


def material(entries, body):
    def value(name):
        return entries.get(f"Body {body}/Material/{name}", "")
    return ", ".join(f"{letter} = {value(name)}" for letter, name in (("E", "Young modulus"), ("ν", "Poisson ratio"))
                     if value(name))


def bodies_table(result, outcome, units):
    """What the log says of each body, and its size where there are pictures."""
    try:
        meshes = result.bodies((result.drawn_increments() or [0])[-1])
    except ResultError:
        meshes = {}
    names = dict.fromkeys([*(word.strip() for word in result.entries.get("Bodies", "").split(",")), *outcome.bodies])
    rows = []
    for name in filter(None, names):
        mesh = meshes.get(re.sub(r"[^A-Za-z0-9_.-]", "_", name))
        size = size_text(mesh.points, result.dimension, units) if mesh else "not drawn"
        rows.append([name, "; ".join(outcome.bodies.get(name, [])), size, material(result.entries, name)])
    return table(["body", "mesh", "size", "material"], rows)


def contacts_table(result, outcome):
    def of(name, entry):
        return result.entries.get(f"Contact {name}/{entry}", "")
    rows = [[name, of(name, "Body"), of(name, "Obstacle") or of(name, "Master") or of(name, "Master body"),
             of(name, "Friction coefficient"), "; ".join(told)] for name, told in outcome.contacts.items()]
    return table(["contact", "body", "against", "friction coefficient", "in the log"], rows) if rows else ""


def folded(title, text):
    return f"<details><summary>{escape(title)}</summary><pre tabindex='0'>{escape(text)}</pre></details>"
