#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Laws that results must obey, whatever the scene.

usage: laws.py PROGRAM FAMILY...      (all: every family)

Each family writes small scenes into a temporary folder, runs them, and checks
numbers of reactions.csv and increments.csv: against each other (a rotated scene
gives rotated reactions), or against closed forms. Every check prints what was
found and its bound.
"""
import csv
import itertools
import math
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree
from pathlib import Path

SHIPPED = Path(__file__).resolve().parent.parent / "parameter-files"
REFERENCE = Path(__file__).resolve().parent / "reference"
LISTS = {"Body": "Bodies", "Obstacle": "Obstacles", "Contact": "Contacts", "Support": "Supports", "Load": "Loads"}
TEXTS = ("contact", "state", "solver", "determinate")
TOGETHER = 16  # increments that a small scene finishes together
ELEMENTS = ("Q1", "Q1 B-bar", "Q1 incompatible modes")


# ---------------------------------------------------------------- vectors

def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def scaled(factor, a):
    return tuple(factor * x for x in a)


def plus(*vectors):
    return tuple(map(sum, zip(*vectors)))


def unit(a):
    return scaled(1 / math.sqrt(dot(a, a)), a)


def apply(matrix, a):
    return tuple(dot(row, a) for row in matrix)


IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def rotation(axis, degrees):
    """Columns are the images of the axes."""
    n, c, s = unit(axis), math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    images = [plus(scaled(c, e), scaled(s, cross(n, e)), scaled((1 - c) * dot(n, e), n)) for e in IDENTITY]
    return tuple(zip(*images))


def tangents(n, dim):
    if dim == 2:
        return (n[1], -n[0], 0.0), (0.0, 0.0, 1.0)
    t1 = unit(cross((0, 1, 0), n) if abs(n[2]) > .9 else cross(n, (0, 0, 1)))
    return t1, cross(n, t1)


# ---------------------------------------------------------------- scenes

def text(value):
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, (tuple, list)):
        return ", ".join(map(text, value))
    return str(value)


def lines(tree, depth=0):
    for name, value in tree.items():
        if isinstance(value, dict):
            yield "  " * depth + "subsection " + name
            yield from lines(value, depth + 1)
            yield "  " * depth + "end"
        else:
            yield "  " * depth + f"set {name} = {text(value)}"


def merge(tree, changes):
    """A copy of a scene with other entries; None removes one."""
    result = dict(tree)
    for name, value in changes.items():
        if value is None:
            result.pop(name, None)
        elif isinstance(value, dict):
            result[name] = merge(result.get(name, {}), value)
        else:
            result[name] = value
    return result


def write_scene(scene, file):
    head = {plural: ", ".join(key[len(kind) + 1:] for key in scene if key.startswith(kind + " "))
            for kind, plural in LISTS.items()}
    file.write_text("\n".join(lines({**head, **scene})) + "\n")


def box(cells, size, origin=None, young=1000.0, poisson=.3, **mesh):
    origin = origin or (0.0,) * len(size)
    return {"Mesh": {"Generator": "subdivided_hyper_rectangle",
                     "Arguments": " : ".join(map(text, (cells, origin, plus(origin, size), "true"))), **mesh},
            "Material": {"Young modulus": young, "Poisson ratio": poisson}}


def floor(dim, **entries):
    return {"Shape": "half space", "Normal": (0, 1) if dim == 2 else (0, 0, 1), **entries}


def contact(body="block", ids=2, obstacle="floor", mu=0.0, **entries):
    return {"Body": body, "Boundary ids": ids, "Obstacle": obstacle, "Friction coefficient": mu, **entries}


def support(ids, directions, displacement="0", body="block", **entries):
    return {"Body": body, "Boundary ids": ids, "Directions": directions, "Displacement": displacement, **entries}


def load(kind, value, ids=None, body="block", **entries):
    return {"Body": body, "Kind": kind, "Value": value, **({} if ids is None else {"Boundary ids": ids}), **entries}


def press_and_shear(dim, cells=None, mu=.3, increments=4, **body):
    """A block pressed in one increment, then sheared along x in equal ones."""
    size = (2.0, 1.0) if dim == 2 else (1.5, 1.0, 1.0)
    cells = cells or ((12, 6) if dim == 2 else (5, 4, 4))
    down, side = "-0.01*min(t, 1)", "0.004*max(t - 1, 0)"
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    return {"Dimension": dim,
            "Body block": box(cells, size, **body),
            "Obstacle floor": floor(dim),
            "Contact bottom": contact(ids=bottom, mu=mu),
            "Support top": support(top, "x, y" if dim == 2 else "x, y, z",
                                   f"{side} ; {down}" if dim == 2 else f"{side} ; 0.3*{side} ; {down}"),
            "Time": {"End": increments, "Increments": increments},
            "Output": {"VTU": 0}}


def with_element(scene, element, body="block"):
    return merge(scene, {f"Body {body}": {"Element": element}})


def write_msh(file, dim, points, cells, faces):
    """Gmsh 2.2; cells and faces as lists of node numbers from 0, faces with an id."""
    kinds = (1, 3) if dim == 2 else (3, 5)
    out = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(points))]
    out += [f"{i + 1} {p[0]!r} {p[1]!r} {p[2]!r}" for i, p in enumerate(points)]
    out += ["$EndNodes", "$Elements", str(len(cells) + len(faces))]
    every = [(kinds[0], tag, nodes) for tag, nodes in faces] + [(kinds[1], 0, nodes) for nodes in cells]
    out += [f"{i + 1} {kind} 2 {tag} {tag} " + " ".join(str(n + 1) for n in nodes)
            for i, (kind, tag, nodes) in enumerate(every)]
    file.write_text("\n".join(out + ["$EndElements"]) + "\n")


def distorted(file, dim, n=4):
    """A unit cube of n^dim cells whose inner nodes, and those of the sides along them, are moved."""
    rng = random.Random(7)
    counts = [n + 1] * dim + [1] * (3 - dim)
    number = {}
    points = []
    for at in itertools.product(*(range(c) for c in counts)):
        number[at] = len(points)
        points.append(tuple((i + (rng.uniform(-.25, .25) if 0 < i < n else 0)) / n if d < dim else 0.0
                            for d, i in enumerate(at)))
    quad = ((0, 0), (1, 0), (1, 1), (0, 1))
    if dim == 2:
        cells = [[number[i + a, j + b, 0] for a, b in quad] for i in range(n) for j in range(n)]
    else:
        cells = [[number[i + a, j + b, k + c] for c in (0, 1) for a, b in quad]
                 for i in range(n) for j in range(n) for k in range(n)]
    faces = []
    for d, side in itertools.product(range(dim), (0, n)):
        others = [e for e in range(dim) if e != d]
        for corner in itertools.product(range(n), repeat=dim - 1):
            at = []
            for shift in (((0,), (1,)) if dim == 2 else quad):
                node = [0, 0, 0]
                node[d] = side
                for e, i, s in zip(others, corner, shift):
                    node[e] = i + s
                at.append(number[tuple(node)])
            faces.append((10 + 2 * d + (side > 0), at))
    write_msh(file, dim, points, cells, faces)
    bottom = 12 if dim == 2 else 14
    return points, [nodes for tag, nodes in faces if tag == bottom]


def cantilever(dim, element, poisson, cells, length=10.0):
    """A beam of height 1 (and width 1), bent by end tractions; and the exact deflection of its end."""
    young, curvature = 1000.0, 1e-3
    plane_strain = dim == 2
    stiffness, ratio = (young / (1 - poisson**2), poisson / (1 - poisson)) if plane_strain else (young, poisson)
    bent = f"{-curvature * ratio / 2!r}*(y^2 - z^2)", f"{-curvature * ratio!r}*y*z"
    origin = (0.0, -.5, -.5)[:dim]
    far = {"Shape": "half space", "Normal": (-1, 0, 0)[:dim], "Point": (2 * length, 0, 0)[:dim]}
    scene = {"Dimension": dim,
             "Body block": {"Element": element, **box(cells, (length, 1.0, 1.0)[:dim], origin, young, poisson)},
             "Obstacle far": far, "Contact end": contact(ids=1, obstacle="far"),
             "Support clamp": support(0, "x"),
             "Support sections": support(0, "y, z"[:3 * dim - 5], " ; ".join(bent[:dim - 1]), Stiffness=1.0),
             "Load end": load("traction", " ; ".join((f"{stiffness * curvature!r}*y", "0", "0")[:dim]), 1),
             "Solver": {"Tolerance": 1e-8},  # rounding of motions far above the strains, of nu far above E
             "Output": {"VTU": 0}}
    return scene, -curvature * length**2 / 2


def cook(folder, element, poisson, n):
    """Cook's membrane in plane strain, E = 240.565, sheared by 6.25 a length at its right end."""
    def place(i, j):
        x, y = i / n, j / n
        return 48 * x, 44 * x + y * (44 - 28 * x), 0.0

    def number(i, j):
        return i * (n + 1) + j
    points = [place(i, j) for i in range(n + 1) for j in range(n + 1)]
    cells = [[number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]
             for i in range(n) for j in range(n)]
    faces = [(tag, [number(i, j), number(i, j + 1)]) for tag, i in ((10, 0), (11, n)) for j in range(n)]
    write_msh(folder / f"cook{n}.msh", 2, points, cells, faces)
    return {"Dimension": 2,
            "Body block": {"Element": element, "Mesh": {"File": f"cook{n}.msh"},
                           "Material": {"Young modulus": 240.565, "Poisson ratio": poisson}},
            "Obstacle far": {"Shape": "half space", "Normal": (-1, 0), "Point": (100, 0)},
            "Contact end": contact(ids=11, obstacle="far"), "Support clamp": support(10, "x, y"),
            "Load end": load("traction", "0 ; 6.25", 11), "Output": {"VTU": 0}}


def deflection(run, y=0.0):
    """Along y of the node at this height (z = 0) of an end that touches nothing."""
    row = min(run.rows, key=lambda row: abs(row["y"] - y) + abs(row["z"]))
    return in_space(row, run.dim, MOTION)[1]


def tributary(points, faces):
    """Integrals of the nodes' shape functions over plane faces."""
    areas = {}
    gauss = ((1 - 1 / math.sqrt(3)) / 2, (1 + 1 / math.sqrt(3)) / 2)
    for nodes in faces:
        p = [points[i] for i in nodes]
        if len(p) == 2:
            length = math.dist(*p)
            shares = [length / 2] * 2
        else:
            shares = [0.0] * 4
            for x, y in itertools.product(gauss, repeat=2):
                shape = ((1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y)
                dx, dy = (-(1 - y), 1 - y, y, -y), (-(1 - x), -x, x, 1 - x)
                a = plus(*(scaled(w, q) for w, q in zip(dx, p)))
                b = plus(*(scaled(w, q) for w, q in zip(dy, p)))
                area = math.sqrt(dot(cross(a, b), cross(a, b))) / 4
                shares = [s + area * w for s, w in zip(shares, shape)]
        for i, s in zip(nodes, shares):
            areas[i] = areas.get(i, 0) + s
    return areas


# ---------------------------------------------------------------- results

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

    def largest(self, *columns):
        return max(max(abs(row[c]) for c in columns) for row in self.rows)

    def at(self, order=None):
        """Rows by increment and place; `order` maps a place onto that of another run."""
        result = {}
        for row in self.rows:
            p = (row["x"], row["y"], row["z"])
            p = order(p) if order else p
            result[(row["increment"], *(round(c, 7) + 0.0 for c in p))] = row
        return result


def normal(row):
    return row["n_x"], row["n_y"], row["n_z"]


def in_space(row, dim, columns):
    """Vector of its components along n, t1, t2; None counts as zero."""
    basis = (normal(row), *tangents(normal(row), dim))
    return plus(*(scaled(row[c], e) if c else (0, 0, 0) for c, e in zip(columns, basis)))


REACTION = ("r_n", "r_t1", "r_t2")
MOTION = ("u_n", "u_t1", "u_t2")
STEP = (None, "du_t1", "du_t2")


class Laws:
    """Runs scenes and keeps the account of the checks of one family."""

    def __init__(self, program):
        self.program = Path(program).resolve()
        self.folder = Path(tempfile.mkdtemp(prefix="conetact-laws-"))
        self.failed = 0
        self.n_runs = 0

    def check(self, what, found, bound):
        good = found <= bound  # so that nan fails
        print(f"  {'' if good else 'FAILED: '}{what}: {found:.3g} (bound {bound:g})")
        self.failed += not good

    def demand(self, what, holds):
        print(f"  {'' if holds else 'FAILED: '}{what}")
        self.failed += not holds

    def start(self, scene, *arguments, **options):
        """Runs the program; `scene` is a tree or a file."""
        self.n_runs += 1
        file = self.folder / f"{self.n_runs}.prm"
        if isinstance(scene, Path):
            file = scene
        else:
            write_scene(scene, file)
        folder = self.folder / str(self.n_runs)
        done = subprocess.run([self.program, file, "-o", folder, "--quiet", *arguments], cwd=self.folder,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, **options)
        return done, folder

    def run(self, scene, *arguments, bounds=True):
        done, folder = self.start(scene, *arguments)
        if done.returncode != 0:
            raise RuntimeError(f"exit code {done.returncode}: {done.stderr}")
        run = Run(folder)
        worst = max(max(row["residual"], row["equilibrium"], row["balance"]) for row in run.increments)
        if bounds and not worst <= 1e-10:
            self.check("residual, equilibrium, balance", worst, 1e-10)
        return run

    def same(self, what, a, b, bound=1e-10, matrix=IDENTITY, forces=1.0, lengths=1.0, order=None, states=True):
        """Reactions, slips and displacements of b are those of a, turned (or mirrored) and scaled."""
        turned = (lambda p: scaled(lengths, apply(matrix, p))) if order is None else order
        first, second = a.at(turned), b.at()
        if first.keys() != second.keys():
            self.demand(f"{what}: the same nodes", False)
            return
        worst = {}
        for kind, columns, scale in (("reactions", REACTION, forces), ("displacements", MOTION, lengths),
                                     ("slips", STEP, lengths)):
            size = scale * max(a.largest(*(REACTION if kind == "reactions" else MOTION)), 1e-300)
            worst[kind] = max(math.dist(apply(matrix, scaled(scale, in_space(row, a.dim, columns))),
                                        in_space(second[key], b.dim, columns))
                              for key, row in first.items()) / size
        size = max(lengths * a.largest("u_n", "u_t1", "gap"), 1e-300)
        worst["gaps"] = max(abs(lengths * row["gap"] - second[key]["gap"]) for key, row in first.items()) / size
        self.check(f"{what}: " + ", ".join(f"{k} {v:.2g}" for k, v in worst.items()), max(worst.values()), bound)
        if states:
            other = [key for key, row in first.items() if row["state"] != second[key]["state"]]
            if other:
                self.demand(f"{what}: states differ at {len(other)} of {len(first)} rows, first {other[0]}", False)

    def admissible(self, what, run, mu=None):
        """Nothing pulls, nothing penetrates, cones hold; mu(row) where it is known."""
        force, length = run.largest("r_n"), run.largest(*MOTION)
        self.check(f"{what}: pull", max(-row["r_n"] for row in run.rows) / force, 0)
        self.check(f"{what}: penetration", max(-row["gap"] for row in run.rows) / length, 1e-10)
        self.check(f"{what}: gap times reaction",
                   max(abs(row["gap"] * row["r_n"]) for row in run.rows) / (force * length), 1e-10)
        if mu is None:
            return
        outside = slack = across = 0.0
        for row in run.rows:
            r, du = (row["r_t1"], row["r_t2"]), (row["du_t1"], row["du_t2"])
            limit = mu(row) * row["r_n"]
            outside = max(outside, math.hypot(*r) - limit)
            if row["state"] == "slip":
                slack = max(slack, abs(math.hypot(*r) - limit))
                across = max(across, abs(r[0] * du[1] - r[1] * du[0]), dot(r, du))
        self.check(f"{what}: outside the cone", outside / force, 1e-10)
        self.check(f"{what}: slip inside the cone", slack / force, 1e-9)
        self.check(f"{what}: slip not against friction", across / (force * length), 1e-10)


# ---------------------------------------------------------------- families

def balance(laws):
    for n, element in ((8, "Q1"), (16, "Q1"), *((8, element) for element in ELEMENTS[1:])):
        scene = with_element(press_and_shear(3, cells=(n, n, n), increments=6), element)
        run = laws.run(scene, bounds=False)
        for column in ("residual", "equilibrium", "balance"):
            laws.check(f"{n}^3 {element}: {column}", max(row[column] for row in run.increments), 1e-10)
        force = moment = 0.0
        for increment in run.increments:
            total, about = (0, 0, 0), (0, 0, 0)
            for row in run.rows:
                if row["increment"] == increment["increment"]:
                    r = in_space(row, 3, REACTION)
                    total = plus(total, r)
                    about = plus(about, cross((row["x"], row["y"], row["z"]), r))
            size = max(map(abs, total))
            force = max(force, *(abs(total[d] - increment[f"bottom_f_{'xyz'[d]}"]) / size for d in range(3)))
            moment = max(moment, *(abs(about[d] - increment[f"bottom_m_{'xyz'[d]}"]) / size for d in range(3)))
        # forces below 1e-9 of the largest are written 0
        laws.check(f"{n}^3: sum of reactions against the resultant", force, 1e-10)
        laws.check(f"{n}^3: sum of moments against the resultant", moment, 1e-9)
        laws.admissible(f"{n}^3 {element}", run, lambda row: .3)


def extrusion(laws):
    plane = press_and_shear(2, mu=.3)
    plane["Obstacle floor"] = {"Shape": "prescribed gap", "Normal": (-.1, 1.0), "Gap": "0.002*(2 - x)"}
    plane["Load side"] = load("traction", "0.5*t ; -0.2*t", 1)
    for n, element in ((1, "Q1"), (3, "Q1"), (2, ELEMENTS[1]), (2, ELEMENTS[2])):
        a = laws.run(with_element(plane, element))
        solid = merge(plane, {
            "Dimension": 3,
            "Body block": {"Element": element, **box((12, 6, n), (2.0, 1.0, 1.0))},
            "Obstacle floor": {"Normal": (-.1, 1.0, 0.0)},
            "Support top": {"Directions": "x, y, z", "Displacement": plane["Support top"]["Displacement"] + " ; 0"},
            "Support faces": support("4, 5", "z"),
            "Load side": {"Value": "0.5*t ; -0.2*t ; 0"}})
        b = laws.run(solid)
        sums, worst = {}, 0.0
        for row in b.rows:
            key = row["increment"], round(row["x"], 7)
            r = in_space(row, 3, REACTION)
            sums[key] = plus(sums.get(key, (0, 0, 0)), r)
            share = (.5 if row["z"] in (0, 1) else 1) / n
            flat = next(o for o in a.rows if o["increment"] == row["increment"] and abs(o["x"] - row["x"]) < 1e-6)
            worst = max(worst, math.dist(r, scaled(share, in_space(flat, 2, REACTION))))
        total = max(math.dist(sums[row["increment"], round(row["x"], 7)], in_space(row, 2, REACTION))
                    for row in a.rows)
        size = a.largest(*REACTION)
        laws.check(f"{element}, {n} cells along z: sums of reactions", total / size, 1e-10)
        laws.check(f"{element}, {n} cells along z: shares of reactions", worst / size, 1e-10)


def turned_scene(dim, axis, degrees, supports):
    """One scene with everything in it that has a direction, turned."""
    m = rotation(axis, degrees)
    back = [f"({m[0][d]!r}*x + ({m[1][d]!r})*y + ({m[2][d]!r})*z)" for d in range(3)]

    def vector(*v):
        return apply(m, v + (0,) * (3 - len(v)))[:dim]

    def functions(*v):  # of t, each a factor and a function
        return " ; ".join(" + ".join(f"({m[d][e]!r})*({f})" for e, f in enumerate(v)) for d in range(dim))

    def directions(*v):
        return ", ".join(f"({text(vector(*e))})" for e in v)

    scene = press_and_shear(dim, mu=f"0.2 + 0.1*{back[0]}")
    scene["Body block"]["Mesh"]["Rotation"] = degrees if dim == 2 else (*map(float, axis), degrees)
    # tilted, so that it is open somewhere; not where a face's own normal holds contact nodes
    tilt = 0.0 if supports == "normal" else -.008
    scene["Obstacle floor"] = {"Shape": "half space",
                               "Normal": vector(*((-tilt, 1) if dim == 2 else (-tilt, -tilt / 2, 1))),
                               "Displacement": functions("0.001*t", "0.0005*t", "0.0003*t")}
    height = back[dim - 1]
    scene["Load weight"] = load("body force", functions("0.2*t", f"-t*{height}", "0.1*t"))
    scene["Load push"] = load("pressure", f"0.5*t*{height}", 0)
    scene["Load pull"] = load("traction", functions("0.3*t", "0.2*t", "0.1*t"), 1)
    scene["Load point"] = load("point force", functions("0.1*t", "0.1*t", "-0.1*t"), Point=vector(.7, .45, .6))
    e = IDENTITY
    down, side = "-0.01*min(t, 1)", "0.004*max(t - 1, 0)"
    if supports == "axes":
        scene["Support top"]["Directions"] = directions(*e[:dim])
    elif supports == "normal":
        top = scene["Support top"]["Boundary ids"]
        scene["Support top"] = support(top, "normal", down)
        scene["Support left"] = support(0, "normal", f"-0.2*{side}")
        if dim == 3:
            scene["Support front"] = support(2, "normal", "0")
    elif supports == "oblique":
        oblique = ((1, 2, 0), (3, -1, 0)) if dim == 2 else ((1, 2, 0), (3, -1, 1), (0, .5, 2))
        motion = scene["Support top"]["Displacement"].split(";")
        scene["Support top"].update({"Directions": directions(*oblique), "Displacement": " ; ".join(
            " + ".join(f"({c!r})*({f})" for c, f in zip(unit(v), motion)) for v in oblique)})
    else:
        scene["Support top"]["Directions"] = directions(*e[:dim])
        scene["Support top"]["Stiffness"] = f"20000 + 1000*{back[0]}"
    return scene, m


def rotation_family(laws):
    for dim, turns in ((2, (((0, 0, 1), 37.3), ((0, 0, 1), -101.7), ((0, 0, 1), 90.0))),
                       (3, (((1, 2, 3), 23.7), ((-2, 1, .3), 131.1)))):
        for supports in ("axes", "normal", "oblique", "springs"):
            first = laws.run(turned_scene(dim, (0, 0, 1), 0.0, supports)[0])
            for axis, degrees in turns:
                scene, m = turned_scene(dim, axis, degrees, supports)
                laws.same(f"{dim}D, {supports}, {degrees} degrees about {axis}", first, laws.run(scene), matrix=m)
        for element in ELEMENTS[1:]:
            runs = [laws.run(with_element(turned_scene(dim, *turn, "axes")[0], element))
                    for turn in (((0, 0, 1), 0.0), turns[0])]
            laws.same(f"{dim}D, {element}, turned", *runs, matrix=rotation(*turns[0]))


def mirror(laws):
    for dim, axes in ((2, (0,)), (3, (0, 1))):
        for axis in axes:
            sign = [-1 if d == axis else 1 for d in range(3)]
            m = tuple(scaled(s, e) for s, e in zip(sign, IDENTITY))
            runs = []
            for mirrored in (False, True):
                s = sign if mirrored else (1, 1, 1)
                scene = press_and_shear(dim, mu=f"0.2 + 0.05*({s[0]})*x")
                size, cells = ((2.0, 1.0), (12, 6)) if dim == 2 else ((1.5, 1.0, 1.0), (5, 4, 4))
                scene["Body block"] = box(cells, size, scaled(-.5, size[:-1]) + (0.0,))
                side, last = "0.004*max(t - 1, 0)", "-0.01*min(t, 1)"
                parts = [f"({s[0]})*{side}", f"({s[1]})*0.3*{side}"][:dim - 1] + [last]
                scene["Support top"]["Displacement"] = " ; ".join(parts)
                scene["Load push"] = load("pressure", "0.5*t", 2 * axis + (1 if mirrored else 0))
                scene["Obstacle floor"]["Normal"] = (.02 * s[0], 1.0) if dim == 2 else (.02 * s[0], .01 * s[1], 1.0)
                runs.append(laws.run(scene))
            laws.same(f"{dim}D, along {'xyz'[axis]}", *runs, matrix=m)


def units(laws):
    def scene(dim, force, length):
        stress = force / length**2
        tree = press_and_shear(dim)
        size = (2.0, 1.0) if dim == 2 else (1.5, 1.0, 1.0)
        cells = (12, 6) if dim == 2 else (5, 4, 4)
        tree["Body block"] = box(cells, scaled(length, size), young=1000.0 * stress)
        if dim == 2:
            tree["Body block"]["Material"]["Thickness"] = .5 * length
        tree["Obstacle floor"] = {"Shape": "prescribed gap", "Normal": (0, 1) if dim == 2 else (0, 0, 1),
                                  "Gap": "0.01*x"}
        tree["Support top"]["Displacement"] = " ; ".join(
            f"{length!r}*({part})" for part in tree["Support top"]["Displacement"].split(";"))
        tree["Support left"] = support(0, "x", f"{length!r}*0.001*t", Stiffness=20000.0 * force / length**3)
        tree["Load side"] = load("pressure", f"{stress!r}*0.5*t", 1)
        return tree

    scales = {"N-mm to SI": (1.0, 1e-3), "force 1e9": (1e9, 1.0), "force 1e-9": (1e-9, 1.0),
              "length 1e9": (1.0, 1e9), "length 1e-9": (1.0, 1e-9), "both odd": (3.7e9, 2.3e-9)}
    for dim, method, names in ((2, "automatic", scales), (3, "automatic", ("N-mm to SI", "both odd")),
                               (2, "smoothing", ("N-mm to SI", "force 1e9", "length 1e-9"))):
        option = ("-s", f"Solver/Method={method}")
        first = laws.run(scene(dim, 1.0, 1.0), *option)
        for name in names:
            force, length = scales[name]
            other = laws.run(scene(dim, force, length), *option)

            def place(p, length=length):
                return scaled(length, p)
            # places are rounded to 7 digits: compare them in the first units
            for row in other.rows:
                for axis in "xyz":
                    row[axis] /= length
            laws.same(f"{dim}D, {method}, {name}", first, other, forces=force, lengths=length, order=lambda p: p)
            counts = [[row["iterations"] for row in run.increments] for run in (first, other)]
            laws.demand(f"{dim}D, {method}, {name}: the same iterations", counts[0] == counts[1])


def patch_scene(dim, body, ids, plane="strain", poisson=.3):
    """Uniform pressure on the top of a unit block on a frictionless floor; ids: left, (front,) bottom, top."""
    pressure, young = 7.0, 1000.0
    scene = {"Dimension": dim, "Body block": body, "Obstacle floor": floor(dim),
             "Contact bottom": contact(ids=ids[-2]),
             "Support left": support(ids[0], "x"),
             "Load top": load("pressure", pressure, ids[-1]),
             "Output": {"VTU": 0}}
    if dim == 3:
        scene["Support front"] = support(ids[1], "y")
    ratio = poisson * (1 + poisson) if dim == 2 and plane == "strain" else poisson
    return scene, pressure, ratio * pressure / young


def corners_below(folder):
    """Places of the corners of all faces of hexahedra at z = 0, to the seven digits of a VTU file."""
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(folder / "solution-block-0001.vtu"))
    reader.Update()
    grid = reader.GetOutput()
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        for f in range(cell.GetNumberOfFaces()):
            face = cell.GetFace(f)
            places = [grid.GetPoint(face.GetPointId(k)) for k in range(4)]
            if all(abs(p[2]) < 1e-6 for p in places):
                yield places


def areas_of(run):
    """Areas of the contact nodes at the bottom: what hangs between two nodes belongs to both by half."""
    places = [(row["x"], row["y"], row["z"]) for row in run.last()]
    if run.dim == 2:
        x = sorted(p[0] for p in places)
        share = {c: (x[min(i + 1, len(x) - 1)] - x[max(i - 1, 0)]) / 2 for i, c in enumerate(x)}
        return lambda row: share[row["x"]]
    nodes = {tuple(round(c, 5) + 0.0 for c in p): i for i, p in enumerate(places)}

    def node(p):
        return nodes.get(tuple(round(c, 5) + 0.0 for c in p))
    faces = list(corners_below(run.folder))
    edges = [(node(a), node(b)) for face in faces for a, b in zip(face, face[1:] + face[:1])]
    halves = {tuple(round(c, 4) + 0.0 for c in scaled(.5, plus(places[a], places[b]))): (a, b)
              for a, b in edges if None not in (a, b)}
    points, owners, quads = [], [], []
    for face in faces:
        for p in face:
            own = node(p)
            pair = (own, own) if own is not None else halves[tuple(round(c, 4) + 0.0 for c in p)]
            owners.append(pair)
            points.append(scaled(.5, plus(places[pair[0]], places[pair[1]])))
        quads.append(range(len(points) - 4, len(points)))
    areas = dict.fromkeys(places, 0.0)
    for i, area in tributary(points, quads).items():
        for owner in owners[i]:
            areas[places[owner]] += area / 2
    return lambda row: areas[row["x"], row["y"], row["z"]]


def patch(laws):
    def check(what, scene, pressure, strain, areas=None):
        run = laws.run(merge(scene, {"Output": {"VTU": 1}}))
        areas = areas or areas_of(run)
        worst = max(abs(row["r_n"] / areas(row) - pressure) for row in run.rows) / pressure
        laws.check(f"{what}: reaction over tributary area", worst, 1e-12)
        slide = max(math.dist(scaled(strain, (row["x"], row["y"] if run.dim == 3 else 0)),
                              (row["u_t1"], row["u_t2"])) for row in run.rows)
        laws.check(f"{what}: displacement", slide / strain, 1e-12)
        laws.check(f"{what}: friction and gap", max(abs(row["r_t1"]) + abs(row["r_t2"]) + abs(row["gap"])
                                                    for row in run.rows), 1e-12)
        total = sum(row["r_n"] for row in run.rows)
        laws.check(f"{what}: sum", abs(total / pressure - 1), 1e-12)
        laws.check(f"{what}: pull", max(-row["r_n"] for row in run.rows), 0)

    def share(n):
        return lambda c: (.5 if min(c, 1 - c) < 1e-9 else 1) / n

    for plane in ("strain", "stress"):
        body = box((6, 5), (1.0, 1.0))
        body["Material"]["Plane"] = plane
        check(f"2D, plane {plane}", *patch_scene(2, body, (0, 2, 3), plane), lambda row: share(6)(row["x"]))
    check("3D", *patch_scene(3, box((4, 3, 4), (1.0, 1.0, 1.0)), (0, 2, 4, 5)),
          lambda row: share(4)(row["x"]) * share(3)(row["y"]))
    for dim, ids in ((2, (10, 12, 13)), (3, (10, 12, 14, 15))):
        file = laws.folder / f"distorted{dim}.msh"
        points, faces = distorted(file, dim)
        areas = tributary(points, faces)
        by_place = {tuple(round(c, 9) for c in points[i]): a for i, a in areas.items()}
        body = {"Mesh": {"File": file.name}, "Material": {"Young modulus": 1000, "Poisson ratio": .3}}
        check(f"{dim}D, distorted", *patch_scene(dim, body, ids),
              lambda row: by_place[tuple(round(row[c], 9) for c in "xyz")])
        boxes = "0.4, 0 : 0.6, 0.3 : 2" if dim == 2 else "0.2, 0.2, 0 : 0.45, 0.6, 0.3 : 1"
        for element, plane in itertools.product(ELEMENTS, ("strain", "stress")[:4 - dim]):
            hanging = merge(body, {"Element": element, "Mesh": {"Refinement boxes": boxes}, "Material": {"Plane": plane}})
            check(f"{dim}D, {element}, plane {plane}, distorted, hanging nodes",
                  *patch_scene(dim, hanging, ids, plane))
    away = box((4, 4), (1.0, 1.0), **{"Refinement boxes": "0.3, 0.6 : 0.7, 0.9 : 2"})
    check("2D, hanging nodes away from the contact", *patch_scene(2, away, (0, 2, 3)),
          lambda row: share(4)(row["x"]))
    near = box((4, 4, 4), (1.0, 1.0, 1.0), **{"Refinement boxes": "0, 0, 0 : 0.5, 0.5, 0.3 : 1"})
    check("3D, hanging nodes on the contact", *patch_scene(3, near, (0, 2, 4, 5)))


def refinement(laws):
    for dim in (2, 3):
        far = "0.5, 0.6 : 1.5, 1 : 2" if dim == 2 else "0.3, 0.3, 0.6 : 0.8, 0.8, 1 : 1"
        near = "0, 0 : 0.6, 0.3 : 2 ; 1.6, 0 : 2, 0.2 : 3" if dim == 2 else "0, 0, 0 : 0.5, 0.5, 0.3 : 1"
        coarse = press_and_shear(dim, cells=(8, 4) if dim == 2 else (4, 4, 4))
        for name, boxes in (("away", far), ("at the contact", near)):
            run = laws.run(merge(coarse, {"Body block": {"Mesh": {"Refinement boxes": boxes}}}))
            laws.admissible(f"{dim}D, refined {name}", run, lambda row: .3)
            if dim == 3 and name != "away":
                # 5 x 5 nodes, 5 x 5 where refined (x < .75, y < .5), 4 of them hanging
                laws.demand(f"no hanging contact node: {len(run.last())} nodes", len(run.last()) == 25 + 16 - 4)
            run = laws.run(merge(coarse, {"Body block": {"Mesh": {"Refinement boxes": boxes}},
                                          "Support top": {"Stiffness": "5000*(1 + x)"}}))
            laws.admissible(f"{dim}D, on springs, refined {name}", run, lambda row: .3)
        fine = laws.run(merge(coarse, {"Body block": {"Mesh": {"Global refinements": 1}}}))
        everywhere = ("-1, -1 : 3, 2 : 1" if dim == 2 else "-1, -1, -1 : 3, 2, 2 : 1")
        boxed = laws.run(merge(coarse, {"Body block": {"Mesh": {"Refinement boxes": everywhere}}}))
        laws.same(f"{dim}D, one box around all", fine, boxed, 1e-11)
        bottom = 2 if dim == 2 else 4
        beside = laws.run(merge(coarse, {"Body block": {"Mesh": {"Refinement distance": f"{bottom} : 5 : 1"}}}))
        laws.same(f"{dim}D, everything is near the contact", fine, beside, 1e-11)
        near = laws.run(merge(coarse, {"Body block": {"Mesh": {"Refinement distance": f"{bottom} : 0.1 : 1"}}}))
        laws.admissible(f"{dim}D, refined beside the contact", near, lambda row: .3)
        laws.demand(f"all {len(near.last())} contact nodes of the fine mesh", len(near.last()) == len(fine.last()))
    adaptive(laws)


def adaptive(laws):
    """The corners of a punch: fewer dofs than with equal cells for the same forces."""
    def forces(run):
        return [run.increments[-1]["bottom_f_" + c] for c in "xy"]

    coarse, fine, exact = (press_and_shear(2, cells=(n, n // 2), increments=3) for n in (8, 64, 128))
    run = laws.run({"Adaptive refinement": 5, **coarse})
    laws.admissible("adaptive", run, lambda row: .3)
    meshes = read(run.folder / "refinement.csv")
    laws.demand(f"one row for each of {len(meshes)} meshes", [m["mesh"] for m in meshes] == [1, 2, 3, 4, 5, 6])
    laws.check("the first mesh is the scene's", abs(meshes[0]["bottom_n"] - forces(laws.run(coarse))[1]), 1e-10)
    laws.check("the results are those of the last mesh", abs(meshes[-1]["bottom_n"] - forces(run)[1]), 1e-10)
    laws.demand(f"{meshes[-1]['contact_nodes']:g} contact nodes", meshes[-1]["contact_nodes"] == len(run.last()))
    laws.demand("estimates decrease", all(b["estimate"] < a["estimate"] for a, b in zip(meshes, meshes[1:])))
    dofs = 2 * 65 * 33
    laws.demand(f"{meshes[-1]['dofs']:g} dofs, {dofs} of equal cells", 2 * meshes[-1]["dofs"] < dofs)
    target, uniform, local = (forces(r) for r in (laws.run(exact), laws.run(fine), run))
    laws.check(f"error of forces, to {math.dist(uniform, target):.3g} of equal cells",
               math.dist(local, target) / math.dist(uniform, target), .6)

    for name, entries in (("stacked-blocks", ()), ("shrink-fit", ("-s", "Adaptive fraction=0.1"))):
        run = laws.run(SHIPPED / f"{name}.prm", "-s", "Output/VTU=0", "-s", "Adaptive refinement=1", *entries)
        first, last = read(run.folder / "refinement.csv")
        laws.demand(f"{name}: {first['dofs']:g} and {last['dofs']:g} dofs", first["dofs"] < last["dofs"])
    failing = merge(coarse, {"Support top": {"Directions": "y", "Displacement": "-0.01*min(t, 1)"},
                             "Load push": load("traction", "100*max(t - 1, 0) ; 0", 3)})
    done, folder = laws.start({"Adaptive refinement": 1, **failing})
    laws.demand(f"no equilibrium: exit code {done.returncode}: {done.stderr.strip()}", done.returncode == 2)
    laws.demand("the increment before it is on disk", len(read(folder / "increments.csv")) == 1)


def elements(laws):
    plain, averaged, bending = ELEMENTS
    for dim, (poisson, bound) in itertools.product((2, 3), ((.3, 1e-9), (.4999, 1e-7))):
        ratio = {}
        for element in ELEMENTS:
            scene, exact = cantilever(dim, element, poisson, (5, 2, 2)[:dim])
            ratio[element] = deflection(laws.run(scene, bounds=False)) / exact
        what = f"{dim}D, nu = {poisson}, slender cells in bending"
        laws.check(f"{what}: error of {bending}", abs(ratio[bending] - 1), bound)
        laws.check(f"{what}: {plain} deflects too little", ratio[plain], .01 if (dim, poisson) == (2, .4999) else .5)
    fine = deflection(laws.run(cook(laws.folder, averaged, .4999, 32)), 60.0)
    ratio = {element: deflection(laws.run(cook(laws.folder, element, .4999, 8)), 60.0) / fine for element in ELEMENTS}
    for element in (averaged, bending):
        laws.check(f"Cook's membrane, nu = .4999: error of {element}", abs(ratio[element] - 1), .06)
    laws.check(f"Cook's membrane, nu = .4999: {plain} locks", ratio[plain], .3)


def obstacles(laws):
    flat = press_and_shear(2, mu=.4)
    n = unit((.03, 1.0, 0))
    planes = [{"Shape": "half space", "Normal": n[:2], "Point": (0.0, -.002)},
              {"Shape": "prescribed gap", "Normal": (.3, 10.0), "Gap": f"{n[0]!r}*x + {n[1]!r}*(y + 0.002)"},
              {"Shape": "implicit", "Function": "5*(0.03*x + (y + 0.002))"}]
    runs = [laws.run(merge(flat, {"Obstacle floor": None}) | {"Obstacle floor": shape}) for shape in planes]
    laws.same("half space and prescribed gap", runs[0], runs[1], 1e-11)
    laws.same("half space and implicit plane", runs[0], runs[2])

    def block(dim, shape, bottom=None):
        scene = press_and_shear(dim, mu=.3)
        size, cells = ((1.0, .5), (16, 6)) if dim == 2 else ((1.0, 1.0, .5), (6, 6, 3))
        origin = scaled(-.5, size[:-1]) + (bottom if bottom is not None else 1.0,)
        scene["Body block"] = box(cells, size, origin)
        scene["Support top"]["Displacement"] = re.sub(r"-0\.01\*min", "-0.03*min", scene["Support top"]["Displacement"])
        scene["Obstacle floor"] = shape
        return scene

    pairs = (
        ("circle", 2, {"Shape": "sphere", "Radius": 1.0}, {"Function": "sqrt(x^2 + y^2) - 1"}, 1.0),
        ("cylinder in the plane", 2, {"Shape": "cylinder"}, {"Function": "sqrt(x^2 + y^2) - 1"}, 1.0),
        ("sphere", 3, {"Shape": "sphere", "Radius": 1.0}, {"Function": "sqrt(x^2 + y^2 + z^2) - 1"}, 1.0),
        ("cylinder", 3, {"Shape": "cylinder", "Axis": (0, 1, 0)}, {"Function": "sqrt(x^2 + z^2) - 1"}, 1.0),
        ("oblique cylinder", 3, {"Shape": "cylinder", "Axis": (1, 2, 0)},
         {"Function": "sqrt((2*x - y)^2/5 + z^2) - 1"}, 1.0),
        ("inside of a cylinder", 3, {"Shape": "cylinder", "Axis": (0, 1, 0), "Radius": 2.0, "Side": "inside"},
         {"Function": "2 - sqrt(x^2 + z^2)"}, -math.sqrt(4 - .25)),
        ("inside of a circle", 2, {"Shape": "sphere", "Radius": 2.0, "Side": "inside"},
         {"Function": "2 - sqrt(x^2 + y^2)"}, -math.sqrt(4 - .25)))
    for name, dim, shape, function, bottom in pairs:
        a = laws.run(block(dim, shape, bottom))
        b = laws.run(block(dim, {"Shape": "implicit", **function}, bottom))
        laws.demand(f"{name}: {sum(r['state'] != 'open' for r in a.rows)} rows touch",
                    any(r["state"] != "open" for r in a.rows) and any(r["state"] == "open" for r in a.rows))
        laws.same(name, a, b, 1e-9 if dim == 3 else 1e-10)

    # only relative motion counts
    for dim in (2, 3):
        moved = press_and_shear(dim)
        functions = moved["Support top"]["Displacement"].split(";")
        bodies_move = laws.run(moved)
        still = merge(moved, {"Support top": {"Displacement": "0"},
                              "Obstacle floor": {"Displacement": " ; ".join(f"-({f})" for f in functions)}})
        laws.same(f"{dim}D, moving obstacle", bodies_move, laws.run(still), 1e-11)
    held = press_and_shear(3)  # contact nodes whose tangent a support moves
    held["Support front"] = support(2, "y", "0.001*t")
    held["Obstacle floor"]["Displacement"] = "0 ; 0.001*t ; 0"
    held["Support top"]["Displacement"] = "0.004*max(t - 1, 0) ; 0.001*t ; -0.01*min(t, 1)"
    still = merge(held, {"Support front": {"Displacement": "0"}, "Obstacle floor": {"Displacement": "0"},
                         "Support top": {"Displacement": "0.004*max(t - 1, 0) ; 0 ; -0.01*min(t, 1)"}})
    laws.same("3D, all moves along y with a held face", laws.run(held), laws.run(still), 1e-11)


def supports(laws):
    # a bar between a floor and springs: pressure = d / (1/k + H/E)
    young, height, k, d = 1000.0, 1.5, 400.0, .01
    for dim in (2, 3):
        size = (1.0, height) if dim == 2 else (1.0, 1.0, height)
        springs = {"Dimension": dim, "Body block": box((2,) * dim, size), "Output": {"VTU": 0},
                   "Support bottom": support(2 * dim - 2, "x, y, z"[:3 * dim - 2], Stiffness=k),
                   "Load top": load("pressure", "2", 2 * dim - 1)}
        found = laws.run(springs).increments[-1]["support_bottom_f_" + "xyz"[dim - 1]]
        laws.check(f"{dim}D, elastic foundation, no contact", abs(found - 2), 1e-10)
        scene = {"Dimension": dim, "Body block": box((4, 3) if dim == 2 else (2, 2, 3), size, young=young),
                 "Obstacle floor": floor(dim), "Contact bottom": contact(ids=2 * dim - 2),
                 "Support left": support(0, "x"),
                 "Support top": support(2 * dim - 1, "y" if dim == 2 else "z", f"-{d}*t", Stiffness=k),
                 "Output": {"VTU": 0}}
        if dim == 3:
            scene["Support front"] = support(2, "y")
        else:
            scene["Body block"]["Material"]["Plane"] = "stress"
        run = laws.run(scene)
        expected = d / (1 / k + height / young)
        total = sum(row["r_n"] for row in run.rows)
        laws.check(f"{dim}D, elastic foundation, total force", abs(total / expected - 1), 1e-12)
        inner = [row for row in run.rows if 0 < row["x"] < 1 and (dim == 2 or 0 < row["y"] < 1)]
        laws.check(f"{dim}D, elastic foundation, pressure",  # of 4 cells, or of 2 by 2
                   max(abs(row["r_n"] / (1 / 4) / expected - 1) for row in inner), 1e-12)
        normal_springs = merge(scene, {"Support top": {"Directions": "normal"}})
        normal_springs["Support top"]["Displacement"] = f"-{d}*t"
        laws.same(f"{dim}D, springs along the normal", run, laws.run(normal_springs), 1e-12)

    # any directions: u.e = d for each gives the same u
    scene = press_and_shear(2)
    ux, uy = "0.004*max(t - 1, 0)", "-0.01*min(t, 1)"
    first = laws.run(scene)
    a, b = unit((1, 1)), unit((1, -2))
    along = [f"{e[0]!r}*({ux}) + ({e[1]!r})*({uy})" for e in (a, b)]
    oblique = merge(scene, {"Support top": {"Directions": "(1, 1), (1, -2)", "Displacement": " ; ".join(along)}})
    laws.same("directions that are not orthogonal", first, laws.run(oblique), 1e-11)
    two = merge(scene, {"Support top": {"Directions": "(1, 1)", "Displacement": along[0]},
                        "Support more": support(3, "(1, -2)", along[1]),
                        "Support again": support(3, "x", ux)})
    laws.same("several supports that agree", first, laws.run(two), 1e-11)
    springs = merge(oblique, {"Support top": {"Stiffness": "20000"}})
    one = merge(two, {"Support top": {"Stiffness": "20000"}, "Support again": None})
    one["Support more"]["Stiffness"] = "20000"
    laws.same("springs that are not orthogonal", laws.run(springs), laws.run(one), 1e-11)
    space = press_and_shear(3)
    functions = [f.strip() for f in space["Support top"]["Displacement"].split(";")]
    vectors = [unit(v) for v in ((1, 1, 0), (0, 1, -2), (3, 0, 1))]
    along = [" + ".join(f"({c!r})*({f})" for c, f in zip(e, functions)) for e in vectors]
    oblique = merge(space, {"Support top": {"Directions": "(1, 1, 0), (0, 1, -2), (3, 0, 1)",
                                            "Displacement": " ; ".join(along)}})
    laws.same("3D, directions that are not orthogonal", laws.run(space), laws.run(oblique), 1e-11)

    # a belt under a block whose contact nodes supports hold: friction is mu N there too, along the slip
    for dim, held, belt in ((2, "x", (.5, 0)), (3, "x, y", (.3, .4, 0)), (3, "x", (.3, .4, 0))):
        scene = {"Dimension": dim, "Body block": box((4,) * dim, (1.0,) * dim),
                 "Obstacle floor": floor(dim, Displacement=" ; ".join(f"{v}*t" for v in belt)),
                 "Contact bottom": contact(ids=2 * dim - 2, mu=.25), "Support bottom": support(2 * dim - 2, held),
                 "Load top": load("pressure", "2", 2 * dim - 1),
                 "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
        if dim == 3:
            scene["Support top"] = support(5, "x, y")
        last = laws.run(scene).last()
        name = f"{dim}D, a belt, {held} of contact nodes held"
        laws.check(f"{name}: size of friction", abs(sum(math.hypot(row["r_t1"], row["r_t2"]) for row in last) - .5), 1e-9)
        laws.demand(f"{name}: none sticks", all(row["state"] != "stick" for row in last))
        if len(held.split()) == dim - 1:
            total = plus((0, 0, 0), *(in_space(row, dim, REACTION) for row in last))
            laws.check(f"{name}: friction along the belt", math.dist(total[:dim - 1], belt[:dim - 1]), 1e-9)

    # rollers at 30 degrees
    c, s = math.cos(math.pi / 6), math.sin(math.pi / 6)
    straight = {"Dimension": 2, "Body block": box((8, 6), (1.0, 1.0)), "Obstacle floor": floor(2),
                "Contact bottom": contact(mu=.2), "Support right": support(1, "x"),
                "Load left": load("pressure", "2*t", 0), "Load top": load("pressure", "3*t", 3),
                "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    turned = merge(straight, {"Body block": {"Mesh": {"Rotation": 30}},
                              "Obstacle floor": {"Normal": (-s, c)}, "Support right": {"Directions": f"({c!r}, {s!r})"}})
    laws.same("rollers at 30 degrees", laws.run(straight), laws.run(turned), matrix=rotation((0, 0, 1), 30))

    first = laws.run(merge(scene, {"Time": {"Stages": "1 : 1, 3 : 4"}}))
    times = laws.run(merge(scene, {"Time": {"Times": "1, 1.5, 2, 2.5, 3"}}))
    laws.same("stages and times", first, times, 0)
    equal = laws.run(merge(scene, {"Time": {"End": 3, "Increments": 3}}))
    laws.same("End and Increments", equal, laws.run(merge(scene, {"Time": {"Stages": "3 : 3"}})), 0)
    table = [row["time"] for row in first.increments]
    laws.demand(f"times {table}", table == [1, 1.5, 2, 2.5, 3])


def loads(laws):
    thickness, n, p = .5, 8, 6.0
    base = {"Dimension": 2, "Body block": box((n, 4), (2.0, 1.0)), "Obstacle floor": floor(2),
            "Contact bottom": contact(mu=.3), "Support left": support(0, "x"), "Output": {"VTU": 0}}
    base["Body block"]["Material"]["Thickness"] = thickness
    share = [p * 2 / n * thickness * (.5 if i in (0, n) else 1) for i in range(n + 1)]
    variants = {
        "traction": {"Load a": load("traction", f"0 ; -{p}", 3)},
        "pressure": {"Load a": load("pressure", p, 3)},
        "two halves": {"Load a": load("pressure", .25 * p, 3), "Load b": load("traction", f"0 ; -{.75 * p}", 3)},
        "point forces": {f"Load p{i}": load("point force", f"0 ; {-f!r}", Point=(2.0 * i / n, 1.0))
                         for i, f in enumerate(share)},
        "point forces between nodes": {f"Load p{i}": load("point force", f"0 ; {-p * 2 / n * thickness!r}",
                                                          Point=(2.0 * (i + .5) / n, 1.0)) for i in range(n)}}
    runs = {name: laws.run({**base, **entries}) for name, entries in variants.items()}
    for name, run in runs.items():
        laws.same(f"traction and {name}", runs["traction"], run, 1e-12)
        row = run.increments[-1]
        laws.check(f"{name}: resultant", math.dist((row["loads_f_x"], row["loads_f_y"], row["loads_m_z"]),
                                                   (0, -2 * p * thickness, -2 * p * thickness)), 1e-11)

    # integrals over [0, 2] x [0, 1] of (1 + y, -x): forces 3, -2; moment of x f_y - y f_x: -8/3 - 5/3
    body = laws.run({**base, "Load weight": load("body force", "1 + y ; -x - 5"), "Load top": load("pressure", p, 3)})
    row = body.increments[-1]
    expected = (3 * thickness, (-2 - 10 - 2 * p) * thickness, (-8 / 3 - 10 - 5 / 3 - 2 * p) * thickness)
    laws.check("2D body force: resultant", math.dist((row["loads_f_x"], row["loads_f_y"], row["loads_m_z"]), expected),
               1e-11)
    # a unit cube under (y, 0, -x): forces 1/2, 0, -1/2; moments (y f_z, z f_x - x f_z, -y f_x)
    cube = {"Dimension": 3, "Body block": box((3, 3, 3), (1.0, 1.0, 1.0)), "Obstacle floor": floor(3),
            "Contact bottom": contact(ids=4, mu=.3), "Support top": support(5, "x, y, z", "0 ; 0 ; -0.01"),
            "Load weight": load("body force", "y ; 0 ; -x"), "Output": {"VTU": 0}}
    row = laws.run(cube).increments[-1]
    found = [row[f"loads_{kind}_{axis}"] for kind in "fm" for axis in "xyz"]
    laws.check("3D body force: resultant", math.dist(found, (.5, 0, -.5, -.25, .25 + 1 / 3, -1 / 3)), 1e-12)
    point = merge(cube, {"Load weight": None,
                         "Load point": load("point force", "0.1 ; 0.2 ; -0.3", Point=(.35, .8, .55))})
    row = laws.run(point).increments[-1]
    found = [row[f"loads_{kind}_{axis}"] for kind in "fm" for axis in "xyz"]
    force = (.1, .2, -.3)
    laws.check("3D point force: resultant", math.dist(found, (*force, *cross((.35, .8, .55), force))), 1e-12)
    push = merge(cube, {"Load weight": None, "Load side": load("pressure", "1 + z", 1)})
    row = laws.run(push).increments[-1]
    found = [row[f"loads_{kind}_{axis}"] for kind in "fm" for axis in "xyz"]
    laws.check("3D pressure: resultant", math.dist(found, (-1.5, 0, 0, 0, -1 / 2 - 1 / 3, .75)), 1e-12)


def friction(laws):
    mu = "0.1 + 0.2*x"
    run = laws.run(press_and_shear(2, mu=mu))
    laws.admissible("2D, mu(x)", run, lambda row: .1 + .2 * row["x"])
    run = laws.run(press_and_shear(3, mu=mu + " + 0.1*y"))
    laws.admissible("3D, mu(x, y)", run, lambda row: .1 + .2 * row["x"] + .1 * row["y"])
    split = press_and_shear(2, mu=".1")
    split["Body block"]["Mesh"]["Boundary ids"] = "8: y < 1e-9 && x > 1"
    split["Contact right"] = contact(ids=8, mu=.3)
    done, _ = laws.start(split)
    laws.demand("two contacts with one obstacle on the node between them are refused", done.returncode == 1)

    isotropic = press_and_shear(3)
    first = laws.run(isotropic)
    laws.admissible("3D", first, lambda row: .3)
    for angle in (0, 33.3):
        both = merge(isotropic, {"Contact bottom": {"Second friction coefficient": .3, "Friction angle": angle}})
        laws.same(f"two equal coefficients at {angle} degrees", first, laws.run(both), 1e-9)

    mu1, mu2, angle = .4, .15, 25.0
    elliptic = merge(isotropic, {"Contact bottom": {"Friction coefficient": mu1, "Second friction coefficient": mu2,
                                                    "Friction angle": angle}})
    first = laws.run(elliptic)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    outside = slack = across = 0.0
    size, length = first.largest("r_n"), first.largest(*MOTION)
    for row in first.rows:
        r = (c * row["r_t1"] + s * row["r_t2"]) / mu1, (c * row["r_t2"] - s * row["r_t1"]) / mu2
        du = (c * row["du_t1"] + s * row["du_t2"]) * mu1, (c * row["du_t2"] - s * row["du_t1"]) * mu2
        outside = max(outside, math.hypot(*r) - row["r_n"])
        if row["state"] == "slip":
            slack = max(slack, abs(math.hypot(*r) - row["r_n"]))
            across = max(across, abs(r[0] * du[1] - r[1] * du[0]), dot(r, du))
    laws.check("elliptic cone: outside", outside / size, 1e-9)
    laws.check("elliptic cone: slip inside", slack / size, 1e-9)
    laws.check("elliptic cone: slip across its normal", across / (size * length), 1e-9)
    swapped = merge(elliptic, {"Contact bottom": {"Friction coefficient": mu2, "Second friction coefficient": mu1,
                                                  "Friction angle": angle - 90}})
    laws.same("axes swapped, 90 degrees less", first, laws.run(swapped), 1e-9)
    turn = 41.0
    m = rotation((0, 0, 1), turn)
    turned = merge(elliptic, {"Body block": {"Mesh": {"Rotation": turn}},
                              "Contact bottom": {"Friction angle": angle + turn},
                              "Support top": {"Directions": ", ".join(f"({text(tuple(row[d] for row in m))})"
                                                                      for d in range(3))}})
    laws.same("elliptic cone turned with the scene", first, laws.run(turned), 1e-9, matrix=m)

    # without lateral strain a plane state is exact: friction acts along the motion alone
    for axis, mu in enumerate((mu1, mu2)):
        scene = press_and_shear(3, poisson=0.0)
        scene["Contact bottom"].update({"Friction coefficient": mu1, "Second friction coefficient": mu2})
        parts = ["0", "0", "-0.01*min(t, 1)"]
        parts[axis] = "0.2*max(t - 1, 0)"
        scene["Support top"]["Displacement"] = " ; ".join(parts)
        rows = [row for row in laws.run(scene).last() if row["r_n"] > 0]
        names = (("r_t1", "r_t2"), ("r_t2", "r_t1"))[axis]
        size = max(row["r_n"] for row in rows)
        laws.demand(f"sheared along axis {axis + 1}: all slip", all(row["state"] == "slip" for row in rows))
        laws.check(f"sheared along axis {axis + 1}: friction",
                   max(abs(row[names[0]] + mu * row["r_n"]) + abs(row[names[1]]) for row in rows) / size, 1e-10)

    for dim in (2, 3):
        scene = press_and_shear(dim, mu=0)
        scene["Obstacle floor"] = {"Shape": "prescribed gap", "Normal": (0, 1) if dim == 2 else (0, 0, 1),
                                   "Gap": "0.02*(x - 1)"}
        runs = {name: laws.run(scene, "-s", f"Solver/Method={name}") for name in
                ("automatic", "smoothing", "active set", "gauss-seidel")}
        first = runs.pop("automatic")
        laws.admissible(f"{dim}D, mu = 0", first)
        laws.check(f"{dim}D, mu = 0: friction", first.largest("r_t1", "r_t2"), 0)
        for name, run in runs.items():
            laws.same(f"{dim}D, mu = 0, {name}", first, run, 1e-8, states=False)
        last = laws.run(scene, "-s", "Time/Times=4")
        direct = [row for row in first.rows if row["increment"] == 4]
        size = max(row["r_n"] for row in direct)
        laws.check(f"{dim}D, mu = 0: no memory of the path",
                   max(abs(a["r_n"] - b["r_n"]) for a, b in zip(direct, last.rows)) / size, 1e-10)
        small = laws.run(merge(scene, {"Contact bottom": {"Friction coefficient": 1e-13}}))
        laws.same(f"{dim}D, mu = 1e-13", first, small, 1e-9, states=False)


def bodies(laws):
    for dim in (2, 3):
        left = press_and_shear(dim)
        right = press_and_shear(dim, mu=.5, young=70.0)
        shift = (5.0,) + (0.0,) * (dim - 1)
        right["Body block"]["Mesh"]["Translation"] = shift
        right["Support top"]["Displacement"] = re.sub(r"0\.004", "-0.003", right["Support top"]["Displacement"])
        other = {"Body other": right["Body block"], "Contact other": {**right["Contact bottom"], "Body": "other"},
                 "Support other": {**right["Support top"], "Body": "other"}}
        both = laws.run({**left, **other})
        for name, alone, start in (("first", laws.run(left), 0), ("second", laws.run(right), 4)):
            part = Run(both.folder)
            part.rows = [row for row in both.rows if (row["x"] > 4) == (start > 0)]
            laws.same(f"{dim}D, {name} body", alone, part, 1e-12)


def in_corner(dim, mu, pressures, supports=None, side_mu=None, turned=0.0, cells=3):
    """A block in the corner of dim walls, pressed against each of them; its edges stand in several contacts."""
    axes = "xyz"[:dim]
    scene = {"Dimension": dim, "Body block": box((cells,) * dim, (1.0,) * dim),
             "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    for k, axis in enumerate(axes):
        normal = tuple(float(i == k) for i in range(dim))
        if turned:
            c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
            normal = (c * normal[0] - s * normal[1], s * normal[0] + c * normal[1]) + normal[2:]
        scene[f"Obstacle {axis}"] = {"Shape": "half space", "Normal": normal}
        scene[f"Contact {axis}"] = contact(ids=2 * k, obstacle=axis, mu=mu if k == dim - 1 or side_mu is None else side_mu)
        scene[f"Load {axis}"] = load("pressure", f"{pressures[k]}*t", 2 * k + 1)
    if turned:
        scene["Body block"]["Mesh"]["Rotation"] = turned if dim == 2 else (0, 0, 1, turned)
    return {**scene, **(supports or {})}


def corners(laws):
    """Nodes in two and three contacts: floating and held, with closed forms."""
    for dim in (2, 3):
        pressures = (1.0, 2.0, 3.0)[:dim]
        bottom = "xyz"[dim - 1]
        share = 1 / 3 ** (dim - 1)  # of a cell's face
        for turned in (0.0, 30.0):
            run = laws.run(in_corner(dim, 0, pressures, turned=turned))
            worst = 0.0
            for row in run.last():
                at = [row["x"], row["y"], row["z"]]
                if turned:
                    c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
                    at[:2] = [c * at[0] + s * at[1], -s * at[0] + c * at[1]]
                k = "xyz".index(row["contact"])
                part = math.prod(.5 if min(at[i], 1 - at[i]) < 1e-9 else 1.0 for i in range(dim) if i != k)
                worst = max(worst, abs(row["r_n"] - 2 * pressures[k] * share * part))
            laws.check(f"{dim}D, frictionless corner turned by {turned:g}: each reaction is its share of the pressure",
                       worst, 1e-10)
            laws.demand(f"{dim}D: the corner has a row in each contact",
                        sum(math.dist((row["x"], row["y"], row["z"]), (0, 0, 0)) < 1e-12 for row in run.last()) == dim)
        for mu in (.2, .8):
            run = laws.run(in_corner(dim, mu, pressures))
            laws.admissible(f"{dim}D, corner, mu {mu}", run, lambda row: mu)
            found = plus((0, 0, 0), *(in_space(row, dim, REACTION) for row in run.last()))
            laws.check(f"{dim}D, corner, mu {mu}: reactions balance the pressures",
                       math.dist(found, scaled(2, pressures + (0,) * (3 - dim))), 1e-10)
            held = {"Support hold": support(2 * dim - 1, ", ".join("xyz"[:dim]), Stiffness=1.0)}
            run = laws.run(in_corner(dim, mu, pressures, held))
            laws.admissible(f"{dim}D, corner, mu {mu}, on springs", run, lambda row: mu)

        # pulled out along the bottom against friction of the bottom alone, or of the wall besides
        for side_mu in (0.0, .4):
            weight, squeeze, mu = 2.0, 1.0, .3
            limit = mu * weight + side_mu * squeeze * (dim == 3)
            for share_of_limit, rightly in ((.98, True), (1.02, False)):
                scene = in_corner(dim, mu, (0.0, weight) if dim == 2 else (0.0, squeeze, weight), side_mu=side_mu)
                scene["Contact x"]["Friction coefficient"] = 0
                scene["Load x"] = load("body force", " ; ".join([f"{share_of_limit * limit / 2!r}*t"] + ["0"] * (dim - 1)))
                scene["Load " + bottom] = load("pressure", f"{weight / 2}*t", 2 * dim - 1)
                if dim == 3:
                    scene["Load y"] = load("pressure", f"{squeeze / 2}*t", 3)
                done, _ = laws.start(scene)
                laws.demand(f"{dim}D, wall of mu {side_mu}: pulled out of the corner at {share_of_limit} of the limit "
                            f"{'holds' if rightly else 'moves'}", done.returncode == (0 if rightly else 2))

    # a disc in a groove of 90 degrees: its nodes meet both walls
    groove = {"Dimension": 2,
              "Body disc": {"Mesh": {"Generator": "hyper_ball", "Arguments": "0, 0 : 1 : false", "Global refinements": 3,
                                     "Rotation": 45},
                            "Material": {"Young modulus": 1e5, "Poisson ratio": .3}},
              "Obstacle left": {"Normal": (1, 1), "Point": (-math.sqrt(.5), -math.sqrt(.5))},
              "Obstacle right": {"Normal": (-1, 1), "Point": (math.sqrt(.5), -math.sqrt(.5))},
              "Contact left": contact("disc", 0, "left"), "Contact right": contact("disc", 0, "right"),
              "Load weight": load("body force", "0 ; -1*t", body="disc"), "Output": {"VTU": 0}}
    last = laws.run(groove).increments[-1]
    weight = -last["loads_f_y"]
    for side, sign in (("left", 1), ("right", -1)):
        found = (last[f"{side}_f_x"], last[f"{side}_f_y"])
        laws.check(f"disc in a groove, {side} wall carries W/sqrt(2)",
                   math.dist(found, (sign * weight / 2, weight / 2)) / weight, 1e-10)


def stack(dim, cells, heights, mu, joint_mu, side="0.002*max(t - 1, 0)"):
    """Blocks one on the other, cells[i] along all axes each, pressed and sheared."""
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    scene = {"Dimension": dim, "Obstacle floor": floor(dim), "Contact bottom": contact("block 0", bottom, mu=mu)}
    below = 0.0
    for i, (n, height) in enumerate(zip(cells, heights)):
        size = (2.0, height) if dim == 2 else (1.5, 1.0, height)
        origin = (0.0, below) if dim == 2 else (0.0, 0.0, below)
        scene[f"Body block {i}"] = box(n, size, origin)
        below += height
        if i > 0:
            scene[f"Contact joint {i}"] = {"Body": f"block {i}", "Boundary ids": bottom,
                                           "Master body": f"block {i - 1}", "Master boundary ids": top,
                                           "Friction coefficient": joint_mu}
    down = "-0.01*min(t, 1)"
    return {**scene, "Support top": support(top, "x, y" if dim == 2 else "x, y, z",
                                            f"{side} ; {down}" if dim == 2 else f"{side} ; 0 ; {down}",
                                            f"block {len(cells) - 1}"),
            "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}


def pairs(laws):
    for dim in (2, 3):
        half, whole = ((10, 5), (10, 10)) if dim == 2 else ((4, 3, 2), (4, 3, 4))
        two = laws.run(stack(dim, (half, half), (1.0, 1.0), .3, 100.0))
        one = laws.run(stack(dim, (whole,), (2.0,), .3, 0))
        laws.demand(f"{dim}D: the joint sticks", all(row["state"] == "stick" for row in two.rows if row["contact"] == "joint 1"))
        two.rows = [row for row in two.rows if row["contact"] == "bottom"]
        laws.same(f"{dim}D: two blocks glued by friction are one", one, two)

        # meshes that do not match, flat: the sums are exact, single values of node to segment are not
        fine = ((10, 5), (7, 4), (9, 6)) if dim == 2 else ((4, 3, 2), (3, 4, 2), (4, 4, 2))
        worst = action = 0.0
        for mu in (.05, .2, .5, 1.0, 2.0):
            run = laws.run(stack(dim, fine, (1.0, .7, .9), .4, mu))
            last = run.increments[-1]
            size = max(abs(last[f"joint_1_f_{c}"]) for c in "xyz")
            worst = max([worst] + [row[f"balance_block_{i}"] for row in run.increments for i in range(3)])
            action = max([action] + [abs(last[f"joint_{j}_f_{c}"] + last[f"joint_{j}_master_f_{c}"]) / size
                                     for j in (1, 2) for c in "xyz"])
        laws.check(f"{dim}D: balance of each body of a stack", worst, 1e-10)
        laws.check(f"{dim}D: action is reaction", action, 1e-12)

        # uniform pressure through a joint, matching and not
        # nodal values of node to face swing where meshes do not match: the README's figures
        for name, upper, bound in (("matching", half, 1e-12), ("not matching", fine[1], (.145, .215)[dim - 2])):
            scene = stack(dim, (half, upper), (1.0, 1.0), 0, 0)
            roller = {"Support low": support((0, 2) if dim == 3 else 0, "normal", body="block 0"),
                      "Support high": support((0, 2) if dim == 3 else 0, "normal", body="block 1")}
            if dim == 3:
                for key in ("Support low", "Support high"):
                    roller[key]["Boundary ids"] = "0, 2"
            scene.pop("Support top")
            run = laws.run({**scene, **roller, "Load top": load("pressure", "2", 3 if dim == 2 else 5, "block 1"),
                            "Time": {"End": 1, "Increments": 1}})
            for what, found in joint_errors(run, dim, 2.0).items():
                laws.check(f"{dim}D: {what} of a flat joint, {name} meshes", found, 1e-10)
            error = max(abs(row["r_n"] / share - 2) / 2 for row, share in joint_shares(run, dim, upper))
            laws.check(f"{dim}D: pressure in a flat joint, {name} meshes", error, bound)

    ring = laws.run(SHIPPED / "shrink-fit.prm", "-s", "Output/VTU=0")
    mean = sum(row["r_n"] for row in ring.rows if row["contact"] == "joint") / math.pi
    laws.check("shrink fit: mean pressure against Lame", abs(mean / .234375 - 1), 1e-3)


def joint_errors(run, dim, pressure):
    """Forces of both sides of joint 1 against those of a uniform pressure, and the sum of their moments.

    The moment of one side alone is not known: rollers take what the swinging nodal forces leave."""
    area = 2.0 if dim == 2 else 1.5
    up = (0.0,) * (dim - 1) + (1.0,) + (0.0,) * (3 - dim)
    totals, moment = {}, (0, 0, 0)
    for contact in ("joint 1", "joint 1_master"):
        rows = [row for row in run.last() if row["contact"] == contact]
        forces = [in_space(row, dim, REACTION) for row in rows]
        totals[contact] = plus((0, 0, 0), *forces)
        moment = plus(moment, *(cross((row["x"], row["y"], row["z"]), f) for row, f in zip(rows, forces)))
    size = pressure * area
    return {"force on the body": math.dist(totals["joint 1"], scaled(size, up)) / size,
            "force on the master": math.dist(totals["joint 1_master"], scaled(-size, up)) / size,
            "moments of both sides": math.sqrt(dot(moment, moment)) / (2 * size)}


def joint_shares(run, dim, cells):
    """Rows of joint 1 with the nodes' shares of its area."""
    size = (2.0,) if dim == 2 else (1.5, 1.0)
    for row in run.rows:
        if row["contact"] == "joint 1":
            share = 1.0
            for c, length, n in zip("xy", size, cells):
                rim = min(row[c], length - row[c]) < 1e-9
                share *= length / n * (.5 if rim else 1)
            yield row, share


def threads(laws):
    scene = press_and_shear(3, cells=(9, 9, 9))
    first = laws.run(scene)
    laws.same("four threads", first, laws.run(scene, "-s", "Solver/Threads=4"), 1e-12)
    for name, tree in (("3D", merge(scene, {"Output": {"VTU": 2}})),
                       ("2D", merge(press_and_shear(2), {"Output": {"VTU": 1}}))):
        one, two = laws.run(tree).folder, laws.run(tree).folder
        files = [sorted(p.name for p in folder.iterdir()) for folder in (one, two)]
        laws.demand(f"{name}: the same {len(files[0])} files", files[0] == files[1])
        other = [f for f in files[0] if f != "log.txt" and without_date(one / f) != without_date(two / f)]
        laws.demand(f"{name}: the same to the bit" + (", not: " + ", ".join(other) if other else ""), not other)


def without_date(file):
    return re.sub(rb"<!--.*?-->", b"", file.read_bytes(), flags=re.S)


def readable(laws, folder, what, quiet=False):
    """Every table and picture on disk is whole."""
    faults = []
    tables = {}
    for name in ("increments.csv", "reactions.csv", "events.csv"):
        file = folder / name
        if not file.exists():
            continue
        content = file.read_text()
        if content and not content.endswith("\n"):
            faults.append(f"{name} ends within a line")
        rows = list(csv.reader(content.splitlines()))
        if any(len(row) != len(rows[0]) for row in rows):
            faults.append(f"{name} has incomplete rows")
        tables[name] = [row[0] for row in rows[1:]]
    written = tables.get("increments.csv", [])
    if written != [str(k + 1) for k in range(len(written))]:
        faults.append("increments have holes")
    seen = tables.get("reactions.csv", [])
    counts = [seen.count(k) for k in dict.fromkeys(seen)]
    if list(dict.fromkeys(seen)) != [str(k + 1) for k in range(len(counts))] or len(set(counts)) > 1:
        faults.append("reactions have holes")
    if abs(len(counts) - len(written)) > TOGETHER:  # a kill between their two renames
        faults.append(f"{len(counts)} increments of reactions, {len(written)} of resultants")
    pictures = 0
    for file in folder.glob("*.*"):
        if file.suffix in (".vtu", ".pvd"):
            try:
                root = xml.etree.ElementTree.parse(file).getroot()
            except xml.etree.ElementTree.ParseError as error:
                faults.append(f"{file.name}: {error}")
                continue
            pictures += file.suffix == ".vtu"
            missing = [d.get("file") for d in root.iter("DataSet") if not (folder / d.get("file")).exists()]
            if missing:
                faults.append(f"{file.name} names {missing[0]}, which is not there")
    if not quiet or faults:
        laws.demand(f"{what}: {len(written)} increments, {pictures} pictures"
                    + "".join("; " + fault for fault in faults), not faults)
    return len(written)


def rows_on_disk(folder):
    """Finished increments in the table, 0 before there is one."""
    try:
        return max(0, (folder / "increments.csv").read_text().count("\n") - 1)
    except FileNotFoundError:
        return 0


def kill_at(laws, file, n, name):
    """Kills the program as soon as n increments are on disk; how many there are then, None if it ended before."""
    folder = laws.folder / name
    process = subprocess.Popen([laws.program, file, "-o", folder, "--quiet"], cwd=laws.folder)
    while process.poll() is None and rows_on_disk(folder) < n:
        time.sleep(.001)
    process.kill()
    if process.wait() != -signal.SIGKILL:
        return None
    return readable(laws, folder, f"killed at increment {n}", quiet=True) if folder.exists() else 0


def kill(laws):
    scene = merge(press_and_shear(3, cells=(7, 7, 7), increments=120), {"Output": {"VTU": 1}})
    scene["Support top"]["Displacement"] = "0.001*max(t - 1, 0) ; 0 ; -0.01*min(t, 1)"
    file = laws.folder / "kill.prm"
    write_scene(scene, file)
    for n in (0, 1, 2, TOGETHER + 1, 40, 70):
        found = kill_at(laws, file, n, f"kill-{n}")
        laws.demand(f"kill -9 when {n} increments are on disk: {found}", found is not None and n <= found < 120)

    path = laws.folder / "kill-path.prm"
    write_scene(merge(pushed_block(2, .6, .5, cells=(80, 40)), {"Output": {"VTU": 1}}), path)
    whole = len(laws.run(path).increments)
    for n in (0, 1, 2, whole // 2):
        found = kill_at(laws, path, n, f"kill-path-{n}")
        laws.demand(f"kill -9 when {n} of {whole} points of a load path are on disk: {found}",
                    found is not None and n <= found < whole)

    def limit(size):
        def set_limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        return set_limit
    for size in (100, 2000, 30000, 100000):
        # Python ignores SIGXFSZ and hands that on
        done, folder = laws.start(file, preexec_fn=limit(size), restore_signals=False)
        laws.demand(f"files up to {size} bytes: exit code {done.returncode}: {done.stderr.strip()}",
                    done.returncode == 3 and done.stderr.count("\n") == 1)
        readable(laws, folder, f"files up to {size} bytes")
        laws.demand("nothing half written is left", not list(folder.glob("*.tmp")))

    full_disk(laws, file)

    in_the_way = laws.folder / "file"
    in_the_way.write_text("")
    for folder in (in_the_way, in_the_way / "sub", Path("/proc/conetact")):
        done = subprocess.run([laws.program, file, "-o", folder, "--quiet"], cwd=laws.folder, capture_output=True,
                              text=True)
        laws.demand(f"-o {folder.name}: exit code {done.returncode}: {done.stderr.strip()}",
                    done.returncode == 3 and done.stderr.count("\n") == 1)


def full_disk(laws, file):
    """A device that is always full, and where one can be mounted a small disk that fills up."""
    for table in ("reactions.csv", "increments.csv"):
        folder = laws.folder / f"full-{table}"
        folder.mkdir()
        for name in (f"{table}.tmp", f"{table}.tmp.tmp"):  # tables are written under such a name first
            (folder / name).symlink_to("/dev/full")
        done = subprocess.run([laws.program, file, "-o", folder, "--quiet"], cwd=laws.folder, capture_output=True,
                              text=True)
        laws.demand(f"full device below {table}: exit code {done.returncode}: {done.stderr.strip()}",
                    done.returncode == 3 and done.stderr.count("\n") == 1)
    disk, copy = laws.folder / "disk", laws.folder / "copy"
    disk.mkdir()
    command = 'mount -t tmpfs -o size=512k tmpfs "$1" || exit 77; "$2" "$3" -o "$1/result" --quiet; e=$?; ' \
              'mkdir "$4"; cp "$1"/result/* "$4"; exit $e'
    done = subprocess.run(["unshare", "-rm", "sh", "-c", command, "sh", disk, laws.program, file, copy],
                          capture_output=True, text=True)
    if done.returncode == 77 or "unshare" in done.stderr:
        print(f"  SKIPPED: no small disk can be mounted here: {done.stderr.strip()}")
        return
    laws.demand(f"full disk: exit code {done.returncode}: {done.stderr.strip()}", done.returncode == 3)
    laws.demand("full disk: some increments", readable(laws, copy, "full disk") > 0)


def hertz(laws):
    radius, force, young, poisson = 10.0, 10.0, 1000.0, .3
    half = math.sqrt(4 * force * radius * (1 - poisson**2) / (math.pi * young))
    peak = 2 * force / (math.pi * half)
    run = laws.run(SHIPPED / "cylinder-on-plane.prm", "-s", "Output/VTU=0")
    rows = sorted(run.last(), key=lambda row: row["x"])
    laws.check("cylinder: total force", abs(sum(row["r_n"] for row in rows) / force - 1), 1e-10)
    x = [row["x"] for row in rows]
    stress = [2 * rows[i]["r_n"] / (x[i + 1] - x[i - 1]) for i in range(1, len(rows) - 1)]
    laws.check("cylinder: largest pressure", abs(max(stress) / peak - 1), .02)
    # the square of the pressure is linear in x^2: the width from its moments, <x^2> = a^2/4
    spread = math.sqrt(4 * sum(row["r_n"] * row["x"]**2 for row in rows) / force)
    laws.check("cylinder: half width from the spread", abs(spread / half - 1), .02)
    touching = [row["x"] for row in rows if row["r_n"] > 0]
    cell = min(b - a for a, b in zip(x, x[1:]))
    laws.check("cylinder: half width from the last nodes, in cells",
               abs((touching[-1] - touching[0]) / 2 - half) / cell, 1.5)
    profile = max(abs(s - peak * math.sqrt(max(0, 1 - (row["x"] / half)**2)))
                  for s, row in zip(stress, rows[1:-1]) if abs(row["x"]) < .8 * half)
    laws.check("cylinder: pressure over the inner 80 %", profile / peak, .03)

    # a sphere on a plane: a quarter of a half ball, 1/4 of the force
    force, radius = 100.0, 10.0
    half = (3 * force * radius * (1 - poisson**2) / (4 * young))**(1 / 3)
    peak = 3 * force / (2 * math.pi * half**2)
    scene = {"Dimension": 3,
             "Body block": {"Mesh": {"Generator": "quarter_hyper_ball", "Arguments": "0, 0, 0 : 10",
                                     "Global refinements": 2, "Rotation": (0, 1, 0, 90), "Translation": (0, 0, radius),
                                     "Refinement boxes": "-3, -3, 0 : 3, 3, 2 : 2",
                                     "Boundary ids": "2: z < 2 && x^2 + y^2 > 0 && abs(x) > 1e-3 && abs(y) > 1e-3 && "
                                                     "x^2 + y^2 < 2.5^2; 4: abs(x) < 1e-9; 5: abs(y) < 1e-9; "
                                                     "6: z > 9.999999"},
                            "Material": {"Young modulus": young, "Poisson ratio": poisson}},
             "Obstacle floor": floor(3), "Contact bottom": contact(ids=2),
             "Support x": support(4, "x"), "Support y": support(5, "y"),
             "Load top": load("pressure", force / (math.pi * radius**2), 6), "Output": {"VTU": 0}}
    run = laws.run(scene)
    total = sum(row["r_n"] for row in run.rows)
    area = -run.increments[-1]["loads_f_z"]
    laws.check("sphere: total force", abs(total / area - 1), 1e-10)
    # <x^2 + y^2> = 2/5 a^2 under Hertz's pressure
    spread = math.sqrt(2.5 * sum(row["r_n"] * (row["x"]**2 + row["y"]**2) for row in run.rows) / total)
    laws.check(f"sphere: contact radius from the spread ({spread:.4g}, Hertz {half:.4g})", abs(spread / half - 1), .05)
    centre = max(run.rows, key=lambda row: -math.hypot(row["x"], row["y"]))
    laws.demand("sphere: the first node touches", centre["r_n"] > 0)


class Events:
    """events.csv of a load path and the records that belong to it."""

    def __init__(self, folder):
        with open(folder / "events.csv", newline="") as stream:
            *rows, outcome = csv.DictReader(stream)
        if outcome["event"] != "outcome":
            raise RuntimeError(f"events.csv does not end with the outcome but with {outcome}")
        self.parameter, self.words = float(outcome["parameter"]), outcome["to"]
        self.at, self.nodes = [], []
        for row in rows:
            if int(row["event"]) > len(self.at):
                self.at.append(float(row["parameter"]))
                self.nodes.append([])
            self.nodes[-1].append((row["node"], row["from"], row["to"]))


def pushed_block(dim, height, mu, angle=0.0, cells=None, weight=2000.0, **entries):
    """A block 2 wide [2 deep] and 1 high on a floor, pushed by p times its weight at a height."""
    width = 2.0 if dim == 2 else 4.0
    cells = cells or ((8, 4) if dim == 2 else (4, 4, 2))
    force = (weight * math.cos(angle), weight * math.sin(angle), 0.0)[:dim] if dim == 3 else (weight, 0.0)
    down = (0.0,) * (dim - 1) + (-weight / width,)
    scene = {"Dimension": dim,
             "Body block": box(cells, (2.0, 1.0) if dim == 2 else (2.0, 2.0, 1.0),
                               None if dim == 2 else (-1.0, -1.0, 0.0), young=1e6),
             "Obstacle floor": floor(dim), "Contact bottom": contact(ids=2 if dim == 2 else 4, mu=mu),
             "Load weight": load("body force", " ; ".join(map(text, down))),
             "Load push": load("point force", " ; ".join(f"{text(f)}*t" for f in force),
                               Point=(0.0,) * (dim - 1) + (height,)),
             "Time": {"Times": 2}, "Solver": {"Method": "load path"}, "Output": {"VTU": 0}}
    return merge(scene, entries)


def path_in_space(laws):
    for degrees in (0, 17, 45, 110):
        angle = math.radians(degrees)
        run = laws.run(pushed_block(3, .2, .5, angle))
        events = Events(run.folder)
        laws.check(f"block pushed low at {degrees} degrees: limit load", abs(events.parameter - .5), 1e-6)
        laws.demand("  it slides: " + events.words, events.words == "limit load: sliding")
        run = laws.run(pushed_block(3, .9, 2.0, angle))
        events = Events(run.folder)
        limit = 1 / (.9 * max(abs(math.cos(angle)), abs(math.sin(angle))))
        laws.check(f"block pushed high at {degrees} degrees: limit load", abs(events.parameter / limit - 1), 1e-6)
        laws.demand("  it tips: " + events.words, events.words == "limit load: tipping")
        laws.admissible("  records", run, lambda row: 2.0)
    for mu in (.7, 1.2):
        run = laws.run(SHIPPED / "double-layer-grid-04.prm", "-s", "Solver/Method=load path", "-s", "Time/End=3",
                       "-s", "Load thrust/Value=4e-4/6*t ; 2e-4/6*t ; -4e-4/6", "-s", "Output/VTU=0",
                       "-s", f"Contact feet/Friction coefficient={mu}")
        events = Events(run.folder)
        laws.check(f"grid, mu = {mu}: side over vertical load at the limit",
                   abs(events.parameter * math.sqrt(5) / 2 - mu), 1e-6)
        laws.demand("  it slides: " + events.words, events.words == "limit load: sliding")


def entries(**values):
    """-s options from Section__Sub_section__Entry=value."""
    return [word for name, value in values.items()
            for word in ("-s", name.replace("__", "/").replace("_", " ") + f"={value}")]


PATH = entries(Solver__Method="load path", Output__VTU=0)


def path_bar(laws):
    """[P] Example 2: the nodes slip one by one from the end, p_j = f q h (j + 1/2) / F."""
    bar = entries(Load_weight__Value="0 ; -3975", Load_pull__Value="243750*t ; 0", Time__End=1.3,
                  Time__Increments=1)
    for n in (5, 10, 20, 40, 80, 160):
        length = 260 / (n - 1)
        run = laws.run(SHIPPED / "bar-on-rigid-base.prm", *PATH, *bar,
                       "-s", f"Body bar/Frame/Arguments=0, 0 : 260, 0 : {n - 1}")
        events = Events(run.folder)
        exact = [.3 * 3975 * length * (j + .5) / 243750 for j in range(n - 1)]
        laws.demand(f"bar of {n} nodes: {len(events.at)} events, {events.words}",
                    len(events.at) == n - 1 and all(len(nodes) == 1 for nodes in events.nodes))
        laws.check("  their loads", max(abs(p / q - 1) for p, q in zip(events.at, exact)), 1e-12)
    run = laws.run(SHIPPED / "bar-pull-release.prm", *PATH)
    events = Events(run.folder)
    step = .3 * 3975 * 260 / 9 / 243750
    exact = [step * (j + .5) for j in range(7)] + [1] + [1 + 2 * step * (j + .5) for j in range(4)]
    laws.demand(f"pulled and released: {len(events.at)} events", len(events.at) == len(exact))
    laws.check("  their loads", max(abs(p - q) for p, q in zip(events.at, exact)), 1e-12)


def path_sheet_pile(laws):
    """[P] Example 3: homogeneous, so that loads of events are proportional to the prestress."""
    expected = [row["force_N"] for row in read(REFERENCE / "popov-3-events.csv")]
    for force in (1, 100):
        run = laws.run(SHIPPED / "sheet-pile.prm", *PATH, *entries(
            Solver__Law="holonomic", Load_push__Value="t ; 0", Time__End=3000 * force,
            Contact_left__Prestress=force, Contact_right__Prestress=force,
            Contact_left__Cohesion=.6 * force, Contact_right__Cohesion=.6 * force))
        events = Events(run.folder)
        laws.demand(f"sheet pile, prestress {force}: {len(events.at)} events, {events.words}",
                    len(events.at) == 68 and events.words == "no further change")
        laws.check("  their loads", max(abs(p / (force * q) - 1) for p, q in zip(events.at, expected)), 1e-9)


def path_limits(laws):
    """A block slides at p = mu or tips at p = 1/h, whatever mesh, law and place of the push."""
    for cells, law in itertools.product(((2, 1), (7, 3), (16, 8)), ("incremental", "holonomic")):
        for height, mu in ((.3, .5), (.61, .8), (.9, 1.5), (1.0, 1.01)):
            run = laws.run(pushed_block(2, height, mu, cells=cells, **{"Solver": {"Law": law}}))
            events = Events(run.folder)
            kind = "sliding" if mu < 1 / height else "tipping"
            laws.check(f"{cells} cells, {law}, h = {height}, mu = {mu}: limit load",
                       abs(events.parameter / min(mu, 1 / height) - 1), 1e-9)
            laws.demand(f"  {events.words}", events.words == f"limit load: {kind}")
            laws.demand("  mechanism.vtu", (run.folder / "mechanism.vtu").exists())


def path_beam(laws):
    """[P] Example 1: with the tightening weight the left support opens at p = 32/3."""
    beam = entries(Time__End=100, Contact_supports__Prestress=1, Contact_supports__Cohesion=.4)
    run = laws.run(SHIPPED / "beam-three-supports.prm", *PATH, *beam, *entries(Solver__Law="holonomic"))
    events = Events(run.folder)
    laws.demand(f"beam: events {events.nodes}, {events.words}",
                events.nodes[0] == [("0", "stick", "open")] and events.words == "no further change")
    laws.check("  first event", abs(events.at[0] * 3 / 32 - 1), 1e-12)



def posts(n, mu=.5):
    """n equal posts of two bars each, held at their tops."""
    nodes, members = [], []
    for i in range(n):
        nodes += [f"{3 * i + 1}: {2 * i}, 0", f"{3 * i + 2}: {2 * i}, 1", f"{3 * i + 3}: {2 * i + 1}, 1"]
        members += [f"{3 * i + 1}-{3 * i + 2}: bar", f"{3 * i + 1}-{3 * i + 3}: bar"]
    return {"Dimension": 2,
            "Body posts": {"Kind": "frame", "Sections": "bar",
                           "Frame": {"Nodes": " ; ".join(nodes), "Members": " ; ".join(members),
                                     "Boundary ids": "1: y == 0 ; 2: y == 1"},
                           "Section bar": {"Young modulus": 1000, "Area": .01}},
            "Obstacle floor": floor(2), "Contact feet": contact("posts", 1, mu=mu),
            "Support tops": {"Body": "posts", "Boundary ids": 2},
            "Load weight": load("nodal force", "0 ; -1", 1, "posts"),
            "Load push": load("nodal force", "t ; 0", 1, "posts"),
            "Time": {"Times": 2}, "Solver": {"Method": "load path"}, "Output": {"VTU": 0}}


def path_alike(laws):
    """Nodes that are alike change together."""
    run = laws.run(posts(40))
    events = Events(run.folder)
    laws.demand(f"40 posts that are alike: {len(events.at)} event of {len(events.nodes[0])} nodes",
                len(events.at) == 1 and len(events.nodes[0]) == 40)
    down = pushed_block(2, .5, .2, **{
        "Load push": None, "Support top": support(3, "x, y", "0 ; -0.01*t"), "Time": {"Times": 1}})
    run = laws.run(down)
    places = {int(row["node"]): row["x"] for row in run.last()}
    other = {"slip+": "slip-", "slip-": "slip+"}
    symmetric = all({(round(2 - places[int(n)], 9), other.get(a, a), other.get(b, b)) for n, a, b in nodes}
                    == {(round(places[int(n)], 9), a, b) for n, a, b in nodes}
                    for nodes in Events(run.folder).nodes)
    laws.demand("a symmetric structure keeps symmetric states", symmetric)


def path_increments(laws):
    """Increments of the SOCLCP come to the path; where nothing reverses one increment is the path."""
    bar = (SHIPPED / "bar-on-rigid-base.prm", "-s", "Output/VTU=0")
    pull = entries(Load_weight__Value="0 ; -3975", Load_pull__Value="243750*t ; 0", Time__End=1, Time__Increments=1)
    path, one = laws.run(*bar, *PATH, *pull), laws.run(*bar, *pull)
    size = path.largest("u_t1")
    laws.check("bar, one increment against the path", max(
        abs(a["u_t1"] - b["u_t1"]) for a, b in zip(path.last(), one.last())) / size, 1e-10)
    moved = ("-s", "Support top/Displacement=-0.2*max(t - 1, 0) ; -0.35*t",
             "-s", "Contact bottom/Friction coefficient=0.2", "-s", "Output/VTU=0")
    file = SHIPPED / "inclined-obstacle.prm"
    path = laws.run(file, *moved, *PATH, "-s", "Time/Times=1, 2").last()
    errors = []
    for n in (4, 16, 64):
        rows = laws.run(file, *moved, "-s", f"Time/Stages=1 : {n}, 2 : {n}").last()
        errors.append(max(abs(a[c] - b[c]) for a, b in zip(path, rows) for c in ("r_n", "r_t1")))
    for coarse, fine in zip(errors, errors[1:]):
        laws.check("where slip reverses, differences to the path with a fourth of the increment", fine / coarse, .5)


def path_prestress(laws):
    """A prestress is a pair of forces, for every method, and balances."""
    for method in ("automatic", "load path"):
        scene = merge(posts(3), {"Load push": None, "Contact feet": {"Prestress": 2}, "Solver": {"Method": method}})
        run = laws.run(scene)
        laws.check(f"{method}: reactions carry the weight and the prestress",
                   max(abs(row["r_n"] - 3) for row in run.last()), 1e-12)
    pile = entries(Contact_left__Prestress=1, Contact_right__Prestress=1)
    a = laws.run(SHIPPED / "sheet-pile.prm", "-s", "Output/VTU=0", *pile)
    laws.check("sheet pile: loads of the prestress cancel", abs(a.increments[-1]["loads_f_y"]), 1e-9)


def path(laws):
    path_prestress(laws)
    path_limits(laws)
    path_bar(laws)
    path_beam(laws)
    path_sheet_pile(laws)
    path_alike(laws)
    path_increments(laws)
    path_in_space(laws)


FAMILIES = {"balance": balance, "extrusion": extrusion, "rotation": rotation_family, "mirror": mirror, "units": units,
            "patch": patch, "elements": elements, "refinement": refinement, "obstacles": obstacles, "supports": supports,
            "loads": loads, "friction": friction, "bodies": bodies, "corners": corners, "pairs": pairs, "threads": threads, "kill": kill,
            "hertz": hertz, "path": path}


def run_families(families, program, *names):
    if "all" in names:
        names = families
    failed = 0
    for name in names:
        print(name)
        begin = time.monotonic()
        laws = Laws(program)
        try:
            families[name](laws)
        except RuntimeError as error:
            laws.demand(str(error).strip(), False)
        failed += laws.failed
        print(f"  {laws.n_runs} runs, {time.monotonic() - begin:.1f} s, {laws.failed} failed")
        if not os.environ.get("CONETACT_KEEP"):
            shutil.rmtree(laws.folder)
        else:
            print(f"  kept: {laws.folder}")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(run_families(FAMILIES, *sys.argv[1:]))
