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


def shares_under(cells, size, polygon):
    """Integrals of the bilinear functions of a grid over a convex polygon."""
    result = {}
    step = [s / n for s, n in zip(size, cells)]
    for i, j in itertools.product(*map(range, cells)):
        corner = [(i + a, j + b) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        part = clip([(x * step[0], y * step[1]) for x, y in corner], polygon)
        for p, q in zip(part[1:], part[2:]):
            o = part[0]
            area = ((p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0])) / 2
            middles = [((a[0] + b[0]) / 2, (a[1] + b[1]) / 2) for a, b in ((o, p), (p, q), (q, o))]
            for x, y in middles:  # exact to the second degree
                s, t = x / step[0] - i, y / step[1] - j
                for (k, m), N in zip(corner, ((1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t)):
                    result[k, m] = result.get((k, m), 0) + area / 3 * N
    return result
