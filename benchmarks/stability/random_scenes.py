# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random scenes of one to three blocks on each other, written in any place, axes, units and order."""
import random
from dataclasses import dataclass

from support.scenes import merge, simplices, text
from support.vectors import IDENTITY, apply, rotation

ELEMENTS = ("Q1", "Q1", "Q1 B-bar", "Q1 incompatible modes", "Q2")


@dataclass
class Frame:
    """Where a scene is written: mirrored along x, then turned about an axis through the origin, in other units."""
    dim: int
    axis: tuple = (0.0, 0.0, 1.0)
    degrees: float = 0.0
    mirrored: bool = False
    length: float = 1.0
    force: float = 1.0

    @property
    def matrix(self):
        m = rotation(self.axis, self.degrees) if self.degrees else IDENTITY
        return tuple((-row[0], *row[1:]) for row in m) if self.mirrored else m

    def vector(self, *v):
        return apply(self.matrix, (*v, *(0.0,) * (3 - len(v))))[:self.dim]

    def place(self, p):
        """A point in the axes and units of the first frame."""
        return tuple(sum(self.matrix[d][e] * p[d] for d in range(3)) / self.length for e in range(3))

    def ids(self, side):
        return {0: 1, 1: 0}.get(side, side) if self.mirrored else side

    def functions(self, components, factor):
        """Of time, along the axes of the first frame."""
        rows = [" + ".join(f"({factor * row[e]!r})*({f})" for e, f in enumerate(components) if f and row[e])
                for row in self.matrix[:self.dim]]
        return " ; ".join(row or "0" for row in rows)

    def box(self, cells, low, high):
        if self.mirrored:
            low, high = (-high[0], *low[1:]), (-low[0], *high[1:])
        mesh = {"Generator": "subdivided_hyper_rectangle",
                "Arguments": " : ".join(map(text, (cells, tuple(self.length * x for x in low),
                                                   tuple(self.length * x for x in high), "true")))}
        if self.degrees:
            mesh["Rotation"] = self.degrees if self.dim == 2 else (*self.axis, self.degrees)
        return mesh


def choose(rng, **weights):
    return rng.choices(list(weights), list(weights.values()))[0]


class Maker:
    """Draws of a number are the same in every frame."""

    def __init__(self, number, dim, frame):
        self.rng = random.Random(f"scene {number}")
        self.dim, self.frame = dim, frame
        self.size = 10 ** self.rng.uniform(-1, 1)
        self.n = self.rng.choice((1, 1, 2, 2, 3))
        self.young = [10 ** self.rng.uniform(2, 6) for _ in range(self.n)]
        self.pressure = min(self.young) * 10 ** self.rng.uniform(-5, -3)
        self.cut = self.rng.random() < .15
        self.words = [f"{dim}D", f"{self.n} bodies"] + ["simplices"] * self.cut
        self.scene = {"Dimension": dim}
        self.area = 2 * dim - 2, 2 * dim - 1  # ids below and above

    def say(self, word):
        self.words.append(word)

    def names(self):
        return [f"b{k}" for k in range(self.n)]

    def bodies(self):
        rng, low = self.rng, 0.0
        for k, name in enumerate(self.names()):
            half = self.size * rng.choice((1.0, 1.0, rng.uniform(.5, .9)))
            height = self.size * rng.uniform(.3, 1.2)
            cells = [rng.randint(1, 3) for _ in range(self.dim)]
            sides = (half,) * (self.dim - 1)
            body = {"Mesh": self.frame.box(cells, (*(-s for s in sides), low), (*sides, low + height)),
                    "Material": {"Young modulus": self.young[k] * self.frame.force / self.frame.length ** 2,
                                 "Poisson ratio": rng.choice((0.0, .3, .49)), "Expansion coefficient": 1e-5}}
            if self.dim == 2:
                body["Material"]["Thickness"] = self.frame.length
            element = rng.choice(ELEMENTS)
            if self.cut:
                body = simplices(body)
            else:
                body["Element"] = element
                self.say(element)
            self.scene[f"Body {name}"] = body
            if k == 0:
                self.half = half
            low += height
        self.top = low

    def friction(self, words):
        mu = self.rng.choice((0.0, .2, .6))
        self.say(f"{words} {mu}")
        return {"Friction coefficient": mu}

    def obstacle(self, name, normal, point, motion=None):
        self.scene[f"Obstacle {name}"] = {
            "Shape": "half space", "Normal": self.frame.vector(*normal),
            "Point": tuple(self.frame.length * x for x in self.frame.vector(*point))}

    def ground(self):
        up = (0.0,) * (self.dim - 1) + (1.0,)
        kind = choose(self.rng, contact=5, tie=2, bilateral=2, clamp=1)
        if kind == "clamp":
            self.say("clamp")
            self.scene["Support ground"] = {"Body": "b0", "Boundary ids": self.area[0],
                                            "Directions": self.directions(*range(self.dim))}
            return
        self.obstacle("floor", up, (0.0,) * self.dim)
        entry = {"Body": "b0", "Boundary ids": self.area[0], "Obstacle": "floor"}
        self.scene["Contact floor"] = {**entry, **(self.friction("floor") if kind == "contact" else {"Kind": kind})}
        if kind != "contact":
            self.say(f"{kind} floor")

    def directions(self, *axes):
        return ", ".join(f"({text(self.frame.vector(*IDENTITY[e][:self.dim]))})" for e in axes)

    def joints(self):
        for k in range(1, self.n):
            kind = choose(self.rng, contact=5, tie=3, bilateral=1)
            pairing = self.rng.choice(("mortar", "node to face"))
            sides = ((f"b{k}", self.area[0]), (f"b{k - 1}", self.area[1]))
            slave, master = sides if self.rng.random() < .7 else sides[::-1]
            self.say(f"{kind}, {pairing}")
            self.scene[f"Contact joint{k}"] = {
                "Body": slave[0], "Boundary ids": slave[1], "Master body": master[0], "Master boundary ids": master[1],
                "Pairing": pairing, **(self.friction("joint") if kind == "contact" else {"Kind": kind})}

    def sides(self):
        rng, e = self.rng, IDENTITY
        if rng.random() < .35:
            gap = rng.choice((0.0, 0.0, 1e-4 * self.size))
            self.obstacle("wall", tuple(-x for x in e[0][:self.dim]), (self.half + gap,) + (0.0,) * (self.dim - 1))
            self.say("wall" + " away" * (gap > 0))
            self.scene["Contact wall"] = {"Body": "b0", "Boundary ids": self.frame.ids(1), "Obstacle": "wall",
                                          **self.friction("wall")}
        if rng.random() < .3:
            body = rng.choice(self.names())
            self.say("guide")
            self.scene["Support guide"] = {"Body": body, "Boundary ids": self.frame.ids(0),
                                           "Directions": self.directions(0)}
        if self.dim == 3 and rng.random() < .2:
            self.say("plane of symmetry")
            for body in self.names():
                self.scene[f"Support front {body}"] = {"Body": body, "Boundary ids": 2,
                                                       "Directions": self.directions(1)}
        if rng.random() < .2:
            axes = rng.choice(((0,), (self.dim - 1,), tuple(range(self.dim))))
            stiffness = min(self.young) / self.size * 10 ** rng.uniform(-3, 0)
            self.say("springs")
            self.scene["Support springs"] = {
                "Body": rng.choice(self.names()), "Boundary ids": self.frame.ids(0), "Directions": self.directions(*axes),
                "Stiffness": stiffness * self.frame.force / self.frame.length ** 3}

    def load(self, name, kind, body, factor, components, side=None):
        units = self.frame.force / self.frame.length ** (3 if kind == "body force" else 2)
        entry = {"Body": body, "Kind": kind, "Value": self.frame.functions(components, factor * units)}
        if side is not None:
            entry["Boundary ids"] = self.frame.ids(side)
        self.scene[f"Load {name}"] = entry

    def loads(self):
        rng, last, p = self.rng, f"b{self.n - 1}", self.pressure
        across = [None] * (self.dim - 1)
        self.load("press", "traction", last, p, [*across, "-min(t, 1)"], self.area[1])
        share = rng.choice((0.0, .1, .3, .7))
        if share:
            self.say(f"push {share}")
            components = ["max(0, t - 1)", "0.5*max(0, t - 1)" if rng.random() < .5 else None][:self.dim - 1]
            self.load("push", "traction", last, share * p, [*components, None], self.area[1])
        if rng.random() < .3:
            self.say("weight")
            for k, name in enumerate(self.names()):
                self.load(f"weight {name}", "body force", name, p / self.size, [*across, "-0.3*min(t, 1)"])
        if rng.random() < .25:
            body = rng.choice(self.names())
            self.say("heat")
            self.scene["Load heat"] = {"Body": body, "Kind": "temperature",
                                       "Value": f"{rng.uniform(-1, 1) * p / max(self.young) * 1e5!r}*t"}
        if rng.random() < .25:
            body = rng.choice(self.names())
            self.say("squeeze")
            for side in (0, 1):
                self.scene[f"Load squeeze {side}"] = {
                    "Body": body, "Kind": "pressure", "Boundary ids": self.frame.ids(side),
                    "Value": f"{p * self.frame.force / self.frame.length ** 2!r}*max(0, t - 1)"}


def dimension_of(number):
    return 2 + number % 2


def make_scene(number, frame):
    """The scene, what is in it in words, and its size."""
    maker = Maker(number, dimension_of(number), frame)
    maker.bodies()
    maker.ground()
    maker.joints()
    maker.sides()
    maker.loads()
    scene = merge(maker.scene, {"Time": {"Stages": "1 : 2, 2 : 2"}, "Output": {"VTU": 0}})
    return scene, ", ".join(maker.words), maker.size
