# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene that is extruded, turned, mirrored or given in other units has the same results."""
import math

from support.scenes import ELEMENTS, box, contact, floor, load, merge, press_and_shear, support, turned_scene, with_element
from support.tables import REACTION, in_space
from support.vectors import IDENTITY, plus, rotation, scaled


def extrusion(laws):
    plane = press_and_shear(2, mu=.3)
    plane["Obstacle floor"] = {"Shape": "prescribed gap", "Normal": (-.1, 1.0), "Gap": "0.002*(2 - x)"}
    plane["Load side"] = load("traction", "0.5*t ; -0.2*t", 1)
    for n, element in ((1, "Q1"), (3, "Q1"), (2, ELEMENTS[1]), (2, ELEMENTS[2])):
        a = laws.run(with_element(plane, element))
        solid = merge(plane, {
            "Dimension": 3,
            "Body block": {"Element": element, **box((12, 6, n), (2.0, 1.0, 1.0))},
            "Obstacle floor": {"Normal": (-.1, 1.0, 0.0)},
            "Support top": {"Directions": "x, y, z", "Displacement": plane["Support top"]["Displacement"] + " ; 0"},
            "Support faces": support("4, 5", "z"),
            "Load side": {"Value": "0.5*t ; -0.2*t ; 0"}})
        b = laws.run(solid)
        sums, worst = {}, 0.0
        for row in b.rows:
            key = row["increment"], round(row["x"], 7)
            r = in_space(row, 3, REACTION)
            sums[key] = plus(sums.get(key, (0, 0, 0)), r)
            share = (.5 if row["z"] in (0, 1) else 1) / n
            flat = next(o for o in a.rows if o["increment"] == row["increment"] and abs(o["x"] - row["x"]) < 1e-6)
            worst = max(worst, math.dist(r, scaled(share, in_space(flat, 2, REACTION))))
        total = max(math.dist(sums[row["increment"], round(row["x"], 7)], in_space(row, 2, REACTION))
                    for row in a.rows)
        size = a.largest(*REACTION)
        laws.check(f"{element}, {n} cells along z: sums of reactions", total / size, 1e-10)
        laws.check(f"{element}, {n} cells along z: shares of reactions", worst / size, 1e-10)


def rotation_family(laws):
    for dim, turns in ((2, (((0, 0, 1), 37.3), ((0, 0, 1), -101.7), ((0, 0, 1), 90.0))),
                       (3, (((1, 2, 3), 23.7), ((-2, 1, .3), 131.1)))):
        for supports in ("axes", "normal", "oblique", "springs"):
            first = laws.run(turned_scene(dim, (0, 0, 1), 0.0, supports)[0])
            for axis, degrees in turns:
                scene, m = turned_scene(dim, axis, degrees, supports)
                laws.same(f"{dim}D, {supports}, {degrees} degrees about {axis}", first, laws.run(scene), matrix=m)
        for element in ELEMENTS[1:]:
            runs = [laws.run(with_element(turned_scene(dim, *turn, "axes")[0], element))
                    for turn in (((0, 0, 1), 0.0), turns[0])]
            laws.same(f"{dim}D, {element}, turned", *runs, matrix=rotation(*turns[0]))


def mirror(laws):
    for dim, axes in ((2, (0,)), (3, (0, 1))):
        for axis in axes:
            sign = [-1 if d == axis else 1 for d in range(3)]
            m = tuple(scaled(s, e) for s, e in zip(sign, IDENTITY))
            runs = []
            for mirrored in (False, True):
                s = sign if mirrored else (1, 1, 1)
                scene = press_and_shear(dim, mu=f"0.2 + 0.05*({s[0]})*x")
                size, cells = ((2.0, 1.0), (12, 6)) if dim == 2 else ((1.5, 1.0, 1.0), (5, 4, 4))
                scene["Body block"] = box(cells, size, scaled(-.5, size[:-1]) + (0.0,))
                side, last = "0.004*max(t - 1, 0)", "-0.01*min(t, 1)"
                parts = [f"({s[0]})*{side}", f"({s[1]})*0.3*{side}"][:dim - 1] + [last]
                scene["Support top"]["Displacement"] = " ; ".join(parts)
                scene["Load push"] = load("pressure", "0.5*t", 2 * axis + (1 if mirrored else 0))
                scene["Obstacle floor"]["Normal"] = (.02 * s[0], 1.0) if dim == 2 else (.02 * s[0], .01 * s[1], 1.0)
                runs.append(laws.run(scene))
            laws.same(f"{dim}D, along {'xyz'[axis]}", *runs, matrix=m)


def table(length):
    """On a smooth floor, of bars in space; forces in N. Where it stands is open: the shortest motion is taken."""
    places = ((0, 0, 0), (2, 0, 0), (0, 1, 0), (0, 0, 1), (2, 0, 1), (0, 1, 1), (.5, 0, 1))
    nodes = [f"{i}: {', '.join(repr(x * length) for x in p)}{' : 1' if p[2] == 0 else ''}" for i, p in enumerate(places, 1)]
    section = {"Young modulus": 2e11 / length**2, "Shear modulus": 8e10 / length**2, "Area": 1e-3 * length**2,
               "Moment of inertia": 1e-6 * length**4, "Torsion constant": 2e-6 * length**4}
    forces = {"w1": (3, (0, 0, -1000)), "w2": (4, (0, 0, -1000)), "w3": (5, (0, 0, -1000)), "a": (3, (0, 750, 0)), "b": (4, (0, 250, 0)),
              "c": (6, (0, -1000, 0))}
    return {"Dimension": 3, "Output": {"VTU": 0}, "Obstacle floor": floor(3), "Contact feet": contact("table", 1),
            "Body table": {"Kind": "frame", "Sections": "s", "Section s": section,
                           "Frame": {"Nodes": " ; ".join(nodes), "Members": "1-4: s ; 2-5: s ; 3-6: s ; 4-7-5: s ; 4-6: s"}},
            **{f"Load {name}": {"Body": "table", "Kind": "point force", "Point": ", ".join(repr(x * length) for x in places[at]),
                                "Value": " ; ".join(f"{f}*t" for f in force)} for name, (at, force) in forces.items()}}


def units(laws):
    tables = [laws.run(table(length)).last() for length in (1.0, 1e3)]
    laws.check("a table of bars on a smooth floor in m and mm: shortest motions",
               max(abs(a[f"u_t{k}"] - b[f"u_t{k}"] / 1e3) for a, b in zip(*tables) for k in (1, 2)) / abs(tables[0][0]["u_t1"]), 1e-8)

    def scene(dim, force, length):
        stress = force / length**2
        tree = press_and_shear(dim)
        size = (2.0, 1.0) if dim == 2 else (1.5, 1.0, 1.0)
        cells = (12, 6) if dim == 2 else (5, 4, 4)
        tree["Body block"] = box(cells, scaled(length, size), young=1000.0 * stress)
        if dim == 2:
            tree["Body block"]["Material"]["Thickness"] = .5 * length
        tree["Obstacle floor"] = {"Shape": "prescribed gap", "Normal": (0, 1) if dim == 2 else (0, 0, 1),
                                  "Gap": "0.01*x"}
        tree["Support top"]["Displacement"] = " ; ".join(
            f"{length!r}*({part})" for part in tree["Support top"]["Displacement"].split(";"))
        tree["Support left"] = support(0, "x", f"{length!r}*0.001*t", Stiffness=20000.0 * force / length**3)
        tree["Load side"] = load("pressure", f"{stress!r}*0.5*t", 1)
        return tree

    scales = {"N-mm to SI": (1.0, 1e-3), "force 1e9": (1e9, 1.0), "force 1e-9": (1e-9, 1.0),
              "length 1e9": (1.0, 1e9), "length 1e-9": (1.0, 1e-9), "both odd": (3.7e9, 2.3e-9)}
    for dim, method, names in ((2, "automatic", scales), (3, "automatic", ("N-mm to SI", "both odd")),
                               (2, "smoothing", ("N-mm to SI", "force 1e9", "length 1e-9"))):
        option = ("-s", f"Solver/Method={method}")
        first = laws.run(scene(dim, 1.0, 1.0), *option)
        for name in names:
            force, length = scales[name]
            other = laws.run(scene(dim, force, length), *option)

            def place(p, length=length):
                return scaled(length, p)
            # places are rounded to 7 digits: compare them in the first units
            for row in other.rows:
                for axis in "xyz":
                    row[axis] /= length
            laws.same(f"{dim}D, {method}, {name}", first, other, forces=force, lengths=length, order=lambda p: p)
            counts = [[row["iterations"] for row in run.increments] for run in (first, other)]
            laws.demand(f"{dim}D, {method}, {name}: the same iterations", counts[0] == counts[1])
