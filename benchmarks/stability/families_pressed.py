# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Free blocks on a floor, one or two, pressed and pushed in many increments: with little friction all nodes slip, and
where a block is then no force tells. All are solvable."""
import math
import random

from support.scenes import ELEMENTS, box, contact, floor, load, simplices
from support.vectors import apply, rotation
from static_cases import StaticCase
from statics import ALL, Load, Statement, Touch

ROUNDING = 1e-11  # of lengths: what counts as closed
PLANE, SPACE = (1, 2, 3, 5, 5, 8, 12, 30, 100), (1, 2, 5, 6, 8, 15)  # increments


def turn_of(rng, dim):
    """Degrees, axis in space; a third of the scenes stands upright."""
    angle = rng.choice((0.0, rng.uniform(-180, 180), rng.uniform(-180, 180)))
    axis = (0.0, 0.0, 1.0) if dim == 2 else tuple(rng.uniform(-1, 1) for _ in range(3))
    return axis, angle, rotation(axis, angle)


def block_of(rng, dim, size, low, young, turn):
    """A block of random cells on the height `low`, over the origin."""
    axis, angle, _ = turn
    cells = tuple(rng.randint(1, 7 if dim == 2 else 3) for _ in range(dim))
    origin = (*(-s / 2 for s in size[:-1]), low)
    body = box(cells, size, origin, young, round(rng.uniform(0, .45), 3),
               Rotation=angle if dim == 2 else (*axis, angle))
    element = rng.choice((*ELEMENTS, "P1"))
    return {"Element": element, **(simplices(body) if element == "P1" else body)}


def turned(turn, dim, vector):
    return tuple(apply(turn[2], (*vector, 0.0, 0.0)[:3])[:dim])


def expressions(vector, factor):
    return " ; ".join(f"{v!r}*({factor})" for v in vector)


class Stack:
    """One or two blocks on a floor, in numbers."""

    def __init__(self, rng, dim):
        self.rng, self.dim, self.turn = rng, dim, turn_of(rng, dim)
        self.unit, self.young = 10 ** rng.uniform(-1, 2), 10 ** rng.uniform(0, 8)
        self.two = rng.random() < .4
        self.sizes = [[self.unit * rng.uniform(1, 2) for _ in range(dim - 1)] + [self.unit * rng.uniform(.3, 1.2)]]
        if self.two:  # on the other, and smaller
            self.sizes.append([rng.choice((1.0, rng.uniform(.5, .9))) * s for s in self.sizes[0]])
        self.mus = [10 ** rng.uniform(-2, math.log10(3)) for _ in self.sizes]

    def entries(self):
        """Bodies and contacts, and what touches."""
        rng, dim, low = self.rng, self.dim, 0.0
        scene = {"Dimension": dim, "Obstacle floor": floor(dim, Normal=self.vector(1.0))}
        for i, size in enumerate(self.sizes):
            scene[f"Body b{i}"] = block_of(rng, dim, tuple(size), low, self.young * 10 ** rng.uniform(-1, 1), self.turn)
            low += size[-1]
        scene["Contact c0"] = contact("b0", 2 * dim - 2, mu=self.mus[0])
        touches = {"c0": Touch("b0", self.mus[0])}
        if self.two:
            upper, lower = ("b1", 2 * dim - 2), ("b0", 2 * dim - 1)
            pairing, upper_is_slave = rng.choice(("mortar", "node to face")), rng.random() < .5
            if pairing == "node to face" and self.sizes[1][0] < self.sizes[0][0]:
                upper_is_slave = True  # else it might stand on one node
            (body, ids), (master, master_ids) = (upper, lower) if upper_is_slave else (lower, upper)
            scene["Contact c1"] = {"Body": body, "Boundary ids": ids, "Master body": master,
                                   "Master boundary ids": master_ids, "Friction coefficient": self.mus[1],
                                   "Pairing": pairing}
            touches["c1"] = Touch(body, self.mus[1], master)
        return scene, touches

    def vector(self, normal, *tangential):
        """In the axes of the turned scene."""
        return turned(self.turn, self.dim, (*(*tangential, 0.0, 0.0)[:self.dim - 1], normal))

    @property
    def top(self):
        return f"b{len(self.sizes) - 1}"

    @property
    def height(self):
        return sum(size[-1] for size in self.sizes)

    @property
    def area(self):
        return math.prod(self.sizes[-1][:-1])

    def limit(self, direction):
        """Largest push on the top over the normal force: sliding or tipping at the floor or the joint."""
        low, ways = 0.0, []
        for size, mu in zip(self.sizes, self.mus):
            reach = min(.5 * min(size[k], self.sizes[-1][k]) / abs(d) for k, d in enumerate(direction) if abs(d) > 1e-9)
            ways += [mu, .5 * reach / (self.height - low)]
            low += size[-1]
        return min(ways)


def direction_of(rng, dim):
    angle = rng.uniform(0, 2 * math.pi)
    return (rng.choice((-1.0, 1.0)),) if dim == 2 else (math.cos(angle), math.sin(angle))


def loads_of(stack, pressure, push, factors):
    """The top is pressed and pushed: entries, and their resultants."""
    down, side = stack.vector(-pressure), stack.vector(0.0, *(pressure * p for p in push))
    point, ids = stack.vector(stack.height), 2 * stack.dim - 1
    entries, loads = {}, []
    for name, vector, (words, factor) in (("press", down, factors[0]), ("push", side, factors[1])):
        if any(vector):
            entries[f"Load {name}"] = load("traction", expressions(vector, words), ids, stack.top)
            loads.append(Load(stack.top, point, tuple(stack.area * v for v in vector), factor))
    return entries, loads


TOGETHER = (("t", lambda t: t), ("t", lambda t: t))
AFTER = (("min(t, 1)", lambda t: min(t, 1)), ("max(t - 1, 0)", lambda t: max(t - 1, 0)))


def pressed_and_pushed(number):
    rng = random.Random(f"pressed-and-pushed {number}")
    dim = 3 if number % 4 == 3 else 2
    stack = Stack(rng, dim)
    scene, touches = stack.entries()
    strain = 10 ** rng.uniform(-6, -2.5)
    direction, part = direction_of(rng, dim), rng.choice((0.0, rng.uniform(.05, .9)))
    push = [part * stack.limit(direction) * d for d in direction]
    together, n = part == 0 or rng.random() < .5, rng.choice(PLANE if dim == 2 else SPACE)
    entries, loads = loads_of(stack, strain * stack.young, push, TOGETHER if together else AFTER)
    end = 1 if together else 2
    scene.update({**entries, "Time": {"End": end, "Increments": n * end}, "Output": {"VTU": 0}})
    soft, size = 100 * strain, 2 * stack.height + max(stack.sizes[0])  # the softest is ten times softer
    statement = Statement(dim, loads, touches, {f"b{i}": ALL[dim] for i in range(len(stack.sizes))},
                          length=1e-8 * soft * size + ROUNDING * size, motion=1e4 * soft * size)
    force = strain * stack.young * stack.area
    statement.pressed = {"c0": (stack.vector(1.0), force)}
    name = f"{dim}D, {len(stack.sizes)} bodies, mu {', '.join(f'{mu:.2g}' for mu in stack.mus)}, {n} increments, " \
           f"{part:.2g} of the limit {'together' if together else 'after'}"
    return StaticCase(name, scene, statement)
