# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The plane in which a contact in space is mapped: bores, shafts and tapers are unrolled about their axis, all else is seen
along the mean normal."""
from dataclasses import dataclass

import numpy as np

TURN = np.radians(150)  # contacts whose normals turn by less about an axis are seen from one side
WHOLE = np.radians(300)  # those that turn by more are closed
ALIKE = .08  # normals of a cone have the same angle with its axis, and radii are those of a cone, to this
ASIDE = .2  # normals point to the axis to this, as a mean of sines


@dataclass
class Sheet:
    """Places in a plane, the directions of the plane at each node, labels of both axes."""

    at: np.ndarray
    first: np.ndarray
    second: np.ndarray
    labels: tuple
    period: float = 0.  # length of the circumference where a contact is closed

    def parts(self, vectors):
        """Components of vectors of nodes in the plane."""
        return np.einsum("ij,ij->i", vectors, self.first), np.einsum("ij,ij->i", vectors, self.second)

    def triangles(self, triangles):
        """Nodes to draw as places and numbers, and triangles between them: those across the cut are at both ends."""
        n = len(self.at)
        number = np.tile(np.arange(n), 3)
        places = np.vstack([self.at + (shift * self.period, 0) for shift in (0, -1, 1)])
        if not self.period or not len(triangles):
            return places[:n], number[:n], triangles
        x = self.at[triangles, 0]
        across = np.ptp(x, axis=1) > self.period / 2
        late = x[across] > 0  # the cut is at -period/2 and period/2
        cut = triangles[across]
        both = [np.where(late, cut + n, cut), np.where(late, cut, cut + 2 * n)]
        return places, number, np.vstack([triangles[~across], *both])


def sheet_of(points, normals):
    return unrolled(points, normals) or seen_along(points, normals)


def seen_along(points, normals):
    """Along the mean normal, or the axis next to it."""
    across = int(np.abs(normals.sum(axis=0)).argmax())
    i, j = (axis for axis in range(3) if axis != across)
    unit = np.eye(3)
    return Sheet(points[:, [i, j]], *(np.tile(unit[k], (len(points), 1)) for k in (i, j)), ("xyz"[i], "xyz"[j]))


def axis_of(normals):
    """The direction along which normals differ least: those of a cylinder or cone make one angle with its axis."""
    values, directions = np.linalg.eigh(np.cov(normals.T))
    axis = directions[:, 0] * np.sign(directions[np.abs(directions[:, 0]).argmax(), 0])
    return axis if np.sqrt(max(values[0], 0)) < ALIKE and abs((normals @ axis).mean()) < .9 else None


def frame_about(axis):
    """Where angles begin (next to x, or to y about x) and the direction in which they grow."""
    start = np.eye(3)[0 if abs(axis[0]) < .9 else 1]
    start = start - (start @ axis) * axis
    start /= np.linalg.norm(start)
    return start, np.cross(axis, start)


def centre_of(places, directions):
    """The point in a plane that lines through places in these directions pass by least."""
    across = np.column_stack((-directions[:, 1], directions[:, 0]))
    centre, _, rank, _ = np.linalg.lstsq(across, np.einsum("ij,ij->i", across, places), rcond=None)
    return centre if rank == 2 else None


def is_round(radii, along):
    """Radii are those of a cylinder or a cone."""
    slope = np.polyfit(along - along.mean(), radii, 1) if np.ptp(along) > 1e-6 * radii.mean() else (0, radii.mean())
    return np.abs(np.polyval(slope, along - along.mean()) - radii).max() < ALIKE * radii.mean()


def widest_gap(angles):
    """Between neighbours on a circle: its width and its middle."""
    ordered = np.sort(angles)
    gaps = np.diff(np.concatenate((ordered, [ordered[0] + 2 * np.pi])))
    k = int(gaps.argmax())
    return gaps[k], ordered[k] + gaps[k] / 2


def unrolled(points, normals):
    """Arc length at the mean radius against the coordinate along the axis; None if the contact is no cylinder or cone."""
    axis = axis_of(normals) if len(points) > 3 else None
    if axis is None:
        return None
    e1, e2 = frame_about(axis)
    flat, turned = (np.column_stack((a @ e1, a @ e2)) for a in (points, normals))
    along, centre = points @ axis, centre_of(flat, turned / np.linalg.norm(turned, axis=1)[:, None])
    if centre is None:
        return None
    radii = np.linalg.norm(flat - centre, axis=1)
    aside = np.cross(turned, flat - centre) / np.maximum(np.linalg.norm(turned, axis=1) * radii, 1e-300)
    angles = np.arctan2(*(flat - centre).T[::-1])
    gap, middle = widest_gap(angles)
    if 2 * np.pi - gap < TURN or not is_round(radii, along) or np.sqrt((aside**2).mean()) > ASIDE:
        return None
    closed = 2 * np.pi - gap > WHOLE
    begin = -np.pi if closed else middle - 2 * np.pi * (middle > 0)
    angles = begin + np.mod(angles - begin, 2 * np.pi)
    radius = float(radii.mean())
    forwards = -np.sin(angles)[:, None] * e1 + np.cos(angles)[:, None] * e2
    return Sheet(np.column_stack((radius * angles, along)), forwards, np.tile(axis, (len(points), 1)),
                 labels_of(axis, e1, radius), 2 * np.pi * radius if closed else 0.)


def labels_of(axis, start, radius):
    def name(direction, other):
        k = int(np.abs(direction).argmax())
        return "xyz"[k] if direction[k] > 1 - 1e-6 else other
    return (f"arc length at the mean radius {radius:.4g}, from {name(start, 'the side of x')}",
            name(axis, "length along the axis"))
