# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Nodes that are held twice, and bodies that nothing holds beside what is bound."""
import math

from support.logs import log_of
from support.scenes import box, contact, load, support
from support.tables import REACTION, in_space
from support.vectors import IDENTITY, apply, rotation, scaled

TURNS = (((0, 0, 1), 0.0), ((-.2225, .021, .9747), 103.309), ((-.7746, -.1973, -.6008), 163.952))


def vectors(m, dim, *axes):
    return ", ".join("(" + ", ".join(repr(float(x)) for x in apply(m, IDENTITY[e])[:dim]) + ")" for e in axes)


def functions(m, dim, v):
    return " ; ".join(f"({x!r})*t" for x in apply(m, v)[:dim])


def turned_block(dim, turn, cells, element, side=0):
    """A block that is tied to a floor, one side held along its normal, pressed and pushed at its top."""
    m = rotation(*turn) if turn[1] else IDENTITY
    if side == 1:  # mirrored along x, which it is symmetric to
        m = tuple((-row[0], *row[1:]) for row in m)
    size = (2.0,) * (dim - 1) + (1.0,)
    mesh = {"Rotation": turn[1] if dim == 2 else (*map(float, turn[0]), turn[1])} if turn[1] else {}
    bottom, top = 2 * dim - 2, 2 * dim - 1
    body = {"Element": element, **box(cells, size, (-1.0,) * (dim - 1) + (0.0,), poisson=.49, **mesh)}
    scene = {"Dimension": dim, "Body block": body,
             "Obstacle floor": {"Shape": "half space", "Normal": apply(m, IDENTITY[dim - 1])[:dim],
                                "Displacement": functions(m, dim, scaled(.001, IDENTITY[dim - 1]))},
             "Support side": support(side, vectors(m, dim, 0)),
             "Load press": load("traction", functions(m, dim, (.3,) + (0.0,) * (dim - 2) + (-1.0,)
                                                      if dim == 2 else (.3, .2, -1.0)), top),
             "Contact floor": {"Body": "block", "Boundary ids": bottom, "Obstacle": "floor", "Kind": "tie"},
             "Output": {"VTU": 0}}
    return scene, m


def place(row, m=IDENTITY):
    return tuple(round(c, 7) + 0.0 for c in apply(m, tuple(row[c] for c in "xyz")))


def same_forces(laws, what, first, other, m):
    """What is tied does not move: forces are all there is."""
    second, dim = {place(row): in_space(row, other.dim, REACTION) for row in other.last()}, first.dim
    laws.check(what, max(math.dist(apply(m, in_space(row, dim, REACTION)), second[place(row, m)]) for row in first.last()) /
               first.largest(*REACTION), 1e-8)


def indeterminate(run):
    return all(row["determinate"] == "no" for row in run.increments) and \
        "how they share its force is not determined, the sum is" in log_of(run)


def tie_and_support(laws):
    """What a support and a tie hold both, the support carries; whatever the axes, units and factors."""
    for dim, cells, element in ((2, (3, 2), "Q2"), (3, (1, 2, 1), "Q1"), (3, (2, 1, 1), "Q2")):
        what = f"{dim}D, {element}, {cells}"
        first, m = turned_block(dim, TURNS[0], cells, element)
        first = laws.run(first)
        sums = [first.increments[-1][f"floor_f_{c}"] + first.increments[-1][f"supports_f_{c}"] for c in "xyz"]
        expected = (-.6, 2.0, 0.0) if dim == 2 else (-1.2, -.8, 4.0)
        laws.check(f"{what}: sums", math.dist(sums, expected), 1e-10)
        laws.demand("  shares are told as open", indeterminate(first))
        held = [row for row in first.last() if abs(row["x"] + 1) < 1e-6]
        laws.check("  the support has what both hold", max(abs(in_space(row, dim, REACTION)[0]) for row in held), 1e-12)
        turns = ((((0, 0, 1), 37.3), 0), (((0, 0, 1), -101.7), 1)) if dim == 2 else ((TURNS[1], 0), (TURNS[2], 1))
        for turn, side in turns:
            scene, m = turned_block(dim, turn, cells, element, side)
            same_forces(laws, f"  turned by {turn[1]:g} degrees{', mirrored' * side}", first, laws.run(scene), m)
        scene, m = turned_block(dim, TURNS[1] if dim == 3 else ((0, 0, 1), 37.3), cells, element)
        same_forces(laws, "  KLU", first, laws.run(scene, "-s", "Solver/Condensation=amesos_klu"), m)


def several(laws):
    """Equal contacts have equal shares: two ties halves, a bilateral contact beside them a third of the normal force."""
    for dim, turn in ((2, ((0, 0, 1), 37.3)), (3, TURNS[1])):
        scene, m = turned_block(dim, turn, (2,) * dim, "Q1")
        below = box((2,) * dim, (2.0,) * (dim - 1) + (1.0,), (-1.0,) * dim)
        below["Mesh"] = {**scene["Body block"]["Mesh"], **below["Mesh"]}
        pair = {"Boundary ids": 2 * dim - 2, "Master body": "below", "Master boundary ids": 2 * dim - 1, "Body": "block"}
        for entry in ("Support side", "Contact floor", "Obstacle floor"):
            del scene[entry]
        scene["Body below"] = below
        scene["Support ground"] = support(2 * dim - 2, vectors(m, dim, *range(dim)), body="below")
        one = laws.run({**scene, "Contact a": {**pair, "Kind": "tie"}})
        whole, size = {place(row): row for row in one.last() if row["contact"] == "a"}, one.largest(*REACTION)
        for kinds in (("tie", "tie"), ("tie", "bilateral", "tie")):
            run = laws.run({**scene, **{f"Contact {name}": {**pair, "Kind": kind} for name, kind in zip("abc", kinds)}})
            worst = 0.0
            for row in run.last():
                if row["contact"].endswith("_master"):
                    continue
                all_ = whole[place(row)]
                across = 0.0 if row["contact"] == "b" and len(kinds) == 3 else .5
                exact = [all_["r_n"] / len(kinds), across * all_["r_t1"], across * all_["r_t2"]]
                worst = max(worst, math.dist([row[c] for c in REACTION], exact))
            laws.check(f"{dim}D, turned by {turn[1]:g} degrees, {' and '.join(kinds)}: equal shares", worst / size, 1e-10)
            laws.demand("  are told as open", indeterminate(run))


def beside_wall(laws):
    """A bilateral floor carries what presses on it; nothing drives the block along it, rounding neither."""
    for angle, poisson, n in ((0.0, 0.0, 1), (10.0, 0.0, 1), (10.0, .3, 3), (37.3, .3, 1), (-101.7, 0.0, 3)):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        scene = {"Dimension": 2, "Body block": box((n, n), (2.0, 1.0), poisson=poisson, Rotation=angle),
                 "Obstacle floor": {"Shape": "half space", "Normal": (-s, c)},
                 "Obstacle wall": {"Shape": "half space", "Normal": (-c, -s), "Point": (2 * c, 2 * s)},
                 "Contact under": {"Body": "block", "Boundary ids": 2, "Obstacle": "floor", "Kind": "bilateral"},
                 "Contact beside": contact("block", 1, "wall"),
                 "Load press": load("traction", f"({s!r})*t ; ({-c!r})*t", 3), "Output": {"VTU": 0}}
        last = laws.run(scene).increments[-1]
        under = [last[f"under_f_{x}"] for x in "xy"]
        laws.check(f"turned by {angle:g} degrees, nu = {poisson}, {n} cells: the floor", math.dist(under, (-2 * s, 2 * c)), 1e-10)
        laws.check("  the wall", math.hypot(last["beside_f_x"], last["beside_f_y"]), 1e-10)


def welds(laws):
    """Halves of a joint, one tied, one touching, pressed together by balanced pressures: 10 everywhere."""
    for angle, mu, kind in ((0.0, .6, "tie"), (10.0, 0.0, "tie"), (10.0, .6, "bilateral")):
        scene = {"Dimension": 2, "Output": {"VTU": 0}}
        for name, low, side in (("lower", -2.0, 3), ("upper", 0.0, 2)):
            scene[f"Body {name}"] = box((4, 2), (4.0, 2.0), (-2.0, low), Rotation=angle)
            back = f"({math.cos(math.radians(angle))!r}*x + ({math.sin(math.radians(angle))!r})*y)"
            up = f"({math.cos(math.radians(angle))!r}*y - ({math.sin(math.radians(angle))!r})*x)"
            scene[f"Body {name}"]["Mesh"]["Boundary ids"] = \
                f"7: abs({up}) < 1e-6 && {back} < 0 ; 8: abs({up}) < 1e-6 && {back} > 0"
            scene[f"Load {name}"] = load("pressure", "10*t", 5 - side, name)
        pair = {"Body": "upper", "Master body": "lower"}
        scene["Contact weld"] = {**pair, "Boundary ids": 7, "Master boundary ids": 7, "Kind": kind}
        scene["Contact joint"] = {**pair, "Boundary ids": 8, "Master boundary ids": 8, "Friction coefficient": mu}
        run = laws.run(scene)
        worst = max(abs(row["r_n"] / row["area"] - 10) + abs(row["r_t1"]) / row["area"] for row in run.last())
        laws.check(f"{kind} and contact in one joint, mu = {mu}, turned by {angle:g} degrees: pressure", worst / 10, 1e-9)


def struts(laws):
    """A bar between two walls that heat makes longer than their distance."""
    young, area, length, clearance = 1.4e7, .18, 22.6, 6e-5
    for axis, mu in ((IDENTITY[0], .5), ((.6, .8, 0.0), 0.0)):
        end = scaled(length, axis)
        wall = scaled(length + clearance, axis)
        across = ", ".join(f"({', '.join(repr(x) for x in v)})" for v in ((0.0, 0.0, 1.0), (-axis[1], axis[0], 0.0)))
        scene = {"Dimension": 3, "Obstacle left": {"Shape": "half space", "Normal": axis},
                 "Obstacle right": {"Shape": "half space", "Normal": scaled(-1, axis), "Point": wall},
                 "Body bar": {"Kind": "frame", "Sections": "s", "Section s": {
                     "Young modulus": young, "Area": area, "Expansion coefficient": 1e-5},
                     "Frame": {"Nodes": f"A: 0.0, 0.0, 0.0 : 1 ; B: {', '.join(map(repr, end))} : 2",
                               "Members": "A-B: s, elements 1"}},
                 "Contact left": contact("bar", 1, "left", mu), "Contact right": contact("bar", 2, "right", mu),
                 "Support across": support("1, 2", across, "0 ; 0", "bar"), "Load heat": load("temperature", "0.525*t", body="bar"),
                 "Time": {"Increments": 3}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        worst = 0.0
        for k, row in enumerate(run.increments):
            exact = young * area * max(0.0, .525e-5 * (k + 1) / 3 * length - clearance) / length
            worst = max(worst, abs(math.hypot(*(row[f"left_f_{c}"] for c in "xyz")) - exact))
        laws.check(f"strut along {axis}, mu = {mu}: its force", worst / (young * area * .525e-5), 1e-9)


def redundant_family(laws):
    for family in (several, beside_wall, welds, struts, tie_and_support):
        family(laws)
