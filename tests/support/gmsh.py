# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files as Gmsh writes them: versions 2.2 and 4.1, text and binary, with physical groups by name."""
import itertools
import struct

SECOND_ORDER = {1: (8, 1), 2: (9, 3), 3: (10, 5), 4: (11, 6), 5: (12, 19)}  # types, and nodes behind the corners
DIMENSIONS = {1: 1, 2: 2, 3: 2, 4: 3, 5: 3, 6: 3, 7: 3, 8: 1, 9: 2, 10: 2, 11: 3, 12: 3, 15: 0}  # of Gmsh's types of elements
FORMATS = tuple(itertools.product(("2.2", "4.1"), (False, True)))


def gmsh_file(points, elements, names, version="4.1", binary=False):
    """Bytes of a file; elements: type, set of groups, nodes from 0; names: {(dimension, group): name}."""
    out = [f"$MeshFormat\n{version} {int(binary)} 8\n".encode()]
    out += [struct.pack("<i", 1) + b"\n"] * binary + [b"$EndMeshFormat\n"]
    rows = "".join(f'{dim} {group} "{name}"\n' for (dim, group), name in sorted(names.items()))
    out.append(f"$PhysicalNames\n{len(names)}\n{rows}$EndPhysicalNames\n".encode())
    body = old(points, elements, binary) if version == "2.2" else new(points, elements, binary)
    return b"".join(out) + body


def of_second_order(points, elements, names):
    """The same with more nodes behind the corners of each element, somewhere inside."""
    points, raised = list(points), []
    for kind, groups, nodes in elements:
        other, n = SECOND_ORDER[kind]
        middle = tuple(sum(points[i][d] for i in nodes) / len(nodes) for d in range(3))
        raised.append((other, groups, [*nodes, *range(len(points), len(points) + n)]))
        points += [middle] * n
    return points, raised, names


def old(points, elements, binary):
    """Elements in several groups stand there once for each."""
    lines = [(kind, group, nodes) for kind, groups, nodes in elements for group in sorted(groups) or [0]]
    out = [f"$Nodes\n{len(points)}\n".encode()]
    for i, p in enumerate(points, 1):
        out.append(struct.pack("<i3d", i, *p) if binary else f"{i} {p[0]!r} {p[1]!r} {p[2]!r}\n".encode())
    out.append(b"\n" * binary + f"$EndNodes\n$Elements\n{len(lines)}\n".encode())
    for i, (kind, group, nodes) in enumerate(lines, 1):
        numbers = (group, group, *(n + 1 for n in nodes))
        if binary:
            out.append(struct.pack(f"<{4 + len(numbers)}i", kind, 1, 2, i, *numbers))
        else:
            out.append((" ".join(map(str, (i, kind, 2, *numbers))) + "\n").encode())
    return b"".join(out) + b"\n" * binary + b"$EndElements\n"


def new(points, elements, binary):
    """Parts of the geometry carry the groups: one for each combination of them."""
    def put(code, *values):
        if binary:
            return struct.pack(f"<{code}", *values)
        return (" ".join(repr(v) if isinstance(v, float) else str(v) for v in values) + "\n").encode()

    parts = sorted({(DIMENSIONS[kind], tuple(sorted(groups))) for kind, groups, _ in elements})
    tags = {part: i for i, part in enumerate(parts, 1)}
    counts = [sum(part[0] == dim for part in parts) for dim in range(4)]
    out = [b"$Entities\n", put("4Q", *counts)]
    for dim, groups in parts:
        box = (0.0,) * (3 if dim == 0 else 6)
        sides = (0,) if dim > 0 else ()
        out.append(put(f"i{len(box)}dQ{len(groups)}i{len(sides)}Q", tags[dim, groups], *box, len(groups), *groups, *sides))
    dim = max(part[0] for part in parts)
    out += [b"$EndEntities\n$Nodes\n", put("4Q", 1, len(points), 1, len(points)), put("3iQ", dim, 1, 0, len(points))]
    out += [put("Q", i + 1) for i in range(len(points))] + [put("3d", *map(float, p)) for p in points]
    blocks = {}
    for kind, groups, nodes in elements:
        blocks.setdefault((kind, tuple(sorted(groups))), []).append(nodes)
    out += [b"$EndNodes\n$Elements\n", put("4Q", len(blocks), len(elements), 1, len(elements))]
    number = itertools.count(1)
    for (kind, groups), lists in blocks.items():
        dim = DIMENSIONS[kind]
        out.append(put("3iQ", dim, tags[dim, groups], kind, len(lists)))
        out += [put(f"{1 + len(nodes)}Q", next(number), *(n + 1 for n in nodes)) for nodes in lists]
    return b"".join(out) + b"$EndElements\n"


def tower(dim, cells, heights, names):
    """A column of parts one on the other, 1 wide: points, elements and names of groups for gmsh_file().

    Part i is the group names[i]; sides are 'floor', 'top', 'left' and 'front', what lies between parts i and i + 1
    is 'joint i', and 'left' is in 'outside' as well, as is 'front'.
    """
    levels = [0.0]
    owner = []
    for i, height in enumerate(heights):
        levels += [levels[-1] + height * k / cells for k in range(1, cells + 1)]
        owner += [i] * cells
    counts = [cells + 1] * (dim - 1) + [len(levels)]
    number = {at: i for i, at in enumerate(itertools.product(*map(range, counts)))}
    points = [(*(k / cells for k in at[:-1]), *(0.0,) * (2 - (dim - 1)), levels[at[-1]])[:3] if dim == 3 else
              (at[0] / cells, levels[at[1]], 0.0) for at in number]
    groups = {name: i for i, name in enumerate(names, 1)}
    sides = {name: i for i, name in enumerate(["floor", "top", "left", "front", "outside"] +
                                              [f"joint {i}" for i in range(len(heights) - 1)], 20)}
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    elements = []

    def face(at, free):
        """The corners of the face of cell `at` that spans the axes `free`."""
        shifts = ((0,), (1,)) if dim == 2 else corners
        return [number[tuple(c + dict(zip(free, s)).get(d, 0) for d, c in enumerate(at))] for s in shifts]

    kinds = {2: (1, 3), 3: (3, 5)}[dim]
    for at in itertools.product(*(range(c - 1) for c in counts)):
        if dim == 2:
            nodes = [number[at[0] + a, at[1] + b] for a, b in corners]
        else:
            nodes = [number[at[0] + a, at[1] + b, at[2] + c] for c in (0, 1) for a, b in corners]
        elements.append((kinds[1], {groups[names[owner[at[-1]]]]}, nodes))
        for d, name in ((0, "left"), (1, "front"))[:dim - 1]:
            if at[d] == 0:
                elements.append((kinds[0], {sides[name], sides["outside"]}, face(at, [e for e in range(dim) if e != d])))
        flat = list(range(dim - 1))
        if at[-1] == 0:
            elements.append((kinds[0], {sides["floor"]}, face(at, flat)))
        above = (*at[:-1], at[-1] + 1)
        if at[-1] == len(levels) - 2:
            elements.append((kinds[0], {sides["top"]}, face(above, flat)))
        elif owner[at[-1]] != owner[at[-1] + 1]:
            elements.append((kinds[0], {sides[f"joint {owner[at[-1]]}"]}, face(above, flat)))
    labels = {(dim, tag): name for name, tag in groups.items()}
    labels.update({(dim - 1, tag): name for name, tag in sides.items()})
    return points, elements, labels
