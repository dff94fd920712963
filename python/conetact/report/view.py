# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Data of the view: shapes once, displacements and fields of each increment in 16 bits, all of them within a size."""
import base64
from dataclasses import dataclass, field

import numpy as np

from ..errors import ResultError
from .fields import FIRST, LESS_WANTED, described, values_of
from .meshes import shape_of

LIMIT = 16e6  # bytes of all increments; a third more as text
MOST_CELLS = 60000  # tetrahedra that a browser cuts while a slider moves
NOTHING = 65535  # in 16 bits: no value here


@dataclass
class Plan:
    """What is embedded of a run, and sentences on what is not."""

    increments: list
    filled: bool = True
    without: tuple = ()
    remarks: list = field(default_factory=list)


@dataclass
class Frame:
    """One body in one increment: the number of its shape, displacements, values by name."""

    shape: int
    displacement: np.ndarray
    values: dict


def pairs_of(result, increment):
    """Meshes of each body and of its surface, by names."""
    try:
        surfaces = result.surfaces(increment)
    except ResultError:  # bodies without faces have none
        return {}
    return {name: (mesh, surfaces[name]) for name, mesh in result.bodies(increment).items() if name in surfaces}


def frames_of(pairs, dimension, plan, shapes):
    """Frames of one increment; shapes that are not there yet are added to `shapes`, with names."""
    frames = []
    for name, (body, surface) in pairs.items():
        shape = shape_of(body, surface, dimension, plan.filled)
        known = [i for i, (other, old) in enumerate(shapes) if other == name and old.same_as(shape)]
        if not known:
            shapes.append((name, shape))
        displacement = (body if shape.whole else surface).arrays["displacement"]
        frames.append(Frame(known[-1] if known else len(shapes) - 1, displacement,
                            values_of(body, surface, shape, dimension, plan.without)))
    return frames


def size_of(frames):
    return sum(2 * len(frame.displacement) * (3 + len(frame.values)) for frame in frames)


def n_cells(pairs):
    """Tetrahedra that would fill all bodies."""
    return sum((6 if cells.shape[1] in (8, 27) else 1) * len(cells) for body, _ in pairs.values()
               for kind, cells in body.cells.items() if kind in (10, 12, 24, 29))


def plan_of(result, increments):
    """Leaves out, one after the other: strains, what is inside of bodies, increments."""
    plan, pairs, dimension = Plan(increments), pairs_of(result, increments[-1]), result.dimension

    def size():
        return len(increments) * size_of(frames_of(pairs, dimension, plan, []))
    plan.filled = dimension == 3 and 0 < n_cells(pairs) <= MOST_CELLS
    if size() > LIMIT:
        plan.without = LESS_WANTED
        plan.remarks.append("Strains are left out.")
    plan.filled = plan.filled and size() <= LIMIT
    if dimension == 3 and n_cells(pairs) and not plan.filled:
        plan.remarks.append("Only surfaces are in this page: a section shows bodies as shells.")
    step = int(np.ceil(size() / LIMIT))
    if step > 1:
        plan.increments = increments[::-1][::step][::-1]
        plan.remarks.append(f"{len(plan.increments)} of {len(increments)} increments that have pictures are in this "
                            f"page, every {step}th one.")
    return plan


def encoded(array, kind):
    return base64.b64encode(np.ascontiguousarray(array, kind).tobytes()).decode()


def in_16_bits(values, low, high):
    scaled = np.round((values - low) / ((high - low) or 1) * (NOTHING - 1))
    return encoded(np.where(np.isfinite(values), np.clip(scaled, 0, NOTHING - 1), NOTHING), "<u2")


def ranges(film):
    """Least and largest value of each quantity, in all bodies and increments."""
    found = {}
    for frame in (frame for frames in film for frame in frames):
        for name, values in frame.values.items():
            finite = values[np.isfinite(values)]
            if len(finite):
                low, high = found.get(name, (np.inf, -np.inf))
                found[name] = min(low, float(finite.min())), max(high, float(finite.max()))
    return found


def displacement_fields(film, dimension, units):
    """Its size and its components, which the page computes from what moves the bodies."""
    moved = [frame.displacement for frames in film for frame in frames]
    found = [("displacement", -1, [np.linalg.norm(u, axis=1) for u in moved]),
             *((f"displacement {axis}", i, [u[:, i] for u in moved]) for i, axis in enumerate("xyz"[:dimension]))]
    return [{"name": name, "title": name, "unit": units.names.get("length", ""), "kind": "displacement", "axis": axis,
             "low": min(float(v.min(initial=0)) for v in values), "high": max(float(v.max(initial=0)) for v in values)}
            for name, axis, values in found]


def described_fields(found, units):
    """Those that were wanted first come first."""
    names = [name for name in FIRST if name in found] + [name for name in found if name not in FIRST]
    return [{**described(name, units), "low": found[name][0], "high": found[name][1]} for name in names]


def described_shape(name, shape):
    parts = ("triangles", "edges", "outline", "lines", "border", "cells")
    data = {part: encoded(getattr(shape, part), "<u4") for part in parts}
    return {"name": name, "points": encoded(shape.points, "<f4"), **data}


def described_frame(frame, found, reach):
    values = {name: in_16_bits(v, *found[name]) for name, v in frame.values.items() if name in found}
    return {"shape": frame.shape, "moved": in_16_bits(frame.displacement, -reach, reach), "values": values}


def nice(factor):
    """1, 2 or 5 times a power of ten, at most that large."""
    if not np.isfinite(factor) or factor < 2:
        return 1.0
    power = 10.0 ** np.floor(np.log10(factor))
    return float(power * max(k for k in (1, 2, 5) if k * power <= factor * (1 + 1e-9)))


def view_of(result, units):
    """Data for viewer.js, or None where no body was drawn; and remarks."""
    increments = result.drawn_increments() or [0]
    if not pairs_of(result, increments[-1]):
        return None, []
    plan, shapes = plan_of(result, increments), []
    if increments == [0]:
        plan.remarks.append("The bodies are undeformed: no increment was drawn.")
    film = [frames_of(pairs_of(result, n), result.dimension, plan, shapes) for n in plan.increments]
    found = ranges(film)
    reach = max(float(np.abs(frame.displacement).max(initial=0)) for frames in film for frame in frames)
    every = np.vstack([shape.points for _, shape in shapes])
    times = dict(zip(result.increments["increment"].tolist(), result.increments["time"].tolist()))
    data = {"dimension": result.dimension, "length": units.names.get("length", ""), "reach": reach,
            "factor": nice(float(np.linalg.norm(np.ptp(every, axis=0))) / (10 * reach)) if reach else 1,
            "filled": any(len(shape.cells) for _, shape in shapes),
            "fields": displacement_fields(film, result.dimension, units) + described_fields(found, units),
            "shapes": [described_shape(*shape) for shape in shapes],
            "increments": [{"number": n, "time": times.get(n, 0)} for n in plan.increments],
            "film": [[described_frame(frame, found, reach) for frame in frames] for frames in film]}
    return data, plan.remarks
