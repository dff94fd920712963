# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Surfaces as files: STL, Wavefront, Gmsh. Faces are tuples of numbers of points, from 0."""
import math
import struct

from support.vectors import scaled, unit


def icosahedron():
    g = (1 + math.sqrt(5)) / 2
    points = [unit(p) for p in ((-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g),
                                (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1))]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
             (8, 6, 7), (9, 8, 1)]
    return points, faces


def ball(radius, refinements):
    """Triangles with their corners on a sphere about the origin."""
    points, faces = icosahedron()
    for _ in range(refinements):
        middles, finer = {}, []

        def middle(a, b):
            key = min(a, b), max(a, b)
            if key not in middles:
                middles[key] = len(points)
                points.append(unit(tuple(x + y for x, y in zip(points[a], points[b]))))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        faces = finer
    return [scaled(radius, p) for p in points], faces


def brick(low, high):
    """The six quadrilaterals of a box."""
    points = [(x, y, z) for z in (low[2], high[2]) for y in (low[1], high[1]) for x in (low[0], high[0])]
    return points, [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def triangles(faces):
    return [(face[0], face[i - 1], face[i]) for face in faces for i in range(2, len(face))]


def write_stl(file, points, faces):
    lines = ["solid made"]
    for face in triangles(faces):
        lines += ["facet normal 0 0 0", "outer loop", *("vertex " + " ".join(map(repr, points[i])) for i in face),
                  "endloop", "endfacet"]
    file.write_text("\n".join(lines + ["endsolid made"]) + "\n")


def write_binary_stl(file, points, faces):
    faces = triangles(faces)
    data = [b"solid binary".ljust(80), struct.pack("<I", len(faces))]
    data += [struct.pack("<12fH", 0, 0, 0, *(x for i in face for x in points[i]), 0) for face in faces]
    file.write_bytes(b"".join(data))


def write_obj(file, points, faces):
    file.write_text("".join("v " + " ".join(map(repr, p)) + "\n" for p in points) +
                    "".join("f " + " ".join(f"{i + 1}//1" for i in face) + "\n" for face in faces))


def write_msh(file, points, faces, version=2):
    """Lines, triangles and quadrilaterals; with version 4 in one block each."""
    kinds = {2: 1, 3: 2, 4: 3}
    if version == 2:
        nodes = [str(len(points)), *(f"{i} " + " ".join(map(repr, p)) for i, p in enumerate(points, 1))]
        elements = [str(len(faces)), *(f"{e} {kinds[len(face)]} 2 1 1 " + " ".join(str(i + 1) for i in face)
                                       for e, face in enumerate(faces, 1))]
    else:
        n = len(points)
        nodes = [f"1 {n} 1 {n}", f"2 1 0 {n}", *map(str, range(1, n + 1)), *(" ".join(map(repr, p)) for p in points)]
        elements = [f"{len(faces)} {len(faces)} 1 {len(faces)}"]
        for e, face in enumerate(faces, 1):
            elements += [f"2 1 {kinds[len(face)]} 1", f"{e} " + " ".join(str(i + 1) for i in face)]
    head = "2.2 0 8" if version == 2 else "4.1 0 8"
    file.write_text("\n".join(["$MeshFormat", head, "$EndMeshFormat", "$Nodes", *nodes, "$EndNodes",
                               "$Elements", *elements, "$EndElements"]) + "\n")
