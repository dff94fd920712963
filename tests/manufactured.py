# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A manufactured frictional solution, a scene made from it, and its errors.

A unit square or cube stands with its bottom, last coordinate 0, on a rough floor.
The displacement is prescribed as a field,

    u_t = d (s + a sin z),   u_n = b sin z,   d a direction along the floor,

(z the last coordinate, s, a, b smooth functions of the others), so that contact
closes everywhere with the pressure p and the friction a G: b follows from p. At
time 1 the floor is at its limit, a G = mu p, and every node slips by s along d; at
time 2 the pressure has grown, friction has fallen and every node sticks, its slip
unchanged. Body force and tractions follow from the field; the top is moved by it.
"""
import math

import numpy as np
from laws import floor, load, support
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

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

    def text(self):
        def wave(name, k, phase):
            return f" * sin({k!r}*{name} + {phase!r})" if k else f" * {math.sin(phase)!r}"
        return " + ".join(repr(factor) + "".join(wave(name, *w) for name, w in zip("xyz", waves))
                          for factor, waves in self.terms) or "0"


def constant(dim, value):
    return Field([(value, ((0, QUARTER),) * dim)])


class Solution:
    """Displacement, stresses and loads at time 1 (slip) or 2 (stick)."""

    def __init__(self, dim, poisson, time):
        self.dim, n = dim, dim - 1
        self.shear = .5 / (1 + poisson)  # Young's modulus 1
        self.lame = poisson / ((1 + poisson) * (1 - 2 * poisson))
        d = DIRECTION[dim]
        waves = ((2.0, .3), (1.5, .8))[:n] + ((0, QUARTER),)
        slip = constant(dim, .01) + Field([(.002, waves)])
        self.pressure = (1.0 if time == 1 else 1.3) * (constant(dim, .004) + Field([(.001, waves)]))
        friction = (MU if time == 1 else .4 * MU) * self.pressure
        a, b = 1 / self.shear * friction, self.pressure
        for t in range(n):
            b = b + self.lame * d[t] * slip.slope(t)
        b = -1 / (self.lame + 2 * self.shear) * b
        self.u = [d[t] * (slip + a.times_wave(n, 1.0, 0.0)) for t in range(n)] + [b.times_wave(n, 1.0, 0.0)]
        self.gradient = [[u.slope(j) for j in range(dim)] for u in self.u]
        trace = sum((self.gradient[i][i] for i in range(dim)), Field([]))
        self.stress = [[self.shear * (self.gradient[i][j] + self.gradient[j][i]) for j in range(dim)]
                       for i in range(dim)]
        for i in range(dim):
            self.stress[i][i] = self.stress[i][i] + self.lame * trace

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
    """Nodal displacements of a VTU file on the lattice: [node, ..., component]."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    grid = reader.GetOutput()
    places = np.rint(vtk_to_numpy(grid.GetPoints().GetData())[:, :dim] * cells).astype(int)
    u = np.zeros((cells + 1,) * dim + (dim,))
    u[tuple(places.T)] = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))[:, :dim]
    return u


def errors(u, solution):
    """Relative errors of a d-linear field: L2 norm of displacements, energy norm."""
    dim, cells = solution.dim, u.shape[0] - 1
    gauss, weight = np.polynomial.legendre.leggauss(3)
    gauss, weight = (gauss + 1) / 2, weight / 2
    x = ((np.arange(cells)[:, None] + gauss) / cells).ravel()
    weights = np.array(1.0)
    for _ in range(dim):
        weights = np.multiply.outer(weights, np.tile(weight / cells, cells))
    cell, place = np.repeat(np.arange(cells), gauss.size), np.tile(gauss, cells)

    def along(values, axis, differentiate):
        low, high = np.take(values, cell, axis), np.take(values, cell + 1, axis)
        share = place.reshape([-1 if d == axis else 1 for d in range(dim)])
        return cells * (high - low) if differentiate else (1 - share) * low + share * high

    def interpolated(values, slope=None):
        for axis in range(dim):
            values = along(values, axis, axis == slope)
        return values

    def norms(of_u, of_gradient):
        l2 = sum((weights * f**2).sum() for f in of_u)
        trace = sum(of_gradient[i][i] for i in range(dim))
        energy = solution.lame * (weights * trace**2).sum() + sum(
            solution.shear / 2 * (weights * (of_gradient[i][j] + of_gradient[j][i])**2).sum()
            for i in range(dim) for j in range(dim))
        return np.sqrt([l2, energy])

    points = [x] * dim
    exact = [f.at(points) for f in solution.u]
    slopes = [[f.at(points) for f in row] for row in solution.gradient]
    wrong = [interpolated(u[..., i]) - exact[i] for i in range(dim)]
    wrong_slopes = [[interpolated(u[..., i], j) - slopes[i][j] for j in range(dim)] for i in range(dim)]
    return norms(wrong, wrong_slopes) / norms(exact, slopes)


def pressure_error(rows, solution, cells):
    """Relative L2 error of reactions over areas, normal and tangential."""
    def share(x):
        return (.5 if min(x, 1 - x) < 1e-9 else 1) / cells
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
