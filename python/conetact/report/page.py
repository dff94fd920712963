# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The page from top to bottom: summary, view, warnings, curves, tables, scene."""
import json
import re
from html import escape
from pathlib import Path

import numpy as np

from .. import ResultError
from ..units import scene_file, units_of
from . import scene, tables
from .curves import all_curves
from .outcome import outcome_of
from .view import view_of

HERE = Path(__file__).resolve().parent
# the browser need not look for an icon, nor may it load anything
HEAD = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy"
  content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:">
<link rel="icon" href="data:,">
<title>{title}</title>
<style>
{style}
</style>
</head>
<body>
"""


def marked(text):
    """As HTML; what stands between backticks is code."""
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(text))


def paragraphs(texts):
    return "".join(f"<p>{marked(text)}</p>\n" for text in texts)


def section(title, *parts):
    inner = "\n".join(filter(None, parts))
    return f"<section>\n<h2>{escape(title)}</h2>\n{inner}\n</section>\n" if inner else ""


def names_in(result, entry):
    return [name.strip() for name in result.entries.get(entry, "").split(",") if name.strip()]


def contact_names(result, outcome):
    """Those of the scene, or those that the program has found."""
    return list(dict.fromkeys([*outcome.contacts, *(n for n in names_in(result, "Contacts") if n != "automatic")]))


def verdict(result, outcome):
    """The first card: how the run ended, in a few words and in the program's."""
    done = len(result.increments)
    if (result.folder / "events.csv").exists() and outcome.good:
        words, parameter = result.outcome
        kind = "bad" if "not converged" in words else "good"
        return kind, words, f"{done} points of the load path, up to p = {parameter:.6g}"
    if outcome.good:
        return "good", "Solved", f"{'all ' if done > 1 else ''}{counted(done, 'increment')}"
    of = f" of {outcome.planned}" if outcome.planned >= done else ""
    return "bad", "Stopped early", f"{done}{of} increments are solved"


def counted(n, word):
    return f"{n} {word}{'' if n == 1 else 's'}"


def tables_of(result):
    """Rows of increments.csv and history.csv, without what is rounding beside the size of the scene and its forces."""
    increments = result.increments
    history = result.history if (result.folder / "history.csv").exists() else increments[:0]
    reactions = [result.reactions] if (result.folder / "reactions.csv").exists() else []
    scales = tables.scales_of(increments, history, *(rows[["x", "y", "z"]] for rows in reactions))
    return tables.rounded(increments, scales), tables.rounded(history, scales)


def largest(history, dimension, name, units, kind):
    """The largest value of the history with its place, as two texts."""
    if not len(history) or not history[name].any():
        return "none", ""
    row = history[np.abs(history[name]).argmax()]
    place = ", ".join(f"{row[f'{name}_{axis}']:.4g}" for axis in "xyz"[:dimension])
    owner = next(str(row[f"{name}_{of}"]) for of in ("contact", "body") if f"{name}_{of}" in history.dtype.names)
    unit = units.names.get(kind, "")
    return f"{row[name]:.4g} {unit}".strip(), f"{owner}, at ({place}), increment {row['increment']}"


def residuals(result):
    rows = result.increments
    if not len(rows):
        return "none", ""
    names = [name for name in ("residual", "equilibrium", "balance") if name in rows.dtype.names]
    worst = {name: float(np.max(rows[name])) for name in names}
    tolerance = result.entries.get("Solver/Tolerance", "")
    words = ", ".join(f"{'contact law' if name == 'residual' else name} {value:.2g}" for name, value in worst.items())
    return f"{max(worst.values()):.2g}", f"{words}{f'; tolerance {tolerance}' if tolerance else ''}"


def states(result):
    if not len(result.increments):
        return ""
    row = result.increments[-1]
    return "at the end " + ", ".join(f"{row[name]} {name}" for name in ("open", "stick", "slip"))


def card(title, value, note, kind=""):
    return (f'<div class="card {kind}"><h3>{escape(title)}</h3><p class="value">{escape(value)}</p>'
            f"<p class='note'>{escape(note)}</p></div>\n")


def summary(result, outcome, units):
    kind, words, note = verdict(result, outcome)
    history, dimension = tables_of(result)[1], result.dimension
    contacts = contact_names(result, outcome)
    cards = [card("Outcome", words, note, kind),
             card("Largest pressure", *largest(history, dimension, "largest_pressure", units, "stress")),
             card("Largest displacement", *largest(history, dimension, "largest_displacement", units, "length")),
             card("Contacts", str(len(contacts)), "; ".join(filter(None, [few(contacts), states(result)]))),
             card("Largest relative error", *residuals(result)),
             card("Warnings", str(len(outcome.warnings)), "see below" if outcome.warnings else "",
                  "warned" if outcome.warnings else "")]
    said = f'<p class="sentence">{escape(outcome.sentence)}</p>' if outcome.sentence else ""
    return f'<div class="cards">\n{"".join(cards)}</div>\n{said}'


def few(names, most=4):
    return ", ".join(names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")


def view_section(result, units):
    data, remarks = view_of(result, units)
    if data is None:
        return section("View", paragraphs(["There is no view: the run wrote no pictures of its increments. "
                                           "Run the scene with -s Output/VTU=1 to have them."]))
    inline = json.dumps(data, separators=(",", ":")).replace("<", "\\u003c")
    code = "\n".join((HERE / name).read_text() for name in ("colours.js", "shaders.js", "controls.js", "viewer.js"))
    remark = f'<p class="note">{escape(" ".join(remarks))}</p>' if remarks else ""
    return section("View", (HERE / "viewer.html").read_text(), remark,
                   f'<script type="application/json" id="data">{inline}</script>', f"<script>\n{code}</script>")


def list_of(texts):
    return "<ul>" + "".join(f"<li>{marked(text)}</li>\n" for text in texts) + "</ul>" if texts else ""


def table_sections(result, units):
    rows, history = tables_of(result)
    if not len(rows):
        return section("Increments", paragraphs(["No increment is solved."]))
    history = tables.history_table(history, units) if len(history) else ""
    return (section("Resultants", tables.resultants_table(rows, units))
            + section("Increments", tables.solved_table(rows, units))
            + section("Energies", tables.others_table(rows, units)) + section("Largest values and probes", history))


def way_sections(result, units):
    """What load paths and adaptive runs have besides."""
    parts = []
    if (result.folder / "events.csv").exists():
        words, parameter = result.outcome
        parts.append(section("Events", tables.events_table(result.events, units),
                             paragraphs([f"The path ends at p = {parameter:.6g}: {words}."])))
    if (result.folder / "refinement.csv").exists():
        parts.append(section("Meshes", tables.meshes_table(result.table("refinement"), units)))
    return "".join(parts)


def scene_section(result, outcome, units):
    file, used = scene_file(result), scene.without_empty((result.folder / "used.prm").read_text())
    return section("Scene", scene.bodies_table(result, outcome, units), scene.contacts_table(result, outcome),
                   scene.folded(f"The scene as it was written, {file.name}", file.read_text()) if file else "",
                   scene.folded("Entries in force, used.prm", used),
                   scene.folded("Log", result.log))


def page_of(result):
    """The whole page as a text."""
    if not (result.folder / "increments.csv").is_file():
        raise ResultError(f"{result.folder} holds no increments.csv: is it a folder of results?")
    units, outcome, name = units_of(result), outcome_of(result), result.folder.resolve().name
    about = scene.head_comment(scene_file(result))
    version = result.log.split(",")[0]
    return "".join([
        HEAD.format(title=escape(f"{name} - Conetact"), style=(HERE / "report.css").read_text()),
        f"<header>\n<h1>{escape(name)}</h1>\n{paragraphs(about[:1])}</header>\n<main>\n",
        summary(result, outcome, units), view_section(result, units), section("Warnings", list_of(outcome.warnings)),
        section("Curves", wrapped("curves", all_curves(result, contact_names(result, outcome), units))),
        way_sections(result, units), table_sections(result, units), section("About the scene", paragraphs(about[1:])),
        scene_section(result, outcome, units), f"</main>\n<footer>{escape(version)}</footer>\n</body>\n</html>\n"])


def wrapped(kind, inner):
    return f'<div class="{kind}">{inner}</div>' if inner else ""
