# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slaves that reach beyond the rim of their master: no node is loaded there, and forces near the rim stay those of
a mesh whose nodes end at it.

rims: a slave of 20 cells on a master that ends anywhere in one of them, in the plane and in space, of all elements,
tied, round an axis; rims-moving: bodies that slide over rims, by both backends.
"""
import itertools

from support.scenes import box, joint, load, merge, simplices, support

CELLS, WIDTH, HEIGHT, YOUNG = 20, 2.0, 1.0, 1000.0
H = WIDTH / CELLS
ENDS = (1.48, 1.4999, 1.5, 1.501, 1.51, 1.52, 1.55, 1.58, 1.59, 1.6)
# Largest pressures under 1 of dual mortar whose functions beyond the rim are given to covered nodes, of an
# independent implementation (two blocks of Q1 cells without friction, the slave on a soft spring).
LARGEST = {1.5: 4.05, 1.501: 4.01, 1.51: 3.75, 1.52: 3.53, 1.55: 3.10, 1.58: 2.76, 1.59: 2.66, 1.6: 3.44}
P1, Q2, P2 = ("Q1", "Q2", "P2")


def steps(pieces):
    """Arguments of a block for pieces of an axis, each (length, cells)."""
    return ", ".join(repr(length / n) for length, n in pieces for _ in range(n))


def block(dim, along, low, high, layers, element="Q1", cut=False):
    """From low to high along x and the last axis, one wide in space; `along`: pieces of x."""
    across = [f"{repr(.5)}, {repr(.5)}"] if dim == 3 else []
    up = steps([(high[1] - low[1], layers)])
    corners = [", ".join(map(repr, (x, 0.0, z) if dim == 3 else (x, z))) for x, z in (low, high)]
    body = {"Element": element,
            "Mesh": {"Generator": "subdivided_hyper_rectangle",
                     "Arguments": " : ".join((" ; ".join((steps(along), *across, up)), *corners, "true"))},
            "Material": {"Young modulus": YOUNG, "Poisson ratio": .3}}
    return simplices({**body, "Mesh": {**body["Mesh"], "Arguments": plain(body["Mesh"]["Arguments"])}}) if cut else body


def plain(arguments):
    """Numbers of cells in place of their lengths, where they are equal."""
    first, *rest = arguments.split(" : ")
    return " : ".join((", ".join(str(len(part.split(","))) for part in first.split(";")), *rest))


def overhang(dim, end, slave="upper", along=((WIDTH, CELLS),), element="Q1", cut=False, layers=10, **contact):
    """A block pressed by 1 on one that ends at `end`; the longer one is the slave, above or below."""
    master = "lower" if slave == "upper" else "upper"
    up = slave == "upper"
    long = block(dim, along, (0.0, 0.0 if up else -HEIGHT), (WIDTH, HEIGHT if up else 0.0), layers, element, cut)
    short = block(dim, ((end, 15),), (0.0, -HEIGHT if up else 0.0), (end, 0.0 if up else HEIGHT), layers, element, cut)
    bottom, top = 2 * dim - 2, 2 * dim - 1
    return {"Dimension": dim, f"Body {slave}": long, f"Body {master}": short,
            "Contact joint": joint(slave, bottom if up else top, master, top if up else bottom, **contact),
            "Support floor": support(bottom, ", ".join("xyz"[:dim]), body="lower"),
            "Support guide": support("0" if dim == 2 else "0, 2, 3", "normal", body="upper"),
            "Load press": load("pressure", "1*t", top, "upper"), "Output": {"VTU": 0}}


def largest(laws, scene, what, force):
    """Largest pressure of the slave; forces of both sides balance, and are the load."""
    run = laws.run(scene)
    last = run.increments[-1]
    up = "xyz"[scene["Dimension"] - 1]
    laws.check(f"{what}: the whole force", abs(abs(last[f"joint_f_{up}"]) / force - 1), 1e-9)
    laws.check("  forces of both sides", abs(last[f"joint_f_{up}"] + last[f"joint_master_f_{up}"]) / force, 1e-12)
    return max(row["r_n"] / row["area"] for row in run.last() if row["contact"] == "joint")


def like(laws, what, found, expected, factor=1.5):
    laws.check(f"{what}: largest pressure {found:.4g} instead of {expected:.4g}, factor", max(found / expected, expected / found), factor)


def fitted(end):
    """Cells of the slave, one of which ends where the master does."""
    inner = max(1, round(end / H))
    return (end, inner), (WIDTH - end, CELLS - inner)


def rims(laws):
    table(laws)
    for dim, slave, (element, cut) in itertools.product((2, 3), ("upper", "lower"), (("Q1", False), ("Q1", True), ("Q2", False), ("P2", True))):
        if dim == 3 and element == "P2":
            continue
        ends = (1.4999, 1.51, 1.57) if dim == 2 and not cut else (1.51,)
        for end in ends:
            what = f"{dim}D, {element}{', cut' * cut}, slave {slave}, master ends at {end}"
            fit = fitted(end) if not cut else ((WIDTH, CELLS),)
            layers = 10 if dim == 2 else 3
            length = WIDTH if slave == "upper" else end
            found = largest(laws, overhang(dim, end, slave, element=element, cut=cut, layers=layers), what, length)
            reference = overhang(dim, end if not cut else 1.5, slave, fit, element, cut, layers)
            like(laws, what, found, largest(laws, reference, "  nodes at the rim", length if not cut or slave == "upper" else 1.5))
