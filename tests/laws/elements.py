# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the elements are for: bending and nearly incompressible bodies."""
import itertools

from support.bending import cantilever, cook, deflection
from support.scenes import ELEMENTS


def bent(laws, dim, element, poisson, tolerance=1e-8):
    """Deflection over the exact one."""
    scene, exact = cantilever(dim, element, poisson, (5, 2, 2)[:dim], tolerance=tolerance)
    return deflection(laws.run(scene, bounds=False)) / exact


def of_second_degree(laws, fine):
    """Bending is quadratic: it is exact."""
    for dim, element, (poisson, bound) in itertools.product((2, 3), ("Q2", "P2"), ((.3, 1e-9), (.4999, 1e-6))):
        if dim == 2 or element == "Q2":  # more nodes in a cell, more rounding of nu
            ratio = bent(laws, dim, element, poisson, 1e-6)
            laws.check(f"{dim}D, nu = {poisson}, bending: error of {element}", abs(ratio - 1), bound)
    for element, bound in (("Q2", .06), ("P2", .02)):
        ratio = deflection(laws.run(cook(laws.folder, element, .4999, 8), bounds=False), 60.0) / fine
        laws.check(f"Cook's membrane, nu = .4999: error of {element}", abs(ratio - 1), bound)


def elements(laws):
    plain, averaged, bending = ELEMENTS
    for dim, (poisson, bound) in itertools.product((2, 3), ((.3, 1e-9), (.4999, 1e-7))):
        ratio = {}
        for element in ELEMENTS:
            ratio[element] = bent(laws, dim, element, poisson)
        what = f"{dim}D, nu = {poisson}, slender cells in bending"
        laws.check(f"{what}: error of {bending}", abs(ratio[bending] - 1), bound)
        laws.check(f"{what}: {plain} deflects too little", ratio[plain], .01 if (dim, poisson) == (2, .4999) else .5)
    fine = deflection(laws.run(cook(laws.folder, averaged, .4999, 32)), 60.0)
    ratio = {element: deflection(laws.run(cook(laws.folder, element, .4999, 8)), 60.0) / fine for element in ELEMENTS}
    for element in (averaged, bending):
        laws.check(f"Cook's membrane, nu = .4999: error of {element}", abs(ratio[element] - 1), .06)
    laws.check(f"Cook's membrane, nu = .4999: {plain} locks", ratio[plain], .3)
    of_second_degree(laws, fine)
