# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hertz contact of a quarter of a block on a rigid parabola, as other programs need it.

The scene is that of tests/support/half_space.py with equal cells.
"""
import sys
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import measure  # noqa: E402,F401  knows the way to tests/support
from calculix_mortar import value  # noqa: E402
from support import half_space  # noqa: E402

HERTZ = SimpleNamespace(size=half_space.SIZE, radius=half_space.RADIUS, poisson=half_space.POISSON["hertz"],
                        force=half_space.Hertz(3, half_space.POISSON["hertz"], 1).force / 4)
MOTION = half_space.hertz(3, 2, 0)["Support far"]["Displacement"].split(" ; ")


def far_motion(place):
    """What the far sides are moved by, as in the half space."""
    return [value(function, place) for function in MOTION]


def is_candidate(place):
    """Whether a node of the bottom may touch."""
    return place[0]**2 + place[1]**2 < 1.25**2
