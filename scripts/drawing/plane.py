# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies, obstacles and reactions in the plane."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from conetact.vtu import LINE, QUADRILATERAL, TRIANGLE

from drawing.colours import ARROWS, OBSTACLE

MAX_CELLS_WITH_EDGES = 6000


def triangles(cells):
    parts = [cells[TRIANGLE]] if TRIANGLE in cells else []
    if QUADRILATERAL in cells:
        parts += [cells[QUADRILATERAL][:, [0, 1, 2]], cells[QUADRILATERAL][:, [0, 2, 3]]]
    return np.vstack(parts)


def draw_body(axes, body, scale):
    x, norm = body.x[:, :2], scale.norm
    values = scale.values(body)
    axes.add_collection(LineCollection(body.points[body.faces][:, :, :2], colors="0.6", linewidths=.7, linestyles="--"))
    if body.is_frame:
        lines = LineCollection(x[body.cells[LINE]], cmap=scale.map, norm=norm, linewidths=3, capstyle="round")
        lines.set_array(values[body.cells[LINE]].mean(axis=1))
        axes.add_collection(lines)
        return
    axes.tripcolor(x[:, 0], x[:, 1], triangles(body.cells), values, shading="gouraud", cmap=scale.map, norm=norm)
    n_cells = sum(map(len, body.cells.values()))
    if n_cells <= MAX_CELLS_WITH_EDGES:
        alpha = min(.5, 400 / n_cells)
        for corners in body.cells.values():
            axes.add_collection(PolyCollection(x[corners], facecolors="none", edgecolors=(1, 1, 1, alpha), linewidths=.4))
    axes.add_collection(LineCollection(x[body.faces], colors="black", linewidths=.6))


def obstacle_lines(contact, size):
    """Of the obstacle's surface, from end to end, with the normals there."""
    feet, normals = contact.feet[:, :2], contact.normals[:, :2]
    if contact.is_flat:
        tangent = np.array((normals[0, 1], -normals[0, 0]))
        along = feet @ tangent
        ends = [feet[along.argmin()] - .06 * size * tangent, feet[along.argmax()] + .06 * size * tangent]
        return [(np.array(ends), normals[[0, 0]])]
    near = np.abs(contact.feet - contact.points).max(axis=1) < .5 * size
    return [(feet[face], normals[face]) for face in contact.faces if near[face].all()]


def draw_obstacle(axes, contact, size):
    for line, normals in obstacle_lines(contact, size):
        axes.add_collection(PolyCollection([np.vstack((line, (line - .025 * size * normals)[::-1]))],
                                           facecolors=OBSTACLE, edgecolors="none"))
        axes.add_collection(LineCollection([line], colors="black", linewidths=1.2))


def draw_reactions(axes, contact, largest, length):
    """Arrows end at the nodes they push; the longest one has the given length."""
    for state, colour in ARROWS.items():
        here = (contact.rows["state"] == state) & (np.linalg.norm(contact.reactions, axis=1) > 1e-6 * largest)
        arrows = contact.arrows(largest, length)[here]
        tails = contact.x[here] - arrows
        axes.quiver(tails[:, 0], tails[:, 1], arrows[:, 0], arrows[:, 1], color=colour, angles="xy",
                    scale_units="xy", scale=1, width=.0035 if here.sum() < 60 else .002,
                    zorder=4)


def draw(axes, shapes, scales, arrows, units, limits):
    low, high, size = *limits, float(np.linalg.norm(limits[1] - limits[0]))
    for contact in shapes.contacts:
        if not contact.is_pair:
            draw_obstacle(axes, contact, size)
    for body in shapes.bodies:
        draw_body(axes, body, scales[body.is_frame])
    for contact in shapes.contacts:
        draw_reactions(axes, contact, *arrows)
    axes.set_aspect("equal")
    margin = .15 * size
    axes.set_xlim(low[0] - margin, high[0] + margin)
    axes.set_ylim(low[1] - margin, high[1] + margin)
    axes.set_xlabel(units.label("x"))
    axes.set_ylabel(units.label("y"))
