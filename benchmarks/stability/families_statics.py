# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Blocks on mats and joints whose limits follow from statics: the least of sliding and tipping.

Each function makes the case of a number, the same one whenever it is asked.
"""
import math
import random

from support.scenes import ELEMENTS, box, contact, floor, load, support
from support.tables import read
from static_cases import NO_EQUILIBRIUM, StaticCase
from statics import ALL, Load, Statement, Touch

ROUNDING = 1e-11  # of lengths: what counts as closed


def cells_text(cells):
    return "x".join(map(str, cells))


class Mats:
    """A block on a clamped mat, in numbers: grids of both surfaces and where they are."""

    def __init__(self, rng, dim, overhang):
        """`overhang`: by how much the mat reaches beyond the block on each side, in cells or in widths."""
        self.rng, self.dim = rng, dim
        self.unit = 10 ** rng.uniform(-1, 2)
        self.matching = rng.random() < .4 and overhang is None
        self.slave_is_block = rng.random() < .5
        self.attempts = 0
        self.draw(overhang)
        while not self.clear():
            self.draw(overhang)

    def draw(self, overhang):
        """Sizes and numbers of cells; more of these where few do not do."""
        rng, dim, more = self.rng, self.dim, self.attempts // 20
        self.attempts += 1
        most = (7 if dim == 2 else 4) + min(more, 4)
        self.cells = [rng.randint(2, most) for _ in range(dim - 1)] + [rng.randint(2, 4)]
        cell = [self.unit * rng.uniform(.5, 1.5) / n for n in self.cells]
        self.width = [n * c for n, c in zip(self.cells[:-1], cell)]
        self.height = self.unit * rng.uniform(.2, 1.2)
        self.depth = self.unit * rng.uniform(.2, .8)
        self.draw_mat(overhang, cell)

    def draw_mat(self, overhang, cell):
        rng, extra = self.rng, []
        if self.matching:
            extra = [[rng.randint(1, 2) * c for _ in range(2)] for c in cell[:-1]]
            self.mat_cells = [round(n + sum(e) / c) for n, e, c in zip(self.cells, extra, cell)]
        else:
            low, high = overhang or (.05, .5)
            extra = [[rng.uniform(low, high) * w for _ in range(2)] for w in self.width]
            self.mat_cells = [rng.randint(n + 1, 2 * n + 4) if self.dim == 2 else rng.randint(n + 1, n + 4)
                              for n in self.cells[:-1]]
        self.low = [-e[0] for e in extra]
        self.high = [w + e[1] for w, e in zip(self.width, extra)]
        self.mat_cells = self.mat_cells[:self.dim - 1] + [rng.randint(1, 3)]

    def grid(self, of_block, axis):
        low, high = (0.0, self.width[axis]) if of_block else (self.low[axis], self.high[axis])
        n = (self.cells if of_block else self.mat_cells)[axis]
        return [low + (high - low) * i / n for i in range(n + 1)]

    def feet(self, axis):
        """Slave nodes that have the other body's surface before them."""
        low, high = (self.low[axis], self.high[axis]) if self.slave_is_block else (0.0, self.width[axis])
        eps = 1e-9 * self.unit
        return [x for x in self.grid(self.slave_is_block, axis) if low - eps <= x <= high + eps]

    def clear(self):
        """No node is beside a rim by little; three feet at least; the middle of the block is well between them."""
        for axis in range(self.dim - 1):
            rims = (self.low[axis], self.high[axis]) if self.slave_is_block else (0.0, self.width[axis])
            cell = min(self.width[axis] / self.cells[axis],
                       (self.high[axis] - self.low[axis]) / self.mat_cells[axis])
            apart = [abs(x - rim) for x in self.grid(self.slave_is_block, axis) for rim in rims]
            if any(1e-9 * self.unit < d < .2 * cell for d in apart):
                return False
            feet, middle = self.feet(axis), self.width[axis] / 2
            if len(feet) < 3 or not feet[0] + .15 * self.width[axis] < middle < feet[-1] - .15 * self.width[axis]:
                return False
        return True

    def reach(self, direction):
        """How far the resultant may move from the middle along a direction within the hull of the feet."""
        ways = []
        for axis, part in enumerate(direction):
            feet, middle = self.feet(axis), self.width[axis] / 2
            if abs(part) > 1e-12:
                ways.append(((feet[-1] - middle) if part > 0 else (middle - feet[0])) / abs(part))
        return min(ways)

    def area(self):
        return math.prod(self.width)

    def middle(self, height):
        return (*(w / 2 for w in self.width), height)

    def bodies(self, block_young, mat_young):
        block = box(tuple(self.cells), (*self.width, self.height), (0.0,) * self.dim, block_young, self.poisson())
        size = [high - low for low, high in zip(self.low, self.high)]
        mat = box(tuple(self.mat_cells), (*size, self.depth), (*self.low, -self.depth), mat_young, self.poisson())
        return ({"Element": self.rng.choice(ELEMENTS), **block}, {"Element": self.rng.choice(ELEMENTS), **mat})

    def poisson(self):
        return round(self.rng.uniform(0, .45), 3)

    def joint(self, mu):
        top, bottom = 2 * self.dim - 1, 2 * self.dim - 2
        sides = [("block", bottom), ("mat", top)]
        (body, ids), (master, master_ids) = sides if self.slave_is_block else sides[::-1]
        return {"Body": body, "Boundary ids": ids, "Master body": master, "Master boundary ids": master_ids,
                "Friction coefficient": mu, "Pairing": "node to face"}, Touch(body, mu, master)


def direction_of(rng, dim, along_x):
    if dim == 2 or along_x:
        return (rng.choice((-1.0, 1.0)), 0.0)[:dim - 1]
    angle = rng.uniform(0, 2 * math.pi)
    return math.cos(angle), math.sin(angle)


def push_of(mats, kind, direction, force, factor):
    """Entries of a horizontal load of a resultant, and its height."""
    dim, parts = mats.dim, [*(force * d for d in direction), 0.0]
    def value(area):
        return " ; ".join(f"{p / area!r}*{factor}" for p in parts)
    if kind == "top":
        return load("traction", value(mats.area()), 2 * dim - 1), mats.height
    if kind == "side":
        side = mats.area() / mats.width[0] * mats.height
        return load("traction", value(side), 0 if direction[0] > 0 else 1), mats.height / 2
    return load("body force", value(mats.area() * mats.height)), mats.height / 2


def pressed_block(mats, young, mu, pressure, part, kind, together, increments):
    """Scene and statement of a block that is pressed on the mat and pushed by a part of its limit."""
    dim, rng = mats.dim, mats.rng
    direction = direction_of(rng, dim, kind == "side")
    normal = pressure * mats.area()
    lever = mats.height if kind == "top" else mats.height / 2
    slide, tip = mu * normal, normal * mats.reach(direction) / lever
    force = part * min(slide, tip)
    first, second = ("t", "t") if together else ("min(t, 1)", "max(t - 1, 0)")
    times = [(i + 1) / increments for i in range(increments)]
    push, height = push_of(mats, kind, direction, force, second)
    joint, touch = mats.joint(mu)
    block, mat = mats.bodies(*young)
    scene = {"Dimension": dim, "Body block": block, "Body mat": mat, "Contact joint": joint,
             "Support ground": support(2 * dim - 2, ", ".join("xyz"[:dim]), body="mat"),
             "Load press": load("pressure", f"{pressure!r}*{first}", 2 * dim - 1), "Load push": push,
             "Time": {"Times": times if together else [1.0] + [1 + t for t in times]}, "Output": {"VTU": 0}}
    ramps = (lambda t: t, lambda t: t) if together else (lambda t: min(t, 1), lambda t: max(t - 1, 0))
    loads = [Load("block", mats.middle(mats.height), (*(0.0,) * (dim - 1), -normal), ramps[0]),
             Load("block", mats.middle(height), (*(force * d for d in direction), 0.0), ramps[1])]
    soft = pressure / min(young)
    size = max(*mats.width, mats.height, mats.depth)
    statement = Statement(dim, loads, {"joint": touch}, {"block": ALL[dim]},
                          length=1e-8 * soft * size + ROUNDING * size, motion=1e4 * soft * size)
    return scene, statement, slide < tip


def stiff_on_soft(number):
    rng = random.Random(f"stiff-on-soft {number}")
    dim = 3 if 1000 <= number < 1200 else 2 if number < 1000 else rng.choice((2, 2, 3))
    tolerance = 1e-10 if number < 1200 else float(f"{10 ** rng.uniform(-12, -6):.3g}")
    mats = Mats(rng, dim, None)
    soft, ratio, mu = 10 ** rng.uniform(0, 2), 10 ** rng.uniform(0, 8), 10 ** rng.uniform(-1, math.log10(2))
    part = rng.uniform(1.03, 1.4) if rng.random() < .35 else rng.uniform(.05, .93)
    kind, together = rng.choice(("top", "side", "body")), rng.random() < .5
    scene, statement, slides = pressed_block(mats, (soft * ratio, soft), mu, soft * 10 ** rng.uniform(-5, -3), part,
                                             kind, together, rng.choice((1, 2, 3)))
    if number >= 1200:
        scene["Solver"], statement.tolerance = {"Tolerance": tolerance}, tolerance
    name = f"{dim}D, E ratio {ratio:.2g}, mu {mu:.2g}, {part:.3g} of {'sliding' if slides else 'tipping'}, " \
           f"slave {'block' if mats.slave_is_block else 'mat'}, {'' if mats.matching else 'not '}matching" + \
           (f", tolerance {tolerance:g}" if number >= 1200 else "")
    return StaticCase(name, scene, statement, NO_EQUILIBRIUM if part > 1 else None)


def joints(number):
    """Even numbers by increments, odd ones by load path; the limit is sliding."""
    rng = random.Random(f"joints {number}")
    dim = 2 if number % 4 < 2 else 3
    wider = rng.random() < .5
    mats = Mats(rng, dim, (.1, .5) if wider else (-.3, -.08))
    mu, mats.height = rng.uniform(.1, .6), .3 * min(mats.width)
    part = rng.choice((.9, 1.1))
    young = (10 ** rng.uniform(2, 4), 10 ** rng.uniform(2, 4))
    scene, statement, slides = pressed_block(mats, young, mu, 1e-4 * min(young), part, "body", False, 2)
    name = f"{dim}D, base {'wider' if wider else 'narrower'}, slave {'block' if mats.slave_is_block else 'base'}, " \
           f"{part} of {'sliding' if slides else 'tipping'}, by {'load path' if number % 2 else 'increments'}"
    if number % 2 == 0:
        return StaticCase(name, scene, statement, NO_EQUILIBRIUM if part > 1 else None)
    scene["Load press"]["Value"] = scene["Load press"]["Value"].replace("*min(t, 1)", "")
    scene["Load push"]["Value"] = scene["Load push"]["Value"].replace("max(t - 1, 0)", "t")
    statement.loads[0].factor, statement.loads[1].factor = lambda t: 1.0, lambda t: t
    scene["Time"], scene["Solver"] = {"Times": 1}, {"Method": "load path"}
    return StaticCase(name, scene, statement, limit=1 / part if part > 1 else None, target=part < 1)


def balanced(number):
    """A block, or two, on a frictionless floor: horizontal loads balance, or do not by little."""
    rng = random.Random(f"balanced-frictionless {number}")
    dim, unit = rng.choice((2, 3)), 10 ** rng.uniform(-1, 2)
    size = [unit * rng.uniform(.5, 1.5) for _ in range(dim)]
    cells = tuple(rng.randint(2, 6 if dim == 2 else 4) for _ in range(dim))
    young = 10 ** rng.uniform(0, 6)
    pressure, area = young * 10 ** rng.uniform(-7, -3), math.prod(size[:-1])
    gap = rng.choice((0.0, 0.0, unit * 10 ** rng.uniform(-6, 1)))
    unbalanced = rng.choice((0, 0, 0, 1e-3, .1))
    side = pressure * rng.uniform(.1, 1) * min(1, size[0] / size[-1])  # the moment of the difference tips nothing
    faces = math.prod(size[1:])
    top, middle = 2 * dim - 1, tuple(s / 2 for s in size[:-1])
    scene = {"Dimension": dim, "Body block": {"Element": rng.choice(ELEMENTS),
                                              **box(cells, tuple(size), None, young, rng.choice((0, .3, .45)))},
             "Obstacle floor": floor(dim, Point=(*(0.0,) * (dim - 1), -gap)),
             "Contact bottom": contact(ids=2 * dim - 2), "Load press": load("pressure", f"{pressure!r}*t", top),
             "Load left": load("pressure", f"{side * (1 + unbalanced)!r}*t", 0),
             "Load right": load("pressure", f"{side!r}*t", 1), "Time": {"End": 1, "Increments": rng.choice((1, 3))},
             "Output": {"VTU": 0}}
    loads = [Load("block", (*middle, size[-1]), (*(0.0,) * (dim - 1), -pressure * area), lambda t: t),
             Load("block", (0.0, *(s / 2 for s in size[1:])), (side * (1 + unbalanced) * faces, 0.0), lambda t: t),
             Load("block", (size[0], *(s / 2 for s in size[1:])), (-side * faces, 0.0), lambda t: t)]
    statement = Statement(dim, loads, {"bottom": Touch("block", 0.0)}, {"block": ALL[dim]},
                          length=1e-8 * pressure / young * unit + ROUNDING * (unit + gap),
                          motion=1e4 * pressure / young * unit + 3 * gap)
    statement.pressed = {"bottom": ((*(0.0,) * (dim - 1), 1.0), pressure * area)}
    case = StaticCase(f"{dim}D, gap {gap:.2g}, side loads differ by {unbalanced}", scene, statement,
                      NO_EQUILIBRIUM if unbalanced else None)
    case.more = [not_determinate]
    return case


def not_determinate(folder):
    """Where the table tells it: the position of such a block is not determined."""
    return [f"increment {row['increment']:g}: determinate = {row['determinate']}"
            for row in read(folder / "increments.csv") if row.get("determinate", "no") != "no"]
