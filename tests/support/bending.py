# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beams and membranes in bending, whose deflections are known."""
from support.meshes import write_msh
from support.scenes import box, contact, load, support
from support.tables import MOTION, in_space


def cantilever(dim, element, poisson, cells, length=10.0, tolerance=1e-8):
    """A beam of height 1 (and width 1), bent by end tractions; and the exact deflection of its end."""
    young, curvature = 1000.0, 1e-3
    plane_strain = dim == 2
    stiffness, ratio = (young / (1 - poisson**2), poisson / (1 - poisson)) if plane_strain else (young, poisson)
    bent = f"{-curvature * ratio / 2!r}*(y^2 - z^2)", f"{-curvature * ratio!r}*y*z"
    origin = (0.0, -.5, -.5)[:dim]
    far = {"Shape": "half space", "Normal": (-1, 0, 0)[:dim], "Point": (2 * length, 0, 0)[:dim]}
    scene = {"Dimension": dim,
             "Body block": {"Element": element, **box(cells, (length, 1.0, 1.0)[:dim], origin, young, poisson)},
             "Obstacle far": far, "Contact end": contact(ids=1, obstacle="far"),
             "Support clamp": support(0, "x"),
             "Support sections": support(0, "y, z"[:3 * dim - 5], " ; ".join(bent[:dim - 1]), Stiffness=1.0),
             "Load end": load("traction", " ; ".join((f"{stiffness * curvature!r}*y", "0", "0")[:dim]), 1),
             "Solver": {"Tolerance": tolerance},  # rounding of motions far above the strains, of nu far above E
             "Output": {"VTU": 0}}
    return scene, -curvature * length**2 / 2


def cook(folder, element, poisson, n):
    """Cook's membrane in plane strain, E = 240.565, sheared by 6.25 a length at its right end."""
    def place(i, j):
        x, y = i / n, j / n
        return 48 * x, 44 * x + y * (44 - 28 * x), 0.0

    def number(i, j):
        return i * (n + 1) + j
    points = [place(i, j) for i in range(n + 1) for j in range(n + 1)]
    cells = [[number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]
             for i in range(n) for j in range(n)]
    faces = [(tag, [number(i, j), number(i, j + 1)]) for tag, i in ((10, 0), (11, n)) for j in range(n)]
    write_msh(folder / f"cook{n}.msh", 2, points, cells, faces)
    return {"Dimension": 2,
            "Body block": {"Element": element, "Mesh": {"File": f"cook{n}.msh"},
                           "Material": {"Young modulus": 240.565, "Poisson ratio": poisson}},
            "Obstacle far": {"Shape": "half space", "Normal": (-1, 0), "Point": (100, 0)},
            "Contact end": contact(ids=11, obstacle="far"), "Support clamp": support(10, "x, y"),
            "Load end": load("traction", "0 ; 6.25", 11), "Output": {"VTU": 0}}


def deflection(run, y=0.0):
    """Along y of the node at this height (z = 0) of an end that touches nothing."""
    row = min(run.rows, key=lambda row: abs(row["y"] - y) + abs(row["z"]))
    return in_space(row, run.dim, MOTION)[1]
