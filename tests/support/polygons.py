# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Convex polygons and the integrals of a grid's functions over them."""
import itertools


def clip(subject, clipping):
    """The common part of convex polygons, anticlockwise."""
    for a, b in zip(clipping, clipping[1:] + clipping[:1]):
        def side(p):
            return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        result = []
        for p, q in zip(subject, subject[1:] + subject[:1]):
            if side(p) >= 0:
                result.append(p)
            if side(p) * side(q) < 0:
                t = side(p) / (side(p) - side(q))
                result.append((p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])))
        subject = result
    return subject


def dunavant():
    """Barycentric coordinates and weights of seven points, exact to the fifth degree."""
    yield (1 / 3, 1 / 3, 1 / 3), 9 / 40
    for sign in (1, -1):
        a = (6 + sign * 15**.5) / 21
        for at in ((a, a, 1 - 2 * a), (a, 1 - 2 * a, a), (1 - 2 * a, a, a)):
            yield at, (155 + sign * 15**.5) / 1200


def shape_values(degree, s):
    return (1 - s, s) if degree == 1 else ((1 - 2 * s) * (1 - s), 4 * s * (1 - s), s * (2 * s - 1))


def shares_under(cells, size, polygon, degree=1):
    """Integrals over a convex polygon of a grid's functions of a degree in each coordinate, by places of nodes."""
    result = {}
    step = [s / n for s, n in zip(size, cells)]
    for i, j in itertools.product(*map(range, cells)):
        part = clip([((i + a) * step[0], (j + b) * step[1]) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))], polygon)
        for p, q in zip(part[1:], part[2:]):
            o = part[0]
            area = ((p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0])) / 2
            for at, weight in dunavant():
                x, y = (sum(w * c for w, c in zip(at, coordinates)) for coordinates in zip(o, p, q))
                across = shape_values(degree, y / step[1] - j)
                for k, along in enumerate(shape_values(degree, x / step[0] - i)):
                    for m, other in enumerate(across):
                        node = i + k / degree, j + m / degree
                        result[node] = result.get(node, 0) + area * weight * along * other
    return result
