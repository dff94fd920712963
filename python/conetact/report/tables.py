# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of the page; each scrolls in a box of its own."""
import re
from html import escape

import numpy as np

SMALL = 1e-9  # what is smaller than this part of its like is rounding, and 0 in a table
KINDS = (("place", r"[xyz]|largest_.*_[xyz]"), ("displacement", r"largest_displacement|(obstacle_)?.+_u_[xyz]"),
         ("force", r".*_f_[xyz]|preload_.*_force"), ("moment", r".*_m_[xyz]"),
         ("energy", r"strain_energy|external_work|dissipation|contact_work.*"))
MOST_ROWS = 400
SOLVED = ("solver", "substeps", "iterations", "residual", "equilibrium", "balance", "open", "stick", "slip",
          "determinate")


def number(value, digits=5):
    if isinstance(value, (float, np.floating)):
        return f"{value:.{digits}g}"
    return str(value)


def table(head, rows, caption=""):
    """Cells that are numbers stand on the right."""
    def kind(value):
        if isinstance(value, (int, float, np.number)):
            return ' class="number"'
        return ' class="words"' if len(value) > 30 else ""

    def cell(value):
        return f"<td{kind(value)}>{escape(number(value))}</td>"
    caption = f"<caption>{escape(caption)}</caption>" if caption else ""
    first = rows[0] if len(rows) else [""] * len(head)
    heads = "".join(f"<th scope='col'{kind(value)}>{escape(name)}</th>" for name, value in zip(head, first))
    lines = "".join(f"<tr>{''.join(map(cell, row))}</tr>\n" for row in rows)
    return (f'<div class="scroll" tabindex="0"><table>{caption}<thead><tr>{heads}</tr></thead>\n'
            f"<tbody>{lines}</tbody></table></div>")


def thinned(rows, word="increment", file="increments.csv"):
    """At most so many rows, the last one among them, and a sentence on the others."""
    step = -(-len(rows) // MOST_ROWS)
    if step <= 1:
        return rows, ""
    kept = rows[::-1][::step][::-1]
    return kept, f"<p>Every {step}th {word} is in this table; {file} has all {len(rows)}.</p>"


def kind_of(name):
    return next((kind for kind, pattern in KINDS if re.fullmatch(pattern, name)), None)


def scales_of(*rows):
    """The largest places, displacements, forces, moments and energies of a run; moments are no smaller than forces times places."""
    scales = {kind: 0. for kind, _ in KINDS}
    for table_rows in rows:
        for name in table_rows.dtype.names:
            if (kind := kind_of(name)) and len(table_rows):
                scales[kind] = max(scales[kind], float(np.abs(table_rows[name]).max()))
    return {**scales, "moment": max(scales["moment"], scales["force"] * scales["place"])}


def rounded(rows, scales):
    """The same rows; what is rounding is 0."""
    rows = rows.copy()
    for name in rows.dtype.names:
        if kind := kind_of(name):
            rows[name] = np.where(np.abs(rows[name]) < SMALL * scales[kind], 0., rows[name])
    return rows


def columns_table(rows, names, units, *of_rows):
    """Columns of a table of the program; columns of zeros alone are left out, but for the first two."""
    shown = [name for name in names if rows.dtype[name].kind not in "fi" or name in names[:2] or rows[name].any()]
    kept, remark = thinned(rows, *of_rows)
    return remark + table([units.label(name) for name in shown], [[row[name] for name in shown] for row in kept])


def solved_table(increments, units):
    names = ["increment", "time", *(name for name in SOLVED if name in increments.dtype.names)]
    kept, remark = thinned(increments)
    return remark + table([units.label(name) for name in names], [[row[name] for name in names] for row in kept])


def resultants(increments):
    """Names of the columns of forces and moments."""
    return [name for name in increments.dtype.names if name[-4:] in
            ("_f_x", "_f_y", "_f_z", "_m_x", "_m_y", "_m_z") or name.startswith(("preload_", "obstacle_"))]


def resultants_table(increments, units):
    return columns_table(increments, ["increment", "time", *resultants(increments)], units)


def others_table(increments, units):
    """Energies, wear and what else there is."""
    known = {"increment", "time", *SOLVED, *resultants(increments), "err1", "err2"}
    names = [name for name in increments.dtype.names if name not in known and not name.startswith("balance")]
    return columns_table(increments, ["increment", "time", *names], units)


def history_table(history, units):
    return columns_table(history, list(history.dtype.names), units)


def events_table(events, units):
    """Changes of states along a load path."""
    return columns_table(events, list(events.dtype.names), units, "event", "events.csv") if len(events) else ""


def meshes_table(refinement, units):
    """One row for each mesh of an adaptive run."""
    return columns_table(refinement, list(refinement.dtype.names), units, "mesh", "refinement.csv")
