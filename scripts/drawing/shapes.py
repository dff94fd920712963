# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shapes to draw: surfaces of deformed bodies, obstacles, reactions, of one increment.

Displacements are drawn several times larger, and gaps with them where that is seen: a node that
touches its obstacle does so in the picture.
"""
from dataclasses import dataclass

import numpy as np
from conetact.vtu import HEXAHEDRON, LINE, QUADRILATERAL, TETRAHEDRON, TRIANGLE

# corners of faces of a cell, those of simplices repeat one in space
FACES = {TRIANGLE: [(0, 1), (1, 2), (2, 0)], QUADRILATERAL: [(0, 1), (1, 2), (2, 3), (3, 0)],
         TETRAHEDRON: [(0, 1, 2, 2), (0, 1, 3, 3), (1, 2, 3, 3), (0, 2, 3, 3)],
         HEXAHEDRON: [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]}


@dataclass
class Body:
    """A mesh whose nodes are drawn once; x: deformed places, faces: of its surface (frames: members)."""

    name: str
    points: np.ndarray
    x: np.ndarray
    cells: dict
    faces: np.ndarray
    arrays: dict

    @property
    def is_frame(self):
        return LINE in self.cells


def merged(mesh):
    """Cells of a VTU file have corners of their own; here they share nodes that move together."""
    both = np.hstack((mesh.points, mesh.arrays["displacement"]))
    _, first, node = np.unique(both, axis=0, return_index=True, return_inverse=True)
    return (mesh.points[first], {kind: node[corners] for kind, corners in mesh.cells.items()},
            {name: values[first] for name, values in mesh.arrays.items()})


def places(points, size):
    """A function that finds the node at a place, -1 where there is none, to 1e-5 of the size."""
    step = 1e-5 * (size or 1)
    grids = [{tuple(key): i for i, key in enumerate(np.floor(points / step + shift).astype(int).tolist())}
             for shift in (0, .5)]

    def find(x):
        keys = [np.floor(x / step + shift).astype(int).tolist() for shift in (0, .5)]
        return np.array([a.get(tuple(k), b.get(tuple(m), -1)) for a, b, k, m in [
            (*grids, k, m) for k, m in zip(*keys)]], dtype=int)
    return find


def surface(points, cells):
    """Faces of one cell only. Where cells of two levels meet, a node in the middle of a large face tells."""
    faces = np.vstack([cells[kind][:, face] for kind in cells for face in FACES[kind]])
    _, first, counts = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    faces = faces[first[counts == 1]]
    middle = places(points, np.ptp(points, axis=0).max())(points[faces].mean(axis=1))
    return faces[(middle < 0) & ~np.isin(faces, middle[middle >= 0]).any(axis=1)]


def make_body(name, mesh, factor):
    if LINE in mesh.cells:
        points, cells, arrays = mesh.points, mesh.cells, mesh.arrays
        faces = cells[LINE]
    else:
        points, cells, arrays = merged(mesh)
        faces = surface(points, cells)
    if "stress" in arrays:
        arrays["pressure"] = -arrays["stress"][:, [0, 4, 8]].mean(axis=1)
    return Body(name, points, points + factor * arrays["displacement"], cells, faces, arrays)


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
        self.first_gap = rows["gap"] - rows["u_n"]
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
                faces = row[body.faces]
                return faces[(faces >= 0).all(axis=1)], body
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


def automatic_factor(result, increment):
    """The largest displacement drawn is at most a tenth of the size, the largest gap at the start a twentieth."""
    meshes = result.bodies(increment).values()
    size = size_of(mesh.points for mesh in meshes)
    largest = max(np.linalg.norm(mesh.arrays["displacement"], axis=1).max() for mesh in meshes)
    rows = rows_of(result, increment)
    gap = np.abs(rows["gap"] - rows["u_n"]).max(initial=0)
    return nice(size / max(10 * largest, 20 * gap, 1e-300)) if largest > 0 else 1.0


def rows_of(result, increment):
    return result.reactions[result.reactions["increment"] == increment]


def shapes_of(result, increment, factor):
    meshes = result.bodies(increment)
    bodies = [make_body(name, mesh, factor) for name, mesh in meshes.items()]
    rows = rows_of(result, increment)
    names = list(dict.fromkeys(rows["contact"].tolist()))
    contacts = [ContactNodes(name, rows[rows["contact"] == name], result.dimension, factor, bodies,
                             f"{name}_master" in names)
                for name in names if not (name.endswith("_master") and name[:-7] in names)]
    return Shapes(bodies, contacts, factor)
