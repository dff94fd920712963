# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A manufactured frictional solution, a scene made from it, and its errors.

A unit square or cube stands with its bottom, last coordinate z = 0, on a rough floor.
The displacement is prescribed; with d a direction along the floor, xi the coordinate
along it, and two functions S and A of xi,

    u_t = d (S cos z + A sin z),   u_n = -S' sin z - A' (1 - cos z),

free of changes of volume, so that it serves nearly incompressible bodies as well.
Contact closes everywhere, with the pressure p = 2 G S' and the friction G A. At time 1
the friction is at its limit, A = 2 mu S', and every node slips by S along d; at time 2
it has fallen and every node sticks, its slip unchanged. Body force and tractions
follow from the field; the top is moved by it.
"""
import math

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from support.scenes import floor, load, merge, support

MU = .4
DIRECTION = {2: (1.0,), 3: (.8, .6)}
QUARTER = math.pi / 2


class Field:
    """Sum of products of sines: terms (factor, ((k, phase) of each coordinate))."""

    def __init__(self, terms):
        self.terms = [term for term in terms if term[0] != 0]

    def __add__(self, other):
        return Field(self.terms + other.terms)

    def __rmul__(self, number):
        return Field([(number * factor, waves) for factor, waves in self.terms])

    def times_wave(self, axis, k, phase):
        """Times sin(k x + phase) of a coordinate that it does not depend on yet."""
        return Field([(factor, waves[:axis] + ((k, phase),) + waves[axis + 1:]) for factor, waves in self.terms])

    def slope(self, axis):
        return Field([(factor * waves[axis][0],
                       waves[:axis] + ((waves[axis][0], waves[axis][1] + QUARTER),) + waves[axis + 1:])
                      for factor, waves in self.terms])

    def at(self, points):
        """Values on the lattice of the given coordinates, one array an axis."""
        total = 0.0
        for factor, waves in self.terms:
            product = np.array(factor)
            for x, (k, phase) in zip(points, waves):
                product = np.multiply.outer(product, np.sin(k * x + phase))
            total = total + product
        return total

    def at_each(self, places):
        """Values at the rows of an array."""
        return sum((factor * np.prod([np.sin(k * x + phase) for x, (k, phase) in zip(places.T, waves)], axis=0)
                    for factor, waves in self.terms), np.zeros(len(places)))

    def text(self):
        def wave(name, k, phase):
            return f" * sin({k!r}*{name} + {phase!r})" if k else f" * {math.sin(phase)!r}"
        return " + ".join(repr(factor) + "".join(wave(name, *w) for name, w in zip("xyz", waves))
                          for factor, waves in self.terms) or "0"


def wave(dim, factor, k, phase):
    """factor sin(k xi + phase), a sum of products of sines of the coordinates."""
    k = [k * d for d in DIRECTION[dim]]
    if dim == 2:
        return Field([(factor, ((k[0], phase), (0, QUARTER)))])
    return Field([(factor, ((k[0], phase + shift), (k[1], QUARTER - shift), (0, QUARTER))) for shift in (0, QUARTER)])


class Solution:
    """Displacement, stresses and loads at time 1 (slip) or 2 (stick); Young's modulus 1."""

    def __init__(self, dim, poisson, time):
        self.dim, n, k, phase = dim, dim - 1, .8, .2
        self.shear = .5 / (1 + poisson)
        self.lame = poisson / ((1 + poisson) * (1 - 2 * poisson))
        share = 2 * MU * (1.0 if time == 1 else .4)
        S, dS, ddS = (wave(dim, .01 * k**i, k, phase + i * QUARTER) for i in range(3))
        A, dA = share * dS, share * ddS
        along = S.times_wave(n, 1.0, QUARTER) + A.times_wave(n, 1.0, 0.0)
        up = dS.times_wave(n, 1.0, 0.0) + dA + -1 * dA.times_wave(n, 1.0, QUARTER)
        self.u = [d * along for d in DIRECTION[dim]] + [-1 * up]
        self.gradient = [[u.slope(j) for j in range(dim)] for u in self.u]
        self.stress = [[self.shear * (self.gradient[i][j] + self.gradient[j][i]) for j in range(dim)]
                       for i in range(dim)]

    def body_force(self):
        return [-1 * sum((self.stress[i][j].slope(j) for j in range(self.dim)), Field([])) for i in range(self.dim)]


def scene(dim, cells, poisson=.3):
    """Both times as two increments on a lattice of `cells` a side."""
    both = [Solution(dim, poisson, time) for time in (1, 2)]

    def in_time(first, second):
        return f"min(t, 2 - t) * ({first.text()}) + max(0, t - 1) * ({second.text()})"

    def vectors(of):
        return " ; ".join(in_time(*pair) for pair in zip(*map(of, both)))

    result = {"Dimension": dim,
              "Body block": {"Mesh": {"Generator": "subdivided_hyper_cube", "Arguments": f"{cells} : 0 : 1 : true"},
                             "Material": {"Young modulus": 1.0, "Poisson ratio": poisson}},
              "Obstacle floor": floor(dim),
              "Contact bottom": {"Body": "block", "Boundary ids": 2 * dim - 2, "Obstacle": "floor",
                                 "Friction coefficient": MU},
              "Support top": support(2 * dim - 1, ", ".join("xyz"[:dim]), vectors(lambda s: s.u)),
              "Load inside": load("body force", vectors(lambda s: s.body_force())),
              "Time": {"End": 2, "Increments": 2}}
    for axis in range(dim - 1):
        for side, sign in ((0, -1), (1, 1)):
            result[f"Load side {'xyz'[axis]}{side}"] = load(
                "traction", vectors(lambda s: [sign * s.stress[i][axis] for i in range(dim)]), 2 * axis + side)
    return result


def read_displacement(file, dim, cells):
    """Nodal displacements of a VTU file on the lattice: [node, ..., component]; `cells`: its gaps a side."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    places = np.rint(vtk_to_numpy(grid.GetPoints().GetData())[:, :dim] * cells).astype(int)
    u = np.zeros((cells + 1,) * dim + (dim,))
    u[tuple(places.T)] = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))[:, :dim]
    return u


def nodal_errors(file, solution):
    """Relative errors of displacements and of mean stresses at the points of a VTU file."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid, dim = reader.GetOutput(), solution.dim
    places = vtk_to_numpy(grid.GetPoints().GetData())[:, :dim]
    stress = vtk_to_numpy(grid.GetPointData().GetArray("stress")).reshape(-1, 3, 3)[:, :dim, :dim]
    u = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))[:, :dim]
    exact = np.stack([f.at_each(places) for f in solution.u], axis=-1)
    exact_stress = np.stack([f.at_each(places) for row in solution.stress for f in row], axis=-1).reshape(stress.shape)
    return [np.linalg.norm(a - b) / np.linalg.norm(b) for a, b in ((u, exact), (stress, exact_stress))]


def gauss_of_simplex(dim, n=5):
    """Points in barycentric coordinates and weights of a sum of 1: those of a cube whose sides run together."""
    x, w = np.polynomial.legendre.leggauss(n)
    x, w = (x + 1) / 2, w / 2
    cube = np.stack(np.meshgrid(*[x] * dim, indexing="ij"), axis=-1).reshape(-1, dim)
    weights = np.prod(np.stack(np.meshgrid(*[w] * dim, indexing="ij"), axis=-1).reshape(-1, dim), axis=1)
    points, left = [], np.ones(len(cube))
    for d in range(dim):
        weights = weights * (1 - cube[:, d])**(dim - 1 - d)
        points.append(left * cube[:, d])
        left = left * (1 - cube[:, d])
    return np.stack([left, *points], axis=-1), weights * math.factorial(dim)


def simplex_shapes(barycentric, n_nodes):
    """Of VTK's triangles and tetrahedra: values, and derivatives by barycentric coordinates."""
    n = barycentric.shape[-1]
    identity = np.eye(n)
    if n_nodes == n:
        return barycentric, np.broadcast_to(identity, (len(barycentric), n, n))
    edges = ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))[:n_nodes - n]
    L = barycentric
    values = [L[:, i] * (2 * L[:, i] - 1) for i in range(n)] + [4 * L[:, i] * L[:, j] for i, j in edges]
    slopes = [np.outer(4 * L[:, i] - 1, identity[i]) for i in range(n)]
    slopes += [4 * (np.outer(L[:, i], identity[j]) + np.outer(L[:, j], identity[i])) for i, j in edges]
    return np.stack(values, axis=-1), np.stack(slopes, axis=1)


def simplex_errors(file, solution):
    """Relative errors of a VTU file with straight triangles or tetrahedra: L2 norm of displacements, energy norm."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid, dim = reader.GetOutput(), solution.dim
    nodes = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
    places = vtk_to_numpy(grid.GetPoints().GetData())[:, :dim][nodes]
    u = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))[:, :dim][nodes]
    corners = places[:, :dim + 1]
    edges = np.swapaxes(corners[:, 1:] - corners[:, :1], 1, 2)
    inverse = np.linalg.inv(edges)  # derivatives of all barycentric coordinates but the first one
    of_place = np.concatenate([-inverse.sum(axis=1, keepdims=True), inverse], axis=1)
    points, weights = gauss_of_simplex(dim, 4 if nodes.shape[1] > dim + 1 else 2)
    values, slopes = simplex_shapes(points, nodes.shape[1])
    weights = np.abs(np.linalg.det(edges))[:, None] * weights / math.factorial(dim)
    at = np.einsum("qv,cvd->cqd", points, corners).reshape(-1, dim)
    found = np.einsum("qn,cni->cqi", values, u), np.einsum("qnv,cvj,cni->cqij", slopes, of_place, u, optimize=True)
    exact = [np.stack([f.at_each(at) for f in row], axis=-1) for row in (solution.u, *solution.gradient)]
    exact = exact[0].reshape(found[0].shape), np.stack(exact[1:], axis=1).reshape(found[1].shape)

    def norms(of_u, of_gradient):
        trace = np.trace(of_gradient, axis1=2, axis2=3)
        both = of_gradient + np.swapaxes(of_gradient, 2, 3)
        energy = solution.shear / 2 * (both**2).sum(axis=(2, 3)) + solution.lame * trace**2
        return np.sqrt([(weights * (of_u**2).sum(axis=2)).sum(), (weights * energy).sum()])
    return norms(*(a - b for a, b in zip(found, exact))) / norms(*exact)


def errors(u, solution, degree=1):
    """
    Relative errors of a field of this degree in each coordinate: L2 norm of displacements, energy norm, and
    the latter with changes of volume as means of cells, as some elements take them.
    """
    dim, cells = solution.dim, (u.shape[0] - 1) // degree
    gauss, weight = np.polynomial.legendre.leggauss(degree + 2)
    gauss, weight = (gauss + 1) / 2, weight / 2
    x = ((np.arange(cells)[:, None] + gauss) / cells).ravel()
    weights = np.array(1.0)
    for _ in range(dim):
        weights = np.multiply.outer(weights, np.tile(weight / cells, cells))
    cell, s = np.repeat(np.arange(cells), gauss.size), np.tile(gauss, cells)
    shapes, slopes = {1: ((1 - s, s), (-1 + 0 * s, 1 + 0 * s)),
                      2: (((1 - 2 * s) * (1 - s), 4 * s * (1 - s), s * (2 * s - 1)), (4 * s - 3, 4 - 8 * s, 4 * s - 1))}[degree]

    def along(values, axis, differentiate):
        shape = [-1 if d == axis else 1 for d in range(dim)]
        return sum((cells * slope if differentiate else N).reshape(shape) * np.take(values, degree * cell + i, axis)
                   for i, (N, slope) in enumerate(zip(shapes, slopes)))

    def interpolated(values, slope=None):
        for axis in range(dim):
            values = along(values, axis, axis == slope)
        return values

    def mean_of_cells(values):
        for axis in range(dim):
            shape = values.shape[:axis] + (cells, gauss.size) + values.shape[axis + 1:]
            values = np.repeat(np.average(values.reshape(shape), axis + 1, weight), gauss.size, axis)
        return values

    def norms(of_u, of_gradient):
        l2 = sum((weights * f**2).sum() for f in of_u)
        trace = sum(of_gradient[i][i] for i in range(dim))
        shear = sum(solution.shear / 2 * (weights * (of_gradient[i][j] + of_gradient[j][i])**2).sum()
                    for i in range(dim) for j in range(dim))
        volume = [solution.lame * (weights * t**2).sum() for t in (trace, mean_of_cells(trace))]
        return np.sqrt([l2, shear + volume[0], shear + volume[1]])

    points = [x] * dim
    exact = [f.at(points) for f in solution.u]
    exact_slopes = [[f.at(points) for f in row] for row in solution.gradient]
    wrong = [interpolated(u[..., i]) - exact[i] for i in range(dim)]
    wrong_slopes = [[interpolated(u[..., i], j) - exact_slopes[i][j] for j in range(dim)] for i in range(dim)]
    return norms(wrong, wrong_slopes) / norms(exact, exact_slopes)


def pressure_error(rows, solution, cells, degree=1):
    """Relative L2 error of reactions over areas, normal and tangential."""
    def share(x):
        at_side = .5 if min(x, 1 - x) < 1e-9 else 1
        return at_side / cells * (1 if degree == 1 else 2 / 3 if round(2 * x * cells) % 2 else 1 / 3)
    wrong = size = 0.0
    for row in rows:
        place = (row["x"], row["y"])[:solution.dim - 1]
        area = math.prod(map(share, place))
        at = [np.array([x]) for x in place] + [np.zeros(1)]
        exact = [-solution.stress[i][solution.dim - 1].at(at).item() for i in range(solution.dim)]
        found = [row[c] / area for c in ("r_t1", "r_t2")[:solution.dim - 1] + ("r_n",)]
        wrong += area * math.dist(found, exact)**2
        size += area * math.dist(exact, [0] * len(exact))**2
    return math.sqrt(wrong / size)


def solution_errors(laws, dim, cells, poisson=.3, body=(), degree=1):
    """Errors of the manufactured solution at both times: displacement, energy, contact stresses."""
    run = laws.run(merge(scene(dim, cells, poisson), {"Body block": dict(body)}))
    result = []
    for time, state in ((1, "slip"), (2, "stick")):
        solution = Solution(dim, poisson, time)
        file, = run.folder.glob(f"solution-*{time:04}.vtu")
        rows = [row for row in run.rows if row["increment"] == time]
        if any(row["state"] != state for row in rows):
            laws.demand(f"{dim}D, {cells} cells: every node in {state}", False)
        result += [*errors(read_displacement(file, dim, degree * cells), solution, degree)[:2],
                   pressure_error(rows, solution, cells, degree)]
    return result


def error_over_areas(rows, solution):
    """Relative L2 error of the contact stresses of rows, normal and tangential."""
    wrong = size = 0.0
    for row in rows:
        at = np.array([[row[c] for c in "xyz"[:solution.dim]]])
        exact = [-solution.stress[i][solution.dim - 1].at_each(at).item() for i in range(solution.dim)]
        found = [row[c] / row["area"] for c in ("r_t1", "r_t2")[:solution.dim - 1] + ("r_n",)]
        wrong += row["area"] * math.dist(found, exact)**2
        size += row["area"] * math.dist(exact, [0] * len(exact))**2
    return math.sqrt(wrong / size)


def simplex_fields(laws, dim, n, element):
    """Both times of the manufactured solution on n cells a side: unknowns, and for each time errors."""
    body = {"Element": element} if dim == 3 else {
        "Element": element, "Mesh": {"Generator": "subdivided_hyper_cube_with_simplices"}}
    run = laws.run(merge(scene(dim, n), {"Body block": body}))
    found = []
    for time in (1, 2):
        solution = Solution(dim, .3, time)
        file = run.folder / f"solution-block-{time:04}.vtu"
        found.append({**dict(zip(("displacement at nodes", "stresses at nodes"), nodal_errors(file, solution))),
                      **dict(zip(("displacement in L2", "energy"), simplex_errors(file, solution))),
                      "pressures": error_over_areas([row for row in run.rows if row["increment"] == time], solution),
                      # at rims a mean over the faces of a node is that of a place beside it
                      "pressures inside": error_over_areas([row for row in run.rows if row["increment"] == time and all(
                          1e-9 < row[c] < 1 - 1e-9 for c in "xy"[:dim - 1])], solution)})
    return found
