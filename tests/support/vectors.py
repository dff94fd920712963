# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Vectors of three numbers, rotations, and the tangents of the program."""
import math


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def scaled(factor, a):
    return tuple(factor * x for x in a)


def plus(*vectors):
    return tuple(map(sum, zip(*vectors)))


def unit(a):
    return scaled(1 / math.sqrt(dot(a, a)), a)


def apply(matrix, a):
    return tuple(dot(row, a) for row in matrix)


IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def rotation(axis, degrees):
    """Columns are the images of the axes."""
    n, c, s = unit(axis), math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    images = [plus(scaled(c, e), scaled(s, cross(n, e)), scaled((1 - c) * dot(n, e), n)) for e in IDENTITY]
    return tuple(zip(*images))


def tangents(n, dim):
    if dim == 2:
        return (n[1], -n[0], 0.0), (0.0, 0.0, 1.0)
    t1 = unit(cross((0, 1, 0), n) if abs(n[2]) > .9 else cross(n, (0, 0, 1)))
    return t1, cross(n, t1)
