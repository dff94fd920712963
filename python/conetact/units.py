# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Units of a scene, as Output/Units or its head comment tells them ("Units: N, mm, MPa."), and labels with them."""
import re
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
LENGTHS = ("nm", "um", "mm", "cm", "dm", "m", "km", "in", "ft")
STRESSES = ("Pa", "kPa", "MPa", "GPa", "psi", "ksi")
NAMED = {("N", "m"): "Pa", ("N", "mm"): "MPa", ("kN", "m"): "kPa", ("kN", "mm"): "GPa", ("MN", "m"): "MPa",
         ("lbf", "in"): "psi"}  # stresses by force and length, as the program calls them in VTU files
FORCES = ("mN", "N", "daN", "kN", "MN", "GN", "lbf", "kip")

# columns of tables by kind; the first that matches
KINDS = ((r"[xyz]|gap|d?u_.*|(foot|acts)_.|(largest_)?displacement|largest_.*_[xyz]|.+_u_[xyz]", "length"),
         (r"r_.*|.*_f_.|.*force.*", "force"),
         (r".*_m_.|.*moment.*|torque", "moment"), (r"(largest_)?pressure|traction.*|.*stress.*|von_mises", "stress"), (r"area", "area"),
         (r"strain_energy|external_work|dissipation|contact_work_normal", "moment"))


class Units:
    """Names of units by kind, "" where the scene has any."""

    def __init__(self, words=""):
        found = [word.strip() for word in re.split(r",| and ", words.split("(")[0])]
        named = {kind: next((w for w in found if w.split(" ")[-1] in names), "")
                 for kind, names in (("length", LENGTHS), ("force", FORCES), ("stress", STRESSES))}
        length, force = named["length"], named["force"]
        self.names = {**named, "area": length and f"{length}²", "moment": force and length and f"{force} {length}",
                      "stress": named["stress"] or NAMED.get((force, length))
                      or (force and length and f"{force}/{length}²")}

    def label(self, name, kind=None):
        """A name with its unit; the kind follows from the name of a column."""
        kind = kind or next((k for pattern, k in KINDS if re.fullmatch(pattern, name)), None)
        unit = self.names.get(kind, "")
        return f"{name} [{unit}]" if unit else name


def scene_file(result):
    """The scene that a log names, where it can still be found."""
    named = re.search(r"^Conetact .*, scene (.+)$", result.log, re.M)
    places = [Path(named[1]), TOP / named[1], TOP / "parameter-files" / Path(named[1]).name] if named else []
    return next((file for file in places if file.is_file()), None)


def units_of(result, words=None):
    """Of the scene of a result, or those given: "mm, N, MPa"."""
    words = words if words is not None else result.entries.get("Output/Units") or None
    file = scene_file(result)
    if words is None and file:
        comments = " ".join(line[1:].strip() for line in file.read_text().splitlines() if line.startswith("#"))
        told = re.search(r"Units: (.*?)(, see|\.( |$)|$)", comments)
        words = told[1] if told and told[1] != "any" else ""
    return Units(words or "")
