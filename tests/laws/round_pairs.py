# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hertz, Cattaneo and Mindlin of two round bodies whose meshes do not match.

plane: cylinders; space: balls, half of each. Stress errors are those of nodal forces over areas.
"""
from support import round_pairs
from support.checks import orders

# bounds of the finest mesh, and the least orders of its errors
PLANE = {"force": (3e-3, 0), "peak pressure": (.01, 0), "half width": (.01, 1), "pressure in L2": (.04, .95),
         "stick width from the forces": (5e-3, 0), "shear stress in L2": (.06, .8)}
SPACE = {"force": (6e-3, 0), "peak pressure": (.015, 0), "half width": (.025, 0), "pressure in L2": (.12, 0),
         "stick width from the forces": (5e-3, 0), "shear stress in L2": (.2, 0)}


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
