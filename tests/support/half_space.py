# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hertz and Cattaneo-Mindlin: exact contact stresses, and scenes cut out of half spaces.

The far sides of each body are moved as they are moved in the half space: in the
plane by the exact displacement (Muskhelishvili's potentials of an elliptic stress),
so that nothing is left of the size L of the domain; in space by that of four forces
(Boussinesq, Cerruti) with the moments of the stress, which misses terms of order
(a/L)^5. Contact half width a = 1, Young's modulus 1, radius RADIUS.

Partial slip needs two bodies of one material, for pressure alone would make a body
slip on a rigid obstacle; in space Poisson's ratio 0, for else the slips are not
along the force. Sources: K. L. Johnson, Contact Mechanics, 1985, chapters 2 to 4, 7.
"""
import math

from support.scenes import contact, support, text

RADIUS = 100.0
MU = .5
SIZE = 4  # of the domain, L/a
STICK = .6  # c/a
POISSON = {"hertz": .3, "partial slip": {2: .3, 3: 0.0}}


class Elliptic:
    """Half plane y > 0 loaded over |x| < a by a stress k sqrt(1 - x^2/a^2), resultant `force`."""

    def __init__(self, a, force, poisson):
        self.a, self.kappa, shear = a, 3 - 4 * poisson, .5 / (1 + poisson)
        self.factor = force / (math.pi * a**2) / (2 * shear)

    def parts(self, y):
        """w = sqrt(z^2 - a^2), f = z - w, and g, the integral of f: real and imaginary parts."""
        a2 = repr(self.a**2)
        difference = f"(x^2 - {y}^2 - {a2})"
        modulus = f"sqrt({difference}^2 + (2*x*{y})^2)"
        X = f"(sign(x)*sqrt(0.5*max(0, {modulus} + {difference})))"
        Y = f"sqrt(0.5*max(0, {modulus} - {difference}))"
        g = (f"(0.5*(x^2 - {y}^2 - x*{X} + {y}*{Y}) + 0.25*{a2}*log((x + {X})^2 + ({y} + {Y})^2))",
             f"(x*{y} - 0.5*(x*{Y} + {y}*{X}) - 0.5*{a2}*atan((x + {X})/({y} + {Y})))")
        return (f"(x - {X})", f"({y} - {Y})"), g

    def centre(self):
        """Displacement of the origin along the force."""
        return -self.factor * (self.kappa + 1) * self.a**2 / 2 * math.log(self.a)

    def normal(self, y):
        """Displacement (u, v) under a pressure."""
        f, g = self.parts(y)
        return (f"{self.factor!r}*({self.kappa - 1!r}*{g[1]} + 2*{y}*{f[0]})",
                f"{-self.factor!r}*({self.kappa + 1!r}*{g[0]} + 2*{y}*{f[1]})")

    def tangential(self, y):
        """Displacement (u, v) under a shear stress along x."""
        f, g = self.parts(y)
        return (f"{-self.factor!r}*({self.kappa + 1!r}*{g[0]} - 2*{y}*{f[1]})",
                f"{-self.factor!r}*({self.kappa - 1!r}*{g[1]} - 2*{y}*{f[0]})")


def boussinesq(force, poisson, x, y, z):
    """Displacement by a normal force at the origin of coordinates that are given as texts."""
    r, k = f"sqrt({x}^2 + {y}^2 + {z}^2)", repr(force * (1 + poisson) / (2 * math.pi))
    side = f"({z}/{r}^3 - {1 - 2 * poisson!r}/({r}*({r} + {z})))"
    return f"{k}*{x}*{side}", f"{k}*{y}*{side}", f"{k}*({z}^2/{r}^3 + {2 - 2 * poisson!r}/{r})"


def cerruti(force, poisson, x, y, z):
    """The same by a force along x."""
    r, k = f"sqrt({x}^2 + {y}^2 + {z}^2)", repr(force * (1 + poisson) / (2 * math.pi))
    c = repr(1 - 2 * poisson)
    return (f"{k}*(1/{r} + {x}^2/{r}^3 + {c}*(1/({r} + {z}) - {x}^2/({r}*({r} + {z})^2)))",
            f"{k}*{x}*{y}*(1/{r}^3 - {c}/({r}*({r} + {z})^2))",
            f"{k}*{x}*({z}/{r}^3 + {c}/({r}*({r} + {z})))")


def far_field(kernel, force, poisson, z, mean_square):
    """Of a stress with this mean of r^2: four forces have the same moments up to the third."""
    d = repr(math.sqrt(mean_square))
    fields = [kernel(force / 4, poisson, x, y, z)
              for x, y in ((f"(x - {d})", "y"), (f"(x + {d})", "y"), ("x", f"(y - {d})"), ("x", f"(y + {d})"))]
    return tuple(" + ".join(component) for component in zip(*fields))


class Hertz:
    """Closed forms for a = 1; `n_elastic` bodies of modulus 1 touch."""

    def __init__(self, dim, poisson, n_elastic, radius=RADIUS):
        modulus = 1 / (n_elastic * (1 - poisson**2))
        self.dim = dim
        self.force = math.pi * modulus / (4 * radius) if dim == 2 else 4 * modulus / (3 * radius)
        self.peak = 2 * self.force / math.pi if dim == 2 else 3 * self.force / (2 * math.pi)
        self.approach = 1 / radius  # in space, of the centres

    def pressure(self, r):
        return self.peak * math.sqrt(max(0, 1 - r * r))

    def friction(self, r):
        """Cattaneo's shear stress with a stick zone of half width STICK."""
        return MU * (self.pressure(r) - STICK * self.pressure(r / STICK))

    def shear_force(self):
        return MU * self.force * (1 - STICK**self.dim)


def block(low, high, fineness, grading, poisson):
    """A box with cells of 1/fineness at the contact, 2^grading times as large far from it."""
    mesh, boxes = {}, []
    for level in range(1, grading + 1):
        depth = 2.4 / 2**level
        reach = [1.3 + depth] * (len(low) - 1) + [depth]
        first = [max(x, -y) for x, y in zip(low, reach)]
        second = [min(x, y) for x, y in zip(high, reach)]
        boxes.append(" : ".join((text(first), text(second), str(level))))
    if boxes:
        mesh["Refinement boxes"] = " ; ".join(boxes)
    cells = [round((h - l) * fineness / 2**grading) for l, h in zip(low, high)]
    return {"Mesh": {"Generator": "subdivided_hyper_rectangle",
                     "Arguments": " : ".join((text(cells), text(low), text(high), "true")), **mesh,
                     "Boundary ids": "9: abs(%s) < 1e-9 && sqrt(%s) < 1.25" % (
                         ("y", "x^2") if len(low) == 2 else ("z", "x^2 + y^2"))},
            "Material": {"Young modulus": 1.0, "Poisson ratio": poisson}}


def hertz(dim, fineness, grading):
    """A quarter (in the plane: half) of a body on a rigid parabola."""
    poisson = POISSON["hertz"]
    exact = Hertz(dim, poisson, 1)
    if dim == 2:
        field = Elliptic(1.0, exact.force, poisson)
        motion = field.normal("y")
        motion = f"{motion[0]} ; {motion[1]} - {field.centre()!r}"
    else:
        motion = " ; ".join(far_field(boussinesq, exact.force, poisson, "z", .4)) + f" - {exact.approach!r}"
    far = "1, 3" if dim == 2 else "1, 3, 5"
    return {"Dimension": dim,
            "Body block": block([0] * dim, [SIZE] * dim, fineness, grading, poisson),
            "Obstacle parabola": {"Shape": "prescribed gap", "Normal": [0] * (dim - 1) + [1],
                                  "Gap": f"(x^2 + {'0' if dim == 2 else 'y^2'})/{2 * RADIUS!r}"},
            "Contact bottom": contact(ids=9, obstacle="parabola"),
            "Support far": support(far, ", ".join("xyz"[:dim]), motion),
            **{f"Support middle {axis}": support(2 * i, axis) for i, axis in enumerate("xyz"[:dim - 1])},
            "Output": {"VTU": 0}}


def partial_slip(dim, fineness, grading):
    """Two bodies pressed together, then sheared; half of them in space."""
    poisson = POISSON["partial slip"][dim]
    exact = Hertz(dim, poisson, 2)
    scene = {"Dimension": dim, "Contact joint": {
        "Body": "upper", "Boundary ids": 9, "Master body": "lower", "Master boundary ids": 9,
        "Gap": f"(x^2 + {'0' if dim == 2 else 'y^2'})/{2 * RADIUS!r}", "Friction coefficient": MU,
        "Pairing": "node to face"}, "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
    press, shear = press_and_shear(exact, poisson, f"abs({'xyz'[dim - 1]})")
    for body, sign in (("upper", 1), ("lower", -1)):
        mirrored = [(sign if i == dim - 1 else 1, sign if i < dim - 1 else 1) for i in range(dim)]
        motion = " ; ".join(f"{m!r}*min(t, 1)*({p}) + {n!r}*max(0, t - 1)*({q})"
                            for (m, n), p, q in zip(mirrored, press, shear))
        low = [-SIZE] + [0] * (dim - 2) + [0 if sign == 1 else -SIZE]
        high = [SIZE] * (dim - 1) + [SIZE if sign == 1 else 0]
        scene[f"Body {body}"] = block(low, high, fineness, grading, poisson)
        far = [0, 1] + ([3] if dim == 3 else []) + [2 * dim - (1 if sign == 1 else 2)]
        scene[f"Support far {body}"] = support(text(far), ", ".join("xyz"[:dim]), motion, body)
        if dim == 3:
            scene[f"Support middle {body}"] = support(2, "y", body=body)
    return scene


def press_and_shear(exact, poisson, depth):
    """Displacements of the upper half space in its own depth, the origin (3D: infinity) moved."""
    force, shear, whole = exact.force, exact.shear_force(), MU * exact.force
    if exact.dim == 2:
        press = Elliptic(1.0, force, poisson)
        full, less = Elliptic(1.0, whole, poisson), Elliptic(STICK, whole * STICK**2, poisson)
        u, v = press.normal(depth)
        slip = [f"{a} - {b}" for a, b in zip(full.tangential(depth), less.tangential(depth))]
        return (u, f"{v} - {press.centre()!r}"), (f"{slip[0]} - {full.centre() - less.centre()!r}", slip[1])
    u, v, w = far_field(boussinesq, force, poisson, depth, .4)  # mean of r^2: 2/5 a^2
    # Mindlin's displacement of the stick zone for nu = 0, of one body
    drift = 3 * MU * force / 16 * 2 * (2 * (1 + poisson)) * (1 - STICK**2)
    a, b, c = far_field(cerruti, shear, poisson, depth, .4 * (1 - STICK**5) / (1 - STICK**3))
    return (u, v, f"{w} - {exact.approach / 2!r}"), (f"{a} - {drift!r}", b, c)


def distance(row):
    return math.hypot(row["x"], row["y"])


def shares(rows, fineness):
    """Areas of nodes on a lattice; those on symmetry planes have less."""
    ranges = [(axis, [row[axis] for row in rows]) for axis in "xy"]
    for row in rows:
        yield row, math.prod((.5 if row[axis] == 0 == min(all_of) else 1) / fineness
                             for axis, all_of in ranges if max(all_of) > 0)


def l2_error(rows, column, exact):
    """Of nodal forces over areas, relative; with the ratio of the largest ones."""
    stresses = [(row[column] / area, exact(distance(row)), area) for row, area in rows]
    wrong, size = (sum(area * f(a, b)**2 for a, b, area in stresses) for f in (lambda a, b: a - b, lambda a, b: b))
    return math.sqrt(wrong / size), max(a for a, b, area in stresses)


def hertz_errors(run, fineness):
    exact = Hertz(run.dim, POISSON["hertz"], 1)
    rows = list(shares(run.last(), fineness))
    force = sum(row["r_n"] for row, area in rows)
    # mean of r^2 under Hertz's pressure: 1/4 a^2 in the plane, 2/5 a^2 in space
    spread = sum(row["r_n"] * distance(row)**2 for row, area in rows) / force
    width = math.sqrt(spread * (4 if run.dim == 2 else 2.5))
    error, peak = l2_error(rows, "r_n", exact.pressure)
    return {"force": abs(force * 2**(run.dim - 1) / exact.force - 1), "half width": abs(width - 1),
            "peak": abs(peak / exact.peak - 1), "pressure": error}


def partial_slip_errors(run, fineness):
    exact = Hertz(run.dim, POISSON["partial slip"][run.dim], 2)
    rows = list(shares([row for row in run.last() if row["contact"] == "joint"], fineness))
    force, shear = (2**(run.dim - 2) * sum(row[c] for row, area in rows) for c in ("r_n", "r_t1"))
    width = (1 - shear / (MU * force))**(1 / run.dim)
    error, peak = l2_error(rows, "r_t1", exact.friction)
    stuck = [distance(row) for row, area in rows if row["state"] == "stick"]
    slipping = [distance(row) for row, area in rows if row["state"] == "slip"]
    # distance of the last sticking and the first slipping node from the edge of the stick zone, in cells
    outside = fineness * max(max(stuck) - STICK, STICK - min(slipping))
    return {"force": abs(force / exact.force - 1), "shear force": abs(shear / exact.shear_force() - 1),
            "stick width from the forces": abs(width / STICK - 1),
            "peak": abs(peak / exact.friction(STICK) - 1), "shear stress": error,
            "nodes out of place beyond the stick zone's edge, in cells": outside}
