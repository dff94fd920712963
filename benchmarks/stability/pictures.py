# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes and fields of VTU files, and the distance of points to a mesh's surface by brute force."""
from collections import Counter

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

# corners of the faces of VTK's quadrilateral and hexahedron, outward
FACES = {4: ((0, 1), (1, 2), (2, 3), (3, 0)),
         8: ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7))}


def read_vtu(file):
    """Places of points, corners of cells, and arrays of points by name."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    data = grid.GetPointData()
    arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    corners = [[grid.GetCell(c).GetPointId(k) for k in range(grid.GetCell(c).GetNumberOfPoints())]
               for c in range(grid.GetNumberOfCells())]
    return vtk_to_numpy(grid.GetPoints().GetData()).astype(float), np.array(corners), arrays


def surface(points, cells):
    """Corners of the faces that belong to one cell only; outward whatever the order of the cell's corners."""
    scale = np.ptp(points, axis=0).max()
    _, merged = np.unique(np.round(points / scale, 6), axis=0, return_inverse=True)
    merged = merged.reshape(-1)
    faces = [(cell[list(f)], points[cell].mean(axis=0)) for cell in cells for f in FACES[len(cell)]]
    keys = [tuple(sorted(merged[f])) for f, _ in faces]
    count = Counter(keys)
    result = []
    for (face, inside), key in zip(faces, keys):
        if count[key] == 1:
            corners = points[face]
            n = face_normals(corners[None], np.full((1, 2), .5))[0]
            result.append(corners if n @ (corners.mean(axis=0) - inside) > 0 else corners[::-1])
    return np.array(result)


def on_face(faces, s):
    """Places with local coordinates s on segments or bilinear faces."""
    x, y = s[:, 0, None], s[:, 1, None]
    if faces.shape[1] == 2:
        return (1 - x) * faces[:, 0] + x * faces[:, 1]
    return (1 - x) * (1 - y) * faces[:, 0] + x * (1 - y) * faces[:, 1] + x * y * faces[:, 2] + (1 - x) * y * faces[:, 3]


def slopes(faces, s):
    x, y = s[:, 0, None], s[:, 1, None]
    if faces.shape[1] == 2:
        a = faces[:, 1] - faces[:, 0]
        return a, np.zeros_like(a)
    return ((1 - y) * (faces[:, 1] - faces[:, 0]) + y * (faces[:, 2] - faces[:, 3]),
            (1 - x) * (faces[:, 3] - faces[:, 0]) + x * (faces[:, 2] - faces[:, 1]))


def face_normals(faces, s):
    a, b = slopes(faces, s)
    n = np.cross(a, b) if faces.shape[1] == 4 else np.stack([a[:, 1], -a[:, 0], 0 * a[:, 0]], axis=1)
    return n / np.linalg.norm(n, axis=1)[:, None]


def closest(faces, point):
    """Local coordinates of the closest point of every face: Gauss-Newton in the unit square, from several starts."""
    best = np.full(len(faces), np.inf)
    found = np.zeros((len(faces), 2))
    for start in ((.5, .5), (0, 0), (1, 0), (1, 1), (0, 1)) if faces.shape[1] == 4 else ((.5, .5),):
        s = np.tile(np.array(start, dtype=float), (len(faces), 1))
        for _ in range(40):
            s = improved(faces, s, point)
        d = np.linalg.norm(on_face(faces, s) - point, axis=1)
        better = d < best
        best[better], found[better] = d[better], s[better]
    return found, best


def improved(faces, s, point):
    """One coordinate after the other, each exactly: the distance is quadratic along it."""
    for k in range(faces.shape[1] // 2):
        zero, one = s.copy(), s.copy()
        zero[:, k], one[:, k] = 0, 1
        a = on_face(faces, zero)
        d = on_face(faces, one) - a
        s[:, k] = np.clip(np.sum((point - a) * d, axis=1) / np.sum(d * d, axis=1), 0, 1)
    return s
