# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A block in every format of meshes that the program reads, and a closed surface in every one of obstacles."""
import itertools
import struct

from support.gmsh import gmsh_file

SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1))


class Block:
    """A brick 2 long and 1 wide and high of few cells; its floor is the boundary 2, its top 3."""

    def __init__(self, dim):
        self.dim, self.counts = dim, (4, 3) if dim == 2 else (3, 2, 2)
        ticks = [[size * k / (n - 1) for k in range(n)] for size, n in zip((2.0, 1.0, 1.0), self.counts)]
        at = {place: i for i, place in enumerate(itertools.product(*(range(n) for n in reversed(self.counts))))}
        number = {tuple(reversed(place)): i for place, i in at.items()}
        self.points = [(*(ticks[d][k] for d, k in enumerate(place)), 0.0)[:3] for place in number]
        self.cells = [self.corners(number, first, range(dim)) for first in itertools.product(*(range(n - 1) for n in self.counts))]
        self.faces = [(group, self.corners(number, (*first, level), range(dim - 1)))
                      for group, level in ((2, 0), (3, self.counts[-1] - 1))
                      for first in itertools.product(*(range(n - 1) for n in self.counts[:-1]))]

    def corners(self, number, first, axes):
        """Of a cell or face: once round, then once round above."""
        if len(axes) == 1:
            return [number[first], number[(first[0] + 1, *first[1:])]]
        rounds = [number[(first[0] + a, first[1] + b, *first[2:])] for a, b in SQUARE]
        if len(axes) == 2:
            return rounds
        return rounds + self.corners(number, (*first[:2], first[2] + 1), axes[:2])


def rows(lists):
    return "".join(" ".join(map(str, values)) + "\n" for values in lists)


def counted(lists, first=1):
    """Rows with their number before them."""
    return rows((i, *values) for i, values in enumerate(lists, first))


def from_one(nodes):
    return [n + 1 for n in nodes]


def vtk(block):
    kinds = {2: (9, 3), 3: (12, 9)}[block.dim]
    cells = block.cells + [nodes for _, nodes in block.faces]
    types = [kinds[0]] * len(block.cells) + [kinds[1]] * len(block.faces)
    ids = [0] * len(block.cells) + [group for group, _ in block.faces]
    n = len(cells)
    return (f"# vtk DataFile Version 3.0\nblock\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {len(block.points)} double\n"
            + rows(block.points) + f"\nCELLS {n} {n + sum(map(len, cells))}\n" + rows((len(c), *c) for c in cells)
            + f"\nCELL_TYPES {n}\n{' '.join(map(str, types))}\n\nCELL_DATA {n}\nSCALARS MaterialID int 1\n"
            f"LOOKUP_TABLE default\n{' '.join(map(str, ids))}\n")


def ucd(block):
    cell, face = {2: ("quad", "line"), 3: ("hex", "quad")}[block.dim]
    elements = [(0, cell, *from_one(c)) for c in block.cells] + [(g, face, *from_one(f)) for g, f in block.faces]
    return f"{len(block.points)} {len(elements)} 0 0 0\n" + counted(block.points) + counted(elements)


def abaqus(block):
    """As Cubit writes it; faces are sides of cells."""
    kind = {2: "S4R", 3: "C3D8R"}[block.dim]
    sides = {2: ("S1", "S3"), 3: ("S1", "S2")}[block.dim]
    comma = lambda text: text.replace(" ", ", ")
    text = ("*HEADING\ncubit(block)\n**\n*NODE, NSET=ALLNODES\n" + comma(counted(block.points))
            + f"**\n*ELEMENT, TYPE={kind}, ELSET=EB1\n" + comma(counted(map(from_one, block.cells))) + "**\n")
    for (group, _), side in zip((block.faces[0], block.faces[-1]), sides):
        own = [i for i, c in enumerate(block.cells, 1)
               if any(g == group and set(f) <= set(c) for g, f in block.faces)]
        name = f"SS{group}_E{side[1:]}"
        text += (f"*ELSET, ELSET={name}\n" + ", ".join(map(str, own)) + f"\n*SURFACE, NAME=SS{group}\n{name}, {side}\n**\n")
    return text + "*SOLID SECTION, ELSET=EB1, MATERIAL=m\n*END\n"


def xda(block):
    return (f"DEAL:MESH\n{len(block.cells)}\n{len(block.points)}\n" + "0\n" * 8 + rows(block.cells) + rows(block.points))


def tecplot(block):
    return (f'TITLE = "block"\nVARIABLES = "X", "Y"\nZONE T="z", N={len(block.points)}, E={len(block.cells)}, '
            "F=FEPOINT, ET=QUADRILATERAL\n" + rows(p[:2] for p in block.points) + rows(map(from_one, block.cells)))


def unv(block):
    """As Salome writes it: nodes, elements, groups."""
    cell, face, beam = {2: (44, 11, "0 1 1\n"), 3: (115, 44, "")}[block.dim]
    end, n = "    -1\n", len(block.cells)
    text = end + "  2411\n" + "".join(f"{i} 1 1 11\n{x} {y} {z}\n" for i, (x, y, z) in enumerate(block.points, 1)) + end
    text += end + "  2412\n" + "".join(f"{i} {cell} 2 1 7 {len(c)}\n" + rows([from_one(c)]) for i, c in enumerate(block.cells, 1))
    text += "".join(f"{i} {face} 2 1 7 {len(f)}\n{beam}" + rows([from_one(f)])
                    for i, (_, f) in enumerate(block.faces, n + 1)) + end + end + "  2467\n"
    for group in (2, 3):
        own = [i for i, (g, _) in enumerate(block.faces, n + 1) if g == group]
        text += f"{group} 0 0 0 0 0 0 {len(own)}\n{group}\n" + "".join(f"8 {i} 0 0\n" for i in own)
    return text + end


def gmsh_1(block):
    cell, face = {2: (3, 1), 3: (5, 3)}[block.dim]
    elements = [(cell, 7, 7, len(c), *from_one(c)) for c in block.cells] + [(face, g, g, len(f), *from_one(f)) for g, f in block.faces]
    return (f"$NOD\n{len(block.points)}\n" + counted(block.points) + f"$ENDNOD\n$ELM\n{len(elements)}\n" + counted(elements) + "$ENDELM\n")


def gmsh_40(block):
    """Entities: two sides, each with its group, and the whole."""
    cell, face = {2: (3, 1), 3: (5, 3)}[block.dim]
    dim, n = block.dim, len(block.points)
    counts = {2: "0 2 1 0", 3: "0 0 2 1"}[dim]
    box = "0 0 0 2 1 1"
    text = f"$MeshFormat\n4 0 8\n$EndMeshFormat\n$Entities\n{counts}\n2 {box} 1 2 0\n3 {box} 1 3 0\n1 {box} 1 7 0\n$EndEntities\n"
    text += f"$Nodes\n1 {n}\n1 {dim} 0 {n}\n" + counted(block.points) + "$EndNodes\n"
    text += f"$Elements\n3 {len(block.cells) + len(block.faces)}\n"
    number = 1
    for tag, kind, of, lists in ((2, face, dim - 1, [f for g, f in block.faces if g == 2]),
                                 (3, face, dim - 1, [f for g, f in block.faces if g == 3]), (1, cell, dim, block.cells)):
        text += f"{tag} {of} {kind} {len(lists)}\n" + counted(map(from_one, lists), number)
        number += len(lists)
    return text + "$EndElements\n"


def gmsh(version, binary):
    def write(block):
        cell, face = {2: (3, 1), 3: (5, 3)}[block.dim]
        elements = [(cell, {7}, c) for c in block.cells] + [(face, {g}, f) for g, f in block.faces]
        dim = block.dim
        return gmsh_file(block.points, elements, {(dim, 7): "steel", (dim - 1, 2): "floor", (dim - 1, 3): "top"}, version, binary)
    return write


# name: extension, writer, dimensions, whether the file has boundary ids
MESHES = {"vtk": ("vtk", vtk, (2, 3), True), "ucd": ("ucd", ucd, (2, 3), True), "ucd as inp": ("inp", ucd, (2, 3), True),
          "abaqus": ("inp", abaqus, (2, 3), True), "xda": ("xda", xda, (2, 3), False),
          "tecplot": ("dat", tecplot, (2,), False), "unv": ("unv", unv, (2, 3), True), "gmsh 1": ("msh", gmsh_1, (2, 3), True),
          "gmsh 4.0": ("msh", gmsh_40, (2, 3), True), "gmsh 2.2": ("msh", gmsh("2.2", False), (2, 3), True),
          "gmsh 4.1": ("msh", gmsh("4.1", False), (2, 3), True), "gmsh 2.2 binary": ("msh", gmsh("2.2", True), (2, 3), True),
          "gmsh 4.1 binary": ("msh", gmsh("4.1", True), (2, 3), True)}

CORNERS = [(x, y, z) for x in (-1.0, 3.0) for y in (-1.0, 2.0) for z in (-1.0, 0.0)]
FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))  # counter-clockwise from outside
TRIANGLES = [(a, b, c) for p, q, r, s in FACES for a, b, c in ((p, q, r), (p, r, s))]


def stl_text():
    corner = lambda i: "      vertex {} {} {}\n".format(*CORNERS[i])
    return ("solid box\n" + "".join("  facet normal 0 0 0\n    outer loop\n" + "".join(map(corner, t)) + "    endloop\n  endfacet\n"
                                    for t in TRIANGLES) + "endsolid box\n")


def stl_binary():
    return b"box".ljust(80) + struct.pack("<I", len(TRIANGLES)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(x for i in t for x in CORNERS[i]), 0) for t in TRIANGLES)


def obj():
    return "".join("v {} {} {}\n".format(*c) for c in CORNERS) + "".join("f " + " ".join(str(i + 1) for i in f) + "\n" for f in FACES)


def gmsh_surface():
    return gmsh_file(CORNERS, [(3, {1}, list(f)) for f in FACES], {(2, 1): "skin"})


SURFACES = {"stl": ("stl", stl_text), "stl binary": ("stl", stl_binary), "obj": ("obj", obj), "gmsh surface": ("msh", gmsh_surface)}


def in_bytes(content):
    return content.encode() if isinstance(content, str) else content
