# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Initial strains against closed forms: bodies that are free, held, and pressed between plates."""
import itertools
import math

from laws.driven import energy
from laws.orthotropic import MODULI, RATIOS, SHEAR, orthotropic
from support.scenes import ELEMENTS, box, contact, floor, load, merge, support

A, B = .003, .002
E, NU, STRAIN = 1000.0, .3, .004


def probes_of(run):
    return [run.probe(f"p{i}") for i in range(3)]


def free(laws):
    """Compatible fields that are linear in space: what is held where nothing moves needs no force."""
    bilinear, bending = f"{A}*y ; {B}*x ; 0.5*({A}*x + {B}*y)", f"{A}*y ; 0 ; 0"
    fields = {"of both sides": (2, bilinear, lambda x, y, z: (A * x * y, B * x * y, 0), ELEMENTS[:1]),
              "of bending": (2, bending, lambda x, y, z: (A * x * y, -A * x * x / 2, 0), ELEMENTS[2:]),
              "of both sides, along z as well": (2, bilinear + " ; 0", lambda x, y, z: (A * x * y, B * x * y, 0), ELEMENTS[:1]),
              "of bending in space": (3, f"{A}*z ; 0 ; 0 ; 0 ; 0 ; 0", lambda x, y, z: (A * x * z, 0, -A * x * x / 2), ELEMENTS[2:]),
              "of shear in space": (3, f"{A}*z ; 0 ; 0 ; 0 ; 0.5*{A}*x ; 0", lambda x, y, z: (A * x * z, 0, 0), ELEMENTS[:1])}
    for (what, (dim, value, exact, elements)), plane in itertools.product(fields.items(), ("strain", "stress")):
        if dim == 3 and plane == "stress":
            continue
        for element in elements:
            size = (2.0, 1.0) if dim == 2 else (2.0, 1.0, 1.0)
            points = [(2.0, 1.0, 1.0)[:dim], (2.0, 0.0, 0.0)[:dim], (1.0, .5, .5)[:dim]]
            body = merge(box((4, 2) if dim == 2 else (4, 2, 2), size), {"Element": element})
            if dim == 2:
                body["Material"]["Plane"] = plane
            run = laws.run({"Dimension": dim, "Body block": body,
                            "Support end": support(0, "x, y" if dim == 2 else "x, y, z"),
                            "Load swelling": load("initial strain", value),
                            "Output": {"VTU": 0, "Probes": " ; ".join(
                                f"p{i}: {', '.join(map(repr, p))}" for i, p in enumerate(points))}},
                           bounds=False)  # there are no forces that balance
            off = max(math.dist(u, exact(*(p + (0,))[:3])) for u, p in zip(probes_of(run), points))
            name = f"{what}, {element}" + (f", plane {plane}" if dim == 2 else "")
            laws.check(f"{name}: displacements", off / A, 1e-12)
            last = run.increments[-1]
            laws.check("  force of the support", math.hypot(*(last[f"supports_f_{c}"] for c in "xyz")) / (E * A), 1e-11)


def held(laws):
    """Sides that do not move carry -C eps."""
    strains = (.003, -.001, .002)
    for degrees in (0.0, 90.0):
        body = orthotropic(box((3, 2, 2), (1.0, 1.0, 1.0)), (0.0, 0.0, 1.0, degrees))
        first, second = (0, 1) if degrees == 0 else (1, 0)
        order = (first, second, 2)
        compliance = [[0.0] * 3 for _ in range(3)]
        for i in range(3):
            compliance[i][i] = 1 / MODULI[i]
        for (i, j), ratio in zip(((0, 1), (0, 2), (1, 2)), RATIOS):
            compliance[i][j] = compliance[j][i] = -ratio / MODULI[i]
        run = laws.run({"Dimension": 3, "Body block": body,
                        **{f"Support {i}": support(i, "normal") for i in range(6)},
                        "Load swelling": load("initial strain", " ; ".join(map(repr, strains)) + " ; 0 ; 0 ; 0"),
                        "Output": {"VTU": 0}})
        last = run.increments[-1]
        stress = [-last[f"support_{2 * d}_f_{c}"] for d, c in enumerate("xyz")]  # tension pulls at the side
        back = [sum(compliance[order[i]][order[j]] * stress[j] for j in range(3)) for i in range(3)]
        laws.check(f"orthotropic, axes at {degrees:g}: strain of the stress found",
                   max(abs(b + e) for b, e in zip(back, strains)) / max(strains), 1e-11)
    sheared = laws.run({"Dimension": 3, "Body block": orthotropic(box((3, 2, 2), (1.0, 1.0, 1.0))),
                        "Support all": support("0, 1, 2, 3, 4, 5", "x, y, z"),
                        "Load twist": load("initial strain", "0 ; 0 ; 0 ; 0.001 ; 0.002 ; 0.003"), "Output": {"VTU": 0}})
    laws.check("held all around: its supports balance", sheared.increments[-1]["balance"], 1e-10)
    # strain_energy is that of the displacements
    laws.check("  nothing moves", abs(sheared.increments[-1]["strain_energy"]) / (SHEAR[0] * 1e-6), 1e-20)


def between_plates(laws):
    """Swelling along y between two plates: the pressure of what they keep it from."""
    for plane, modulus in (("stress", E), ("strain", E / (1 - NU * NU))):
        body = box((6, 4), (2.0, 1.0))
        body["Material"].update(Plane=plane, Thickness=.5)
        scene = {"Dimension": 2, "Body block": body, "Obstacle floor": floor(2),
                 "Obstacle lid": {"Shape": "half space", "Normal": (0, -1), "Point": (0, 1)},
                 "Contact bottom": contact(ids=2), "Contact top": contact(ids=3, obstacle="lid"),
                 "Support side": support(0, "x"), "Load swelling": load("initial strain", f"0 ; {STRAIN}*t ; 0"),
                 "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        laws.check(f"plane {plane}: pressure of both plates",
                   max(abs(row["r_n"] / row["area"] / (modulus * STRAIN * row["time"]) - 1) for row in run.rows), 1e-11)
        laws.check("  work", energy(run), 1e-11)

    # heat is a strain along all axes
    hot = merge(scene, {"Body block": {"Material": {"Expansion coefficient": .001}}, "Contact bottom": {"Friction coefficient": .2}})
    heat = laws.run(merge(hot, {"Load swelling": load("temperature", "(4 + x*y)*t")}))
    strain = "0.001*(4 + x*y)*t"
    same = laws.run(merge(hot, {"Load swelling": load("initial strain", f"{strain} ; {strain} ; 0 ; {strain}")}))
    laws.same("temperature and the strain it makes", heat, same, 1e-12)
    work = max(abs(a["external_work"] - b["external_work"]) / abs(a["external_work"])
               for a, b in zip(heat.increments, same.increments))
    laws.check("  their works", work, 1e-11)
    both = laws.run(merge(hot, {"Load swelling": load("temperature", "4*t"),
                                "Load more": load("initial strain", "0.001*x*y*t ; 0.001*x*y*t ; 0 ; 0.001*x*y*t")}))
    laws.same("  and both of them together", heat, both, 1e-12)


def rings(laws):
    """A body of revolution that swells along its radius and round it is free of force."""
    body = merge(box((6, 4), (1.0, 1.0), (1.0, 0.0)), {"Material": {"Plane": "axisymmetric"}})
    scene = {"Dimension": 2, "Body block": body, "Support foot": support(2, "y"), "Support lid": support(3, "y"),
             "Load swelling": load("initial strain", f"{STRAIN} ; 0 ; 0 ; {STRAIN}"), "Output": {"VTU": 0, "Probes": "p0: 1, 0 ; p1: 2, 1 ; p2: 1.5, 0.5"}}
    run = laws.run(scene, bounds=False)
    laws.check("ring: radial way", max(abs(u[0] / (STRAIN * r) - 1) for u, r in zip(probes_of(run), (1.0, 2.0, 1.5))), 1e-11)
    laws.check("  force of its supports", abs(run.increments[-1]["support_foot_f_y"]) / (E * STRAIN), 1e-11)


def initial_strain(laws):
    free(laws)
    held(laws)
    between_plates(laws)
    rings(laws)
