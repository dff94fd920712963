# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of half cylinders whose surface is a parabola, fine at the line of contact; of dies."""
import itertools

from support.meshes import write_msh


def graded(step, fine, size, growth=1.25):
    """Coordinates from 0 to size, uniform up to `fine`, growing beyond."""
    x = [k * step for k in range(round(fine / step) + 1)]
    steps = []
    while sum(steps) < size - x[-1]:
        step *= growth
        steps.append(step)
    factor = (size - x[-1]) / sum(steps)
    for s in steps:
        x.append(x[-1] + s * factor)
    return x


def half_cylinder(file, step, radius, size, sign):
    """Half of a body whose surface is a parabola, x from 0: below (sign -1) or above y = 0. Ids 1 surface, 2 end, 3 middle."""
    xs, ys = graded(step, 1.5, size), graded(step, 1.0, size)
    number = {}
    points = []
    for (i, x), (j, y) in itertools.product(enumerate(xs), enumerate(ys)):
        number[i, j] = len(points)
        points.append((x, sign * (y + x * x / (2 * radius) * (1 - y / size)), 0.0))
    turn = (lambda quad: quad) if sign > 0 else (lambda quad: quad[::-1])
    cells = [turn([number[i, j], number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]])
             for i in range(len(xs) - 1) for j in range(len(ys) - 1)]
    last = len(ys) - 1
    faces = [(tag, [number[i, j], number[i + 1, j]]) for tag, j in ((1, 0), (2, last)) for i in range(len(xs) - 1)]
    faces += [(3, [number[0, j], number[0, j + 1]]) for j in range(last)]
    write_msh(file, 2, points, cells, faces)


def die(file, cells, size, radius, bottom=0.0):
    """A block whose underside is a parabola, lowest at x = 0. Ids 1 underside, 2 top."""
    (n, m), (width, height) = cells, size
    places = [(width * (i / n - .5), j / m) for i in range(n + 1) for j in range(m + 1)]
    points = [(x, bottom + height * y + x * x / (2 * radius) * (1 - y), 0.0) for x, y in places]
    quads = [[i * (m + 1) + j, (i + 1) * (m + 1) + j, (i + 1) * (m + 1) + j + 1, i * (m + 1) + j + 1]
             for i in range(n) for j in range(m)]
    faces = [(tag, [i * (m + 1) + j, (i + 1) * (m + 1) + j]) for tag, j in ((1, 0), (2, m)) for i in range(n)]
    write_msh(file, 2, points, quads, faces)
