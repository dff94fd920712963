# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Balls of P2 tetrahedra from Gmsh, cut out of half spaces as in half_space.py.

A quarter of a block, or half of one, that Gmsh fills with tetrahedra as fine as it is asked for where bodies
touch; then its nodes, those in the middle of edges as well, are moved so that the surface is the paraboloid.
"""
import math
import subprocess

from support import half_space
from support.half_space import MU, RADIUS, SIZE
from support.scenes import joint, merge, support

SURFACE, FAR, MIDDLE, ACROSS = 1, 2, 3, 4
RIM = 1.25  # of the faces that may touch
CORNERS = {9: 3, 11: 4}  # nodes at corners of Gmsh's faces and cells of second order


def drawing(step, coarser, quarter):
    """In Gmsh's language: a block of half spaces y > 0 (and x > 0), with a disc in its lower side."""
    places = [(0, 0), (RIM, 0), (0, RIM), (SIZE, 0), (SIZE, SIZE), (0, SIZE)]
    lines, arcs = [(1, 2), (2, 4), (4, 5), (5, 6), (6, 3), (3, 1)], [(2, 1, 3)]
    disc, beside = "1, 7, 6", "2, 3, 4, 5, -7"
    sides = {FAR: (3, 4), MIDDLE: (1, 2), ACROSS: (5, 6)}
    if not quarter:
        places = [(0, 0), (RIM, 0), (-RIM, 0), (SIZE, 0), (SIZE, SIZE), (-SIZE, SIZE), (-SIZE, 0), (0, RIM)]
        lines, arcs = [(1, 2), (2, 4), (4, 5), (5, 6), (6, 7), (7, 3), (3, 1)], [(2, 1, 8), (8, 1, 3)]
        disc, beside = "1, 8, 9, 7", "2, 3, 4, 5, 6, -9, -8"
        sides = {FAR: (3, 4, 5), MIDDLE: (1, 2, 6, 7)}
    n, m = len(places), len(lines)
    text = [f"Point({i}) = {{{x}, {y}, 0}};" for i, (x, y) in enumerate(places, 1)]
    text += [f"Line({i}) = {{{a}, {b}}};" for i, (a, b) in enumerate(lines, 1)]
    text += [f"Circle({i}) = {{{a}, {b}, {c}}};" for i, (a, b, c) in enumerate(arcs, m + 1)]
    text += [f"Line Loop(1) = {{{disc}}}; Plane Surface(1) = {{1}};", f"Line Loop(2) = {{{beside}}}; Plane Surface(2) = {{2}};"]
    # upper side and upright ones
    round_it = [a for a, b in lines]
    text += [f"Point({n + i}) = {{{places[i - 1][0]}, {places[i - 1][1]}, {SIZE}}};" for i in round_it]
    text += [f"Line({100 + i}) = {{{i}, {n + i}}};" for i in round_it]
    text += [f"Line({200 + i}) = {{{n + a}, {n + b}}};" for i, (a, b) in enumerate(lines, 1)]
    for i, (a, b) in enumerate(lines, 1):
        text.append(f"Line Loop({10 + i}) = {{{i}, {100 + b}, -{200 + i}, -{100 + a}}}; Plane Surface({10 + i}) = {{{10 + i}}};")
    text.append(f"Line Loop(9) = {{{', '.join(str(200 + i) for i in range(1, m + 1))}}}; Plane Surface(9) = {{9}};")
    all_sides = [1, 2, 9, *(10 + i for i in range(1, m + 1))]
    text.append(f"Surface Loop(1) = {{{', '.join(map(str, all_sides))}}}; Volume(1) = {{1}};")
    text.append(f"Physical Volume(1) = {{1}}; Physical Surface({SURFACE}) = {{1}};")
    for tag, numbers in sides.items():
        numbers = [10 + i for i in numbers] + ([9] if tag == FAR else [])
        text.append(f"Physical Surface({tag}) = {{{', '.join(map(str, numbers))}}};")
    beyond = "(Sqrt(x^2 + y^2) - 1.1)"
    away = f"Sqrt((0.5*({beyond} + Fabs({beyond})))^2 + z^2)"
    text += ["Field[1] = MathEval;", f'Field[1].F = "{step!r} + {coarser!r}*{away}";', "Background Field = 1;",
             "Mesh.CharacteristicLengthExtendFromBoundary = 0;", "Mesh.CharacteristicLengthFromPoints = 0;",
             "Mesh.ElementOrder = 2;", "Mesh.MshFileVersion = 2.2;", "Mesh.RandomSeed = 1;"]
    return "\n".join(text) + "\n"


def ball(file, step, sign, curvature, coarser=.35, quarter=True):
    """Writes the mesh of a body above (sign 1) or below; its surface is at sign curvature r^2 / 2. Number of cells."""
    source, flat = file.with_suffix(".geo"), file.with_suffix(".flat.msh")
    source.write_text(drawing(step, coarser, quarter))
    subprocess.run(["gmsh", "-v", "0", "-3", "-nt", "1", source, "-o", flat], check=True, stdin=subprocess.DEVNULL)
    lines, out, n_cells = iter(flat.read_text().splitlines()), [], 0
    for line in lines:
        out.append(line)
        if line == "$Nodes":
            count = next(lines)
            out.append(count)
            for _ in range(int(count)):
                number, x, y, z = next(lines).split()
                x, y, z = float(x), float(y), float(z)
                height = z + curvature / 2 * (x * x + y * y) * (1 - z / SIZE)
                out.append(f"{number} {x!r} {y!r} {sign * height!r}")
        elif line == "$Elements":
            count = next(lines)
            out.append(count)
            for _ in range(int(count)):
                words = next(lines).split()
                n_cells += words[1] == "11"
                out.append(" ".join(turned(words) if sign < 0 else words))
    file.write_text("\n".join(out) + "\n")
    return n_cells


def turned(words):
    """An element of second order the other way round: its first two corners change places."""
    kind, tags = int(words[1]), 3 + int(words[2])
    head, nodes = words[:tags], words[tags:]
    order = {9: (1, 0, 2, 3, 5, 4), 11: (1, 0, 2, 3, 4, 6, 5, 9, 8, 7)}.get(kind, range(len(nodes)))
    return head + [nodes[i] for i in order]


def deformable(file, poisson):
    return {"Mesh": {"File": file.name}, "Element": "P2", "Material": {"Young modulus": 1.0, "Poisson ratio": poisson}}


def on_plane(folder, step, **sizes):
    """A quarter of a ball on a rigid plane."""
    poisson = half_space.POISSON["hertz"]
    exact = half_space.Hertz(3, poisson, 1)
    file = folder / "ball.msh"
    ball(file, step, 1, 1 / RADIUS, **sizes)
    motion = " ; ".join(half_space.far_field(half_space.boussinesq, exact.force, poisson, "z", .4)) + f" - {exact.approach!r}"
    return {"Dimension": 3, "Body block": deformable(file, poisson),
            "Obstacle plane": {"Shape": "half space", "Normal": (0, 0, 1)},
            "Contact bottom": {"Body": "block", "Boundary ids": SURFACE, "Obstacle": "plane", "Friction coefficient": 0.0},
            "Support far": support(FAR, "x, y, z", motion), "Support middle": support(MIDDLE, "y"),
            "Support across": support(ACROSS, "x"), "Output": {"VTU": 0}}


def on_ball(folder, steps, quarter=True, **sizes):
    """Two balls, quarters that are pressed or halves that are sheared after that; steps of the upper, the slave, and the lower one."""
    poisson = half_space.POISSON["partial slip"][3]
    exact = half_space.Hertz(3, poisson, 2)
    press, shear = half_space.press_and_shear(exact, poisson, "abs(z)")
    scene = {"Dimension": 3, "Contact joint": joint("upper", SURFACE, "lower", SURFACE, **{"Friction coefficient": MU}),
             "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    for body, sign, step in zip(("upper", "lower"), (1, -1), steps):
        file = folder / f"{body}.msh"
        ball(file, step, sign, 1 / (2 * RADIUS), quarter=quarter, **sizes)
        mirrored = [(sign if i == 2 else 1, sign if i < 2 else 1) for i in range(3)]
        motion = " ; ".join(f"{m!r}*min(t, 1)*({p}) + {n!r}*max(0, t - 1)*({q})"
                            for (m, n), p, q in zip(mirrored, press, shear))
        scene[f"Body {body}"] = deformable(file, poisson)
        scene[f"Support far {body}"] = support(FAR, "x, y, z", motion, body)
        scene[f"Support middle {body}"] = support(MIDDLE, "y", body=body)
        if quarter:
            scene[f"Support across {body}"] = support(ACROSS, "x", body=body)
    if quarter:
        scene = merge(scene, {"Contact joint": {"Friction coefficient": 0.0}, "Time": {"End": 1, "Increments": 1}})
    return scene


def pressure_errors(rows, exact, parts):
    """Of the force, of the peak and of pressures; how far nodes are off their neighbours more than closed forms are."""
    force = parts * sum(row["r_n"] for row in rows)
    inside = [row for row in rows if half_space.distance(row) < .8]
    off = {id(row): row["pressure"] - exact.pressure(half_space.distance(row)) for row in inside}
    centre = min(rows, key=half_space.distance)
    return {"force": abs(force / exact.force - 1), "peak pressure": abs(centre["pressure"] / exact.peak - 1),
            "pressures within 0.8, root of the mean square": math.sqrt(
                sum(row["area"] * off[id(row)]**2 for row in inside) / sum(row["area"] for row in inside)) / exact.peak,
            "zigzag": zigzag(inside, off) / exact.peak}


def zigzag(rows, off):
    """The largest difference between what a node is off and what its six nearest neighbours are in the mean."""
    worst = 0.0
    for row in rows:
        near = sorted(rows, key=lambda other: math.hypot(other["x"] - row["x"], other["y"] - row["y"]))[1:7]
        worst = max(worst, abs(off[id(row)] - sum(off[id(other)] for other in near) / len(near)))
    return worst
