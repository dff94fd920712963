# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""One run of the program, judged by its tables.

What can be computed anew from the tables is: the law of contact and friction of
every node, and the balance of all forces. Tables write forces below 1e-9 of the
largest as 0; nodes with such a zero are judged to that precision.
"""
import csv
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))
from support.batch import of_thread  # noqa: E402

TOLERANCE = 1e-10
WRITTEN = 1e-9  # smaller forces stand as 0 in the tables
ROUNDING = 1e-4  # of stiffness times displacement: smaller forces have no 12 digits


@dataclass
class Case:
    """A shipped scene with other values; `refused` is what the sentence must say, None: solvable."""
    name: str
    scene: Path
    settings: dict = field(default_factory=dict)
    refused: str = None
    group: str = None  # cases of a group must have the same iterations

    def arguments(self):
        return [str(self.scene)] + [part for key, value in self.settings.items() for part in ("-s", f"{key}={value}")]

    def command(self):
        return "conetact " + " ".join(map(shlex.quote, self.arguments()))


@dataclass
class Result:
    case: Case
    failure: str = ""
    residual: float = 0.0
    iterations: int = 0
    parts: int = 1
    history: tuple = ()  # iterations of each increment
    reactions: np.ndarray = None


def read(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def columns(rows, *names):
    return np.array([[float(row[name]) for name in names] for row in rows])


def frictions(used):
    """Friction of each contact of a used.prm: (mu_1, mu_2, angle of the first axis)."""
    result = {}
    for name, body in re.findall(r"^subsection Contact (.*?)\n(.*?)^end", used, re.M | re.S):
        entry = dict(re.findall(r"set (.*?)\s*= ?(.*)", body))
        first = float(entry["Friction coefficient"])
        second = entry["Second friction coefficient"]
        result[name] = (first, float(second) if second else first, np.radians(float(entry["Friction angle"])))
    return result


def turned(t, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * t[:, 0] + s * t[:, 1], c * t[:, 1] - s * t[:, 0]], axis=1)


def project(r, mu):
    """On the cone |r_t| <= mu r_n, normal last; on the half line where mu is 0."""
    length, n = np.linalg.norm(r[:, :2], axis=1), r[:, 2]
    mantle = (n + mu * length) / (1 + mu ** 2)
    inside, outside = length <= mu * n, mu * length <= -n
    height = np.where(outside, 0, np.where(inside, n, mantle))
    shrink = np.where(outside, 0, np.where(inside, 1, mu * height / np.where(length > 0, length, 1)))
    return np.column_stack([r[:, :2] * shrink[:, None], height])


def stiffness(rows, used):
    """Force over displacement of a contact node: E times thickness, in 3D times the distance h of nodes; bars E A/h."""
    young = min(float(text) for text in re.findall(r"Young modulus\s*= (\S+)", used))
    if plane(used):
        return young * float(re.search(r"Thickness\s*= (.*)", used)[1])
    places = np.unique(columns(rows, "x", "y", "z"), axis=0)
    distance = np.sqrt(np.prod(np.sort(np.ptp(places, axis=0))[1:]) / len(places))
    bar = re.search(r"^\s*set Area\s*= (\S+)", used, re.M)
    return young * (float(bar[1]) / distance if bar else distance)


def plane(used):
    return re.search(r"^set Dimension\s*= 2", used, re.M) is not None


class Law:
    """Natural residual of contact and friction, as in contact_residual(), from the tables."""

    def __init__(self, rows, used):
        self.friction = frictions(used)
        self.rho = stiffness(rows, used)
        self.tangents = 1 if plane(used) else 2
        self.written = WRITTEN * np.linalg.norm(columns(rows, "r_n", "r_t1", "r_t2"), axis=1).max()
        self.history = 0.0  # largest reaction so far

    def error(self, rows):
        force, gap = columns(rows, "r_t1", "r_t2", "r_n"), columns(rows, "gap")[:, 0]
        motion = columns(rows, "du_t1", "du_t2")
        self.history = max(self.history, np.linalg.norm(force, axis=1).max())
        scale = max(self.history, self.rho * np.abs(motion).max(), self.rho * np.abs(gap).max())
        zero = (force[:, [*range(self.tangents), 2]] == 0).any(axis=1)
        errors = self.node_errors(rows, force, motion, gap, 2 * self.written * zero)
        return float(errors.max() / scale) if scale > 0 else 0.0

    def node_errors(self, rows, force, motion, gap, unknown):
        """Elliptic cones are mapped on circular ones with the larger mu, the errors back."""
        mu = np.array([self.friction[row["contact"]] for row in rows])
        if self.tangents == 1:
            mu[:, 1:] = np.column_stack([mu[:, 0], 0 * mu[:, 0]])
        largest = mu[:, :2].max(axis=1)
        map_ = np.where(mu[:, :2] > 0, largest[:, None] / np.where(mu[:, :2] > 0, mu[:, :2], 1), 1)
        r = np.column_stack([turned(force[:, :2], mu[:, 2]) * map_, force[:, 2]])
        slip = turned(motion, mu[:, 2]) / map_
        v = np.column_stack([slip, gap + largest * np.linalg.norm(slip, axis=1)])
        v[:, :2] *= largest[:, None] > 0
        error = r - project(r - self.rho * v, largest)
        error[:, :2] /= map_
        return np.maximum(np.linalg.norm(error, axis=1) - unknown * map_.max(axis=1), 0)


def balance_error(increments, contacts, floor):
    """Sum of all forces in each increment, over the largest of the run."""
    names = [name.replace(" ", "_") for name in contacts] + ["supports", "loads"]
    forces = np.array([[[float(row[f"{name}_f_{c}"]) for c in "xyz"] for name in names] for row in increments])
    largest = max(np.abs(forces).max(), floor)
    zeros = (forces == 0).sum(axis=1)
    return float((np.abs(forces.sum(axis=1)) / largest - WRITTEN * zeros).max())


def measures(increments, rows, used):
    """The program's own residuals, and the same computed anew."""
    own = [row for row in rows if not row["contact"].endswith("_master")]
    law = Law(own, used)
    noise = ROUNDING * law.rho * np.abs(columns(own, "u_n", "u_t1", "u_t2")).max()
    found = {name: columns(increments, name).max() for name in ("residual", "equilibrium", "balance")}
    found["sum of forces"] = balance_error(increments, dict.fromkeys(row["contact"] for row in rows), noise)
    found["contact law"] = 0.0
    for row in increments:
        nodes = [node for node in own if node["increment"] == row["increment"]]
        own = own[len(nodes):]
        if row["substeps"] == "1":  # the law holds part by part
            found["contact law"] = max(found["contact law"], law.error(nodes))
    return found


def judge_tables(folder, result):
    increments, rows = read(folder / "increments.csv"), read(folder / "reactions.csv")
    result.history = tuple(int(row["iterations"]) for row in increments)
    result.iterations, result.parts = max(result.history), max(int(row["substeps"]) for row in increments)
    result.reactions = columns([row for row in rows if not row["contact"].endswith("_master")], "r_n", "r_t1", "r_t2")
    found = measures(increments, rows, (folder / "used.prm").read_text())
    result.residual = max(found.values())
    result.failure = "; ".join(f"{name} {value:.2g}" for name, value in found.items() if not value <= TOLERANCE)


def judge(case, folder, code, sentence):
    """The verdict on a finished run."""
    result = Result(case)
    if case.refused:
        if code != 2:
            result.failure = f"exit code {code} instead of a refusal"
        elif not re.search(case.refused, sentence):
            result.failure = "refused with another sentence: " + sentence
    elif code != 0:
        result.failure = f"exit code {code}: {sentence}"
    else:
        judge_tables(folder, result)
    return result


def run(program, case, folder, seconds=300):
    try:
        done = of_thread(program).run(*case.arguments(), "-o", folder, "--quiet", "-s", "Output/VTU=0", timeout=seconds)
    except subprocess.TimeoutExpired:
        return Result(case, f"no end within {seconds} s")
    return judge(case, folder, done.returncode, done.stderr.strip())
