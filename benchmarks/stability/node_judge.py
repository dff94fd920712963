# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A judge that knows statics and the laws of contact nodes as a scene states them.

Of a run it reads places, displacements and forces. Way, pressure, speed, coefficient, limit, closing of layers and wear
are computed here, node by node, from the texts of the scene; so are the sums of forces and moments of each body.
"""
import math
from dataclasses import dataclass, field

import numpy as np
import statics
from statics import Sums, acting_at, other_side, padded, reaction


def by_table(x, *points):
    return float(np.interp(x, points[::2], points[1::2]))


NAMES = {"exp": math.exp, "sin": math.sin, "min": min, "max": max, "abs": abs, "table": by_table,
         "choose": lambda condition, a, b: a if condition else b, "__builtins__": {}}


class Text:
    """An expression of a scene, to be called with its variables."""

    def __init__(self, text):
        python = str(text).replace("if(", "choose(").replace(";", ",").replace(" : ", ", ")
        self.code = compile(python, str(text), "eval")

    def __call__(self, **at):
        return float(eval(self.code, NAMES, at))


@dataclass
class Contact:
    """What a scene says about a contact; empty: nothing."""
    body: str
    master: str = None
    gap: callable = lambda place: 0.0  # at the start
    entries: dict = field(default_factory=dict)

    def __post_init__(self):
        self.laws = {name: Text(value) for name, value in self.entries.items() if name in (
            "Friction coefficient", "Second friction coefficient", "Shear limit", "Compliance", "Shear compliance", "Wear coefficient", "Active")}
        self.cycles = float(self.entries.get("Wear acceleration", 1))
        self.share = float(self.entries.get("Wear share", 1))
        self.implicit = self.entries.get("Wear integration") == "implicit"

    def value(self, name, at, none=0.0):
        return self.laws[name](**at) if name in self.laws else none


@dataclass
class Known:
    """A scene, as its author knows it."""
    dim: int
    contacts: dict
    loads: list  # statics.Load
    supports: dict  # of each: its body
    stiffness: float  # force over length
    temperature: Text = field(default_factory=lambda: Text("0"))


class Node:
    """What one node has been through."""

    def __init__(self):
        self.way, self.worn, self.sure = 0.0, 0.0, True
        self.u, self.friction = np.zeros(2), np.zeros(2)


class Judge:
    """Largest violations, over the largest force, length or depth of the run."""

    def __init__(self, run, known):
        self.run, self.known, self.worst, self.nodes, self.time = run, known, {}, {}, 0.0
        self.fields = {}  # of masters that wear, so far: depths by places along x
        self.force = run.largest("r_n", "r_t1", "r_t2") or 1.0
        self.length = max(run.largest("u_n", "u_t1", "u_t2"), self.force / known.stiffness)
        self.depth = run.largest("wear") if "wear" in run.rows[0] else 0.0

    def note(self, what, error, scale):
        self.worst[what] = max(self.worst.get(what, 0.0), error / scale) if math.isfinite(error) else math.inf

    def judge(self):
        for record in self.run.increments:
            rows = [row for row in self.run.rows if row["increment"] == record["increment"]]
            self.balance(record, rows)
            volumes = {}
            for row in rows:
                if not other_side(row["contact"]):
                    depth = self.node(row, record)
                    volumes[row["contact"]] = volumes.get(row["contact"], 0.0) + depth * row["area"]
            for name, volume in volumes.items():
                if f"{name}_worn" in record and self.depth:
                    self.note("worn volume", abs(record[f"{name}_worn"] - volume),
                              self.depth * sum(row["area"] for row in rows))
            for name, touch in self.known.contacts.items():
                if self.depth and touch.master:
                    self.fields[name] = sorted((row["x"], row["wear"]) for row in rows if row["contact"] == name + "_master")
            self.time = record["time"]
        return self.worst

    def balance(self, record, rows):
        """Forces and moments of each body: contacts, supports, loads."""
        sums = {}
        for row in rows:
            body = statics.owner(self.known, row["contact"])
            sums.setdefault(body, Sums()).add(acting_at(row), reaction(row, self.known.dim))
        for load in self.known.loads:
            if load.body in sums:
                sums[load.body].add(padded(load.point), load.factor(record["time"]) * padded(load.force))
        for name, body in self.known.supports.items():
            if body in sums:
                sums[body].total += [record[f"support_{name}_{kind}_{c}"] for kind in "fm" for c in "xyz"]
        for one in sums.values():
            self.note("statics", float(np.abs(one.total).max()), self.force * max(1.0, one.reach))
        for name, touch in self.known.contacts.items():
            own = [reaction(row, self.known.dim) for row in rows if row["contact"] == name]
            other = [reaction(row, self.known.dim) for row in rows if row["contact"] == name + "_master"]
            if touch.master and other:
                self.note("action is reaction", float(np.abs(np.sum(own + other, axis=0)).max()), self.force)

    def situation(self, row, node):
        at = dict(zip("xyz", statics.place(row)), t=row["time"], s=node.way, p=0.0, v=0.0)
        at["T"] = self.known.temperature(**at)
        at["p"] = max(row["r_n"], 0.0) / row["area"] if row["area"] > 0 else 0.0
        return at

    def node(self, row, record):
        """The depth that it has lost so far."""
        touch = self.known.contacts[row["contact"]]
        node = self.nodes.setdefault((row["contact"], row["node"]), Node())
        at = self.situation(row, node)
        friction, u = np.array([row["r_t1"], row["r_t2"]]), np.array([row["u_t1"], row["u_t2"]])
        slip = np.array([row["du_t1"], row["du_t2"]])
        self.note("slip is the way of the increment", np.linalg.norm(slip - (u - node.u)), self.length)
        if row["area"] > 0:
            slip = slip + touch.value("Shear compliance", at) / row["area"] * (friction - node.friction)
        at["v"] = np.linalg.norm(slip) / (row["time"] - self.time)
        node.sure = node.sure and record["substeps"] == 1  # of an increment that was cut the law holds in parts
        if node.sure:
            self.law(row, touch, at, friction, slip)
        self.wear(row, touch, node, at, np.linalg.norm(slip))
        node.u, node.friction = u, friction
        return node.worn

    def law(self, row, touch, at, friction, slip):
        F, L, r_n = self.force, self.length, row["r_n"]
        if not touch.value("Active", at, 1.0):
            self.note("force where nothing is active", abs(r_n) + np.linalg.norm(friction), F)
            return
        gap = row["gap"] + touch.value("Compliance", at) * at["p"]
        self.note("pulls", max(0.0, -r_n), F)
        self.note("penetrates", max(0.0, -gap), L)
        self.note("presses across a gap", abs(r_n * gap), F * L)
        most = max(0.0, touch.value("Shear limit", at, math.inf)) * row["area"]
        limit = min(max(0.0, touch.value("Friction coefficient", at)) * max(r_n, 0.0), most)
        if "Second friction coefficient" in touch.laws:
            friction, slip = self.round_limit(touch, at, friction, slip, limit, max(r_n, 0.0), most)
        size, way = np.linalg.norm(friction), np.linalg.norm(slip)
        self.note("friction above its limit", max(0.0, size - limit), F)
        if r_n > 0:
            self.note("friction is not against the slip", np.linalg.norm(friction * way + limit * slip), F * L)
        if row["state"] == "slip":
            self.note("slips below the limit", limit - size, F)
        if row["state"] == "stick":
            self.note("sticks and slips", way, L)
        if row["state"] == "open":
            self.note("open and presses", abs(r_n) + size, F)

    def round_limit(self, touch, at, friction, slip, limit, r_n, most):
        """Friction and slip as a circle sees them whose radius is the limit along the first axis."""
        second = min(max(0.0, touch.value("Second friction coefficient", at)) * r_n, most)
        angle = math.radians(touch.entries.get("Friction angle", 0.0))
        turn = np.array([[math.cos(angle), math.sin(angle)], [-math.sin(angle), math.cos(angle)]])
        stretch = np.array([1.0, limit / second if second > 0 else 1.0])
        return stretch * (turn @ friction), turn @ slip / stretch

    def wear(self, row, touch, node, at, slip):
        """Its depth, its way and its gap, which are those of geometry."""
        before = node.worn
        if "wear" in row:
            if node.sure:
                node.worn += touch.cycles * touch.value("Wear coefficient", at) * at["p"] * slip
            elif touch.share > 0:
                node.worn = row["wear"] / touch.share
            if self.depth:
                self.note("wear", abs(row["wear"] - touch.share * node.worn), self.depth)
        if row["state"] == "slip":
            node.way += slip
        opened = node.worn if touch.implicit else before
        if touch.master and touch.share < 1 and self.depth:
            # the rest is a depth of the master, linear along its faces; what means over faces see of it no table tells
            if self.known.dim == 3 or touch.entries.get("Pairing") != "node to face":
                return
            opened += (touch.share - 1) * before + float(np.interp(row["foot_x"], *zip(*(self.fields.get(row["contact"]) or [(0.0, 0.0)]))))
        self.note("gap is that of geometry", abs(row["gap"] - touch.gap(statics.place(row)) - row["u_n"] - opened), self.length)


def faults(run, known):
    return Judge(run, known).judge()
