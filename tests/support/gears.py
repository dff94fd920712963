# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Spur gears with involute flanks: their meshes, and two of them whose teeth press on each other."""
import math

from support.meshes import write_msh
from support.scenes import joint, support

TEETH, MODULE, PRESSURE_ANGLE, WIDTH = 12, 2.0, math.radians(20), 3.0
PITCH, BORE = MODULE * TEETH / 2, 5.0
BASE, TIP, ROOT = PITCH * math.cos(PRESSURE_ANGLE), PITCH + MODULE, PITCH - 1.25 * MODULE
RIM, HUB = 1, 2  # boundary ids


def involute(r):
    """What a flank has turned by at the radius r; below the base circle it is radial."""
    a = math.acos(min(BASE / r, 1.0))
    return math.tan(a) - a


def outline(n_flank=7, n_tip=3, n_root=3):
    """Radius and angle of points along one pitch, from the middle of a tooth's tip to that of the next."""
    def half(r):  # of a tooth, as an angle
        return math.pi / (2 * TEETH) + involute(PITCH) - involute(r)
    pitch = 2 * math.pi / TEETH
    tip = [(TIP, i / n_tip * half(TIP)) for i in range(n_tip)]
    fillet = .15 * (pitch / 2 - half(BASE)) / (BASE - ROOT)
    radii = [TIP + i / n_flank * (ROOT - TIP) for i in range(n_flank + 1)]
    flank = [(r, half(max(r, BASE)) + fillet * max(BASE - r, 0.0)) for r in radii]
    last = flank[-1][1]
    root = [(ROOT, last + i / n_root * (pitch / 2 - last)) for i in range(1, n_root + 1)]
    one = [*tip, *flank, *root]
    return [*one, *((r, pitch - angle) for r, angle in reversed(one[1:-1]))]


def write_gear(file, centre, turned, n_rings=6, n_layers=2):
    pitch = outline()
    rim = [(r, turned + angle + k * 2 * math.pi / TEETH) for k in range(TEETH) for r, angle in pitch]
    n = len(rim)
    points, number = [], {}
    for layer in range(n_layers + 1):
        for ring in range(n_rings + 1):
            part = (ring / n_rings)**.8
            for i, (r, angle) in enumerate(rim):
                number[layer, ring, i] = number[layer, ring, i + n] = len(points)
                r = BORE + part * (r - BORE)
                points.append((centre + r * math.cos(angle), r * math.sin(angle), WIDTH * layer / n_layers))

    def face(ring, layer, i):
        return [number[layer, ring, i], number[layer, ring, i + 1], number[layer + 1, ring, i + 1], number[layer + 1, ring, i]]
    cells = [[number[layer + c, ring + a, i + b] for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
             for layer in range(n_layers) for ring in range(n_rings) for i in range(n)]
    faces = [(tag, face(ring, layer, i)) for tag, ring in ((HUB, 0), (RIM, n_rings)) for layer in range(n_layers) for i in range(n)]
    write_msh(file, 3, points, cells, faces)


def pair(folder):
    """The left gear is turned by its hub, the right one is held; writes their meshes."""
    distance = 2 * PITCH + .002
    write_gear(folder / "left.msh", 0.0, 0.0)
    write_gear(folder / "right.msh", distance, math.pi + math.pi / TEETH)
    steel = {"Material": {"Young modulus": 210e3, "Poisson ratio": .3}}
    return {"Dimension": 3, "Body left": {"Mesh": {"File": str(folder / "left.msh")}, **steel},
            "Body right": {"Mesh": {"File": str(folder / "right.msh")}, **steel},
            "Contact teeth": joint("left", RIM, "right", RIM, **{"Friction coefficient": .1}),
            "Support shaft": support(HUB, "x, y, z", "-0.004*t*y ; 0.004*t*x ; 0", body="left"),
            "Support held": support(HUB, "x, y, z", body="right"),
            "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 1, "Units": "mm, N, MPa"}}
