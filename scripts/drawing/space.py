# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies, obstacles and reactions in space, seen from far away.

All of them are polygons of one collection, which is drawn from the back to the front.
"""
import numpy as np
from matplotlib.colors import to_rgba
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

from drawing.colours import ARROWS, OBSTACLE
from drawing.shapes import rectangle

MAX_FACES_WITH_EDGES = 8000
PARTS = 4000  # into about so many polygons the faces of coarse meshes are cut
NONE, EDGE = (0, 0, 0, 0), (0, 0, 0, .3)


class Polygons:
    """Corners, colours of faces and edges."""

    def __init__(self):
        self.corners, self.faces, self.edges = [], [], []

    def add(self, corners, face=NONE, edge=NONE):
        self.corners.append(corners)
        self.faces.append(to_rgba(face))
        self.edges.append(to_rgba(edge))

    def draw(self, axes):
        if self.corners:
            axes.add_collection3d(Poly3DCollection(self.corners, facecolors=self.faces, edgecolors=self.edges,
                                                   linewidths=.5))


def cut(corners, n):
    """n x n parts of quadrilaterals with their values (the last numbers of a corner)."""
    if n == 1:
        return corners
    s, t = (w[..., None, None] for w in np.meshgrid(*[np.arange(n + 1) / n] * 2, indexing="ij"))
    a, b, c, d = corners.transpose(1, 0, 2)
    grid = (1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d
    parts = np.stack((grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]), axis=3)
    return parts.reshape(-1, *parts.shape[3:])


def add_edges(polygons, corners, n, colour, sight):
    """Of faces cut into n x n parts, in n pieces, a little nearer than these."""
    w = np.arange(n + 1)[:, None, None, None] / n
    points = (1 - w) * corners + w * np.roll(corners, -1, axis=1)
    points = points + sight * .7 / n * np.ptp(corners, axis=1).max(axis=1)[:, None, None]
    for piece in np.stack((points[:-1], points[1:], points[:-1]), axis=3).reshape(-1, 3, 3):
        polygons.add(piece, edge=colour)


def add_bodies(polygons, bodies, scale, sight):
    n_faces = sum(len(body.faces) for body in bodies)
    n = int(min(max(np.sqrt(PARTS / max(n_faces, 1)), 1), 6))
    for body in bodies:
        corners = np.dstack((body.x[body.faces], scale.values(body)[body.faces]))
        for part in cut(corners, n):
            colour = scale.map(scale.norm(part[:, 3].mean()))
            polygons.add(part[:, :3], colour, EDGE if n == 1 and n_faces <= MAX_FACES_WITH_EDGES else colour)
        if n > 1:
            add_edges(polygons, body.x[body.faces], n, EDGE, sight)


def add_obstacle(polygons, contact, size):
    """A rectangle, or the surface opposite to the faces of the contact."""
    if contact.is_flat:
        parts, colour = cut(np.array([rectangle(contact, size)]), 12), to_rgba(OBSTACLE, .45)
    else:
        near = np.abs(contact.feet - contact.points).max(axis=1) < .5 * size
        parts, colour = [contact.feet[face] for face in contact.faces if near[face].all()], to_rgba(OBSTACLE, .2)
    for part in parts:
        polygons.add(part, colour, to_rgba("0.5", .12))


def add_reactions(polygons, contact, largest, length, sight):
    arrows = contact.arrows(largest, length)
    lengths = np.linalg.norm(arrows, axis=1)
    for tip, arrow, state in zip(contact.x, arrows, contact.rows["state"].tolist()):
        if state in ARROWS and np.linalg.norm(arrow) > 1e-3 * lengths.max():
            side = np.cross(arrow, sight)
            side *= .1 * length / max(np.linalg.norm(side), 1e-300)
            back = tip - .25 * length * arrow / np.linalg.norm(arrow)
            polygons.add(np.array([tip - arrow, tip, back + side, tip, back - side, tip]), edge=ARROWS[state])


def draw_frames(axes, bodies, scale):
    for body in bodies:
        colours = scale.map(scale.norm(scale.values(body)[body.faces].mean(axis=1)))
        axes.add_collection3d(Line3DCollection(body.points[body.faces], colors="0.75", linewidths=.6))
        axes.add_collection3d(Line3DCollection(body.x[body.faces], colors=colours, linewidths=2))


def draw(axes, shapes, scales, arrows, units, limits):
    low, high, size = *limits, float(np.linalg.norm(limits[1] - limits[0]))
    elevation, azimuth = np.radians((axes.elev, axes.azim))
    sight = np.array((np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)))
    polygons = Polygons()
    if False in scales:
        add_bodies(polygons, [body for body in shapes.bodies if not body.is_frame], scales[False], sight)
    for contact in shapes.contacts:
        if not contact.is_pair:
            add_obstacle(polygons, contact, size)
        add_reactions(polygons, contact, *arrows, sight)
    polygons.draw(axes)
    if True in scales:
        draw_frames(axes, [body for body in shapes.bodies if body.is_frame], scales[True])
    set_limits(axes, low - .03 * size, high + .03 * size, units)


def set_limits(axes, low, high, units):
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low)
    for name, extent in zip("xyz", high - low):
        axis = getattr(axes, f"{name}axis")
        axis.set_major_locator(MaxNLocator(max(1, round(6 * extent / (high - low).max()))))
        axis.set_label_text(units.label(name))
        axis.labelpad = 8
