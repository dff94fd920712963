# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hertz, Cattaneo and Mindlin of two round bodies whose meshes do not match.

plane: cylinders; space: balls, half of each. Stress errors are those of nodal forces over areas.
orders_of_plane: their orders where nothing else is in the way. Stresses have edges with an infinite slope (of the
contact, of the stick zone), so errors are a number times the size of a cell, and the number depends on where in a
cell the edge lies: on meshes where it lies alike (15 and 30 cells: in a node of either body, but for 0.7) that is
first order. A radius of 100 half widths leaves 4e-3 of the stick width, whatever the mesh.
"""
from support import round_pairs
from support.checks import orders

# bounds of the finest mesh, and the least orders of its errors
PLANE = {"force": (3e-3, 0), "peak pressure": (.01, 0), "half width": (.01, 1), "pressure in L2": (.04, .95),
         "stick width from the forces": (5e-3, 0), "shear stress in L2": (.06, .8)}
SPACE = {"force": (6e-3, 0), "peak pressure": (.015, 0), "half width": (.025, 0), "pressure in L2": (.12, 0),
         "stick width from the forces": (5e-3, 0), "shear stress in L2": (.2, 0)}


FINE = {"force": (3e-3, .95), "peak pressure": (.01, .95), "half width": (.01, .95), "pressure in L2": (.05, .95)}
FLAT = 1e4  # radius over half width: closed forms are those of half spaces, and other bodies differ by its inverse


def family(laws, dim, cases, bounds, growth):
    for ratio, cells, exchanged in cases:
        found = [round_pairs.errors(laws.run(round_pairs.pair(laws.folder, dim, n, ratio, exchanged, growth)), n) for n in cells]
        name = f"{cells[-1]} cells a half width on {cells[-1] / ratio:.3g}{', exchanged' * exchanged}"
        for what, (bound, order) in bounds.items():
            laws.check(f"{name}: {what}", found[-1][what], bound)
            if len(cells) > 1 and order > 0:
                seen = orders(cells, [[f[what]] for f in found])[0]
                laws.demand(f"  order {seen:.2f}", seen >= order)
        laws.check(f"{name}: nodes beyond the edge of the stick zone, in cells", found[-1]["nodes out of place, in cells"], 1)


def plane(laws):
    family(laws, 2, ((.5, (8, 16), False), (.7, (16,), True), (1.5, (8, 16), False), (3.0, (8, 16), False), (3.0, (16,), True)),
           PLANE, 1.25)


def space(laws):
    family(laws, 3, ((1.5, (4, 8), False), (3.0, (8,), False)), SPACE, 1.5)
    cells, ratio = (8, 16), 3.0
    found = [round_pairs.errors_of_quarter(laws.run(round_pairs.pressed_quarter(laws.folder, n, ratio, 1.5))) for n in cells]
    for what, (bound, order) in FINE.items():
        laws.check(f"quarters, pressed only, {cells[-1]} cells a half width on {cells[-1] / ratio:.3g}: {what}", found[-1][what], bound)
        seen = orders(cells, [[f[what]] for f in found])[0]
        laws.demand(f"  order {seen:.2f}", seen >= order)


def orders_of_plane(laws):
    cells = (15, 30)
    for ratio in (.5, .7, 1.5, 3.0):
        for exchanged in (False, True):
            found = [round_pairs.errors(laws.run(round_pairs.pair(laws.folder, 2, n, ratio, exchanged, radius=FLAT)), n, FLAT)
                     for n in cells]
            print(f"  30 cells a half width on {30 / ratio:.3g}{', exchanged' * exchanged}")
            for what in ("pressure in L2", "shear stress in L2"):
                seen = orders(cells, [[f[what]] for f in found])[0]
                laws.demand(f"  {what}: {found[-1][what]:.2g}, order {seen:.2f}", seen >= .95)
            laws.check("  stick width from the forces", found[-1]["stick width from the forces"], 1e-3)
