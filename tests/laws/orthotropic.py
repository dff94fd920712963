# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Orthotropic materials along any axes: uniform stress, and a body that is turned with its material."""
import itertools
import math

from support.scenes import ELEMENTS, box, contact, floor, load, merge, support

MODULI, RATIOS, SHEAR = (1000.0, 400.0, 250.0), (.3, .25, .35), (300.0, 200.0, 120.0)
PRESSURE = 2.0


def orthotropic(body, axes=0.0, **entries):
    return merge(body, {"Material": {"Young modulus": None, "Poisson ratio": None, "Young moduli": MODULI, "Poisson ratios": RATIOS,
                                     "Shear moduli": SHEAR, "Axes": axes, **entries}})


def along(degrees):
    """Modulus along y of a plate in plane stress whose axes are turned, and the strain along x over that along y."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    both = 1 / SHEAR[0] - 2 * RATIOS[0] / MODULI[0]
    young = 1 / (s**4 / MODULI[0] + c**4 / MODULI[1] + both * s**2 * c**2)
    across = (1 / MODULI[0] + 1 / MODULI[1] - 1 / SHEAR[0]) * s**2 * c**2 - RATIOS[0] / MODULI[0] * (s**4 + c**4)
    return young, across * young


def settlement(run):
    """The mean way of the loaded side of a unit block, by the work of its pressure."""
    return 2 * run.increments[-1]["external_work"] / PRESSURE


def pressed(dim, body):
    """On a floor without friction."""
    ids = (2, 3) if dim == 2 else (4, 5)
    return {"Dimension": dim, "Body block": body, "Obstacle floor": floor(dim), "Contact bottom": contact(ids=ids[0]),
            "Load top": load("pressure", repr(PRESSURE), ids[1]), "Output": {"VTU": 0}}


def plates(laws):
    for degrees, element in itertools.product((0.0, 30.0, 60.0, 90.0, 135.0), (*ELEMENTS, "P1")):
        body = merge(orthotropic(box((4, 3), (1.0, 1.0)), degrees, Plane="stress"), {"Element": element})
        young, ratio = along(degrees)
        scene = pressed(2, body)
        scene["Support foot"] = support(2, "x", f"{-ratio * PRESSURE / young!r}*x")  # as it strains by itself
        run = laws.run(scene)
        laws.check(f"plate, {element}, axes at {degrees}: modulus", abs(settlement(run) / (PRESSURE / young) - 1), 1e-11)
        laws.check(f"plate, {element}, axes at {degrees}: friction of the foot",
                   abs(run.increments[-1]["support_foot_f_x"]) / PRESSURE, 1e-11)
        laws.check(f"plate, {element}, axes at {degrees}: pressure",
                   max(abs(row["r_n"] / row["area"] / PRESSURE - 1) for row in run.rows), 1e-11)


def blocks(laws):
    """Turned by right angles about each axis a block is as stiff as along each of its own axes."""
    for axis, degrees, stiff in (((0, 0, 1), 90.0, MODULI[2]), ((1, 0, 0), 90.0, MODULI[1]), ((0, 1, 0), 90.0, MODULI[0])):
        scene = pressed(3, orthotropic(box((3, 2, 2), (1.0, 1.0, 1.0)), (*map(float, axis), degrees)))
        run = laws.run({**scene, "Support left": support(0, "x"), "Support front": support(2, "y")})
        laws.check(f"block turned about {axis}: modulus", abs(settlement(run) / (PRESSURE / stiff) - 1), 1e-11)


def isotropic(laws):
    """With equal moduli it is the isotropic material, whatever the axes."""
    young, ratio = 1000.0, .3
    for dim, plane in ((2, "strain"), (2, "stress"), (2, "axisymmetric"), (3, "strain")):
        body = box((5, 4) if dim == 2 else (3, 3, 3), (1.0,) * dim)
        both = []
        for material in ({}, {"Young modulus": None, "Poisson ratio": None, "Young moduli": (young,) * 3, "Poisson ratios": (ratio,) * 3,
                              "Shear moduli": (young / (2 + 2 * ratio),) * 3, "Axes": 27.0 if dim == 2 else (1.0, 2.0, -1.0, 27.0)}):
            scene = merge(pressed(dim, merge(body, {"Material": {**material, **({"Plane": plane} if dim == 2 else {})}})),
                          {"Contact bottom": {"Friction coefficient": .1},
                           "Support top": support(3 if dim == 2 else 5, "x, y, z"[:3 * dim - 2], " ; ".join(["0"] * (dim - 1) + ["-0.01"]))})
            both.append(laws.run(scene))
        laws.demand(f"{dim}D, {plane}: forces that slip and stick", both[0].largest("r_n", "r_t1") > 1)
        laws.same(f"{dim}D, {plane}: orthotropic with equal moduli", *both, 1e-10)


STRAINS = {2: "-1e-3*t ; -2e-3*t ; 3e-4*t", 3: "-1e-3*t ; -2e-3*t ; -1e-3*t ; 1e-4*t ; 2e-4*t ; 3e-4*t"}


def unloaded(laws):
    """Bodies that strain themselves between plates that leave room: nothing but rounding acts, and is told as 0."""
    for dim, element, degrees, all_held in itertools.product((2, 3), ("Q2", "P1"), (0.0, 30.0), (False, True)):
        held = "x, y, z"[:3 * dim - 2] if all_held else "x"
        ids = (2, 3) if dim == 2 else (4, 5)
        body = merge(orthotropic(box((4, 3) if dim == 2 else (3, 2, 2), (1.0,) * dim), degrees if dim == 2 else (1.0, 2.0, 3.0, degrees)),
                     {"Element": element})
        scene = {"Dimension": dim, "Body block": body, "Obstacle floor": floor(dim),
                 "Obstacle lid": {"Shape": "half space", "Normal": (0, -1) if dim == 2 else (0, 0, -1), "Point": (0,) * (dim - 1) + (1.001,)},
                 "Contact bottom": contact(ids=ids[0], mu=.3), "Contact top": contact(ids=ids[1], obstacle="lid"),
                 "Support left": support(0, held), "Output": {"VTU": 0},
                 "Load shrinking": load("initial strain", "-1e-3*t" + " ; 0" * (2 if dim == 2 else 5) if all_held else STRAINS[dim])}
        last = laws.run(scene).increments[-1]
        laws.demand(f"{dim}D, {element}, axes at {degrees}, held along {held}, without loads: all forces and balances are 0",
                    not any(last[name] for name in last if "_f_" in name or "_m_" in name or name.startswith("balance")))


def orthotropy(laws):
    for law in (plates, blocks, isotropic, unloaded):
        law(laws)
