# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of numpy arrays, of meshio and of pyvista as files of Gmsh that scenes can name."""
from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from .cell_kinds import KINDS, OF_VTK, kind_with
from .errors import InputError

Points = npt.NDArray[np.float64]
Cells = npt.NDArray[np.int64]
Name = Union[str, int]
Condition = Callable[[Points], npt.NDArray[np.bool_]]
Blocks = list[tuple[str, Cells]]


class Mesh:
    """Points and cells of a body, with groups of faces (`boundary`) and of cells (`groups`) by names or numbers.

    `cells` is an array with the nodes of a cell in each row, or a dictionary of such arrays by kinds: "quad", "tetra",
    "hexahedron", ... as meshio calls them, with its order of nodes. A boundary is an array of faces, or a condition on
    the centres of outer faces.

    >>> points = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)]
    >>> mesh = conetact.Mesh(points, [(0, 1, 4, 3), (1, 2, 5, 4)],
    ...                      boundary={"floor": lambda x: x[:, 1] == 0, "side": [(0, 3)]}, groups={"left": [0]})
    >>> mesh
    Mesh(2D: 6 points, 2 quad; boundary floor, side; groups left)
    """

    def __init__(self, points: npt.ArrayLike, cells: npt.ArrayLike | Mapping[str, npt.ArrayLike], *,
                 boundary: Mapping[Name, npt.ArrayLike | Condition] | None = None,
                 groups: Mapping[Name, npt.ArrayLike] | None = None, kind: str | None = None) -> None:
        self.points = points_of(points)
        self.cells: Blocks = blocks_of(cells, kind, 2 if is_plane(self.points) else 3)
        self.dimension = max(KINDS[name].dimension for name, _ in self.cells)
        check_nodes(self.cells, len(self.points))
        if len({KINDS[name].dimension for name, _ in self.cells}) != 1 or self.dimension < 2:
            raise InputError("Cells of a body are all triangles and quadrilaterals, or all of space; these are "
                             f"{', '.join(name for name, _ in self.cells)}. Faces with a name belong to `boundary`.")
        for name in (*(boundary or {}), *(groups or {})):
            check_name(name)
        self.groups = {name: np.unique(cell_numbers(rows, self.n_cells)) for name, rows in (groups or {}).items()}
        self.boundary = {name: self._faces(name, rows) for name, rows in (boundary or {}).items()}

    @property
    def n_cells(self) -> int:
        """Number of all cells of the body.

        >>> conetact.Mesh([(0, 0), (1, 0), (1, 1), (0, 1)], [(0, 1, 2, 3)]).n_cells
        1
        """
        return sum(len(rows) for _, rows in self.cells)

    def _faces(self, name: Name, rows: npt.ArrayLike | Condition) -> Blocks:
        if callable(rows):
            return self._faces_where(name, rows)
        faces = blocks_of(rows, None, self.dimension - 1)
        check_nodes(faces, len(self.points))
        self._check_faces(name, faces)
        return faces

    def _check_faces(self, name: Name, blocks: Blocks) -> None:
        """Each is one of a cell, inside of the body, too: by the corners, which come first."""
        known = {n: {tuple(face) for face in np.sort(rows, axis=1).tolist()}
                 for n, rows in faces_of(self.cells, self.dimension).items()}
        for kind, rows in blocks:
            n = len(KINDS[kind].faces) or 2  # as many sides as corners
            for face in rows[:, :n].tolist():
                if tuple(sorted(face)) not in known.get(n, ()):
                    raise InputError(f"The boundary '{name}' names ({', '.join(map(str, face))}), which is no face of a cell.")

    def _faces_where(self, name: Name, condition: Condition) -> Blocks:
        found = []
        for kind, rows in self.outer_faces():
            there = np.asarray(condition(self.points[rows].mean(axis=1)), dtype=bool)
            found += [(kind, rows[there])] if there.any() else []
        if not found:
            raise InputError(f"The boundary '{name}' has no face: its condition holds at the centre of none.")
        return found

    def outer_faces(self) -> Blocks:
        """Faces that belong to one cell only, by their corners.

        >>> conetact.Mesh([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)]).outer_faces()
        [('line', array([[0, 1],
               [1, 2],
               [2, 0]]))]
        """
        faces = faces_of(self.cells, self.dimension)
        blocks = []
        for n, rows in sorted(faces.items()):
            _, first, times = np.unique(np.sort(rows, axis=1), axis=0, return_index=True, return_counts=True)
            blocks.append((kind_with(n, self.dimension - 1) or "", rows[np.sort(first[times == 1])]))
        return blocks

    def save(self, file: str | os.PathLike[str]) -> Path:
        """Writes a file of Gmsh, version 2.2, which a scene can name.

        >>> conetact.Mesh([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)]).save("triangle.msh").name
        'triangle.msh'
        """
        file = Path(file)
        try:
            file.write_text(gmsh_text(self), encoding="utf-8")
        except OSError as error:
            raise InputError(f"The mesh cannot be written to {file}: {error.strerror}.") from None
        return file

    def __repr__(self) -> str:
        named = {"boundary": list(self.boundary), "groups": list(self.groups)}
        lists = [f"{what} {', '.join(map(str, names))}" for what, names in named.items() if names]
        cells = ", ".join(f"{len(rows)} {kind}" for kind, rows in self.cells)
        return f"Mesh({'; '.join([f'{self.dimension}D: {len(self.points)} points, {cells}', *lists])})"


def from_meshio(mesh: Any) -> Mesh:
    """A mesh of meshio (`meshio.read(...)`); cell sets and physical groups become boundaries and groups of cells.

    >>> class Block:
    ...     type, data = "triangle", [(0, 1, 2)]
    >>> class Read:  # in place of meshio.read("part.inp")
    ...     points, cells, cell_sets = [(0, 0), (1, 0), (0, 1)], [Block], {"steel": [[0]]}
    >>> conetact.from_meshio(Read)
    Mesh(2D: 3 points, 1 triangle; groups steel)
    """
    blocks: Blocks = [(block.type, array_of_cells(block.data)) for block in mesh.cells]
    marks = {**marks_of_sets(mesh), **marks_of_tags(mesh, blocks)}
    return mesh_with_marks(mesh.points, blocks, marks)


def marks_of_sets(mesh: Any) -> dict[Name, list[Cells]]:
    """Numbers of cells in each block; meshio has None or nothing where a block has none."""
    sets = getattr(mesh, "cell_sets", None) or {}
    return {name: [np.asarray([] if part is None else part, dtype=np.int64) for part in parts]
            for name, parts in sets.items() if not str(name).startswith("gmsh:")}


def marks_of_tags(mesh: Any, blocks: Blocks) -> dict[Name, list[Cells]]:
    """Of physical groups that were read from a file of Gmsh; groups without a name keep their number."""
    tags = (getattr(mesh, "cell_data", None) or {}).get("gmsh:physical")
    if tags is None:
        return {}
    names = {(int(tag), int(dim)): name for name, (tag, dim) in (getattr(mesh, "field_data", None) or {}).items()}
    marks: dict[Name, list[Cells]] = {}
    for i, ((kind, _), numbers) in enumerate(zip(blocks, tags)):
        for tag in np.unique(numbers[numbers != 0]):
            name = names.get((int(tag), KINDS[kind].dimension if kind in KINDS else -1), int(tag))
            empty = [np.empty(0, dtype=np.int64) for _ in blocks]
            marks.setdefault(name, empty)[i] = np.flatnonzero(numbers == tag)
    return marks


def from_pyvista(grid: Any, boundary: str = "gmsh:physical") -> Mesh:
    """A mesh of pyvista. The array `boundary` of cells, if there is one, has numbers of groups; 0 is none.

    Faces (in the plane lines) among the cells of the grid are boundaries, volumes groups of cells.

    >>> class Grid:  # in place of pyvista.read("part.vtu")
    ...     points, cells_dict, celltypes = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], {5: [(0, 1, 2)], 3: [(0, 1)]}, [5, 3]
    ...     cell_data = {"gmsh:physical": [0, 7]}
    >>> conetact.from_pyvista(Grid)
    Mesh(2D: 3 points, 1 triangle; boundary 7)
    """
    if not hasattr(grid, "cells_dict"):
        grid = grid.cast_to_unstructured_grid()
    kinds, tags = np.asarray(grid.celltypes), None
    if boundary in grid.cell_data:
        tags = np.asarray(grid.cell_data[boundary]).astype(np.int64)
    blocks: Blocks = [(vtk_name(kind), array_of_cells(rows)) for kind, rows in grid.cells_dict.items()]
    of_blocks = [] if tags is None else [tags[kinds == kind] for kind in grid.cells_dict]
    numbers = sorted({int(tag) for part in of_blocks for tag in part} - {0})
    marks: dict[Name, list[Cells]] = {tag: [np.flatnonzero(part == tag) for part in of_blocks] for tag in numbers}
    return mesh_with_marks(grid.points, blocks, marks)


def vtk_name(kind: int) -> str:
    if int(kind) not in OF_VTK:
        raise InputError(f"Cells of VTK's type {kind} are not known. There are: {', '.join(map(str, sorted(OF_VTK)))}.")
    return OF_VTK[int(kind)]


def mesh_of(thing: Any) -> Mesh:
    """A Mesh of what has the attributes of one of meshio or pyvista.

    >>> triangle = conetact.Mesh([(0, 0), (1, 0), (0, 1)], [(0, 1, 2)])
    >>> conetact.mesh_of(triangle) is triangle
    True
    """
    if isinstance(thing, Mesh):
        return thing
    if hasattr(thing, "cells_dict") and hasattr(thing, "celltypes") or hasattr(thing, "cast_to_unstructured_grid"):
        return from_pyvista(thing)
    if hasattr(thing, "points") and hasattr(thing, "cells"):
        return from_meshio(thing)
    raise InputError("A mesh is a file, a Mesh, entries of box(), or of meshio or pyvista; this is of type "
                     f"{type(thing).__name__}.")


def mesh_with_marks(points: npt.ArrayLike, blocks: Blocks, marks: Mapping[Name, list[Cells]]) -> Mesh:
    """Cells of the highest dimension are the body, those below it are faces that count where they are in a group."""
    known = [KINDS[name].dimension if name in KINDS else -1 for name, _ in blocks]
    top = max(known, default=-1)
    cells = [block for block, dim in zip(blocks, known) if dim == top]
    if top < 2:
        kinds = ", ".join(name for name, _ in blocks) or "none"
        raise InputError(f"The mesh has no cells that a body can have. Its kinds are: {kinds}.")
    starts = np.cumsum([0, *(len(rows) if dim == top else 0 for (_, rows), dim in zip(blocks, known))])
    mesh = Mesh(used_plane(points, top), joined(cells))
    order = stable_order(cells)
    for name, parts in marks.items():
        volumes = [part + starts[i] for i, part in enumerate(parts) if known[i] == top]
        faces = [(blocks[i][0], blocks[i][1][part]) for i, part in enumerate(parts)
                 if known[i] == top - 1 and len(part)]
        if sum(map(len, volumes)):
            mesh.groups[name] = np.sort(order[np.concatenate(volumes)])
        if faces:
            mesh.boundary[name] = faces
    return mesh


def used_plane(points: npt.ArrayLike, dimension: int) -> Points:
    array = points_of(points)
    if dimension == 2 and not is_plane(array):
        raise InputError("The mesh has cells of the plane only, but its points are not in the plane z = 0. "
                         "A body in space needs tetrahedra or hexahedra.")
    return array


def joined(blocks: Blocks) -> dict[str, Cells]:
    """One array for each kind."""
    kinds = dict.fromkeys(name for name, _ in blocks)
    return {kind: np.concatenate([rows for name, rows in blocks if name == kind]) for kind in kinds}


def stable_order(blocks: Blocks) -> Cells:
    """Where a cell of the blocks stands once blocks of a kind are joined."""
    kinds = list(dict.fromkeys(name for name, _ in blocks))
    place = np.concatenate([np.full(len(rows), kinds.index(name)) for name, rows in blocks])
    order = np.empty(len(place), dtype=np.int64)
    order[np.argsort(place, kind="stable")] = np.arange(len(place))
    return order


def points_of(points: npt.ArrayLike) -> Points:
    array = np.asarray(points, dtype=float)
    if array.ndim != 2 or array.shape[1] not in (2, 3) or not np.isfinite(array).all():
        raise InputError("Points are an array of finite numbers with 2 or 3 columns; this one is of shape "
                         f"{array.shape}.")
    return np.pad(array, ((0, 0), (0, 3 - array.shape[1])))


def is_plane(points: Points) -> bool:
    return not points[:, 2].any()


def array_of_cells(rows: npt.ArrayLike) -> Cells:
    array = np.asarray(rows)
    if array.ndim != 2 or array.dtype.kind not in "iu":
        raise InputError(f"Cells are an array of whole numbers, a row for each; this one is of shape {array.shape} and "
                         f"type {array.dtype}.")
    return array.astype(np.int64)


def blocks_of(cells: npt.ArrayLike | Mapping[str, npt.ArrayLike], kind: str | None, dimension: int) -> Blocks:
    if isinstance(cells, Mapping):
        return [(checked_kind(name, rows), array_of_cells(rows)) for name, rows in cells.items()]
    rows = array_of_cells(cells)
    name = kind or kind_with(rows.shape[1], dimension)
    if name is None:
        raise InputError(f"There is no kind of cell of dimension {dimension} with {rows.shape[1]} nodes.")
    return [(checked_kind(name, rows), rows)]


def checked_kind(name: str, rows: npt.ArrayLike) -> str:
    if name not in KINDS:
        raise InputError(f"Cells '{name}' are not known. There are: {', '.join(KINDS)}.")
    if (n := array_of_cells(rows).shape[1]) != KINDS[name].nodes:
        raise InputError(f"Cells '{name}' have {KINDS[name].nodes} nodes; these have {n}.")
    return name


def check_name(name: Name) -> None:
    """Entries of scenes have names in lists."""
    if isinstance(name, str) and (name != name.strip() or not name or re.search(r'[,#"\n]', name)):
        raise InputError(f"The name '{name}' cannot be used in a mesh. Choose one without , # and quotes.")


def check_nodes(blocks: Blocks, n_points: int) -> None:
    for name, rows in blocks:
        if len(rows) and (rows.min() < 0 or rows.max() >= n_points):
            raise InputError(f"Cells '{name}' name the nodes {rows.min()} to {rows.max()}; "
                             f"there are 0 to {n_points - 1}.")


def cell_numbers(rows: npt.ArrayLike, n_cells: int) -> Cells:
    """Of a list of numbers, or of true and false for each cell."""
    array = np.asarray(rows)
    numbers = np.flatnonzero(array) if array.dtype == bool else array.astype(np.int64)
    if len(numbers) and (numbers.min() < 0 or numbers.max() >= n_cells):
        raise InputError(f"A group names the cells {numbers.min()} to {numbers.max()}; there are 0 to {n_cells - 1}.")
    return numbers


def faces_of(blocks: Blocks, dimension: int) -> dict[int, Cells]:
    """Faces of all cells by their number of corners."""
    faces: dict[int, list[Cells]] = {}
    for name, rows in blocks:
        if KINDS[name].dimension == dimension:
            for corners in KINDS[name].faces:
                faces.setdefault(len(corners), []).append(rows[:, corners])
    return {n: np.concatenate(parts) for n, parts in faces.items()}


def numbers_of(names: Iterable[Name]) -> dict[Name, int]:
    """Numbers stand for themselves; names get those that are free."""
    names = list(names)
    taken = {int(name) for name in names if not isinstance(name, str)}
    free = iter(number for number in range(1, len(names) + len(taken) + 1) if number not in taken)
    return {name: next(free) if isinstance(name, str) else int(name) for name in names}


def gmsh_text(mesh: Mesh) -> str:
    """Elements in several groups stand there once for each."""
    faces, cells = numbers_of(mesh.boundary), numbers_of(mesh.groups)
    rows = [*face_rows(mesh, faces), *cell_rows(mesh, cells)]
    names = [f'{dim} {number} "{name}"' for dim, numbers in ((mesh.dimension - 1, faces), (mesh.dimension, cells))
             for name, number in numbers.items() if isinstance(name, str)]
    points = [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(mesh.points.tolist(), 1)]
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names)), *names,
                      "$EndPhysicalNames", "$Nodes", str(len(points)), *points, "$EndNodes", "$Elements",
                      str(len(rows)), *(f"{i} {row}" for i, row in enumerate(rows, 1)), "$EndElements", ""])


def face_rows(mesh: Mesh, numbers: Mapping[Name, int]) -> list[str]:
    return [row for name, blocks in mesh.boundary.items() for kind, rows in blocks
            for row in element_rows(kind, rows, [numbers[name]] * len(rows))]


def cell_rows(mesh: Mesh, numbers: Mapping[Name, int]) -> list[str]:
    of_cell: list[list[int]] = [[] for _ in range(mesh.n_cells)]
    for name, cells in mesh.groups.items():
        for cell in cells.tolist():
            of_cell[cell].append(numbers[name])
    lines: list[str] = []
    start = 0
    for kind, rows in mesh.cells:
        groups = [of_cell[start + i] or [0] for i in range(len(rows))]
        repeats = np.repeat(np.arange(len(rows)), [len(group) for group in groups])
        lines += element_rows(kind, rows[repeats], [number for group in groups for number in group])
        start += len(rows)
    return lines


def element_rows(kind: str, rows: Cells, groups: list[int]) -> list[str]:
    order = KINDS[kind].order or tuple(range(KINDS[kind].nodes))
    head = KINDS[kind].gmsh
    return [f"{head} 2 {group} {group} {' '.join(map(str, nodes))}"
            for group, nodes in zip(groups, (rows[:, order] + 1).tolist())]
