# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the VTU files of the program, XML with zipped arrays behind it, and the PVTU files that join some."""
from __future__ import annotations

import xml.etree.ElementTree as xml
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "<u1", "UInt32": "<u4",
         "UInt64": "<u8"}
LINE, TRIANGLE, QUADRILATERAL, TETRAHEDRON, HEXAHEDRON = 3, 5, 9, 10, 12


@dataclass
class VtuMesh:
    """Points (n x 3), cells by VTK's type, arrays of the points and of the cells by name.

    >>> mesh = conetact.run(SCENE).bodies(1)["block"]
    >>> mesh.points.shape, sorted(mesh.cells), sorted(mesh.cell_arrays)
    ((231, 3), [9], ['body', 'material_id'])
    """

    points: Array
    cells: dict[int, Array]
    arrays: dict[str, Array]
    cell_arrays: dict[str, Array]


ARRAYS = b'<AppendedData encoding="raw">\n_'


def unzipped(data: memoryview) -> bytes:
    """Blocks behind a head that tells how many there are, their size, that of the last one, and zipped sizes."""
    n_blocks = int(np.frombuffer(data, "<u4", 1)[0])
    sizes = np.frombuffer(data, "<u4", 3 + n_blocks)[3:]
    ends = 4 * (3 + n_blocks) + np.cumsum(sizes, dtype=int)
    return b"".join(zlib.decompress(data[end - size:end]) for size, end in zip(sizes, ends))


def array_of(element: xml.Element | None, arrays: memoryview) -> Array:
    if element is None:
        raise ValueError("it lacks an array")
    values: Array = np.frombuffer(unzipped(arrays[int(element.attrib["offset"]):]), TYPES[element.attrib["type"]])
    components = int(element.get("NumberOfComponents", 1))
    return values.reshape(-1, components) if components > 1 else values


def cells_of(arrays: Mapping[str, Array]) -> dict[int, Array]:
    """Corners of cells, an array for each type."""
    offsets = arrays["offsets"]
    cells: dict[int, Array] = {}
    for kind in np.unique(arrays["types"]):
        ends = offsets[arrays["types"] == kind]
        n = offsets[0] if len(ends) == len(offsets) else np.diff(offsets, prepend=0)[arrays["types"] == kind][0]
        cells[int(kind)] = arrays["connectivity"][ends[:, None] - n + np.arange(n)]
    return cells


def pieces_of(file: str | Path) -> list[str]:
    try:
        return [piece.attrib["Source"] for piece in xml.parse(file).getroot().findall("PUnstructuredGrid/Piece")]
    except (xml.ParseError, KeyError) as error:
        raise ValueError(f"{file} is no PVTU file of the program ({error}).") from None


def joined(meshes: Sequence[VtuMesh]) -> VtuMesh:
    first = np.cumsum([0] + [len(mesh.points) for mesh in meshes])

    def together(parts: Sequence[Mapping[Any, Array]]) -> dict[Any, Array]:
        return {name: np.concatenate([part[name] for part in parts if name in part])
                for name in dict.fromkeys(name for part in parts for name in part)}

    cells = [{kind: cells + start for kind, cells in mesh.cells.items()} for mesh, start in zip(meshes, first)]
    return VtuMesh(np.concatenate([mesh.points for mesh in meshes]), together(cells),
                   together([mesh.arrays for mesh in meshes]), together([mesh.cell_arrays for mesh in meshes]))


def read_vtu(file: str | Path) -> VtuMesh:
    """A VTU file of the program; of a PVTU file the pieces in turn: points between them come once in each.

    >>> result = conetact.run(SCENE)
    >>> conetact.read_vtu(result.folder / "solution-block-0001.vtu").arrays["stress"].shape
    (231, 9)
    """
    if Path(file).suffix == ".pvtu":
        return joined([read_vtu(Path(file).parent / name) for name in pieces_of(file)])
    try:
        text, _, behind = Path(file).read_bytes().partition(ARRAYS)
        piece, data = xml.fromstring(text + b"</VTKFile>" if behind else text).find("UnstructuredGrid/Piece"), memoryview(behind)
        if piece is None:
            raise ValueError("it holds no grid")
        points = array_of(piece.find("Points/DataArray"), data).astype(float)
        cells = cells_of({a.attrib["Name"]: array_of(a, data) for a in piece.findall("Cells/DataArray")})
        arrays = {a.attrib["Name"]: array_of(a, data).astype(float) for a in piece.findall("PointData/DataArray")}
        of_cells = {a.attrib["Name"]: array_of(a, data) for a in piece.findall("CellData/DataArray")}
    except (xml.ParseError, AttributeError, KeyError, ValueError, zlib.error) as error:
        raise ValueError(f"{file} is no VTU file of the program ({error}).") from None
    return VtuMesh(points.reshape(-1, 3), cells, arrays, of_cells)
