# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steel under its own weight: strains of 1e-8, falls of up to a metre. Units: N, mm."""
import math
import random

from support.scenes import ELEMENTS, box, contact, load, support
from static_cases import NO_EQUILIBRIUM, StaticCase
from statics import ALL, Load, Statement, Touch

YOUNG, WEIGHT = 2e5, 7.7e-5
KINDS = ("floor", "incline", "disc", "ring", "groove", "walls", "lowered")


def drop(rng, size):
    """0 to 1 m."""
    return rng.choice((0.0, size * 10 ** rng.uniform(-6, -1), 10 ** rng.uniform(-3, 3)))


def statement_of(dim, contacts, volume, middle, size, gap, free=None):
    """The weight acts at the middle; lengths are right to rounding of what has moved."""
    force = (*(0.0,) * (dim - 1), -WEIGHT * volume)
    return Statement(dim, [Load("block", middle, force)], contacts, {"block": ALL[dim]} if free is None else free,
                     length=1e-13 * (size + gap) + 1e-8 * WEIGHT * size * size / YOUNG, motion=4 * (size + gap))


def weight(dim):
    return load("body force", " ; ".join(["0"] * (dim - 1) + [repr(-WEIGHT)]))


def steel_block(rng, dim, low=.5, high=1.5):
    unit = 10 ** rng.uniform(0, 2)
    size = tuple(min(100.0, unit * rng.uniform(low, high)) for _ in range(dim))
    cells = tuple(rng.randint(2, 8 if dim == 2 else 4) for _ in range(dim))
    return size, {"Element": rng.choice(ELEMENTS), **box(cells, size, None, YOUNG, .3)}, cells


def plane(normal, gap):
    """A half space whose surface is `gap` before the origin along its normal."""
    return {"Shape": "half space", "Normal": normal, "Point": tuple(-gap * n for n in normal)}


def on_floor(rng):
    return on_plane(rng, 0.0)


def incline(rng):
    return on_plane(rng, rng.uniform(.02, .8))


def on_plane(rng, angle):
    """A block on a plane that falls along x: it holds below the friction angle, unless it tips."""
    dim = rng.choice((2, 3))
    size, body, cells = steel_block(rng, dim)
    gap = drop(rng, max(size))
    tip = size[0] / size[-1]
    if math.tan(angle) > .9 * tip:
        angle = math.atan(.9 * tip) * rng.uniform(.1, .95)
    slides = angle > 0 and rng.random() < .4
    mu = math.tan(angle) * (rng.uniform(.5, .97) if slides else rng.uniform(1.03, 2)) + .1 * (angle == 0)
    down, up = WEIGHT * math.sin(angle), -WEIGHT * math.cos(angle)
    normal = (0.0,) * (dim - 1) + (1.0,)
    scene = {"Dimension": dim, "Body block": body, "Obstacle floor": plane(normal, gap),
             "Contact bottom": contact(ids=2 * dim - 2, mu=mu),
             "Load weight": load("body force", " ; ".join([repr(down), *["0"] * (dim - 2), repr(up)])),
             "Output": {"VTU": 0}}
    statement = statement_of(dim, {"bottom": Touch("block", mu)}, math.prod(size), tuple(s / 2 for s in size),
                             max(size), gap)
    volume = math.prod(size)
    statement.loads[0].force = (down * volume, *(0.0,) * (dim - 2), up * volume)
    if not slides:
        statement.pressed = {"bottom": (normal, -up * volume)}
    name = f"{dim}D block of {max(size):.3g} mm, plane of {math.degrees(angle):.3g} degrees, mu {mu:.3g}, gap {gap:.3g}"
    return StaticCase(name, scene, statement, NO_EQUILIBRIUM if slides else None)


def polygon(radius, corners):
    return corners / 2 * radius**2 * math.sin(2 * math.pi / corners)


def round_body(rng, ring, radius, turn):
    """Mesh, number of corners and area of a disc or a ring about the origin."""
    if ring:
        n, levels = rng.choice((16, 24, 32)), rng.choice((1, 2))
        inner = radius * rng.uniform(.6, .9)
        mesh = {"Generator": "hyper_shell", "Arguments": f"0, 0 : {inner!r} : {radius!r} : {n} : true"}
        corners, area = n * 2**levels, polygon(radius, n * 2**levels) - polygon(inner, n * 2**levels)
        ids = 1
    else:
        levels, ids = rng.choice((3, 4)), 0
        mesh = {"Generator": "hyper_ball", "Arguments": f"0, 0 : {radius!r} : false"}
        corners = 4 * 2**levels
        area = polygon(radius, corners)
    mesh = {**mesh, "Global refinements": levels, "Rotation": turn}
    return {"Element": rng.choice(ELEMENTS), "Mesh": mesh,
            "Material": {"Young modulus": YOUNG, "Poisson ratio": .3}}, corners, area, ids


def disc(rng, ring=False):
    """On a rough floor, on two corners: the middle is between them."""
    radius, part = 10 ** rng.uniform(0, 2) / 2, rng.uniform(.2, .8)
    seed = rng.random()
    _, corners, _, _ = round_body(random.Random(seed), ring, radius, 0.0)
    turn = 360 / corners * part
    body, corners, area, ids = round_body(random.Random(seed), ring, radius, turn)
    gap, mu = drop(rng, radius), rng.uniform(.1, 1)
    scene = {"Dimension": 2, "Body block": body, "Obstacle floor": plane((0.0, 1.0), radius + gap),
             "Contact bottom": contact(ids=ids, mu=mu), "Load weight": weight(2), "Output": {"VTU": 0}}
    statement = statement_of(2, {"bottom": Touch("block", mu)}, area, (0.0, 0.0), 2 * radius, gap)
    statement.pressed = {"bottom": ((0.0, 1.0), WEIGHT * area)}
    return StaticCase(f"{'ring' if ring else 'disc'} of {2 * radius:.3g} mm, {corners} corners, gap {gap:.3g}, "
                      f"mu {mu:.2g}", scene, statement)


def groove(rng):
    """A ring or disc in a groove; each wall has its own half of the rim, the corner is far below."""
    radius, ring, mu = 10 ** rng.uniform(0, 2) / 2, rng.random() < .7, rng.choice((0.0, 0.0, .2, .5))
    turn = rng.choice((0.0, rng.uniform(0, 360)))
    body, corners, area, ids = round_body(rng, ring, radius, turn)
    slope, gap = rng.uniform(math.radians(20), math.radians(70)), drop(rng, radius)
    c, s = math.cos(slope), math.sin(slope)
    body["Mesh"]["Boundary ids"] = f"7: x < {-.1 * radius!r} && x^2 + y^2 > {(.97 * radius)**2!r} ; " \
                                   f"8: x > {.1 * radius!r} && x^2 + y^2 > {(.97 * radius)**2!r}"
    scene = {"Dimension": 2, "Body block": body, "Obstacle floor": plane((s, c), radius + gap),
             "Obstacle wall": plane((-s, c), radius + gap), "Contact left": contact(ids=7, mu=mu),
             "Contact right": contact(ids=8, obstacle="wall", mu=mu), "Load weight": weight(2), "Output": {"VTU": 0}}
    touches = {"left": Touch("block", mu), "right": Touch("block", mu)}
    statement = statement_of(2, touches, area, (0.0, 0.0), 2 * radius, gap / c)
    if mu == 0:
        wall = WEIGHT * area / (2 * c)
        statement.pressed = {"left": ((s, c), wall), "right": ((-s, c), wall)}
    return StaticCase(f"{'ring' if ring else 'disc'} of {2 * radius:.3g} mm in a groove of {math.degrees(slope):.3g} "
                      f"degrees, turned {turn:.3g}, gap {gap:.3g}, mu {mu}", scene, statement)


def walls(rng):
    """A block on a floor between two walls, or beside one; nodes of the lowest cells touch the floor only."""
    dim = 2
    size, body, cells = steel_block(rng, dim)
    gap, mu = drop(rng, max(size)), rng.choice((0.0, .1, .4))
    beside = [rng.choice((0.0, size[0] * 10 ** rng.uniform(-6, 0))) for _ in range(2)]
    cell = size[1] / cells[1]
    body["Mesh"]["Boundary ids"] = f"7: x < 1e-9 && y > {1.01 * cell!r} ; 8: x > {size[0] * (1 - 1e-9)!r} && " \
                                   f"y > {1.01 * cell!r}"
    sides = (7, 8)[:rng.choice((1, 2))]
    scene = {"Dimension": dim, "Body block": body, "Obstacle floor": plane((0.0, 1.0), gap),
             "Contact bottom": contact(ids=2, mu=mu), "Load weight": weight(dim), "Output": {"VTU": 0}}
    touches = {"bottom": Touch("block", mu)}
    for side, free in zip(sides, beside):
        normal, at = ((1.0, 0.0), -free) if side == 7 else ((-1.0, 0.0), size[0] + free)
        scene[f"Obstacle wall {side}"] = {"Shape": "half space", "Normal": normal, "Point": (at, 0.0)}
        scene[f"Contact side {side}"] = contact(ids=side, obstacle=f"wall {side}", mu=0.0)
        touches[f"side {side}"] = Touch("block", 0.0)
    statement = statement_of(dim, touches, math.prod(size), (size[0] / 2, size[1] / 2), max(size), gap)
    statement.motion += max(beside)
    statement.pressed = {"bottom": ((0.0, 1.0), WEIGHT * math.prod(size))}
    return StaticCase(f"block of {max(size):.3g} mm beside {len(sides)} walls at {beside[0]:.3g}, {beside[1]:.3g}, "
                      f"gap {gap:.3g}, mu {mu}", scene, statement)


def lowered(rng):
    """Clamped at the top, moved down 150 mm, then pressed by `deep`; nu = 0 makes it a row of bars."""
    dim = rng.choice((2, 3))
    size, body, _ = steel_block(rng, dim)
    body["Material"]["Poisson ratio"] = 0
    deep, mu = size[-1] * 10 ** rng.uniform(-4, -2.5), rng.uniform(0, .5)
    normal = (0.0,) * (dim - 1) + (1.0,)
    down = f"-150*min(t, 1) - {deep!r}*max(t - 1, 0)"
    scene = {"Dimension": dim, "Body block": body, "Obstacle floor": plane(normal, 150.0),
             "Contact bottom": contact(ids=2 * dim - 2, mu=mu), "Load weight": weight(dim),
             "Support top": support(2 * dim - 1, ", ".join("xyz"[:dim]), " ; ".join(["0"] * (dim - 1) + [down])),
             "Time": {"Times": rng.choice(((.99, 2), (.5, .99, 2), (2,)))}, "Output": {"VTU": 0}}
    volume = math.prod(size)
    statement = statement_of(dim, {"bottom": Touch("block", mu)}, volume, tuple(s / 2 for s in size), max(size), 150, {})
    # what the weight stretches comes to the floor first
    statement.pressed = {"bottom": (normal, YOUNG * deep / size[-1] * volume / size[-1] + WEIGHT * volume / 2)}
    statement.loads[0].force = (*(0.0,) * (dim - 1), -YOUNG * deep / size[-1] * volume / size[-1])  # the scale of forces
    statement.length = 1e-12 * (150 + max(size))
    return StaticCase(f"{dim}D block of {max(size):.3g} mm, lowered by 150 mm and {deep:.3g}, mu {mu:.2g}", scene, statement)


def own_weight(number):
    rng = random.Random(f"own-weight {number}")
    kind = KINDS[number % len(KINDS)]
    makers = {"floor": on_floor, "incline": incline, "disc": disc, "ring": lambda r: disc(r, True),
              "groove": groove, "walls": walls, "lowered": lowered}
    return makers[kind](rng)
