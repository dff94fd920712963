# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Curves over time as drawings in the page (SVG)."""
from html import escape

import numpy as np

WIDTH, HEIGHT = 460, 270
LEFT, RIGHT, TOP, BOTTOM = 62, 10, 12, 38
MOST_CURVES = 6
MOST_POINTS = 600
ROUNDING = 1e-9


def ticks(low, high, wanted=5):
    """Round numbers between both."""
    raw = (high - low) / wanted or 1
    power = 10.0 ** np.floor(np.log10(raw))
    step = power * next(k for k in (1, 2, 5, 10) if k * power >= raw * .999)
    return [round(k * step, 12) if abs(k * step) > 1e-9 else k * step
            for k in range(int(np.ceil(low / step - 1e-9)), int(np.floor(high / step + 1e-9)) + 1)]


def limits(values):
    low, high = float(min(np.min(values), 0)), float(max(np.max(values), 0))
    room = .06 * (high - low)
    return (low - room * (low < 0), high + room * (high > 0)) if high > low else (low - 1, high + 1)


class Frame:
    """Axes of one drawing."""

    def __init__(self, x, curves):
        self.x = (float(x.min()), float(x.max())) if np.ptp(x) > 0 else (float(x[0]) - 1, float(x[0]) + 1)
        self.y = limits(np.concatenate(list(curves.values())))

    def across(self, x):
        return LEFT + (x - self.x[0]) / (self.x[1] - self.x[0]) * (WIDTH - LEFT - RIGHT)

    def up(self, y):
        return HEIGHT - BOTTOM - (y - self.y[0]) / (self.y[1] - self.y[0]) * (HEIGHT - TOP - BOTTOM)

    def drawn(self, label):
        parts = []
        for tick in ticks(*self.y):
            at = self.up(tick)
            parts.append(f'<path class="grid" d="M{LEFT} {at:.1f}H{WIDTH - RIGHT}"/>'
                         f'<text x="{LEFT - 6}" y="{at + 4:.1f}" text-anchor="end">{tick:.5g}</text>')
        for tick in ticks(*self.x, 6):
            at = self.across(tick)
            parts.append(f'<text x="{at:.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{tick:.4g}</text>')
        zero = self.up(min(max(0, self.y[0]), self.y[1]))
        parts.append(f'<path class="axis" d="M{LEFT} {zero:.1f}H{WIDTH - RIGHT}M{LEFT} {TOP}V{HEIGHT - BOTTOM}"/>'
                     f'<text x="{(LEFT + WIDTH) / 2}" y="{HEIGHT - 5}" text-anchor="middle">{escape(label)}</text>')
        return "".join(parts)


def curve(frame, x, y, i):
    step = -(-len(x) // MOST_POINTS)
    places = [f"{frame.across(a):.1f} {frame.up(b):.1f}" for a, b in zip(x[::-1][::step], y[::-1][::step])]
    marked = [p.split() for p in places] if len(places) < 40 else []
    marks = "".join(f'<circle cx="{a}" cy="{b}" r="2.6"/>' for a, b in marked)
    return f'<g class="curve c{i}"><path d="M{"L".join(places)}"/>{marks}</g>'


def drawing(title, x, curves, label="time"):
    """A figure with its legend below; nothing where all curves are 0."""
    size = max((np.abs(y).max(initial=0) for y in curves.values()), default=0)
    curves = {name: y for name, y in curves.items() if np.abs(y).max(initial=0) > ROUNDING * size}
    left_out = len(curves) - MOST_CURVES
    curves = dict(sorted(curves.items(), key=lambda c: -np.abs(c[1]).max())[:MOST_CURVES]) if left_out > 0 else curves
    if not curves or len(x) < 2:
        return ""
    frame = Frame(x, curves)
    lines = "".join(curve(frame, x, y, i) for i, y in enumerate(curves.values()))
    names = "".join(f'<span class="key c{i}">{escape(name)}</span>' for i, name in enumerate(curves))
    more = f"<span>{left_out} smaller ones are left out</span>" if left_out > 0 else ""
    return (f'<figure><figcaption>{escape(title)}</figcaption><svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" '
            f'aria-label="{escape(title)} over {escape(label)}">{frame.drawn(label)}{lines}</svg>'
            f'<div class="keys">{names}{more}</div></figure>')


def of_contacts(increments, contacts, part):
    """Forces of contacts, "f", or moments, "m", by name."""
    return {f"{name} {part}_{axis}": increments[column] for name in contacts for axis in "xyz"
            if (column := f"{name.replace(' ', '_')}_{part}_{axis}") in increments.dtype.names}


def all_curves(result, contacts, units):
    rows, label = result.increments, "load parameter p" if (result.folder / "events.csv").exists() else "time"
    x = rows["time"]
    drawn = [drawing(units.label("Forces of contacts", "force"), x, of_contacts(rows, contacts, "f"), label),
             drawing("States of contact nodes", x, {name: rows[name] for name in ("open", "stick", "slip")}, label)]
    if (result.folder / "history.csv").exists() and len(result.history) == len(rows):
        drawn += [drawing(units.label(title, kind), x, {name.replace("_", " "): result.history[name]}, label)
                  for title, kind, name in (("Largest displacement", "length", "largest_displacement"),
                                            ("Largest pressure", "stress", "largest_pressure"))]
        probes = {name: result.history[name] for name in result.history.dtype.names
                  if name[-4:] in ("_u_x", "_u_y", "_u_z")}
        drawn.append(drawing(units.label("Displacements of probes", "length"), x, probes, label))
    energies = {name.replace("_", " "): rows[name] for name in ("strain_energy", "external_work", "dissipation")
                if name in rows.dtype.names}
    return "".join([*drawn, drawing(units.label("Energy, and work of each increment", "moment"), x, energies, label)])
