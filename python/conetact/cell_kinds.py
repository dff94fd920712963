# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Kinds of cells: their names in meshio, numbers in VTK and Gmsh, faces, and the order of their nodes in Gmsh."""
from __future__ import annotations

from dataclasses import dataclass

HEXAHEDRON_FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (0, 4, 7, 3))
TETRAHEDRON_FACES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
SIDES = {n: tuple((i, (i + 1) % n) for i in range(n)) for n in (3, 4)}


@dataclass(frozen=True)
class CellKind:
    """`faces` are corners; `order[i]` is the node of VTK that stands at place i in Gmsh, if that is another one."""

    name: str
    dimension: int
    nodes: int
    vtk: int
    gmsh: int
    faces: tuple[tuple[int, ...], ...] = ()
    order: tuple[int, ...] = ()


KINDS = {kind.name: kind for kind in (
    CellKind("vertex", 0, 1, 1, 15),
    CellKind("line", 1, 2, 3, 1), CellKind("line3", 1, 3, 21, 8),
    CellKind("triangle", 2, 3, 5, 2, SIDES[3]), CellKind("triangle6", 2, 6, 22, 9, SIDES[3]),
    CellKind("quad", 2, 4, 9, 3, SIDES[4]), CellKind("quad8", 2, 8, 23, 16, SIDES[4]),
    CellKind("quad9", 2, 9, 28, 10, SIDES[4]),
    CellKind("pixel", 2, 4, 8, 3, ((0, 1), (1, 3), (3, 2), (2, 0)), (0, 1, 3, 2)),
    CellKind("tetra", 3, 4, 10, 4, TETRAHEDRON_FACES),
    CellKind("tetra10", 3, 10, 24, 11, TETRAHEDRON_FACES, (0, 1, 2, 3, 4, 5, 6, 7, 9, 8)),
    CellKind("hexahedron", 3, 8, 12, 5, HEXAHEDRON_FACES),
    CellKind("hexahedron20", 3, 20, 25, 17, HEXAHEDRON_FACES,
             (0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14)),
    CellKind("hexahedron27", 3, 27, 29, 12, HEXAHEDRON_FACES,
             (0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26)),
    CellKind("voxel", 3, 8, 11, 5, ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (0, 4, 6, 2)),
             (0, 1, 3, 2, 4, 5, 7, 6)),
    CellKind("wedge", 3, 6, 13, 6, ((0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0))),
    CellKind("pyramid", 3, 5, 14, 7, ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))))}
OF_VTK = {kind.vtk: kind.name for kind in KINDS.values()}


def kind_with(nodes: int, dimension: int) -> str | None:
    """The kind of cell with so many nodes, None if there is none."""
    return next((kind.name for kind in KINDS.values() if (kind.nodes, kind.dimension) == (nodes, dimension)
                 and kind.name not in ("pixel", "voxel")), None)
