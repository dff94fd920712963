# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the elements are for: bending and nearly incompressible bodies."""
import itertools

from support.bending import cantilever, cook, deflection
from support.scenes import ELEMENTS


def elements(laws):
    plain, averaged, bending = ELEMENTS
    for dim, (poisson, bound) in itertools.product((2, 3), ((.3, 1e-9), (.4999, 1e-7))):
        ratio = {}
        for element in ELEMENTS:
            scene, exact = cantilever(dim, element, poisson, (5, 2, 2)[:dim])
            ratio[element] = deflection(laws.run(scene, bounds=False)) / exact
        what = f"{dim}D, nu = {poisson}, slender cells in bending"
        laws.check(f"{what}: error of {bending}", abs(ratio[bending] - 1), bound)
        laws.check(f"{what}: {plain} deflects too little", ratio[plain], .01 if (dim, poisson) == (2, .4999) else .5)
    fine = deflection(laws.run(cook(laws.folder, averaged, .4999, 32)), 60.0)
    ratio = {element: deflection(laws.run(cook(laws.folder, element, .4999, 8)), 60.0) / fine for element in ELEMENTS}
    for element in (averaged, bending):
        laws.check(f"Cook's membrane, nu = .4999: error of {element}", abs(ratio[element] - 1), .06)
    laws.check(f"Cook's membrane, nu = .4999: {plain} locks", ratio[plain], .3)
