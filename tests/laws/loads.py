# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Loads against each other and against integrals in closed form."""
import csv
import math

from support.scenes import box, contact, floor, load, merge, simplices, support
from support.vectors import cross


def beam_between_nodes(laws):
    """Probes inside the one member of a clamped beam; loads grow in time."""
    length, e, inertia, q = 1000.0, 210e3, 800.0, .1
    scene = {"Dimension": 2,
             "Body beam": {"Kind": "frame", "Sections": "s",
                           "Frame": {"Nodes": f"1: 0, 0 ; 2: {length}, 0 : 1", "Members": "1-2: s, group 7",
                                     "Boundary ids": "1: x > -1"},
                           "Section s": {"Young modulus": e, "Area": 100.0, "Moment of inertia": inertia}},
             "Support ends": support(1, "clamped", body="beam"), "Load q": load("line load", f"0 ; -{q}*t", 7, body="beam"),
             "Time": {"End": 2, "Increments": 2}, "Output": {"VTU": 0, "Probes": "a: 500, 0 ; b: 130, 0 ; end: 1000, 0"}}
    run = laws.run(scene, bounds=False)
    with open(run.folder / "history.csv", newline="") as stream:
        for row in csv.DictReader(stream):
            for name, x in (("a", 500), ("b", 130), ("end", length)):
                exact = -q * float(row["time"]) * (x * (length - x))**2 / (24 * e * inertia)
                laws.check(f"beam: deflection at {x}, t = {row['time']}", abs(float(row[f"{name}_u_y"]) - exact), 1e-9)


def couples(laws):
    """A cantilever that a couple alone bends: no force acts on it, whatever the units."""
    for unit in (1.0, 1e-3, 1e3):
        length, stiffness, m = 2 * unit, 3.0, .7
        scene = {"Dimension": 2,
                 "Body beam": {"Kind": "frame", "Sections": "s",
                               "Frame": {"Nodes": f"1: 0, 0 ; 2: {length}, 0 ; 3: {1.5 * length}, 0", "Members": "1-2-3: s",
                                         "Boundary ids": f"1: x < {.1 * length} ; 2: x == {length} ; 3: x > {1.1 * length}"},
                               "Section s": {"Young modulus": stiffness, "Area": unit**2, "Moment of inertia": unit**4}},
                 "Obstacle floor": {"Shape": "half space", "Normal": "0, 1", "Point": f"0, {-length}"},
                 "Contact tip": contact(body="beam", ids=3, mu=.3),
                 "Support wall": support(1, "x, y, rz", body="beam"),
                 "Load couple": load("nodal force", f"0 ; 0 ; {m * unit**3}", 2, body="beam"),
                 "Output": {"VTU": 0, "Probes": f"p: {length}, 0"}}
        found = laws.run(scene, bounds=False).probe("p")
        laws.check(f"couple alone, units {unit}: deflection", abs(found[1] * stiffness / (m * length**2 / unit / 2) - 1), 1e-9)


def whole_forces(laws):
    """Forces and moments of given size: their resultants, and the moment about the point where they act."""
    plate = {"Dimension": 2, "Body block": box((7, 3), (2.0, 1.0), Rotation=23), "Support left": support(0, "x, y"), "Output": {"VTU": 0}}
    plate["Body block"]["Material"]["Thickness"] = .3
    cube = {"Dimension": 3, "Body block": simplices(box((3, 2, 2), (1.5, 1.0, .7))), "Support left": support(0, "x, y, z"),
            "Output": {"VTU": 0}}
    bent = {"Dimension": 3, "Body block": {"Mesh": {"Generator": "cylinder", "Arguments": "1 : 2", "Global refinements": 1},
                                           "Element": "Q2", "Material": {"Young modulus": 1000, "Poisson ratio": .3}},
            "Support left": support(1, "x, y, z"), "Output": {"VTU": 0}}
    for name, scene, ids, centre in (("2D, turned", plate, "1, 3", None), ("2D, one edge, turned", plate, "3", None),
                                     ("3D, tetrahedra", cube, "1, 5", None),
                                     ("Q2, a mantle", bent, "0, 2", None)):
        dim = scene["Dimension"]
        f = (3.0, -2.0, 1.5)[:dim]
        text = " ; ".join(map(repr, f))
        for what, point in (("in the centre", centre), ("at a point", (.7, -.4, 2.1)[:dim])):
            run = laws.run({**scene, "Load pull": load("force", text, ids, **({} if point is None else {"Point": point}))})
            row = run.increments[-1]
            found = [row[f"load_pull_f_{c}"] for c in "xyz"]
            laws.check(f"{name}: a force {what}", math.dist(found, (*f, 0)[:3] if dim == 2 else f), 1e-12)
            if point is not None:
                moment = cross((*point, 0)[:3], (*f, 0)[:3])
                laws.check("  its moment", math.dist([row[f"load_pull_m_{c}"] for c in "xyz"], moment) / math.hypot(*moment), 1e-12)
        moment = (0, 0, 5.0) if dim == 2 else (1.0, -4.0, 2.5)
        run = laws.run({**scene, "Load twist": load("moment", "5" if dim == 2 else " ; ".join(map(repr, moment)), ids)})
        row = run.increments[-1]
        laws.check(f"{name}: a moment", math.dist([row[f"load_twist_m_{c}"] for c in "xyz"], moment) / 5, 1e-12)
        laws.check("  without a force", math.hypot(*(row[f"load_twist_f_{c}"] for c in "xyz")), 1e-12)
    ring = {"Dimension": 2, "Body block": merge(box((4, 3), (1.0, 1.0), (1.0, 0.0)), {"Material": {"Plane": "axisymmetric"}}),
            "Support low": support(2, "x, y"), "Load press": load("force", "0 ; -7", 3), "Output": {"VTU": 0}}
    laws.check("axisymmetric: a force along the axis", abs(laws.run(ring).increments[-1]["load_press_f_y"] + 7), 1e-12)


def weights(laws):
    """Gravity of what has a density, centrifugal loads, forces of pins: against integrals in closed form."""
    g, rho, thickness = 9.81, 2.5, .4
    for dim, backend in ((2, "condensed"), (2, "iterative"), (3, "condensed"), (3, "iterative")):
        what, down = f"{dim}D, {backend}", "y" if dim == 2 else "z"
        scene = {"Dimension": dim, "Gravity": f"0, -{g}" if dim == 2 else f"0, 0, -{g}",
                 "Body block": box((4, 3, 2)[:dim], (2.0, 1.0, .5)[:dim]),
                 "Obstacle floor": floor(dim), "Contact bottom": contact(ids=2 if dim == 2 else 4, mu=.3),
                 "Support left": support(0, "x"), "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
        scene["Body block"]["Material"]["Density"] = rho
        if dim == 2:
            scene["Body block"]["Material"]["Thickness"] = thickness
        else:
            scene["Support front"] = support(2, "y")
        mass = rho * 2 * (thickness if dim == 2 else .5)
        run = laws.run(scene)
        row = run.increments[-1]
        laws.check(f"{what}: a weight", abs(row[f"load_weight_block_f_{down}"] / (-mass * g) - 1), 1e-12)
        laws.check("  on its contact", abs(row[f"bottom_f_{down}"] / (mass * g) - 1), 1e-9)
        plain = merge(scene, {"Gravity": None, "Load own": load("body force", f"0 ; -{rho * g!r}" if dim == 2 else f"0 ; 0 ; -{rho * g!r}")})
        laws.same("  a body force", laws.run(plain), run, 1e-10)
        w = 3.0  # about the corner: rho w^2 times the integral of x
        spun = merge(scene, {"Gravity": None, "Load spin": load("centrifugal", w), "Obstacle floor": None, "Contact bottom": None,
                             "Support bottom": support(2 if dim == 2 else 4, down)})
        row = laws.run(spun).increments[-1]
        laws.check(f"{what}: centrifugal, m w^2 r", math.dist((row["load_spin_f_x"], row["load_spin_f_y"]), (mass * w * w * 1.0, mass * w * w * .5))
                   / (mass * w * w), 1e-12)
    about_x = merge(spun, {"Load spin": {"Axis": "2, 0, 0", "Point": "5, 0.2, 0"}})
    row = laws.run(about_x).increments[-1]
    laws.check("3D: about an axis along x", math.dist([row[f"load_spin_f_{c}"] for c in "xyz"], (0, mass * w * w * .3, mass * w * w * .25))
               / (mass * w * w), 1e-12)
    ring = {"Dimension": 2, "Body block": merge(box((4, 3), (1.0, 1.0), (1.0, 0.0)), {"Material": {"Plane": "axisymmetric", "Density": 2}}),
            "Gravity": "0, -3", "Support low": support(2, "x, y"), "Load spin": load("centrifugal", 5), "Output": {"VTU": 0}}
    run = laws.run(ring)
    volume = math.pi * 3
    laws.check("axisymmetric: a weight", abs(run.increments[-1]["load_weight_block_f_y"] / (-6 * volume) - 1), 1e-12)
    # a thin ring of radius r that is free: u = rho w^2 r^3 / E
    thin = {"Dimension": 2, "Body block": merge(box((1, 4), (.002, 1.0), (1.0, 0.0), young=1000.0, poisson=0.0),
                                                {"Material": {"Plane": "axisymmetric", "Density": 2}}),
            "Support low": support(2, "y"), "Load spin": load("centrifugal", 1), "Output": {"VTU": 0, "Probes": "p: 1.001, 0.5"}}
    laws.check("axisymmetric: a thin ring that spins", abs(laws.run(thin, bounds=False).probe("p")[0] / (2 * 1.001**3 / 1000) - 1), 1e-5)
    for dim in (2, 3):
        mesh = {"Generator": "hyper_cube_with_cylindrical_hole", "Arguments": "0.4 : 1 : 1 : 2 : true", "Global refinements": 2}
        plate = {"Dimension": dim, "Body block": {"Mesh": mesh, "Material": {"Young modulus": 1000, "Poisson ratio": .3}},
                 "Support sides": support(0, "x, y" if dim == 2 else "x, y, z"), "Output": {"VTU": 0}}
        bore = 4 if dim == 2 else 6
        # along an edge of the mesh, along none, and with kinks of the pressure within faces
        for element, size, degrees in (("Q1", 5.0, math.degrees(math.atan2(4, 3))), ("Q1", 500.0, 17), ("Q2", 500.0, 17), ("Q2", 1.0, 211)):
            force = (size * math.cos(math.radians(degrees)), size * math.sin(math.radians(degrees)), 0.0)[:dim]
            pinned = merge(plate, {"Body block": {"Element": element}, "Load pin": load("bearing", " ; ".join(map(repr, force)), bore)})
            row = laws.run(pinned, bounds=False).increments[-1]
            laws.check(f"{dim}D, {element}: a pin's force along {degrees:.0f} degrees",
                       math.dist((row["load_pin_f_x"], row["load_pin_f_y"]), force[:2]) / size, 1e-12)
            laws.check("  through the axis of its bore", abs(row["load_pin_m_z"]) / size, 1e-12)


def stages(laws):
    """Loads that come and go, and a support that is released: a block that hangs on its top until it stands on the floor."""
    for dim, backend in ((2, "condensed"), (3, "condensed"), (3, "iterative")):
        bottom, top = (2, 3) if dim == 2 else (4, 5)
        up = "x, y" if dim == 2 else "x, y, z"
        scene = {"Dimension": dim, "Body block": box((3,) * dim, (1.0,) * dim, poisson=0.0), "Obstacle floor": floor(dim),
                 "Contact bottom": contact(ids=bottom, mu=.3), "Support press": support(top, up, "0 ; -0.01" if dim == 2 else "0 ; 0 ; -0.01", Active="t < 2.5"),
                 "Load own": load("body force", "0 ; -2" if dim == 2 else "0 ; 0 ; -2", Active="t > 1.5"),
                 "Time": {"End": 4, "Increments": 4}, "Solver": {"Backend": backend}, "Output": {"VTU": 0}}
        run = laws.run(scene)
        down = "y" if dim == 2 else "z"
        for record, floor_bears, load_there in zip(run.increments, (10.0, 11.0, 2.0, 2.0), (0, -2, -2, -2)):
            t = record["time"]
            laws.check(f"{dim}D, {backend}, t = {t}: the floor bears", abs(record[f"bottom_f_{down}"] - floor_bears) / 11, 1e-9)
            laws.check("  the load", abs(record[f"load_own_f_{down}"] - load_there) / 2, 1e-12)
            held = abs(record[f"support_press_f_{down}"])
            laws.demand("  the support holds, or is released", (held > 1) == (t < 2.5))
        laws.demand("  four increments in one table", [row["increment"] for row in run.increments] == [1, 2, 3, 4])


def loads(laws):
    beam_between_nodes(laws)
    couples(laws)
    whole_forces(laws)
    weights(laws)
    stages(laws)
    thickness, n, p = .5, 8, 6.0
    base = {"Dimension": 2, "Body block": box((n, 4), (2.0, 1.0)), "Obstacle floor": floor(2),
            "Contact bottom": contact(mu=.3), "Support left": support(0, "x"), "Output": {"VTU": 0}}
    base["Body block"]["Material"]["Thickness"] = thickness
    share = [p * 2 / n * thickness * (.5 if i in (0, n) else 1) for i in range(n + 1)]
    variants = {
        "traction": {"Load a": load("traction", f"0 ; -{p}", 3)},
        "pressure": {"Load a": load("pressure", p, 3)},
        "two halves": {"Load a": load("pressure", .25 * p, 3), "Load b": load("traction", f"0 ; -{.75 * p}", 3)},
        "point forces": {f"Load p{i}": load("point force", f"0 ; {-f!r}", Point=(2.0 * i / n, 1.0))
                         for i, f in enumerate(share)},
        "point forces between nodes": {f"Load p{i}": load("point force", f"0 ; {-p * 2 / n * thickness!r}",
                                                          Point=(2.0 * (i + .5) / n, 1.0)) for i in range(n)}}
    runs = {name: laws.run({**base, **entries}) for name, entries in variants.items()}
    for name, run in runs.items():
        laws.same(f"traction and {name}", runs["traction"], run, 1e-12)
        row = run.increments[-1]
        laws.check(f"{name}: resultant", math.dist((row["loads_f_x"], row["loads_f_y"], row["loads_m_z"]),
                                                   (0, -2 * p * thickness, -2 * p * thickness)), 1e-11)

    # integrals over [0, 2] x [0, 1] of (1 + y, -x): forces 3, -2; moment of x f_y - y f_x: -8/3 - 5/3
    body = laws.run({**base, "Load weight": load("body force", "1 + y ; -x - 5"), "Load top": load("pressure", p, 3)})
    row = body.increments[-1]
    expected = (3 * thickness, (-2 - 10 - 2 * p) * thickness, (-8 / 3 - 10 - 5 / 3 - 2 * p) * thickness)
    laws.check("2D body force: resultant", math.dist((row["loads_f_x"], row["loads_f_y"], row["loads_m_z"]), expected),
               1e-11)
    # a unit cube under (y, 0, -x): forces 1/2, 0, -1/2; moments (y f_z, z f_x - x f_z, -y f_x)
    cube = {"Dimension": 3, "Body block": box((3, 3, 3), (1.0, 1.0, 1.0)), "Obstacle floor": floor(3),
            "Contact bottom": contact(ids=4, mu=.3), "Support top": support(5, "x, y, z", "0 ; 0 ; -0.01"),
            "Load weight": load("body force", "y ; 0 ; -x"), "Output": {"VTU": 0}}
    row = laws.run(cube).increments[-1]
    found = [row[f"loads_{kind}_{axis}"] for kind in "fm" for axis in "xyz"]
    laws.check("3D body force: resultant", math.dist(found, (.5, 0, -.5, -.25, .25 + 1 / 3, -1 / 3)), 1e-12)
    point = merge(cube, {"Load weight": None,
                         "Load point": load("point force", "0.1 ; 0.2 ; -0.3", Point=(.35, .8, .55))})
    row = laws.run(point).increments[-1]
    found = [row[f"loads_{kind}_{axis}"] for kind in "fm" for axis in "xyz"]
    force = (.1, .2, -.3)
    laws.check("3D point force: resultant", math.dist(found, (*force, *cross((.35, .8, .55), force))), 1e-12)
    push = merge(cube, {"Load weight": None, "Load side": load("pressure", "1 + z", 1)})
    row = laws.run(push).increments[-1]
    found = [row[f"loads_{kind}_{axis}"] for kind in "fm" for axis in "xyz"]
    laws.check("3D pressure: resultant", math.dist(found, (-1.5, 0, 0, 0, -1 / 2 - 1 / 3, .75)), 1e-12)
