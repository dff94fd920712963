# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shapes to draw: surfaces of deformed bodies, obstacles, reactions, of one increment.

Displacements are drawn several times larger, and gaps with them where that is seen: a node that
touches its obstacle does so in the picture.
"""
from dataclasses import dataclass

import numpy as np
from conetact.report.fields import of_body, split
from conetact.report.meshes import PARTS as PARTS_OF_FACES
from conetact.vtu import HEXAHEDRON, LINE, QUADRILATERAL, TETRAHEDRON, TRIANGLE

# corners of faces of a cell, those of simplices repeat one in space
FACES = {TRIANGLE: [(0, 1), (1, 2), (2, 0)], QUADRILATERAL: [(0, 1), (1, 2), (2, 3), (3, 0)],
         TETRAHEDRON: [(0, 1, 2, 2), (0, 1, 3, 3), (1, 2, 3, 3), (0, 2, 3, 3)],
         HEXAHEDRON: [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]}
# nodes of a hexahedron of second degree in VTK's order, on a grid of 3 x 3 x 3
GRID = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2), (1, 0, 0), (2, 1, 0),
        (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2), (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1),
        (0, 1, 1), (2, 1, 1), (1, 0, 1), (1, 2, 1), (1, 1, 0), (1, 1, 2), (1, 1, 1)]
# cells of second degree as cells of first degree between their nodes
PARTS = {22: PARTS_OF_FACES[22], 28: PARTS_OF_FACES[28],
         24: (TETRAHEDRON, [(0, 4, 6, 7), (4, 1, 5, 8), (6, 5, 2, 9), (7, 8, 9, 3),
                            (4, 9, 5, 6), (4, 9, 6, 7), (4, 9, 7, 8), (4, 9, 8, 5)]),
         29: (HEXAHEDRON, [[GRID.index(tuple(a + b // 2 for a, b in zip(first, corner))) for corner in GRID[:8]]
                           for first in ((i, j, k) for i in (0, 1) for j in (0, 1) for k in (0, 1))])}


@dataclass
class Body:
    """A mesh whose nodes are drawn once; x: deformed places, faces: of its surface (frames: members)."""

    name: str
    points: np.ndarray
    x: np.ndarray
    cells: dict
    faces: np.ndarray
    arrays: dict
    corner_faces: np.ndarray = None  # of cells of second degree, without the nodes between corners

    @property
    def is_frame(self):
        return LINE in self.cells


def of_first_degree(cells):
    """Cells with corners only."""
    found = {}
    for kind, corners in cells.items():
        into, parts = PARTS.get(kind, (kind, [tuple(range(corners.shape[1]))]))
        found.setdefault(into, []).extend(corners[:, list(part)] for part in parts)
    return {kind: np.vstack(parts) for kind, parts in found.items()}


def without_middles(cells):
    """Cells of second degree as one cell between their corners each."""
    corners = {22: 3, 28: 4, 24: 4, 29: 8}
    return {PARTS[kind][0]: nodes[:, :corners[kind]] for kind, nodes in cells.items() if kind in PARTS}


def merged(mesh):
    """Cells of a VTU file have corners of their own; here they share nodes that move together."""
    both = np.hstack((mesh.points, mesh.arrays["displacement"]))
    first, node = same_rows(both)
    return (mesh.points[first], {kind: node[corners] for kind, corners in mesh.cells.items()},
            {name: values[first] for name, values in of_body(mesh.arrays).items()})


def same_rows(rows):
    """The first of equal rows each, and which of these every row is."""
    order = np.lexsort(pairs(rows).T)
    new = np.ones(len(rows), bool)
    new[1:] = (rows[order[1:]] != rows[order[:-1]]).any(axis=1)
    group = np.empty(len(rows), int)
    group[order] = np.cumsum(new) - 1
    return order[new], group


def pairs(rows):
    """Two numbers of nodes as one, which halves the work of sorting."""
    n = int(rows.max(initial=0)) + 1
    if rows.dtype.kind != "i" or rows.shape[1] % 2 or n >= 2**31:
        return rows
    return rows[:, ::2].astype(np.int64) * n + rows[:, 1::2]


def boxes(points, step, shift):
    """A number for the box of a grid that a point is in; few boxes share one."""
    keys = np.floor(points / step + shift).astype(np.int64)
    return keys @ np.array([73856093, 19349669, 83492791][:points.shape[1]], np.int64)


def places(points, size):
    """A function that finds the node at a place, -1 where there is none, to 1e-5 of the size."""
    step, grids = 1e-5 * (size or 1), []
    for shift in (0, .5):
        keys = boxes(points, step, shift)
        order = np.argsort(keys, kind="stable")
        grids.append((shift, keys[order], order))

    def find(x):
        found = np.full(len(x), -1)
        for shift, keys, order in grids if len(points) else ():
            wanted = boxes(x, step, shift)
            at = np.maximum(np.searchsorted(keys, wanted, side="right") - 1, 0)
            is_there = (keys[at] == wanted) & (np.abs(points[order[at]] - x).max(axis=1) <= step)
            found = np.where((found < 0) & is_there, order[at], found)
        return found
    return find


def surface(points, cells, levels=True):
    """Faces of one cell only. Where cells of two levels meet, a node in the middle of a large face tells."""
    faces = np.vstack([cells[kind][:, face] for kind in cells for face in FACES[kind]])
    first, group = same_rows(np.sort(faces, axis=1))
    counts = np.bincount(group)
    faces = faces[first[counts == 1]]
    if not levels:
        return faces
    on_surface = np.unique(faces)
    found = places(points[on_surface], np.ptp(points, axis=0).max())(points[faces].mean(axis=1))
    middle = np.where(found < 0, -1, on_surface[found])
    return faces[(middle < 0) & ~np.isin(faces, middle[middle >= 0]).any(axis=1)]


def with_components(arrays):
    """Also those of vectors and tensors by name: stress_xx, displacement_z, principal_stresses_1."""
    parts = [split(name, values, 3) for name, values in arrays.items() if values.ndim > 1]
    return {name: values for part in [arrays, *parts] for name, values in part.items()}


def make_body(name, mesh, factor):
    corner_faces = None
    if LINE in mesh.cells:
        points, cells, arrays = mesh.points, mesh.cells, of_body(mesh.arrays)
        faces = cells[LINE]
    else:
        points, cells, arrays = merged(mesh)
        if coarse := without_middles(cells):
            corner_faces = surface(points, coarse, False)
        cells = of_first_degree(cells)
        faces = surface(points, cells)
    if "stress" in arrays:
        arrays["pressure"] = -arrays["stress"][:, [0, 4, 8]].mean(axis=1)
    return Body(name, points, points + factor * arrays["displacement"], cells, faces, with_components(arrays),
                corner_faces)


def basis(normals, dim):
    """n, t1, t2 of each node, by the conventions of doc/results.md."""
    n = normals
    if dim == 2:
        return n, np.column_stack((n[:, 1], -n[:, 0], 0 * n[:, 0])), 0 * n
    t1 = np.cross(n, (0., 0., 1.))
    steep = np.abs(n[:, 2]) > .9
    t1[steep] = np.cross((0., 1., 0.), n[steep])
    t1 /= np.maximum(np.linalg.norm(t1, axis=1), 1e-300)[:, None]
    return n, t1, np.cross(n, t1)


def vectors(rows, *names):
    return np.column_stack([rows[name] for name in names])


def first_gaps(rows):
    """Those at the start; 0 where a node faces nothing, and has none."""
    return np.nan_to_num(rows["gap"] - rows["u_n"])


class ContactNodes:
    """Nodes of one contact in one increment: where they are drawn, what they carry, what they may touch."""

    def __init__(self, name, rows, dim, factor, bodies, is_pair):
        self.name, self.rows, self.is_pair = name, rows, is_pair
        self.points = vectors(rows, "x", "y", "z")
        normals, t1, t2 = basis(vectors(rows, "n_x", "n_y", "n_z"), dim)
        self.normals = normals
        self.reactions = sum(rows[r][:, None] * v for r, v in zip(("r_n", "r_t1", "r_t2"), (normals, t1, t2)))
        self.faces, self.body = self._faces(bodies)
        moved = self.points if self.body is None else self.points + factor * self._displacements()
        self.x = moved
        self.first_gap = first_gaps(rows)
        self.stretched = factor > 1 and self._closed_gap() * factor > .01 * size_of(body.points for body in bodies)
        self.feet = self.points - (factor if self.stretched else 1) * self.first_gap[:, None] * normals

    def _closed_gap(self):
        """The largest one at the start of a node that touches now."""
        return np.abs(self.first_gap[self.rows["state"] != "open"]).max(initial=0)

    def _faces(self, bodies):
        """Of the body they belong to: faces with all corners in this contact, by rows of the table."""
        for body in bodies:
            self.node = places(body.points, np.ptp(body.points, axis=0).max())(self.points)
            if (self.node >= 0).all():
                row = np.full(len(body.points), -1)
                row[self.node] = np.arange(len(self.points))
                faces = [row[f] for f in (body.faces, body.corner_faces) if f is not None]
                faces = [f[(f >= 0).all(axis=1)] for f in faces]
                return next((f for f in faces if len(f)), faces[0]), body
        return np.empty((0, 2), int), None

    def _displacements(self):
        return self.body.arrays["displacement"][self.node]

    def arrows(self, largest, length):
        """Reactions as vectors to draw; one of the largest force has the given length."""
        return self.reactions * (length / largest if largest > 0 else 0)

    @property
    def is_flat(self):
        """One plane (or line) is what all of them may touch."""
        n = self.normals[0]
        depths = self.feet @ n
        return bool(np.allclose(self.normals, n, atol=1e-6)
                    and np.ptp(depths) <= 1e-6 * max(np.ptp(self.feet, axis=0).max(), 1e-300))


@dataclass
class Shapes:
    """All that is drawn of one increment."""

    bodies: list
    contacts: list
    factor: float

    def limits(self):
        x = np.vstack([body.x for body in self.bodies] + [body.points for body in self.bodies])
        return x.min(axis=0), x.max(axis=0)

def nice(factor):
    """1, 2 or 5 times a power of ten, at most that large."""
    if not np.isfinite(factor) or factor < 2:
        return 1.0
    power = 10.0 ** np.floor(np.log10(factor))
    return float(power * max(k for k in (1, 2, 5) if k * power <= factor * (1 + 1e-9)))


def size_of(points):
    return float(np.linalg.norm(np.ptp(np.vstack(list(points)), axis=0)))


def automatic_factor(result, increment, meshes=None):
    """The largest displacement drawn is at most a tenth of the size, the largest gap at the start a twentieth."""
    meshes = (meshes or result.bodies(increment)).values()
    size = size_of(mesh.points for mesh in meshes)
    largest = max(np.linalg.norm(mesh.arrays["displacement"], axis=1).max() for mesh in meshes)
    rows = rows_of(result, increment)
    gap = np.abs(first_gaps(rows)).max(initial=0)
    return nice(size / max(10 * largest, 20 * gap, 1e-300)) if largest > 0 else 1.0


def rows_of(result, increment):
    return result.reactions[result.reactions["increment"] == increment]


def shapes_of(result, increment, factor, meshes=None):
    meshes = meshes or result.bodies(increment)
    bodies = [make_body(name, mesh, factor) for name, mesh in meshes.items()]
    rows = rows_of(result, increment)
    names = list(dict.fromkeys(rows["contact"].tolist()))
    contacts = [ContactNodes(name, rows[rows["contact"] == name], result.dimension, factor, bodies,
                             f"{name}_master" in names)
                for name in names if not (name.endswith("_master") and name[:-7] in names)]
    return Shapes(bodies, contacts, factor)


def rectangle(contact, size):
    """Corners on what is flat, a little larger than the contact: of an obstacle."""
    n = contact.normals[0]
    a = np.eye(3)[np.abs(n).argmin()]
    a = a - (a @ n) * n
    a, middle = a / np.linalg.norm(a), contact.feet.mean(axis=0)
    b = np.cross(n, a)
    (a0, a1), (b0, b1) = ((c.min() - .06 * size, c.max() + .06 * size)
                          for c in ((contact.feet - middle) @ a, (contact.feet - middle) @ b))
    return np.array([middle + p * a + q * b for p, q in ((a0, b0), (a1, b0), (a1, b1), (a0, b1))])
