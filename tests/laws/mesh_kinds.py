# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of several kinds of cells, decks of parts, pieces that are joined, drawings: what stands on a floor weighs what it should."""
import itertools

from support.gmsh import gmsh_file
from support.logs import log_of
from support.meshes import distorted
from support.scenes import contact, floor, joint, load, merge, support

PRESSURE = 2.0
HEXAHEDRON, WEDGE, PYRAMID, TETRAHEDRON = 5, 6, 7, 4  # Gmsh's types


def pieces(kind, cube, centre):
    """A cube as cells of one kind; pyramids and tetrahedra need its centre."""
    a, b, c, d, e, f, g, h = cube
    if kind == "hexahedra":
        return [(HEXAHEDRON, cube)]
    if kind == "wedges":
        return [(WEDGE, [a, d, e, b, c, f]), (WEDGE, [d, h, e, c, g, f])]  # triangles to the left and right
    faces = ([a, b, c, d], [a, e, f, b], [b, f, g, c], [c, g, h, d], [d, h, e, a], [e, h, g, f])
    if kind == "pyramids":
        return [(PYRAMID, [*face, centre]) for face in faces]
    # as a neighbour of wedges and hexahedra cuts its faces: through the smallest number
    cells = []
    for face in faces:
        k = face.index(min(face))
        p, q, r, s = face[k:] + face[:k]
        cells += [(TETRAHEDRON, [p, q, r, centre]), (TETRAHEDRON, [p, r, s, centre])]
    return cells


def blocks(kinds, n, low, number):
    """n x n x 2 cubes on z = low, below of the one kind, above of the other: points, elements from `number` on."""
    at = {place: number + i for i, place in enumerate(itertools.product(range(3), range(n + 1), range(n + 1)))}
    points = [(x / n, y / n, low + z / n) for z, y, x in at]
    elements = []
    for z, y, x in itertools.product(range(2), range(n), range(n)):
        cube = [at[z + c, y + b, x + a] for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        centre = number + len(points)
        if kinds[z] in ("pyramids", "tetrahedra"):
            points.append(((x + .5) / n, (y + .5) / n, low + (z + .5) / n))
        elements += [(kind, nodes) for kind, nodes in pieces(kinds[z], cube, centre)]
    sides = {"bottom": [], "top": [], "left": [], "front": []}
    for i, j in itertools.product(range(n), repeat=2):
        round_ = ((0, 0), (1, 0), (1, 1), (0, 1))
        sides["bottom"].append([at[0, j + b, i + a] for a, b in round_])
        sides["top"].append([at[2, j + b, i + a] for a, b in round_])
    for z, i in itertools.product(range(2), range(n)):
        round_ = ((0, 0), (1, 0), (1, 1), (0, 1))
        a, d, h, e = (at[z + b, i + a, 0] for a, b in round_)
        sides["left"] += [[a, d, e], [d, h, e]] if kinds[z] == "wedges" else [[a, d, h, e]]
        sides["front"].append([at[z + b, 0, i + a] for a, b in round_])
    return points, elements, sides


def stack(laws, name, kinds):
    """Two bodies of one file that meet at z = 1, of other numbers of cells: the file, and its scene under pressure."""
    points, elements, names = [], [], {}
    for body, (kind, n, low) in enumerate(((kinds[0], 2, 0.0), (kinds[1], 3, 1.0)), 1):
        more, cells, sides = blocks(kind, n, low, len(points))
        elements += [(kind_, {body}, nodes) for kind_, nodes in cells]
        for i, (side, faces) in enumerate(sides.items()):
            names[2, 10 * body + i] = f"{side} {body}"
            elements += [(len(face) - 1, {10 * body + i}, face) for face in faces]
        points += more
        names[3, body] = f"body {body}"
    file = laws.folder / f"{name}.msh"
    file.write_bytes(gmsh_file(points, elements, names))
    scene = {"Dimension": 3, "Obstacle floor": floor(3), "Contact sole": contact("one", "bottom 1"),
             "Contact joint": joint("two", "bottom 2", "one", "top 1", **{"Friction coefficient": 0}),
             "Load top": load("pressure", repr(PRESSURE), "top 2", "two"), "Output": {"VTU": 0}}
    for number, body in ((1, "one"), (2, "two")):
        scene[f"Body {body}"] = {"Mesh": {"File": file.name, "Group": f"body {number}"},
                                 "Material": {"Young modulus": 100.0, "Poisson ratio": .3}}
        scene[f"Support left {body}"] = support(f"left {number}", "x", body=body)
        scene[f"Support front {body}"] = support(f"front {number}", "y", body=body)
    return scene


def patch(laws):
    """A pressure passes exactly through bodies of several kinds of cells."""
    for kinds in ((("wedges", "hexahedra"), ("tetrahedra", "hexahedra")), (("pyramids", "pyramids"), ("hexahedra", "hexahedra")),
                  (("hexahedra", "pyramids"), ("wedges", "tetrahedra"))):
        name = "-".join(itertools.chain(*kinds))
        scene = stack(laws, name, kinds)
        run = laws.run(scene)
        for which in ("sole", "joint"):
            laws.check(f"{name}: pressure of '{which}'", max(abs(row["r_n"] / row["area"] / PRESSURE - 1) for row in run.rows
                                                            if row["contact"] == which), 1e-10)
        laws.demand(f"{name}: the log says what was split", "split into" in log_of(run))
    done, _ = laws.start(merge(scene, {"Body one": {"Mesh": {"Mixed cells": "refuse"}}}))
    laws.demand("refused where that is asked for", done.returncode == 1 and "Mixed cells = split" in done.stderr)


def deck(laws):
    """Two instances of a part of a deck, one turned on the other, are what two boxes are."""
    n = 3
    at = {place: i for i, place in enumerate(itertools.product(range(n + 1), repeat=3), 1)}
    nodes = "".join(f"{i}, {x / n}, {y / n}, {z / n}\n" for (z, y, x), i in at.items())
    cells = "".join(f"{i}, " + ", ".join(str(at[z + c, y + b, x + a]) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))) + "\n"
                    for i, (z, y, x) in enumerate(itertools.product(range(n), repeat=3), 1))
    (laws.folder / "nodes.inp").write_text(nodes)
    (laws.folder / "stack.inp").write_text(
        "*PART, NAME=cube\n*NODE\n*INCLUDE, INPUT=nodes.inp\n*ELEMENT, TYPE=C3D8, ELSET=solid\n" + cells
        + f"*ELSET, ELSET=lowest, GENERATE\n1, {n * n}\n*ELSET, ELSET=highest, GENERATE\n{n**3 - n * n + 1}, {n**3}\n"
        + "*SURFACE, NAME=down\nlowest, S1\n*SURFACE, NAME=up\nhighest, S2\n"
        + "*NSET, NSET=left, GENERATE\n" + f"1, {(n + 1)**3}, {n + 1}\n*NSET, NSET=front\n"
        + "\n".join(str(at[z, 0, x]) for z in range(n + 1) for x in range(n + 1)) + "\n*END PART\n*ASSEMBLY, NAME=all\n"
        + "*INSTANCE, NAME=one, PART=cube\n*END INSTANCE\n"
        # a quarter turn about the middle of the upper cube: left is where front was
        + "*INSTANCE, NAME=two, PART=cube\n0, 0, 1\n0.5, 0.5, 0, 0.5, 0.5, 1, 90\n*END INSTANCE\n*END ASSEMBLY\n"
        + "*MATERIAL, NAME=steel\n*ELASTIC\n100, .3\n*STEP\n*STATIC\n*END STEP\n")
    scene = {"Dimension": 3, "Obstacle floor": floor(3), "Contact sole": contact("one", "one.down"),
             "Contact joint": joint("two", "two.down", "one", "one.up", **{"Friction coefficient": 0}),
             "Load top": load("pressure", repr(PRESSURE), "two.up", "two"), "Output": {"VTU": 0},
             "Support a": support("left", "x", body="one"), "Support b": support("front", "y", body="one"),
             "Support c": support("left", "y", body="two"), "Support d": support("front", "x", body="two")}
    for body in ("one", "two"):
        scene[f"Body {body}"] = {"Mesh": {"File": "stack.inp", "Group": body}, "Material": {"Young modulus": 100.0, "Poisson ratio": .3}}
    run = laws.run(scene)
    laws.check("deck of two instances: pressures", max(abs(row["r_n"] / row["area"] / PRESSURE - 1) for row in run.rows), 1e-10)
    log = log_of(run)
    laws.demand("  the log says what was not read", "not *ELASTIC, *MATERIAL" in log)


def joined(laws):
    """A bar in two pieces whose nodes between them are there twice is the whole bar, once they are joined."""
    names = {(1, 1): "sole", (1, 2): "top", (1, 3): "ends", (2, 10): "bar"}
    square = [(0., 0., 0.), (1., 0., 0.), (1., 1., 0.), (0., 1., 0.)]
    twice = square + [(x + 1, y, z) for x, y, z in square]
    elements = [(3, {10}, [0, 1, 2, 3]), (3, {10}, [4, 5, 6, 7]), (1, {1}, [0, 1]), (1, {1}, [4, 5]), (1, {2}, [3, 2]), (1, {2}, [7, 6]),
                (1, {3}, [0, 3]), (1, {3}, [5, 6])]
    once = {4: 1, 7: 2}
    forces = []
    for file, cells, entries in (("twice.msh", elements, {"Merge": 1e-6}),
                                 ("once.msh", [(kind, groups, [once.get(i, i) for i in nodes]) for kind, groups, nodes in elements], {})):
        (laws.folder / file).write_bytes(gmsh_file(twice, cells, names))
        run = laws.run({"Dimension": 2, "Body part": {"Mesh": {"File": file, **entries}, "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}},
                        "Obstacle floor": floor(2), "Contact sole": contact("part", "sole", mu=.3),
                        "Load press": load("pressure", "10*t", "top", "part"), "Support base": support("ends", "x, y", body="part"),
                        "Output": {"VTU": 0}})
        forces.append([row["r_n"] for row in run.rows])
        if entries:
            log = log_of(run)
            laws.demand("joined nodes are told, and no doubled ones", "2 nodes at places of others are joined" in log and "coincide" not in log)
    laws.demand("joined nodes are one node", forces[0] == forces[1])


def drawings(laws):
    """A box that is drawn and meshed in the run, of any height, stands as it should."""
    (laws.folder / "box.geo").write_text('SetFactory("OpenCASCADE"); DefineConstant[ h = 1 ]; Box(1) = {0, 0, 0, 2, 1, h};\n'
                                         'Physical Volume("box") = {1}; Physical Surface("sole") = {5}; Physical Surface("top") = {6};\n'
                                         'Physical Surface("left") = {1}; Physical Surface("front") = {3};\n')
    for height, entries in ((1.0, {}), (1.5, {"Parameters": "h = 1.5", "Size near": "sole : 0.2"}), (1.0, {"Order": 2})):
        run = laws.run({"Dimension": 3, "Body box": {"Mesh": {"File": "box.geo", "Size": .5, **entries},
                                                     "Material": {"Young modulus": 100.0, "Poisson ratio": .3}, "Element": "P1"},
                        "Obstacle floor": floor(3), "Contact sole": contact("box", "sole"), "Support left": support("left", "x", body="box"),
                        "Support front": support("front", "y", body="box"), "Load top": load("pressure", repr(PRESSURE), "top", "box"),
                        "Output": {"VTU": 0}})
        name = f"box {height} high, {entries}"
        laws.check(f"{name}: pressures", max(abs(row["r_n"] / row["area"] / PRESSURE - 1) for row in run.rows), 1e-10)
        work = PRESSURE**2 * 2.0 * height / 100.0 / 2
        laws.check(f"{name}: work", abs(run.increments[-1]["external_work"] / work - 1), 1e-10)
        laws.demand(f"{name}: its mesh is beside the results", (run.folder / "mesh_box.msh").read_text().startswith("$MeshFormat\n4.1"))
        laws.demand(f"{name}: cells are as small as asked for", "near" not in str(entries) or len(run.rows) > 60)


def own_sizes(laws):
    """Without Size a .geo file has its own, also by a constant."""
    counts = []
    for size in (.2, .1):  # below what Gmsh takes by itself
        (laws.folder / "sized.geo").write_text('SetFactory("OpenCASCADE"); DefineConstant[ h = 1 ]; Box(1) = {0, 0, 0, 2, 1, 1};\n'
                                               'Mesh.MeshSizeMax = h; Physical Volume("box") = {1}; Physical Surface("sole") = {5};\n')
        run = laws.run({"Dimension": 3, "Body box": {"Mesh": {"File": "sized.geo", "Parameters": f"h = {size}"},
                                                     "Material": {"Young modulus": 100.0, "Poisson ratio": .3}, "Element": "P1"},
                        "Obstacle floor": floor(3), "Contact sole": contact("box", "sole", mu=.3),
                        "Load weight": load("body force", "0 ; 0 ; -1", body="box"), "Output": {"VTU": 0}})
        counts.append(len(run.rows))
    laws.demand(f"half the size has more nodes on the sole: {counts}", counts[1] > 2.5 * counts[0])


def far_away(laws):
    """Where maps put it, by national coordinates in metres, a block has the forces that it has at the origin."""
    for dim, element in ((2, "Q1"), (3, "Q1"), (3, "Q1 incompatible modes")):
        runs = []
        for number, corner in enumerate(((0.0, 0.0, 0.0), (5e5, 5.4e6, 100.0))):
            distorted(laws.folder / f"block-{number}.msh", dim, corner=corner)
            push = (.2, -1.0) if dim == 2 else (.2, .1, -1.0)
            runs.append(laws.run({"Dimension": dim, "Body block": {"Element": element, "Mesh": {"File": f"block-{number}.msh"},
                                                                   "Material": {"Young modulus": 1000.0, "Poisson ratio": .3}},
                                  "Obstacle ground": {"Shape": "half space", "Normal": (0.0,) * (dim - 1) + (1.0,), "Point": corner[:dim]},
                                  "Contact sole": contact("block", 8 + 2 * dim, "ground", .3),
                                  "Load top": load("traction", " ; ".join(map(repr, push)), 9 + 2 * dim)}))
        near, far = (run.last() for run in runs)
        what = f"far from the origin, {dim}D, {element}"
        laws.check(f"{what}: reactions", max(abs(a[c] - b[c]) for a, b in zip(near, far) for c in ("r_n", "r_t1")), 1e-8)
        laws.check("  their sum", abs(sum(row["r_n"] for row in far) - 1), 1e-11)


def mesh_kinds(laws):
    for law in (patch, deck, joined, drawings, own_sizes, far_away):
        law(laws)
