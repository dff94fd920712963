#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs shipped scenes and draws the pictures of doc/gallery.md in doc/gallery, about 1200 dots wide.

usage: gallery.py [SCENE...]      (all of them by default)

bolted-flange is the picture of README.md, of a tutorial's scene with smaller cells.

The program is build/conetact, or what CONETACT names in the environment. Needs python3-numpy
and python3-matplotlib.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import drawing  # noqa: F401 (first: it knows the way to python/)
from conetact import run

TOP = Path(__file__).resolve().parent.parent
# other values of entries, options of picture.py; or what curve.py draws
GALLERY = {
    "inclined-obstacle": ({}, ["--increment", "12"]),
    "square-greco": ({}, []),
    "partial-slip": ({}, []),
    "fretting-wear": ({}, []),
    "stacked-blocks": ({}, []),
    "shrink-fit": ({}, []),
    "cylinder-on-plane": ({}, []),
    "block-press-shear": ({"Body block/Mesh/Arguments": "8, 8, 8 : 0, 0, 0 : 1, 1, 1 : true"}, []),
    "sphere-on-layer": ({}, []),
    "pushed-block-3d": ({"Output/VTU": 1}, []),
    "sheet-pile": ({}, []),
    "double-layer-grid-04": ({}, []),
    "floating-block": ({}, []),
    "bolt-preload": ({}, ["--increment", "10", "--amplify", "50", "--contact", "bed"]),
    "bolt-joint": ({}, ["--increment", "7", "--amplify", "100", "--contact", "joint"]),
    "dovetail": ({}, ["--increment", "4", "--amplify", "40"]),
    "disc-brake": ({"Output/VTU": 6}, ["--view", "50,-30"]),
    "block-in-groove": ({"Output/VTU": 1, "Time/Times": 0.42}, ["--view", "20,-35"]),
    "retaining-wall": ({}, []),
    "o-ring": ({}, []),
    "bracket": ({}, []),
    "masonry-pier": ({}, ["--increment", "14", "--amplify", "200"]),
    "gasket-flange": ({}, ["--increment", "28", "--amplify", "50"]),
    "brake-fade": ({}, ["--amplify", "50"]),
}
MOST_BYTES = 150000
FRONT = "bolted-flange"
FLANGE = TOP / "doc/site/tutorials/flange/flange.prm"
CURVES = {"fretting-loop": ({"Output/VTU": 0}, ["joint_f_x", "u_t1", "--near", "0.8,0"])}


def draw_front(folder):
    """The bolt and its flange in section, and the joint."""
    run(FLANGE, {f"Body {body}/Mesh/Parameters": "size = 3" for body in ("flange", "bolt")}, folder / "flange")
    subprocess.run([TOP / "scripts" / "picture.py", folder / "flange", "--clip", "y=0", "--contacts", "joint", "--percentile", "99",
                    "--view", "20,-62", "-o", TOP / "doc" / f"{FRONT}.png", "--dpi", "97"], check=True)
    make_small(TOP / "doc" / f"{FRONT}.png")


def draw(name, folder):
    if name == FRONT:
        draw_front(folder)
        return
    changes, options = (GALLERY | CURVES)[name]
    run(TOP / "parameter-files" / f"{name}.prm", changes, folder / name)
    picture = TOP / "doc" / "gallery" / f"{name}.png"
    picture.parent.mkdir(exist_ok=True)
    script, size = ("curve.py", ["--dpi", "172"]) if name in CURVES else ("picture.py", ["--dpi", "97"])
    subprocess.run([TOP / "scripts" / script, folder / name, *options, "-o", picture, *size], check=True)
    make_small(picture)


def make_small(picture):
    """With 256 colours where it is large, a third of the size then; an octree keeps the red of slip."""
    from PIL import Image
    if picture.stat().st_size < MOST_BYTES:
        return
    with Image.open(picture) as drawn:
        few = drawn.convert("RGB").quantize(256, method=Image.Quantize.FASTOCTREE)
    few.save(picture, optimize=True)


def main(names):
    known = [*GALLERY, *CURVES, FRONT]
    unknown = [name for name in names if name not in known]
    if unknown:
        sys.exit(f"gallery.py: there is no {unknown[0]} in the gallery; it has {', '.join(known)}.")
    with tempfile.TemporaryDirectory() as folder:
        for name in names or known:
            draw(name, Path(folder))


if __name__ == "__main__":
    main(sys.argv[1:])
