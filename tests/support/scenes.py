# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes as trees of entries: how one is written, changed, and built of blocks."""
import copy
import math
from pathlib import Path

from support.vectors import IDENTITY, apply, plus, rotation, unit

SHIPPED = Path(__file__).resolve().parents[2] / "parameter-files"
LISTS = {"Body": "Bodies", "Obstacle": "Obstacles", "Contact": "Contacts", "Support": "Supports", "Load": "Loads"}
ELEMENTS = ("Q1", "Q1 B-bar", "Q1 incompatible modes")


def text(value):
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, (tuple, list)):
        return ", ".join(map(text, value))
    return str(value)


def lines(tree, depth=0):
    for name, value in tree.items():
        if isinstance(value, dict):
            yield "  " * depth + "subsection " + name
            yield from lines(value, depth + 1)
            yield "  " * depth + "end"
        else:
            yield "  " * depth + f"set {name} = {text(value)}"


def merge(tree, changes):
    """A copy of a scene with other entries; None removes one."""
    result = copy.deepcopy(tree)
    for name, value in changes.items():
        if value is None:
            result.pop(name, None)
        elif isinstance(value, dict):
            result[name] = merge(result.get(name, {}), value)
        else:
            result[name] = value
    return result


def write_scene(scene, file):
    head = {plural: ", ".join(key[len(kind) + 1:] for key in scene if key.startswith(kind + " "))
            for kind, plural in LISTS.items()}
    file.write_text("\n".join(lines({**head, **scene})) + "\n")


def box(cells, size, origin=None, young=1000.0, poisson=.3, **mesh):
    origin = origin or (0.0,) * len(size)
    return {"Mesh": {"Generator": "subdivided_hyper_rectangle",
                     "Arguments": " : ".join(map(text, (cells, origin, plus(origin, size), "true"))), **mesh},
            "Material": {"Young modulus": young, "Poisson ratio": poisson}}


def simplices(body):
    """The same box, its cells cut into triangles or tetrahedra."""
    return merge(body, {"Mesh": {"Generator": body["Mesh"]["Generator"] + "_with_simplices"}})


def ring(inner, outer, cells=12, degrees=0.0, young=1000.0, poisson=.3):
    """Sides: 0 inside, 1 outside."""
    return {"Mesh": {"Generator": "hyper_shell", "Arguments": f"0, 0 : {inner!r} : {outer!r} : {cells} : true",
                     "Rotation": degrees},
            "Material": {"Young modulus": young, "Poisson ratio": poisson, "Plane": "stress"}}


def floor(dim, **entries):
    return {"Shape": "half space", "Normal": (0, 1) if dim == 2 else (0, 0, 1), **entries}


def contact(body="block", ids=2, obstacle="floor", mu=0.0, **entries):
    return {"Body": body, "Boundary ids": ids, "Obstacle": obstacle, "Friction coefficient": mu, **entries}


def joint(slave, slave_ids, master, master_ids, **entries):
    return {"Body": slave, "Boundary ids": slave_ids, "Master body": master, "Master boundary ids": master_ids,
            "Pairing": "mortar", **entries}


def support(ids, directions, displacement="0", body="block", **entries):
    return {"Body": body, "Boundary ids": ids, "Directions": directions, "Displacement": displacement, **entries}


def load(kind, value, ids=None, body="block", **entries):
    return {"Body": body, "Kind": kind, "Value": value, **({} if ids is None else {"Boundary ids": ids}), **entries}


def beam(start, end, n, young, height):
    """Its boundary ids: 0 all nodes, 1 the first, 2 the last."""
    return {"Kind": "frame", "Sections": "s",
            "Frame": {"Generator": "line", "Arguments": " : ".join(map(text, (start, end, n)))},
            "Section s": {"Young modulus": young, "Area": height**2, "Moment of inertia": height**4 / 12}}


def press_and_shear(dim, cells=None, mu=.3, increments=4, **body):
    """A block pressed in one increment, then sheared along x in equal ones."""
    size = (2.0, 1.0) if dim == 2 else (1.5, 1.0, 1.0)
    cells = cells or ((12, 6) if dim == 2 else (5, 4, 4))
    down, side = "-0.01*min(t, 1)", "0.004*max(t - 1, 0)"
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    return {"Dimension": dim,
            "Body block": box(cells, size, **body),
            "Obstacle floor": floor(dim),
            "Contact bottom": contact(ids=bottom, mu=mu),
            "Support top": support(top, "x, y" if dim == 2 else "x, y, z",
                                   f"{side} ; {down}" if dim == 2 else f"{side} ; 0.3*{side} ; {down}"),
            "Time": {"End": increments, "Increments": increments},
            "Output": {"VTU": 0}}


def with_element(scene, element, body="block"):
    return merge(scene, {f"Body {body}": {"Element": element}})


def turned_scene(dim, axis, degrees, supports):
    """One scene with everything in it that has a direction, turned."""
    m = rotation(axis, degrees)
    back = [f"({m[0][d]!r}*x + ({m[1][d]!r})*y + ({m[2][d]!r})*z)" for d in range(3)]

    def vector(*v):
        return apply(m, v + (0,) * (3 - len(v)))[:dim]

    def functions(*v):  # of t, each a factor and a function
        return " ; ".join(" + ".join(f"({m[d][e]!r})*({f})" for e, f in enumerate(v)) for d in range(dim))

    def directions(*v):
        return ", ".join(f"({text(vector(*e))})" for e in v)

    scene = press_and_shear(dim, mu=f"0.2 + 0.1*{back[0]}")
    scene["Body block"]["Mesh"]["Rotation"] = degrees if dim == 2 else (*map(float, axis), degrees)
    # tilted, so that it is open somewhere; not where a face's own normal holds contact nodes
    tilt = 0.0 if supports == "normal" else -.008
    scene["Obstacle floor"] = {"Shape": "half space",
                               "Normal": vector(*((-tilt, 1) if dim == 2 else (-tilt, -tilt / 2, 1))),
                               "Displacement": functions("0.001*t", "0.0005*t", "0.0003*t")}
    height = back[dim - 1]
    scene["Load weight"] = load("body force", functions("0.2*t", f"-t*{height}", "0.1*t"))
    scene["Load push"] = load("pressure", f"0.5*t*{height}", 0)
    scene["Load pull"] = load("traction", functions("0.3*t", "0.2*t", "0.1*t"), 1)
    scene["Load point"] = load("point force", functions("0.1*t", "0.1*t", "-0.1*t"), Point=vector(.7, .45, .6))
    e = IDENTITY
    down, side = "-0.01*min(t, 1)", "0.004*max(t - 1, 0)"
    if supports == "axes":
        scene["Support top"]["Directions"] = directions(*e[:dim])
    elif supports == "normal":
        top = scene["Support top"]["Boundary ids"]
        scene["Support top"] = support(top, "normal", down)
        scene["Support left"] = support(0, "normal", f"-0.2*{side}")
        if dim == 3:
            scene["Support front"] = support(2, "normal", "0")
    elif supports == "oblique":
        oblique = ((1, 2, 0), (3, -1, 0)) if dim == 2 else ((1, 2, 0), (3, -1, 1), (0, .5, 2))
        motion = scene["Support top"]["Displacement"].split(";")
        scene["Support top"].update({"Directions": directions(*oblique), "Displacement": " ; ".join(
            " + ".join(f"({c!r})*({f})" for c, f in zip(unit(v), motion)) for v in oblique)})
    else:
        scene["Support top"]["Directions"] = directions(*e[:dim])
        scene["Support top"]["Stiffness"] = f"20000 + 1000*{back[0]}"
    return scene, m


def stack(dim, cells, heights, mu, joint_mu, side="0.002*max(t - 1, 0)"):
    """Blocks one on the other, cells[i] along all axes each, pressed and sheared."""
    bottom, top = (2, 3) if dim == 2 else (4, 5)
    scene = {"Dimension": dim, "Obstacle floor": floor(dim), "Contact bottom": contact("block 0", bottom, mu=mu)}
    below = 0.0
    for i, (n, height) in enumerate(zip(cells, heights)):
        size = (2.0, height) if dim == 2 else (1.5, 1.0, height)
        origin = (0.0, below) if dim == 2 else (0.0, 0.0, below)
        scene[f"Body block {i}"] = box(n, size, origin)
        below += height
        if i > 0:
            scene[f"Contact joint {i}"] = {"Body": f"block {i}", "Boundary ids": bottom,
                                           "Master body": f"block {i - 1}", "Master boundary ids": top,
                                           "Friction coefficient": joint_mu, "Pairing": "node to face"}
    down = "-0.01*min(t, 1)"
    return {**scene, "Support top": support(top, "x, y" if dim == 2 else "x, y, z",
                                            f"{side} ; {down}" if dim == 2 else f"{side} ; 0 ; {down}",
                                            f"block {len(cells) - 1}"),
            "Time": {"End": 3, "Increments": 3}, "Output": {"VTU": 0}}


def pushed_block(dim, height, mu, angle=0.0, cells=None, weight=2000.0, **entries):
    """A block 2 wide [2 deep] and 1 high on a floor, pushed by p times its weight at a height."""
    width = 2.0 if dim == 2 else 4.0
    cells = cells or ((8, 4) if dim == 2 else (4, 4, 2))
    force = (weight * math.cos(angle), weight * math.sin(angle), 0.0)[:dim] if dim == 3 else (weight, 0.0)
    down = (0.0,) * (dim - 1) + (-weight / width,)
    scene = {"Dimension": dim,
             "Body block": box(cells, (2.0, 1.0) if dim == 2 else (2.0, 2.0, 1.0),
                               None if dim == 2 else (-1.0, -1.0, 0.0), young=1e6),
             "Obstacle floor": floor(dim), "Contact bottom": contact(ids=2 if dim == 2 else 4, mu=mu),
             "Load weight": load("body force", " ; ".join(map(text, down))),
             "Load push": load("point force", " ; ".join(f"{text(f)}*t" for f in force),
                               Point=(0.0,) * (dim - 1) + (height,)),
             "Time": {"Times": 2}, "Solver": {"Method": "load path"}, "Output": {"VTU": 0}}
    return merge(scene, entries)


def entries(**values):
    """-s options from Section__Sub_section__Entry=value."""
    return [word for name, value in values.items()
            for word in ("-s", name.replace("__", "/").replace("_", " ") + f"={value}")]
