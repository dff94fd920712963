#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws a finished run: its deformed bodies with stresses, obstacles and reactions, and what its contacts carry.

usage: picture.py FOLDER [--increment N | all] [-o PICTURE.png] [--field QUANTITY] [--amplify A] [--film FILM.gif] ...

Left: bodies and frames, displacements (and gaps) drawn larger; arrows push the nodes they
end at. Right: normal stress and friction along each contact, in the plane divided by the
friction coefficient (both coincide where a node is about to slip), in space as a map.
`--increment all` draws every increment to PICTURE-0001.png, ... with the same scales, `--film` joins them.
Works in the plane and in space. Needs python3-numpy and python3-matplotlib; for good pictures in space also
python3-vtk9 and xvfb.
"""
import argparse
import sys
from pathlib import Path

import drawing  # noqa: F401 (first: it knows the way to python/)
import matplotlib.pyplot as plt
import numpy as np
from conetact import ConetactError, Result
from conetact.units import units_of
from drawing import contacts, film, plane, rendered, screen, space
from drawing.colours import ARROWS, scales_of
from drawing.files import save
from drawing.shapes import automatic_factor, shapes_of
from matplotlib.lines import Line2D

MAX_CONTACTS = 4


def increments_of(result, asked):
    """Those to draw; a sentence if there are none."""
    drawn = result.drawn_increments()
    if not drawn:
        if len(result.increments):
            raise ConetactError(f"{result.folder} has no drawing of an increment: run the scene with -s Output/VTU=1.")
        if list(result.folder.glob("solution-*-0000.*vtu")):
            raise ConetactError(f"{result.folder} holds the undeformed bodies only: log.txt says why no increment was solved.")
        raise ConetactError(f"{result.folder} holds no solution-*.vtu: run the scene with -s Output/VTU=1.")
    if asked == "all":
        return drawn
    increment = drawn[-1] if asked is None else int(asked)
    if increment not in drawn:
        raise ConetactError(f"{result.folder} holds no drawing of increment {increment}; there are {told(drawn)}.")
    return [increment]


def told(numbers):
    """1 to 5, 8, 11."""
    parts, begin = [], numbers[0]
    for number, behind in zip(numbers, [*numbers[1:], None]):
        if behind != number + 1:
            parts.append(f"{begin} to {number}" if number > begin else str(number))
            begin = behind
    return ", ".join(parts)


def named_contacts(shapes, names):
    """Those that get a panel, in the order of their names."""
    known = {contact.name: contact for contact in shapes.contacts}
    for name in names:
        if name not in known:
            raise ConetactError(f"There is no contact '{name}'; those of this run: {', '.join(known) or 'none'}.")
    return [known[name] for name in names]


def telling_contacts(shapes, kind_of):
    """Those that get a panel if nobody names any: all, or of many what may slip or open before what is tied, and what
    carries most; of bolts that carry about the same the first one."""
    if len(shapes.contacts) <= MAX_CONTACTS:
        return shapes.contacts
    force = {contact.name: np.abs(contact.rows["r_n"]).sum() for contact in shapes.contacts}
    tied = {contact.name: kind_of(contact.name) != "contact" for contact in shapes.contacts}

    def are_alike(one, other):
        return (len(one.rows) == len(other.rows) and tied[one.name] == tied[other.name]
                and abs(force[one.name] - force[other.name]) <= .1 * force[other.name])
    chosen = []
    for contact in sorted(shapes.contacts, key=lambda c: (tied[c.name], -force[c.name])):
        if len(chosen) < MAX_CONTACTS and not any(are_alike(contact, other) for other in chosen):
            chosen.append(contact)
    return [contact for contact in shapes.contacts if contact in chosen]


def legend(axes, largest, units, contacts):
    seen = {"stick", "slip"}.union(*(contact.rows["state"] for contact in contacts))
    handles = [Line2D([], [], color=colour, marker=r"$\rightarrow$", markersize=12, linestyle="none", label=state)
               for state, colour in ARROWS.items() if state in seen]
    title = units.label(f"reactions, the longest one {largest:.3g}", "force")
    axes.legend(handles=handles, title=title, frameon=False, fontsize="small", title_fontsize="small", ncol=2,
                loc="lower left", bbox_to_anchor=(0, 1), borderaxespad=0)


class Series:
    """Pictures of some increments with the same factor, colours and limits."""

    def __init__(self, args):
        self.result, self.args = Result(args.folder), args
        self.units = units_of(self.result, args.units)
        self.increments = increments_of(self.result, args.increment)
        self.space = self.result.dimension == 3
        self.is_rendered = self.space and screen.is_there()
        last = self.result.bodies(self.increments[-1])
        self.factor = args.amplify or automatic_factor(self.result, self.increments[-1], last)
        self.shapes = [shapes_of(self.result, n, self.factor) for n in self.increments[:-1]]
        self.shapes.append(shapes_of(self.result, self.increments[-1], self.factor, last))
        self.scales = scales_of(self.shapes, args.colour, args.percentile)
        if args.colour and args.colour not in [scale.quantity for scale in self.scales.values()]:
            names = sorted({name for body in self.shapes[0].bodies for name in body.arrays})
            raise ConetactError(f"The bodies have no quantity '{args.colour}'; there are {', '.join(names)}.")
        self.contacts = [contact for shapes in self.shapes for contact in shapes.contacts]
        self.arrows, self.limits = self._arrows_and_limits()

    def _arrows_and_limits(self):
        """Largest force and its length in the pictures; what all bodies (in space arrows, too) fill."""
        lows, highs = zip(*(shapes.limits() for shapes in self.shapes))
        low, high = np.min(lows, axis=0), np.max(highs, axis=0)
        largest = max((np.linalg.norm(contact.reactions, axis=1).max() for contact in self.contacts), default=0)
        many = self.space and sum(len(contact.x) for contact in self.shapes[0].contacts) > 50
        arrows = largest, (.06 if many else .12) * float(np.linalg.norm(high - low))
        tails = [contact.x - contact.arrows(*arrows) for contact in self.contacts if self.space]
        return arrows, (np.vstack([low, *tails]).min(axis=0), np.vstack([high, *tails]).max(axis=0))

    def layout(self, n_panels):
        """The axes of the bodies and those of contacts, in a figure of the shape of the bodies."""
        width, height = np.maximum((self.limits[1] - self.limits[0])[:2], 1e-300)
        tall = 1.0 if self.space else min(max(height / width, .5), 1.3)
        columns = 2 if n_panels else 1
        figure = plt.figure(figsize=(6.2 * columns, max(5.4 * tall + 1, 3.2 * n_panels, 4.4)), layout="constrained")
        figure.get_layout_engine().set(rect=(.01, .02, .98, .97), wspace=.04)
        shares = [2, 1] if self.space and n_panels > 1 else [1] * columns  # maps above one another are narrow
        grid = figure.add_gridspec(max(n_panels, 1), columns, width_ratios=shares)
        options = {"projection": "3d", "elev": self.args.view[0], "azim": self.args.view[1]}
        options = options if self.space and not self.is_rendered else {}
        bodies = figure.add_subplot(grid[:, 0], **options)
        return figure, bodies, [figure.add_subplot(grid[i, 1]) for i in range(n_panels)]

    def remark(self):
        prescribed = [c.name for c in self.shapes[0].contacts if c.is_pair
                      and self.result.entries.get(f"Contact {c.name}/Gap")]
        stretched = any(contact.stretched for contact in self.contacts if not contact.is_pair)
        return (f"displacements {'and gaps ' if stretched else ''}× {self.factor:g}"
                + (f"; the prescribed gap of {', '.join(prescribed)} is not drawn" if prescribed else ""))

    def contacts_on_the_right(self, shapes):
        if self.args.no_contacts:
            return []
        if self.args.contacts:
            return named_contacts(shapes, self.args.contacts)
        return telling_contacts(shapes, lambda name: self.result.entries.get(f"Contact {name}/Kind", "contact"))

    def draw(self, number, file):
        shapes, increment = self.shapes[number], self.increments[number]
        drawn = self.contacts_on_the_right(shapes)
        omitted = f"; {len(drawn)} of {len(shapes.contacts)} contacts on the right" if 1 < len(drawn) < len(shapes.contacts) else ""
        figure, axes, panels = self.layout(len(drawn))
        if not self.is_rendered:
            (space if self.space else plane).draw(axes, shapes, self.scales, self.arrows, self.units, self.limits)
        for scale in self.scales.values():
            scale.draw_bar(figure, axes, self.units)
        if self.arrows[0] > 0:
            legend(axes, self.arrows[0], self.units, shapes.contacts)
        times = self.result.increments
        time = times["time"][times["increment"] == increment][0]
        figure.suptitle(f"{self.result.folder.resolve().name}, increment {increment}, t = {time:.4g}"
                        f" ({self.remark()}{omitted})")
        for panel, contact in zip(panels, drawn):
            same = [other for other in self.contacts if other.name == contact.name]
            if self.space:
                contacts.draw_map(figure, panel, contact, same, self.units)
            else:
                contacts.draw_line(panel, contact, same, self.result, self.units)
        if self.is_rendered:
            rendered.draw(axes, shapes, self.scales, self.arrows, self.units, self.limits, self.args.view, self.args.clip,
                          self.args.dpi)
        save(figure, file, self.args.dpi)


def view(text):
    elevation, azimuth = (float(word) for word in text.split(","))
    return elevation, azimuth


def names(text):
    return [name.strip() for name in text.split(",")]


def percentile(text):
    if not 50 < float(text) <= 100:
        raise ValueError(text)
    return float(text)


def clip(text):
    """An axis as a number, and the place of the plane on it."""
    axis, _, place = text.partition("=")
    return "xyz".index(axis.strip() or "none"), float(place)


def parse(arguments):
    summary, usage, rest = __doc__.split("\n\n", 2)
    parser = argparse.ArgumentParser(usage=usage.removeprefix("usage: ").replace("picture.py", "%(prog)s"),
                                     description=f"{summary}\n\n{rest}",
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--increment", help="a number, or all; default: the last one that is drawn")
    parser.add_argument("-o", "--output", type=Path, help="default: picture.png in the folder")
    parser.add_argument("--field", "--colour", dest="colour", metavar="QUANTITY", help="what colours show: von_mises, "
                        "stress_xx, displacement, displacement_z, pressure, axial_force, moment, ...")
    parser.add_argument("--percentile", type=percentile, default=100., metavar="P", help="colours end where so many of "
                        "100 nodes are within, such as 99: one node does not spoil them")
    parser.add_argument("--clip", type=clip, action="append", default=[], metavar="AXIS=PLACE", help="in space: what is "
                        "before this plane is cut away, such as x=0.5; several times: several planes")
    parser.add_argument("--film", type=Path, metavar="FILM", help="all increments as a film, .gif or .mp4")
    parser.add_argument("--amplify", type=float, help="displacements are drawn so many times larger; default: to be seen")
    parser.add_argument("--contacts", "--contact", type=names, default=[], metavar="NAME[,NAME]...", help="only these contacts "
                        "on the right; default: all, or the four that tell most, ties last")
    parser.add_argument("--no-contacts", action="store_true", help="only the bodies")
    parser.add_argument("--dpi", type=int, default=130, help="dots an inch; default 130")
    parser.add_argument("--units", help="of length, force and stress, such as 'mm, N, MPa'; default: those of the scene")
    parser.add_argument("--view", type=view, default=(22., -60.), metavar="ELEVATION,AZIMUTH", help="in space, degrees")
    args = parser.parse_args(arguments)
    if args.increment not in (None, "all") and not args.increment.isdecimal():
        raise ConetactError(f"--increment is '{args.increment}'; it must be a number or all.")
    if args.film:
        film.check(args.film)
        args.increment = "all"
    return args


def check_clips(series):
    if series.args.clip and not series.space:
        raise ConetactError("--clip cuts bodies in space; those of this run are in the plane.")
    if series.args.clip and not series.is_rendered:
        raise ConetactError("--clip needs VTK and an X server (Debian: python3-vtk9, xvfb).")


def draw_all(series, file, numbered):
    """Pictures of all increments that are wanted; their files."""
    files = [file.with_stem(f"{file.stem}-{n:04}") if numbered else file for n in series.increments]
    for number, picture in enumerate(files):
        series.draw(number, picture)
    return files


def main(arguments):
    try:
        args = parse(arguments)
        series = Series(args)
        check_clips(series)
        if args.film:
            film.make(args.film, lambda file: draw_all(series, file, True))
        else:
            draw_all(series, args.output or args.folder / "picture.png", args.increment == "all")
    except (ConetactError, ValueError) as error:
        sys.exit(f"picture.py: {error}")


if __name__ == "__main__":
    main(sys.argv[1:])
