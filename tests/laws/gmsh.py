# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of Gmsh as they come: formats, names of groups, several materials in a body, several bodies in a file."""
from support.gmsh import FORMATS, gmsh_file, of_second_order, tower
from support.scenes import contact, floor, joint, load, merge, support

PRESSURE = 2.0
SOFT, STIFF = 100.0, 400.0


def column(dim, file, **material):
    """A column on a floor, pressed from above; all sides by name. Poisson's ratio 0: stresses are uniform."""
    return {"Dimension": dim,
            "Body column": {"Mesh": {"File": file}, "Material": {"Poisson ratio": 0, **material}},
            "Obstacle floor": floor(dim), "Contact bottom": contact("column", '"floor"'),
            "Support left": support("left", "x", body="column"),
            **({"Support front": support("front", "y", body="column")} if dim == 3 else {}),
            "Load top": load("pressure", repr(PRESSURE), "top", "column"), "Output": {"VTU": 0}}


def settlement(run):
    """The mean way of the top, by the work of the pressure on it, which grows in one increment."""
    return 2 * run.increments[-1]["external_work"] / PRESSURE


def formats(laws):
    """The same mesh in every format gives the same results; a column of two materials settles by the sum of both."""
    for dim in (2, 3):
        tables = []
        for version, binary in FORMATS:
            file = laws.folder / f"column-{version}-{binary}.msh"
            file.write_bytes(gmsh_file(*tower(dim, 2, (1.0, .5), ("rubber", "steel")), version, binary))
            run = laws.run(column(dim, file.name, **{"Material group": "rubber ; steel", "Young modulus": f"{SOFT} ; {STIFF}"}))
            exact = PRESSURE * (1.0 / SOFT + .5 / STIFF)
            what = f"{dim}D, {version} {'binary' if binary else 'text'}"
            laws.check(f"{what}: settlement of two materials", abs(settlement(run) / exact - 1), 1e-12)
            laws.check(f"{what}: pressure", max(abs(row["r_n"] / row["area"] / PRESSURE - 1) for row in run.rows), 1e-11)
            tables.append([row["r_n"] for row in run.rows])
            file.write_bytes(gmsh_file(*of_second_order(*tower(dim, 2, (1.0, .5), ("rubber", "steel"))), version, binary))
            scene = column(dim, file.name, **{"Material group": "rubber ; steel", "Young modulus": f"{SOFT} ; {STIFF}"})
            scene["Body column"]["Element"] = "Q1"  # its nodes in the middle stand anywhere
            tables.append([row["r_n"] for row in laws.run(scene).rows])
        laws.demand(f"{dim}D: reactions depend neither on the format nor on nodes of second order", all(table == tables[0] for table in tables))


def bodies_of_a_file(laws):
    """Two bodies of one file in contact at the group between them; overlapping groups by name and by number."""
    file = laws.folder / "parts.msh"
    for dim in (2, 3):
        file.write_bytes(gmsh_file(*tower(dim, 2, (1.0, .5), ("rubber", "steel"))))
        walls = {"Support lower": support("outside", "normal", body="lower"), "Support upper": support("24", "normal", body="upper")}
        scene = {"Dimension": dim, **walls,
                 "Body lower": {"Mesh": {"File": file.name, "Group": "rubber"},
                                "Material": {"Poisson ratio": .3, "Young modulus": SOFT}},
                 "Body upper": {"Mesh": {"File": file.name, "Group": "2"}, "Material": {"Poisson ratio": .3, "Young modulus": STIFF}},
                 "Obstacle floor": floor(dim), "Contact bottom": contact("lower", "floor"),
                 "Contact joint": joint("upper", "joint 0", "lower", "joint 0", **{"Friction coefficient": 0}),
                 "Load top": load("pressure", repr(PRESSURE), "top", "upper"), "Output": {"VTU": 0}}
        run = laws.run(scene)
        for name in ("bottom", "joint"):
            rows = [row for row in run.rows if row["contact"] == name]
            laws.check(f"{dim}D, two bodies of a file: pressure of '{name}'",
                       max(abs(row["r_n"] / row["area"] / PRESSURE - 1) for row in rows), 1e-10)
        refined = merge(scene, {"Body lower": {"Mesh": {"Refinement distance": "joint 0 : 0.1 : 1"}}})
        rows = [row for row in laws.run(refined).rows if row["contact"] == "bottom"]
        laws.check(f"{dim}D, refined beside a group: pressure", max(abs(row["r_n"] / row["area"] / PRESSURE - 1) for row in rows), 1e-10)


def heat(laws):
    """Each material expands by itself: a heated column of two between plates and walls is pressed by the sum of both."""
    file = laws.folder / "heated.msh"
    file.write_bytes(gmsh_file(*tower(2, 2, (1.0, .5), ("rubber", "steel"))))
    alpha, change = (1e-3, 3e-3), 10.0
    scene = merge(column(2, file.name, **{"Material group": "rubber ; steel", "Young modulus": f"{SOFT} ; {STIFF}",
                                          "Expansion coefficient": " ; ".join(map(repr, alpha))}),
                  {"Body column": {"Mesh": {"Boundary ids": "99: x > 0.999"}}, "Load top": None,
                   "Load heat": load("temperature", change, body="column"),
                   "Support top": support("top", "y", body="column"), "Support right": support(99, "x", body="column")})
    run = laws.run(scene)
    stress = change * (alpha[0] * 1.0 + alpha[1] * .5) / (1.0 / SOFT + .5 / STIFF)
    laws.check("heated column of two materials: pressure",
               max(abs(row["r_n"] / row["area"] / stress - 1) for row in run.rows), 1e-12)


def numbers(laws):
    """A number that conditions give to faces means these alone, whatever numbers faces in several groups have."""
    file = laws.folder / "numbers.msh"
    file.write_bytes(gmsh_file(*tower(2, 2, (1.0, .5), ("rubber", "steel"))))
    for number in (26, 24, 99):  # the next one of the file, one of it, another one
        scene = merge(column(2, file.name, **{"Young modulus": SOFT}),
                      {"Body column": {"Mesh": {"Boundary ids": f"{number}: x > 0.999"}}, "Contact bottom": {"Friction coefficient": 0},
                       "Load side": load("pressure", repr(PRESSURE), number, "column")})
        carried = laws.run(scene).increments[-1]["support_left_f_x"]
        exact = 1.5 * PRESSURE if number != 24 else 0  # which is both sides
        laws.check(f"pressed on {number}: what the other side carries", abs(abs(carried) - exact), 1e-10)


def gmsh(laws):
    for law in (formats, bodies_of_a_file, heat, islands, numbers):
        law(laws)


def squares(places, n=4, h=.25):
    """Squares of 1 that stand beside each other, as a file of Gmsh: bottoms are 10, 11, ..., tops 20, 21, ..."""
    nodes, elements = [], []
    for k, x in enumerate(places):
        number = [[len(nodes) + 1 + j * (n + 1) + i for i in range(n + 1)] for j in range(n + 1)]
        nodes += [(x + i * h, j * h) for j in range(n + 1) for i in range(n + 1)]
        elements += [(3, 1, (number[j][i], number[j][i + 1], number[j + 1][i + 1], number[j + 1][i])) for j in range(n) for i in range(n)]
        elements += [(1, id + k, number[j][i:i + 2]) for id, j in ((10, 0), (20, n)) for i in range(n)]
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes)),
                      *(f"{i} {x} {y} 0" for i, (x, y) in enumerate(nodes, 1)), "$EndNodes", "$Elements", str(len(elements)),
                      *(f"{i} {kind} 2 {tag} {tag} {' '.join(map(str, at))}" for i, (kind, tag, at) in enumerate(elements, 1)),
                      "$EndElements", ""])


def islands(laws):
    """A body of two pieces: each held by supports, or refused by both backends and before a run, by name and place."""
    (laws.folder / "islands.msh").write_text(squares((0.0, 3.0)))
    free = {"Dimension": 2, "Body pair": {"Mesh": {"File": "islands.msh"}, "Material": {"Young modulus": SOFT, "Poisson ratio": 0}},
            "Obstacle floor": floor(2), "Contact bottom": contact("pair", "10, 11"), "Load top": load("pressure", "t", "20, 21", "pair"),
            "Output": {"VTU": 0}}
    held = merge(free, {"Contact bottom": None, "Obstacle floor": None, "Support left": support(10, "x, y", body="pair"),
                        "Support right": support(11, "x, y", body="pair")})
    for backend in ("condensed", "iterative"):
        solver = {"Solver": {"Backend": backend}}
        row = laws.run(merge(held, solver)).increments[-1]
        laws.check(f"two pieces that are held, {backend}: each carries its own",
                   max(abs(row[f"support_{side}_f_y"] - 1) for side in ("left", "right")), 1e-10)
        for arguments in ((), ("--dry-run",)):
            done, _ = laws.start(merge(free, solver), *arguments)
            laws.demand(f"two pieces that are not held, {backend} {' '.join(arguments)}: exit code {done.returncode}: {done.stderr.strip()}",
                        done.returncode == 1 and "Body 'pair' is of 2 pieces that are not joined" in done.stderr
                        and "25 nodes around (0.5, 0.5, 0), 25 nodes around (3.5, 0.5, 0)" in done.stderr)
