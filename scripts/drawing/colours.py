# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What colours mean: a quantity on bodies, one on members of frames, contact states."""
import matplotlib
import numpy as np
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.ticker import MaxNLocator

ROUNDING = 1e-8  # of the size of a field: what varies by less is uniform
STATES = {"open": ("0.55", "o"), "stick": ("black", "s"), "slip": ("crimson", "D"), "bonded": ("seagreen", "^"),
          "wet": ("royalblue", "v")}
ARROWS = {state: colour for state, (colour, _) in STATES.items() if state != "open"}
OBSTACLE = "0.82"
TITLES = {"von_mises": "von Mises stress", "pressure": "pressure in the body", "axial_force": "axial force",
          "axial_stress": "axial stress", "moment": "bending moment"}


def choose_quantity(bodies, asked):
    """The one that is asked for where these bodies have it, or von Mises' stress; of frames moments, or axial forces."""
    if asked and all(asked in body.arrays for body in bodies):
        return asked
    if not bodies[0].is_frame:
        return "von_mises"
    moments = [np.abs(body.arrays[name]).max() for body in bodies for name in body.arrays if name.startswith("moment")]
    return "moment" if max(moments) > 1e-9 * largest(bodies, "axial_force") and all(
        "moment" in body.arrays for body in bodies) else "axial_force"


def largest(bodies, name):
    return max(np.abs(body.arrays[name]).max() for body in bodies)


class Scale:
    """Colours of one quantity, the same for all bodies (and pictures of a series) that have it."""

    def __init__(self, quantity, low, high, beyond=False):
        self.quantity, self.beyond = quantity, beyond
        if low < 0 < high:  # signs are told apart
            low, high = -max(-low, high), max(-low, high)
        self.map = matplotlib.colormaps["coolwarm" if low < 0 < high else "viridis"]
        self.uniform = None
        if high - low <= ROUNDING * max(-low, high):
            self.uniform = (low + high) / 2
            self.map = ListedColormap([self.map(.5)])
            around = abs(self.uniform) or 1
            low, high = self.uniform - around, self.uniform + around
        self.norm = Normalize(low, high)

    def values(self, body):
        values = body.arrays[self.quantity]
        return np.linalg.norm(values, axis=1) if values.ndim > 1 else values

    def draw_bar(self, figure, axes, units):
        title = TITLES.get(self.quantity, self.quantity.replace("_", " "))
        kind = units.label(self.quantity)[len(self.quantity):]
        mappable = matplotlib.cm.ScalarMappable(self.norm, self.map)
        bar = figure.colorbar(mappable, ax=axes, label=title + kind, location="bottom", shrink=.7, aspect=32, pad=.03,
                              extend="both" if self.beyond else "neither")
        if self.uniform is not None:
            bar.set_ticks([self.uniform], labels=[f"{self.uniform:.6g}"])
            return bar
        bar.locator = MaxNLocator(6)
        bar.formatter.set_powerlimits((-3, 4))
        bar.formatter.set_useOffset(False)
        bar.update_ticks()
        return bar


def limits_of(values, percentile):
    """Least and largest value; with a percentile those that only few nodes are beyond."""
    return np.percentile(values, (100 - percentile, percentile)) if percentile < 100 else (values.min(), values.max())


def scales_of(series, asked, percentile=100):
    """For continua (False) and frames (True) of a series of shapes."""
    scales = {}
    for frames in (False, True):
        bodies = [body for shapes in series for body in shapes.bodies if body.is_frame == frames]
        if bodies:
            scale = Scale(choose_quantity(bodies, asked), 0, 1)
            values = np.concatenate([scale.values(body) for body in bodies])
            scales[frames] = Scale(scale.quantity, *limits_of(values, percentile), percentile < 100)
    return scales
