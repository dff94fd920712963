# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tables of a run: reactions.csv, increments.csv, events.csv."""
import csv
import re

from support.vectors import plus, scaled, tangents

TEXTS = ("contact", "state", "solver", "determinate", "unique")
REACTION = ("r_n", "r_t1", "r_t2")
MOTION = ("u_n", "u_t1", "u_t2")
STEP = (None, "du_t1", "du_t2")


def read(file):
    with open(file, newline="") as stream:
        return [{name: value if name in TEXTS else float(value) for name, value in row.items()}
                for row in csv.DictReader(stream)]


class Run:
    """Tables of a finished run."""

    def __init__(self, folder):
        self.folder = folder
        self.dim = int(re.search(r"^set Dimension\s*= (\d)", (folder / "used.prm").read_text(), re.M)[1])
        self.rows = read(folder / "reactions.csv")
        self.increments = read(folder / "increments.csv")

    def last(self):
        return [row for row in self.rows if row["increment"] == self.rows[-1]["increment"]]

    def probe(self, name):
        """Its displacement at the end."""
        with open(self.folder / "history.csv", newline="") as stream:
            row = list(csv.DictReader(stream))[-1]
        return tuple(float(row[f"{name}_u_{c}"]) for c in "xyz")

    def largest(self, *columns):
        """Of what is a number: gaps to nothing are none."""
        return max(max(abs(row[c]) for c in columns if row[c] == row[c]) for row in self.rows)

    def at(self, order=None):
        """Rows by increment and place; `order` maps a place onto that of another run."""
        result = {}
        for row in self.rows:
            p = (row["x"], row["y"], row["z"])
            p = order(p) if order else p
            result[(row["increment"], *(round(c, 7) + 0.0 for c in p))] = row
        return result


class Events:
    """events.csv of a load path and the records that belong to it."""

    def __init__(self, folder):
        with open(folder / "events.csv", newline="") as stream:
            *rows, outcome = csv.DictReader(stream)
        if outcome["event"] != "outcome":
            raise RuntimeError(f"events.csv does not end with the outcome but with {outcome}")
        self.parameter, self.words = float(outcome["parameter"]), outcome["to"]
        self.at, self.nodes, self.loads = [], [], []
        for row in rows:
            if int(row["event"]) > len(self.at):
                self.at.append(float(row["parameter"]))
                self.loads.append(row["load"])
                self.nodes.append([])
            self.nodes[-1].append((row["node"], row["from"], row["to"]))


def normal(row):
    return row["n_x"], row["n_y"], row["n_z"]


def in_space(row, dim, columns):
    """Vector of its components along n, t1, t2; None counts as zero."""
    basis = (normal(row), *tangents(normal(row), dim))
    return plus(*(scaled(row[c], e) if c else (0, 0, 0) for c, e in zip(columns, basis)))
