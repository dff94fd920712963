#!/usr/bin/python3
# SPDX-FileCopyrightText: Conetact authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How much of a pushed block slips, against the friction coefficient.

usage: slipping_part.py [--output CURVE.png]      (default: slipping-part.png)

The block of parameter-files/floating-block.prm is held by friction alone and pushed with
0.4 of the force that presses it. With a friction coefficient below 0.4 nothing holds it,
and the program says so; above, nodes slip at the side that is pushed, the fewer the rougher.
"""
import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

TOP = Path(__file__).resolve().parents[2]
sys.path.append(str(TOP / "python"))
import conetact  # noqa: E402

SCENE = TOP / "parameter-files" / "floating-block.prm"
MU = "Contact bottom/Friction coefficient"
PUSH_OVER_PRESS = .4


def slipping_part(reactions):
    """Of the area in contact."""
    closed = reactions["state"] != "open"
    return reactions["area"][reactions["state"] == "slip"].sum() / reactions["area"][closed].sum()


def draw(mu, parts, file):
    figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
    axes.plot(mu, parts, ".-")
    axes.axvline(PUSH_OVER_PRESS, color="grey", linestyle="--", label="least friction that holds the block")
    axes.set(xlabel="friction coefficient", ylabel="slipping part of the contact", ylim=(0, 1))
    axes.legend(frameon=False)
    figure.savefig(file, dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=Path, default=Path("slipping-part.png"))
    args = parser.parse_args()

    results = conetact.sweep(SCENE, {MU: [.38, .41, .43, .46, .5, .55, .6, .7, .8, 1, 1.2]}, {"Output/VTU": 0})
    held = [result for result in results if not result.error]
    mu = np.array([result.changes[MU] for result in held])
    parts = np.array([slipping_part(result.reactions) for result in held])
    for result in results:
        print(f"mu = {result.changes[MU]:<5}", result.error or f"{slipping_part(result.reactions):.3f} slips")
    draw(mu, parts, args.output)

    assert all(isinstance(result.error, conetact.AnalysisError) == (result.changes[MU] < PUSH_OVER_PRESS) for result in results)
    assert (np.diff(parts) <= 0).all(), "more friction, less slip"
    for result in held:  # the floor carries what pushes
        assert abs(result.increments["bottom_f_x"][-1] + PUSH_OVER_PRESS) < 1e-10


if __name__ == "__main__":
    main()
