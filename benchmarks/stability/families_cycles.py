# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cycles through zero load, exact or to rounding: loads, springs, supports, obstacles and temperatures that come and
go. All are solvable; what is left where nothing acts is rounding of what acted before."""
import math
import random

from support.scenes import load, merge, support
from support.tables import read
from static_cases import StaticCase
from statics import ALL, Load, Statement, Touch
from families_pressed import ROUNDING, Stack, direction_of, expressions, loads_of

PI = repr(math.pi)
CYCLES = (("abs(sin({pi}*t))", lambda t: abs(math.sin(math.pi * t))),
          ("max(0, sin(2*{pi}*t))", lambda t: max(0, math.sin(2 * math.pi * t))),
          ("1 - cos(2*{pi}*t)", lambda t: 1 - math.cos(2 * math.pi * t)),
          ("abs(1 - t)", lambda t: abs(1 - t)),
          ("1 - abs(2*(t - floor(t)) - 1)", lambda t: 1 - abs(2 * (t - math.floor(t)) - 1)),
          ("min(t, 0.7) - min(max(t - 0.3, 0), 0.7)", lambda t: min(t, .7) - min(max(t - .3, 0), .7)))
REMAINS = 1e-12  # of the largest force so far: what may be left where nothing acts


def times_of(rng, dim):
    """Two cycles at most; numbers of increments that meet the zeros exactly, nearly and never."""
    if rng.random() < .3:
        return {"Times": rng.choice(((.3, .5, 1), (.5, .75, 1), (.5, 1, 1.5, 2), (1, 2), (.1, 1, 1.2, 2)))}
    return {"End": 2, "Increments": rng.choice((2, 4, 5, 10, 20, 40, 100) if dim == 2 else (2, 4, 5, 10))}


def cycle_of(rng):
    words, factor = rng.choice(CYCLES)
    return words.format(pi=PI), factor


def hold_below(scene, stack, touches):
    """The lowest block stands on a clamp in place of the floor."""
    del scene["Contact c0"], scene["Obstacle floor"], touches["c0"]
    dim = stack.dim
    scene["Support ground"] = support(2 * dim - 2, ", ".join("xyz"[:dim]), body="b0")
    return {"b1": ALL[dim]}


def beside_wall(scene, stack, touches):
    """A wall that the lowest block touches from the start, and is pressed against where it bulges."""
    normal, point = stack.vector(0.0, -1.0), stack.vector(0.0, stack.sizes[0][0] / 2)
    scene["Obstacle wall"] = {"Shape": "half space", "Normal": normal, "Point": point}
    scene["Contact wall"] = {"Body": "b0", "Boundary ids": 1, "Obstacle": "wall", "Friction coefficient": 0}
    touches["wall"] = Touch("b0", 0.0)


def left_faults(statement, cycle):
    """Reactions where nothing acts any more, on bodies that nothing else presses."""
    def look(folder):
        past, faults = 0.0, []
        for row in read(folder / "reactions.csv"):
            size = max(abs(row[name]) for name in ("r_n", "r_t1", "r_t2"))
            acts = abs(cycle(row["time"])) > 1e-14
            past = max(past, size if acts else 0)
            if past > 0 and not acts and size > REMAINS * past:
                faults.append(f"increment {row['increment']:g}: {size:.3g} is left of {past:.3g}")
        return faults
    return look


def by_loads(rng, stack):
    """Blocks that are pressed, and pushed by a part of what they hold."""
    scene, touches = stack.entries()
    free = {f"b{i}": ALL[stack.dim] for i in range(len(stack.sizes))}
    if stack.two and rng.random() < .5:
        free = hold_below(scene, stack, touches)
    wall = rng.random() < .3
    if wall:
        beside_wall(scene, stack, touches)
    direction = direction_of(rng, stack.dim)
    push = [rng.choice((0.0, .4)) * stack.limit(direction) * d for d in direction]
    words, factor = cycle_of(rng)
    entries, loads = loads_of(stack, stack.strain * stack.young, push, [(words, factor)] * 2)
    return {**scene, **entries}, Statement(stack.dim, loads, touches, free, 0), \
        [] if wall or "c0" not in touches else [factor]


def moved(stack, words, depth, sideways):
    """Displacements of the top: down by a depth, sideways by another."""
    return expressions(stack.vector(-depth, sideways), words)


def by_supports(rng, stack):
    """The top is lowered on the floor and raised again; springs carry it, or a clamp."""
    scene, touches = stack.entries()
    words, _ = cycle_of(rng)
    depth, unit = stack.strain * stack.height, stack.unit
    if rng.random() < .4:  # from above
        below = stack.vector(-rng.choice((.5, 1e-3, 3)) * depth)
        scene["Obstacle floor"]["Point"] = below
    entries = {"Stiffness": stack.young / unit * 10 ** rng.uniform(-3, 1)} if stack.springs else {}
    scene["Support top"] = support(2 * stack.dim - 1, ", ".join("xyz"[:stack.dim]),
                                   moved(stack, words, depth, rng.choice((0.0, .3, 2)) * depth), stack.top, **entries)
    free = {"b0": ALL[stack.dim]} if stack.two else {}
    return scene, Statement(stack.dim, [], touches, free, 0), []


def by_springs(rng, stack):
    """On springs and over the floor, which it never meets in half of the scenes."""
    stack.springs = True
    scene, statement, zeros = by_supports(rng, stack)
    if rng.random() < .5 and not stack.two:
        scene["Obstacle floor"]["Point"] = stack.vector(-.1 * stack.unit)
        statement.silent = True
    return scene, statement, zeros


def by_obstacles(rng, stack):
    """The floor comes, presses and goes; the top is clamped."""
    scene, touches = stack.entries()
    words, _ = cycle_of(rng)
    depth = stack.strain * stack.height
    gap = rng.choice((0.0, 0.0, .5, 100.0)) * depth
    scene["Obstacle floor"].update({"Point": stack.vector(-gap), "Displacement": expressions(
        stack.vector(depth + gap, rng.choice((0.0, .5)) * depth), words)})
    scene["Support top"] = support(2 * stack.dim - 1, ", ".join("xyz"[:stack.dim]), body=stack.top)
    free = {"b0": ALL[stack.dim]} if stack.two else {}
    return scene, Statement(stack.dim, [], touches, free, 0), []


def by_temperature(rng, stack):
    """Blocks that are heated on the floor, below a clamp or free and loaded by nothing."""
    scene, touches = stack.entries()
    words, _ = cycle_of(rng)
    free = {f"b{i}": ALL[stack.dim] for i in range(len(stack.sizes))}
    if rng.random() < .6:
        scene["Support top"] = support(2 * stack.dim - 1, ", ".join("xyz"[:stack.dim]), body=stack.top)
        del free[stack.top]
    for i in range(len(stack.sizes)):
        scene[f"Body b{i}"] = merge(scene[f"Body b{i}"], {"Material": {"Expansion coefficient": 1e-5}})
        scene[f"Load heat {i}"] = load("temperature", f"{stack.strain * 1e5!r}*({words})", body=f"b{i}")
    return scene, Statement(stack.dim, [], touches, free, 0), []


KINDS = {"loads": by_loads, "springs": by_springs, "supports": by_supports, "obstacles": by_obstacles,
         "temperature": by_temperature}


def through_zero(number):
    rng = random.Random(f"through-zero {number}")
    dim = 3 if number // 5 % 4 == 3 else 2
    stack = Stack(rng, dim)
    stack.strain, stack.springs = 10 ** rng.uniform(-6, -3), False
    kind = list(KINDS)[number % 5]
    scene, statement, zeros = KINDS[kind](rng, stack)
    size, soft = 2 * stack.height + max(stack.sizes[0]), 100 * stack.strain
    far = rng.random() < .2
    if far:
        for name in statement.contacts:
            scene[f"Contact {name}"]["Kinematics"] = "finite sliding"
        # Arms are those of the deformed bodies then.
        statement.free = {body: "xyz"[:dim] for body in statement.free}
    iterative = not far and "wall" not in statement.contacts and rng.random() < .2
    scene.update({"Time": times_of(rng, dim), "Output": {"VTU": 0}})
    if iterative:
        scene["Solver"] = {"Backend": "iterative"}
    statement.length, statement.motion = 1e-8 * soft * size + ROUNDING * size, 1e4 * soft * size
    name = f"{dim}D, {kind}, {len(stack.sizes)} bodies, mu {', '.join(f'{mu:.2g}' for mu in stack.mus)}" + \
           (", far" if far else ", iterative" if iterative else "")
    return StaticCase(name, scene, statement, more=[left_faults(statement, factor) for factor in zeros])
