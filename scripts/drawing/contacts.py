# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What one contact carries: stresses along it in the plane, a map of its pressure in space."""
import re

import numpy as np

from drawing.colours import STATES
from drawing.unrolled import sheet_of

WIDE = 12  # times as wide as high: lengths of both axes differ


def friction_coefficient(result, contact):
    """A number; None where it is a function or 0."""
    text = result.entries.get(f"Contact {contact}/Friction coefficient", "")
    return float(text) or None if re.fullmatch(r"[-+]?[\d.]+(e[-+]?\d+)?", text, re.I) else None


def carried(contact):
    """Normal and tangential stresses, or nodal forces where nodes have no areas or belong to frames."""
    rows = contact.rows
    forces = (contact.body is not None and contact.body.is_frame) or not rows["area"].any()
    names = ("r_n", "r_t1", "r_t2") if forces else ("pressure", "traction_t1", "traction_t2")
    return [rows[name] for name in names], ("nodal force", "force") if forces else ("contact stress", "stress")


def coordinate(contact):
    """Along a contact in the plane: x or y, or on a round one the length of the way along it."""
    p = contact.points
    axis = int(np.argmax(np.ptp(p, axis=0)[:2]))
    order = chain(contact.faces, int(contact.first_gap.argmax()))
    alike = (contact.normals @ contact.normals[0]).min() > .8 and abs(np.sign(np.diff(p[order, axis])).sum()) == len(order) - 1
    if alike or len(order) < len(p):
        return p[:, axis], "xy"[axis]
    way = np.zeros(len(p))
    way[order] = np.cumsum(np.concatenate(([0], np.linalg.norm(np.diff(p[order], axis=0), axis=1))))
    return way, "length along the contact"


def chain(edges, start):
    """Nodes in the order of a line; of a ring from one of them, in both cases only those that are joined."""
    neighbours = {start: []}
    for a, b in edges.tolist():
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    ends = [node for node, others in neighbours.items() if len(others) == 1]
    order, seen = [ends[0] if ends else start], {ends[0] if ends else start}
    while True:
        beyond = [node for node in neighbours[order[-1]] if node not in seen]
        if not beyond:
            return order
        order.append(beyond[0])
        seen.add(beyond[0])


def draw_states(axes, at, states):
    for state, (colour, mark) in STATES.items():
        here = states == state
        if here.any():
            axes.plot(at[here], np.full(here.sum(), .03), mark, markersize=3, color=colour, label=state,
                      transform=axes.get_xaxis_transform())


def extremes(contacts, mu=None):
    """Least and largest value that is drawn of a contact over a series."""
    values = [v for contact in contacts for v in ([carried(contact)[0][0]] if mu is None else
                                                  [carried(contact)[0][0], carried(contact)[0][1] / mu])]
    return min(min(v.min() for v in values), 0), max(v.max() for v in values)


def draw_line(axes, contact, series, result, units):
    (normal, tangential, _), (what, kind) = carried(contact)
    at, name = coordinate(contact)
    order = np.argsort(at)
    mu = friction_coefficient(result, contact.name)
    low, high = extremes(series, mu or 1)
    height = high - low or 1
    axes.axhline(0, color="grey", linewidth=.8)
    axes.plot(at[order], normal[order], "s-", markersize=3.5, color="C0", label=r"$r_n$")
    axes.plot(at[order], (tangential / (mu or 1))[order], "^-", markersize=3.5, color="C1",
              label=r"$r_t/\mu$" if mu else r"$r_t$")
    draw_states(axes, at, contact.rows["state"])
    axes.set_ylim(low - .14 * height, high + .05 * height)
    axes.set_xlabel(units.label(name, "length"))
    axes.set_ylabel(units.label(what, kind))
    add_legend(axes, contact)


def draw_map(figure, axes, contact, series, units):
    """Seen along the mean normal, or unrolled: pressure in colour, friction as arrows, states as marks."""
    (normal, *_), (what, kind) = carried(contact)
    sheet = sheet_of(contact.points, contact.normals)
    p = sheet.at
    low, high = extremes(series)
    scale = {"cmap": "viridis", "vmin": low, "vmax": high if high > low else low + 1}
    covered = len(np.unique(contact.faces)) == len(p)  # else some faces have corners that meet nothing
    if covered:
        faces = contact.faces[:, [0, 1, 2, 0, 2, -1]].reshape(-1, 3)
        faces = faces[faces[:, 1] != faces[:, 2]]  # those of simplices repeat a corner
        places, number, faces = sheet.triangles(faces)
        drawn = axes.tripcolor(*places.T, faces, normal[number], shading="gouraud", **scale)
    else:
        drawn = axes.scatter(*p.T, c=normal, s=60, **scale)
        axes.margins(.12)
    for state, (colour, mark) in STATES.items():
        here = contact.rows["state"] == state
        if here.any():
            axes.plot(*p[here].T, mark, markersize=min(3, 60 / len(p)**.5) if covered else 9,
                      color=colour, label=state, linestyle="none",
                      markerfacecolor="none", markeredgewidth=.6 if covered else 1.2)
    friction = contact.reactions - contact.rows["r_n"][:, None] * contact.normals
    size = np.linalg.norm(friction, axis=1).max()
    if size > 0:
        axes.quiver(*p.T, *sheet.parts(friction), angles="xy", scale_units="xy", width=.004,
                    color="white" if covered else "0.4", scale=size / (.08 * np.ptp(p, axis=0).max()))
    axes.set_aspect("equal" if np.ptp(p[:, 0]) < WIDE * np.ptp(p[:, 1]) else "auto")
    axes.autoscale_view()
    if sheet.period:
        axes.set_xlim(-sheet.period / 2, sheet.period / 2)
    axes.set_xlabel(units.label(sheet.labels[0], "length"))
    axes.set_ylabel(units.label(sheet.labels[1], "length"))
    label = "normal force" if kind == "force" else "contact pressure"
    figure.colorbar(drawn, ax=axes, label=units.label(label, kind))
    add_legend(axes, contact)


def add_legend(axes, contact):
    """Above, where nothing is drawn."""
    axes.legend(title=f"contact {contact.name}", frameon=False, fontsize="small", ncol=5, loc="lower center",
                bbox_to_anchor=(.5, 1), borderaxespad=0)
