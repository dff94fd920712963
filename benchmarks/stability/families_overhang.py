# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Blocks that reach beyond the rim of what they stand on, or what stands on them: a block on a box, stacks of two or
three, the wider one slave or master. A rim is anywhere in a cell of the wider one; the largest pressure is that of the
same scene on a mesh whose nodes end there."""
import math
import random

from support.scenes import ELEMENTS, box, load, support, text
from support.tables import read
from families_pressed import ROUNDING, turn_of, turned
from static_cases import StaticCase
from statics import Load, Statement, Touch

FACTOR = 1.5  # of largest pressures
AREAS = 1e-9  # sums of nodal areas, of the area that both sides share
HAIR = 1e-6  # of a width: what a box reaches beyond nodes at its rim
APART = 1.6  # cells at least between rims and to an end


class Axis:
    """Extents of all parts of a stack along an axis, the cells of each, and the rims in each."""

    def __init__(self, rng, wider, cells):
        self.rng, n = rng, len(wider) + 1
        self.from_one_side = rng.random() < .5
        self.cells, attempts = [rng.randint(*cells) for _ in range(n)], 0
        while not self.draw(wider):
            attempts += 1
            self.cells = [c + (attempts % 20 == 0) for c in self.cells]

    def draw(self, wider):
        """Whether rims are far enough from each other; `wider`: whether each part is wider than the one below."""
        rng, sides = self.rng, [(0.0, 1.0)]
        for grows in wider:
            low, high = sides[-1]
            reach = (high - low) * rng.uniform(.1, .4), (high - low) * rng.uniform(.1, .4)
            sign = 1 if grows else -1
            sides.append((low if self.from_one_side else low - sign * reach[0], high + sign * reach[1]))
        self.sides, self.rims = sides, [set() for _ in sides]
        for k, grows in enumerate(wider):
            wide, narrow = (k + 1, k) if grows else (k, k + 1)
            self.rims[wide] |= set(sides[narrow]) - set(sides[wide])
        return all(self.are_apart(k) for k in range(len(sides)))

    def are_apart(self, k):
        low, high = self.sides[k]
        places = sorted((low, *self.rims[k], high))
        return all(b - a >= APART * (high - low) / self.cells[k] for a, b in zip(places, places[1:]))

    def steps(self, k, fitted):
        """Widths of the cells of a part; fitted: the node next to each rim, and those between, are moved to it."""
        low, high = self.sides[k]
        n = self.cells[k]
        if not fitted:
            return [(high - low) / n] * n
        ends = [(low, 0), *((rim, round((rim - low) / (high - low) * n)) for rim in sorted(self.rims[k])), (high, n)]
        return [(b - a) / (j - i) for (a, i), (b, j) in zip(ends, ends[1:]) for _ in range(j - i)]

    def shared(self, k):
        """Length that a part has in common with the next."""
        (a, b), (c, d) = self.sides[k:k + 2]
        return min(b, d) - max(a, c)


class Overhang:
    """A stack in numbers; of one body: on an obstacle."""

    def __init__(self, rng, dim, bodies):
        self.rng, self.dim, self.bodies = rng, dim, bodies
        self.turn, self.unit, self.young = turn_of(rng, dim), 10 ** rng.uniform(-1, 2), 10 ** rng.uniform(0, 8)
        wider = [True] if bodies == 1 else [rng.random() < .5 for _ in range(bodies - 1)]
        self.axes = [Axis(rng, wider, (8, 24) if dim == 2 else (5, 9))]
        if dim == 3:
            self.axes.append(Axis(rng, wider, (4, 7)) if rng.random() < .5 else None)
        self.across = rng.uniform(.3, .8), rng.randint(1, 2)
        self.heights = [rng.uniform(.4, 1) for _ in range(max(bodies, 2))]
        self.layers = [rng.randint(3, 8) if dim == 2 else rng.randint(1, 3) for _ in self.heights]
        self.youngs = [self.young * 10 ** rng.uniform(-1, 1) for _ in self.heights]
        self.poissons = [round(rng.uniform(0, .45), 3) for _ in self.heights]
        self.elements = [rng.choice((*ELEMENTS, "Q2")) for _ in self.heights]
        self.mu = rng.choice((0.0, rng.uniform(.1, .6)))
        self.slaves = [rng.choice((0, 1)) for _ in range(bodies - 1)]  # the lower, the upper

    def sides(self, k):
        """Low and high along the axes of the floor."""
        return [axis.sides[k] if axis else (0.0, self.across[0]) for axis in self.axes]

    def area(self, pairs):
        return math.prod(self.unit * (high - low) for low, high in pairs)

    def shared(self, k):
        """Area of a joint."""
        return math.prod(self.unit * (axis.shared(k) if axis else self.across[0]) for axis in self.axes)

    def block(self, k, low, fitted):
        """A part on the height `low`."""
        (axis, angle, _), unit, corners = self.turn, self.unit, self.sides(k)
        steps = [axis_.steps(k, fitted) if axis_ else [self.across[0] / self.across[1]] * self.across[1]
                 for axis_ in self.axes]
        steps.append([self.heights[k] / self.layers[k]] * self.layers[k])
        size = [unit * (b - a) for a, b in corners] + [unit * self.heights[k]]
        origin = [unit * a for a, _ in corners] + [unit * low]
        body = box((1,) * self.dim, tuple(size), tuple(origin), self.youngs[k], self.poissons[k],
                   Rotation=angle if self.dim == 2 else (*axis, angle))
        mesh = body["Mesh"]
        cells = " ; ".join(", ".join(repr(unit * step) for step in steps_) for steps_ in steps)
        mesh["Arguments"] = " : ".join((cells, *mesh["Arguments"].split(" : ")[1:]))
        return {"Element": self.elements[k], **body}

    def vector(self, normal):
        return turned(self.turn, self.dim, ((*(0.0,) * (self.dim - 1), normal)))

    def obstacle(self, fitted):
        """The lowest part of a stack of one body. It reaches beyond a guide of the block, whose nodes would else have
        the normals of its edge, as would those of fitted meshes."""
        more = HAIR if fitted else 0.0
        sides = [(-.5 if low == 0 else low - more, high + more) for low, high in self.sides(0)]
        center = [self.unit * (a + b) / 2 for a, b in sides] + [-self.unit * self.heights[0] / 2]
        size = [self.unit * (b - a) for a, b in sides] + [self.unit * self.heights[0]]
        axis, angle, _ = self.turn
        return {"Shape": "box", "Center": turned(self.turn, self.dim, center), "Sizes": tuple(size),
                "Rotation": angle if self.dim == 2 else (*axis, angle)}

    def scene(self, fitted):
        dim, low, first = self.dim, 0.0, int(self.bodies == 1)
        bottom, top, parts = 2 * dim - 2, 2 * dim - 1, range(first, len(self.heights))
        scene = {"Dimension": dim, "Output": {"VTU": 0}}
        for k in parts:
            scene[f"Body b{k}"] = self.block(k, low, fitted)
            low += self.heights[k]
            if k > 0:
                scene[f"Support guide {k}"] = support("0" if dim == 2 else "0, 2", "normal", body=f"b{k}",
                                                        Stiffness=10 * self.youngs[k] / self.unit)  # leaves friction be
                scene[f"Contact c{k}"] = self.joint(k, bottom, top)
        if first == 0:
            scene["Support floor"] = support(bottom, ", ".join("xyz"[:dim]), body="b0")
        else:
            scene["Obstacle floor"] = self.obstacle(fitted)
        scene["Load press"] = load("pressure", f"{self.pressure!r}*t", top, f"b{parts[-1]}")
        return scene

    def joint(self, k, bottom, top):
        if self.bodies == 1:
            return {"Body": f"b{k}", "Boundary ids": bottom, "Obstacle": "floor", "Friction coefficient": self.mu}
        sides = ((f"b{k - 1}", top), (f"b{k}", bottom))
        slave, master = sides if self.slaves[k - 1] == 0 else sides[::-1]
        return {"Body": slave[0], "Boundary ids": slave[1], "Master body": master[0],
                "Master boundary ids": master[1], "Friction coefficient": self.mu}

    def words(self):
        wide = " on ".join(text(axis.cells) for axis in self.axes if axis)
        return f"{self.dim}D, {self.bodies} bodies, cells {wide}, mu {self.mu:.2g}, {', '.join(self.elements)}"


def nodes_of(folder):
    """Of each contact at the end: reaction, area and place of its nodes."""
    rows, found = read(folder / "reactions.csv"), {}
    end = max(row["increment"] for row in rows)
    for row in rows:
        if row["increment"] == end and not row["contact"].endswith("_master") and row["area"] > 0:
            found.setdefault(row["contact"], []).append((row["r_n"], row["area"], [row[c] for c in "xyz"]))
    return found


def largest_of(nodes):
    """Pressure, area and place of the node with the largest pressure."""
    return max((force / area, area, place) for force, area, place in nodes)


def mean_about(nodes, place, least):
    """Pressure on the nodes next to a place that have this area at least."""
    force, area = 0.0, 0.0
    for f, a, _ in sorted(nodes, key=lambda node: math.dist(node[2], place)):
        if area >= least * (1 - AREAS):
            break
        force, area = force + f, area + a
    return force / area


def pressure_faults(areas):
    """Largest pressures against those of the scene that is run beside. Nodes at a rim that is in a cell have what is
    left of the cell, too: a pressure that rises towards the rim is a mean over more there, so the lower bound takes
    the mean over as much."""
    def look(folder):
        beside, faults = nodes_of(folder.parent / "beside" / "result"), []
        for name, nodes in nodes_of(folder).items():
            pressure, own_area, _ = largest_of(nodes)
            expected, _, place = largest_of(beside[name])
            least = mean_about(beside[name], place, own_area)
            if not least / FACTOR <= pressure <= FACTOR * expected:
                faults.append(f"{name}: largest pressure {pressure:.6g} instead of {expected:.6g}, "
                              f"{least:.6g} over its area")
            area = sum(node[1] for node in nodes)
            if name in areas and abs(area / areas[name] - 1) > AREAS:
                faults.append(f"{name}: areas sum to {area:.10g} instead of {areas[name]:.10g}")
        return faults
    return look


def overhang(number):
    rng = random.Random(f"overhang {number}")
    dim, bodies = 3 if number % 4 == 3 else 2, rng.choice((1, 2, 2, 3))
    stack = Overhang(rng, dim, bodies)
    strain = 10 ** rng.uniform(-6, -3)
    stack.pressure = strain * min(stack.youngs)
    last, height = len(stack.heights) - 1, stack.unit * sum(stack.heights)
    force = stack.pressure * stack.area(stack.sides(last))
    touches = {}
    for k in range(1, last + 1):
        slave, master = (f"b{k - 1}", f"b{k}") if bodies > 1 and stack.slaves[k - 1] == 0 else (f"b{k}", f"b{k - 1}")
        touches[f"c{k}"] = Touch(slave, stack.mu, None if bodies == 1 else master)
    statement = Statement(dim, [], touches, {}, length=1e-8 * strain * 100 * height + ROUNDING * 3 * stack.unit,
                          motion=1e4 * strain * height)
    for k in range(1, last + 1):
        up = 1.0 if touches[f"c{k}"].body == f"b{k}" else -1.0
        statement.pressed[f"c{k}"] = stack.vector(up), force
    areas = {f"c{k}": stack.shared(k - 1) for k in range(1, last + 1)} if bodies > 1 else {}
    return StaticCase(stack.words(), stack.scene(False), statement, more=[pressure_faults(areas)],
                      beside=stack.scene(True))
