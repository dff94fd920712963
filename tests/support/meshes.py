# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh files of Gmsh, and the areas of nodes on their faces."""
import itertools
import math
import random

from support.vectors import cross, dot, plus, scaled


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


def distorted(file, dim, n=4, by=.25, corner=(0.0, 0.0, 0.0)):
    """A unit cube of n^dim cells whose inner nodes, and those of the sides along them, are moved by parts of a cell."""
    rng = random.Random(7)
    counts = [n + 1] * dim + [1] * (3 - dim)
    number = {}
    points = []
    for at in itertools.product(*(range(c) for c in counts)):
        number[at] = len(points)
        points.append(tuple(corner[d] + (i + (rng.uniform(-by, by) if 0 < i < n else 0)) / n if d < dim else 0.0
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
