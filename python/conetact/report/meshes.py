# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is drawn of a mesh: triangles and edges of its surface, members, and cells where sections are to be filled."""
from dataclasses import dataclass

import numpy as np

from ..vtu import HEXAHEDRON, LINE, QUADRILATERAL, TETRAHEDRON, TRIANGLE

# cells of second degree of VTK as cells of first degree between their nodes
PARTS = {TRIANGLE: (TRIANGLE, [(0, 1, 2)]), QUADRILATERAL: (QUADRILATERAL, [(0, 1, 2, 3)]),
         22: (TRIANGLE, [(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)]),
         28: (QUADRILATERAL, [(0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3)])}
# tetrahedra that fill a cell, by its corners, which VTK names first
FILLING = {TETRAHEDRON: [(0, 1, 2, 3)],
           HEXAHEDRON: [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]}
FILLING[24], FILLING[29] = FILLING[TETRAHEDRON], FILLING[HEXAHEDRON]
SHARP = np.cos(np.radians(25))  # faces that meet under a larger angle have an edge between them
NEAR = 1e-7  # of the size: nodes that are one place


@dataclass
class Shape:
    """Places of nodes and what connects them.

    `rows` are these nodes in the body, `touching` are the nodes of the surface among these.
    """

    points: np.ndarray
    triangles: np.ndarray
    edges: np.ndarray
    outline: np.ndarray
    lines: np.ndarray
    border: np.ndarray
    cells: np.ndarray
    rows: np.ndarray
    touching: np.ndarray
    whole: bool  # nodes are those of the body, not of its surface

    def same_as(self, other):
        parts = ("points", "triangles", "lines")
        return all(np.array_equal(getattr(self, name), getattr(other, name)) for name in parts)


def hashes(points, step, shift):
    keys = np.floor(points / step + shift).astype(np.int64)
    return (keys * np.array([73856093, 19349669, 83492791], np.int64)).sum(axis=1)


def rows_at(points, wanted):
    """The row of the point at each place, -1 where there is none. Two grids, so that none falls between boxes."""
    size = np.ptp(points, axis=0).max(initial=0) or 1
    rows = np.full(len(wanted), -1)
    for shift in (.25, .75):
        known = hashes(points, 4 * NEAR * size, shift)
        order = np.argsort(known, kind="stable")
        at = np.searchsorted(known[order], hashes(wanted, 4 * NEAR * size, shift))
        found = order[np.minimum(at, len(order) - 1)]
        near = np.abs(points[found] - wanted).max(axis=1) <= NEAR * size
        rows = np.where((rows < 0) & near, found, rows)
    return rows


def polygons(cells):
    """Triangles and quadrilaterals of plane cells or of faces, as two arrays."""
    found = {TRIANGLE: [np.empty((0, 3), int)], QUADRILATERAL: [np.empty((0, 4), int)]}
    for kind, corners in cells.items():
        if kind in PARTS:
            into, parts = PARTS[kind]
            found[into] += [corners[:, part] for part in parts]
    return np.vstack(found[TRIANGLE]), np.vstack(found[QUADRILATERAL])


def normals(corners):
    """Of polygons, by their diagonals (of triangles two sides)."""
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, -1] - corners[:, 1])
    return normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]


def sides(faces):
    """Both ends of each side, the smaller number first."""
    n = faces.shape[1]
    return np.sort(np.stack([faces[:, [i, (i + 1) % n]] for i in range(n)], axis=1), axis=2).reshape(-1, 2)


def edges_of(points, groups):
    """All edges once, and those that are sharp; rims are where cells of two levels meet, which is nothing to see."""
    ends = np.vstack([sides(faces) for faces in groups])
    if not len(ends):
        return ends, ends
    normal = np.vstack([np.repeat(normals(points[faces]), faces.shape[1], axis=0) for faces in groups])
    key = ends[:, 0].astype(np.int64) * len(points) + ends[:, 1]
    order = np.argsort(key, kind="stable")
    _, first, counts = np.unique(key[order], return_index=True, return_counts=True)
    a, b = order[first], order[np.minimum(first + 1, len(order) - 1)]
    bent = np.abs((normal[a] * normal[b]).sum(axis=1)) < SHARP
    return ends[a], ends[a][(counts == 2) & bent]


def tetrahedra(cells):
    return np.vstack([np.empty((0, 4), int), *(corners[:, part] for kind, corners in cells.items()
                                               for part in FILLING.get(kind, ()))])


def shape_of(body, surface, dimension, filled):
    """Of a body and its surface as two meshes. `filled`: with inner nodes and cells, for sections in space."""
    rows = rows_at(body.points, surface.points)
    lines = body.cells.get(LINE, np.empty((0, 2), int))
    whole = bool(len(lines) or dimension == 2 or (filled and (rows >= 0).all()))
    if whole:
        points, touching, of_body = body.points, rows, np.arange(len(body.points))
        faces = [rows[group] for group in polygons(surface.cells)] if dimension == 3 else polygons(body.cells)
        border = rows[surface.cells[LINE]] if dimension == 2 and not len(lines) else lines[:0]
    else:
        points, touching, of_body = surface.points, np.arange(len(surface.points)), rows
        faces, border = polygons(surface.cells), lines[:0]
    faces = [group[(group >= 0).all(axis=1)] for group in faces]
    border = border[(border >= 0).all(axis=1)]
    edges, outline = edges_of(points, faces)
    outline = border if len(border) else outline
    triangles = np.vstack([faces[0], faces[1][:, [0, 1, 2]], faces[1][:, [0, 2, 3]]])
    cells = tetrahedra(body.cells) if filled and whole and dimension == 3 else np.empty((0, 4), int)
    return Shape(points, triangles, edges, outline, lines, border, cells, of_body, touching, whole)
